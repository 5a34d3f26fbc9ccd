//! What one sees of a wavy surface.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use light::{Arrival, Hit, Shade, Spectrum, Surroundings, fresnel, reflect, refract};

use super::sight::{Sight, Way};
use super::{Covariance, Facet, Waves};
use crate::Surface;

/// Facets count as seen under this cosine at least: more grazing ones are behind others.
const GRAZING: f64 = 1e-3;

/// A wavy surface, by its level outline: what it mirrors, and what comes through it (3.21 without its cos θ_j, as
/// [`crate::flat::SurfaceShade`] has it), with the facet that the eye's ray meets first.
///
/// The facet is the mean over what the ray stands for: waves shorter than that fade. How facets vary within it widens the
/// bundles of rays that go on, and makes the sun's and lamps' mirror images glitter (Cox and Munk 1954): with the probability p of slopes,
///
///   L = α E p / (4 (v·m/m_y) h_y⁴),
///
/// h halfway between the eye's direction v and the light's, m the mean normal; p is a normal distribution with the covariance of the slopes, the disc's own
/// added. Rays that waves send into their own side's surface meet it once more there, as if it were level: so nothing is
/// lost. Share of what is mirrored is that of the mean facet.
///
/// *Errors.* Rays go on from the level outline and not from the facet: what is seen in and through the surface is moved sideways by up
/// to the waves' height times the ray's lean. A crest that the ray touches over less than 1/64 of a wave, or 1/4096 of its way between the heights
/// that waves reach (of importance below 1° of elevation), may be missed. Waves do not rise over the rim of the outline.
pub struct WavyShade {
    surface: Surface,
    waves: Arc<Waves>,
}

impl WavyShade {
    /// Of waves on this surface.
    pub fn new(surface: Surface, waves: Arc<Waves>) -> Self {
        Self { surface, waves }
    }

    /// The facet that shows at a hit of the level outline.
    fn facet(&self, hit: &Hit) -> Facet {
        let toward = hit.toward_eye.as_dvec3();
        let footprint = footprint(hit);
        // Upwards or downwards: the eye's side.
        let side = if hit.place.normal.y > 0.0 { 1.0 } else { -1.0 };
        let hit_at = hit.place.position.as_dvec3();
        let run = DVec2::new(toward.x, toward.z);
        let rise = (side * toward.y).max(GRAZING);
        let way = Way { at: DVec2::new(hit_at.x, hit_at.z), run, rise, side };
        Sight::new(&self.waves, footprint, way).met(f64::from(hit.distance))
    }
}

/// Where in the surface the bundle of a hit meets it: its width across, and that over the cosine along the ray.
fn footprint(hit: &Hit) -> Covariance {
    let toward = hit.toward_eye.as_dvec3();
    let width = f64::from(hit.width);
    let cos = toward.y.abs().max(GRAZING);
    let along = DVec2::new(toward.x, toward.z).normalize_or_zero();
    Covariance::even(width).and(along, width * width / 12.0 * (1.0 / (cos * cos) - 1.0))
}

impl Shade for WavyShade {
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let above = hit.place.normal.y > 0.0;
        let toward = hit.toward_eye.as_dvec3();
        let facet = self.facet(hit);
        let mut normal = if above { facet.normal() } else { -facet.normal() };
        let turned = GRAZING - toward.dot(normal);
        if turned > 0.0 {
            normal = (normal + toward * turned).normalize();
        }
        let eta = if above { self.surface.index } else { 1.0 / self.surface.index };
        let mirrored = fresnel(eta, toward.dot(normal).clamp(0.0, 1.0)) as f32;
        let onward = Onward { index: self.surface.index, hit: widened(hit, &facet), around };
        let mut sum = glints(hit, (&facet, normal), eta, around);
        if mirrored > 0.0 {
            sum += onward.seen(reflect(-toward, normal), above, mirrored, 2.0) * mirrored;
        }
        let passes = 1.0 - mirrored;
        if passes > 0.0
            && let Some(direction) = refract(-toward, normal, eta)
        {
            let bend = (1.0 - 1.0 / eta).abs() as f32;
            let radiance = onward.seen(direction, !above, passes, bend);
            sum += radiance * (f64::from(passes) / (eta * eta)) as f32;
        }
        sum
    }
}

/// The hit with as much curvature as turns its normal by what slopes differ by within it: √12 deviations, as of an even spread.
fn widened(hit: &Hit, facet: &Facet) -> Hit {
    let turn = (6.0 * (facet.spread.xx + facet.spread.zz)).sqrt() as f32;
    let bare = Hit { curvature: 1.0, ..*hit }.turn();
    Hit { curvature: if bare > 0.0 { turn / bare } else { 0.0 }, ..*hit }
}

/// Rays that go on from a hit.
struct Onward<'a> {
    index: f64,
    hit: Hit,
    around: &'a dyn Surroundings,
}

impl Onward<'_> {
    /// Radiance that comes back along `direction`, in air or in water; one that goes into the surface is turned there once more.
    fn seen(&self, direction: DVec3, in_air: bool, share: f32, bend: f32) -> Spectrum {
        let side = if in_air { 1.0 } else { -1.0 };
        if direction.y * side > 0.0 {
            return self.along(direction, share, bend);
        }
        let eta = if in_air { self.index } else { 1.0 / self.index };
        let cos = direction.y.abs();
        let mirrored = fresnel(eta, cos) as f32;
        // What is level stays just out of the surface.
        let back = DVec3::new(direction.x, side * cos.max(1e-6), direction.z).normalize();
        let mut sum = Spectrum::ZERO;
        if mirrored > 0.0 {
            sum += self.along(back, share * mirrored, bend) * mirrored;
        }
        let passes = 1.0 - mirrored;
        if passes > 0.0
            && let Some(through) = refract(direction, DVec3::Y * side, eta)
        {
            let radiance = self.along(through, share * passes, bend);
            sum += radiance * (f64::from(passes) / (eta * eta)) as f32;
        }
        sum
    }

    fn along(&self, direction: DVec3, share: f32, bend: f32) -> Spectrum {
        let direction = direction.as_vec3().normalize();
        let ray = self.hit.place.leave(direction, f32::INFINITY);
        self.around.radiance(&ray, self.hit.path.then(share, &self.hit, bend))
    }
}

/// Mirror images of what sends beams, as facets within the hit show them.
fn glints(hit: &Hit, (facet, mean): (&Facet, DVec3), eta: f64, around: &dyn Surroundings) -> Spectrum {
    let toward = hit.toward_eye.as_dvec3();
    let side = hit.place.normal.as_dvec3();
    let mut sum = Spectrum::ZERO;
    around.beams(&hit.place, &mut |arrival| {
        let Arrival::Beam { toward: light, irradiance, radius: Some(radius) } = arrival else { return };
        let half = (toward + light.as_dvec3()).normalize_or_zero();
        if light.as_dvec3().dot(side) <= 0.0 || half.dot(side) <= GRAZING {
            return;
        }
        let slope = DVec2::new(-half.x, -half.z) / half.y;
        // A disc turns the half vector by up to half its radius: a fourth of that's square is its variance.
        let disc = f64::from(radius).powi(2) / 16.0;
        let spread = Covariance { xx: facet.spread.xx + disc, zz: facet.spread.zz + disc, ..facet.spread };
        let seen = toward.dot(mean) / mean.y.abs();
        let share = fresnel(eta, toward.dot(half).clamp(0.0, 1.0));
        let dense = share * density(&spread, slope - facet.slope) / (4.0 * seen * half.y.powi(4));
        sum += irradiance * dense as f32;
    });
    sum
}

/// Density of a normal distribution with this covariance about 0; 0 where it has no extent.
fn density(spread: &Covariance, at: DVec2) -> f64 {
    let det = spread.xx * spread.zz - spread.xz * spread.xz;
    if det.is_nan() || det <= 1e-18 {
        return 0.0;
    }
    let inverse = Covariance { xx: spread.zz / det, xz: -spread.xz / det, zz: spread.xx / det };
    (-0.5 * inverse.along(at)).exp() / (TAU * det.sqrt())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use light::{Path, Place, Ray};
    use proptest::prelude::*;

    use super::*;
    use crate::waves::Stokes;

    /// A sky of 1, and n² from below; or a beam alone.
    struct Furnace {
        index: f32,
        beam: Option<Arrival>,
    }

    impl Surroundings for Furnace {
        fn arrivals(&self, _: &Place, receive: &mut dyn FnMut(Arrival)) {
            self.beam.iter().for_each(|beam| receive(*beam));
        }

        fn radiance(&self, ray: &Ray, _: Path) -> Spectrum {
            let radiance = if ray.direction.y > 0.0 { 1.0 } else { self.index * self.index };
            Spectrum::splat(if self.beam.is_some() { 0.0 } else { radiance })
        }
    }

    fn hit(toward_eye: DVec3, width: f32) -> Hit {
        let normal = if toward_eye.y > 0.0 { Vec3::Y } else { Vec3::NEG_Y };
        let place = Place { position: Vec3::new(0.3, 0.0, -0.8), error: 0.0, normal, seed: 0 };
        Hit { width, ..Hit::plain(place, toward_eye.as_vec3(), 10.0) }
    }

    fn shade(amplitude: f64, turn: f64) -> WavyShade {
        let wave = |angle: f64, phase| Stokes::new(amplitude, 1.0, DVec2::from_angle(angle), phase).unwrap();
        let waves = Waves::new(vec![wave(turn, turn), wave(turn + 1.3, 2.0)], DVec2::ZERO);
        WavyShade::new(Surface { level: 0.0, index: 1.34 }, Arc::new(waves))
    }

    proptest! {
        #[test]
        fn a_furnace_shows_no_waves(
            up in -1.0..1.0f64, angle in 0.0..TAU, turn in 0.0..TAU, amplitude in 0.0..0.05f64, width in 0.0..0.3f32,
        ) {
            prop_assume!(up.abs() > 0.01);
            let level = (1.0 - up * up).sqrt();
            let toward = DVec3::new(level * angle.cos(), up, level * angle.sin());
            let furnace = Furnace { index: 1.34, beam: None };
            let got = shade(amplitude, turn).radiance(&hit(toward, width), &furnace);
            let expected = if up > 0.0 { 1.0 } else { 1.34 * 1.34 };
            // f32 products and sums of up to four rays.
            prop_assert!((got[0] / expected - 1.0).abs() < 2e-6, "{}", got[0]);
        }
    }

    #[test]
    fn the_facet_is_the_first_on_the_way() {
        let shade = shade(0.03, 0.4);
        for (up, angle) in [(0.15, 0.3f64), (0.3, 2.0), (0.8, 4.0), (-0.4, 1.0)] {
            let level = (1.0f64 - up * up).sqrt();
            let toward = DVec3::new(level * angle.cos(), up, level * angle.sin());
            let hit = hit(toward, 0.0);
            let got = shade.facet(&hit);
            // By small steps from where no wave reaches.
            let mut back = shade.waves.highest() / up.abs();
            let met = loop {
                let at = hit.place.position.as_dvec3() + toward * back;
                let facet = shade.waves.facet(DVec2::new(at.x, at.z), super::super::POINT);
                if (at.y - facet.height) * up.signum() <= 0.0 {
                    break facet;
                }
                back -= 1e-5;
            };
            // Met within a step of 1e-5: the slope changes by k times its own, and twice that in sharp crests.
            let bound = 1e-5 * 2.0 * TAU * shade.waves.steepest();
            assert!((got.slope - met.slope).length() < bound, "{up}: {:?} {:?}", got.slope, met.slope);
            assert!(met.normal().dot(toward) * up.signum() > 0.0);
        }
    }

    #[test]
    fn glitter_is_all_that_is_mirrored() {
        // ∫ L cos θ dω over all eyes = ∫ α E (l·n)/n_y p(slope) dslope; waves far shorter than the footprint, ka = 0.057 each.
        let shade = shade(0.009, 0.0);
        let light = DVec3::new(0.3, 0.9, 0.2).normalize();
        let beam = Arrival::Beam { toward: light.as_vec3(), irradiance: Spectrum::ONE, radius: Some(0.0) };
        let furnace = Furnace { index: 1.34, beam: Some(beam) };
        let (rings, turns) = (600, 600);
        let mut sum = 0.0;
        for i in 0..rings {
            for j in 0..turns {
                let up = (f64::from(i) + 0.5) / f64::from(rings);
                let (s, c) = ((f64::from(j) + 0.5) / f64::from(turns) * TAU).sin_cos();
                let toward = DVec3::new((1.0 - up * up).sqrt() * c, up, (1.0 - up * up).sqrt() * s);
                let got = shade.radiance(&hit(toward, 20.0), &furnace)[0];
                sum += f64::from(got) * up * TAU / f64::from(rings * turns);
            }
        }
        let level = fresnel(1.34, light.y) * light.y;
        // The mean over slopes is the level facet's but for half of σ² times curvatures of about 1, and facets past the horizon.
        println!("{:.5}", sum / level - 1.0);
        assert!((sum / level - 1.0).abs() < 0.01, "{sum} {level}");
    }
}
