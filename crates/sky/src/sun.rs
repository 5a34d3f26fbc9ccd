//! The sun: a disc of one radiance, so that shadows have penumbrae.

use std::f32::consts::PI;

use glam::Vec3;
use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum};

use crate::sampling::{disc, lattice, shift, transmit};

/// Mean angular diameter of the sun's disc \[degrees\]; 0.524 in July to 0.542 in January.
pub const DIAMETER_DEG: f32 = 0.533;

/// Keeps the sun's random choices apart from those of other sources.
const PURPOSE: u32 = 0x53;

/// The sun as a light source.
///
/// The disc has the same radiance everywhere (its darker limb is left out). It arrives as one beam from its
/// centre, however many samples look for what hides it: the directions within it differ by 0.27° at most,
/// i.e. by less than half a percent of the irradiance facing it. What of the disc is below the horizon
/// (the plane y = 0) gives no light, and the beam then comes from the part that is left.
///
/// ```
/// use glam::Vec3;
/// use light::{Illuminate, Place, Spectrum, Vacuum};
/// use keikan_sky::{DIAMETER_DEG, Sun, atmosphere::direct_beam};
/// let toward = Vec3::new(0.0, 0.5, -(0.75f32.sqrt())); // 30° high in the north
/// let sun = Sun { toward, irradiance: direct_beam(30.0, 0.0, 0.1), angular_diameter_deg: DIAMETER_DEG, samples: 16 };
/// let ground = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 1 };
/// let share = sun.irradiance(&ground, &Vacuum)[3] / sun.irradiance[3];
/// assert!((share - 0.5).abs() < 1e-6); // sin 30°
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector towards the centre of the disc.
    pub toward: Vec3,
    /// Irradiance of the whole disc on a plane that faces it \[W m⁻² nm⁻¹\].
    pub irradiance: Spectrum,
    /// Diameter of the disc \[degrees\], at most 90; 0 = a point, which is never seen itself.
    pub angular_diameter_deg: f32,
    /// Rays towards the disc for each place: 1 gives hard shadows (from the centre), 16 penumbrae with a
    /// noise of some 5 % of full sun within them, and cost grows in proportion.
    pub samples: u32,
}

impl Sun {
    /// sin of the disc's angular radius.
    fn sin_radius(&self) -> f32 {
        (0.5 * self.angular_diameter_deg.clamp(0.0, 90.0)).to_radians().sin()
    }

    /// Share of the disc above the horizon, within \[0, 1\].
    ///
    /// The part of a unit circle above a line at distance x below its centre: 1 − (acos x − x √(1 − x²))/π.
    fn risen(&self) -> f32 {
        let x = self.toward.y / self.sin_radius();
        if x.is_nan() || x.abs() >= 1.0 {
            return f32::from(self.toward.y > 0.0);
        }
        1.0 - (x.acos() - x * (1.0 - x * x).sqrt()) / PI
    }

    /// The directions of the disc that are above the horizon, for one seed; where a sliver is that none has met, its middle.
    fn directions(&self, seed: u32) -> impl Iterator<Item = Vec3> {
        let missed = self.sampled(seed).next().is_none();
        self.sampled(seed).chain(missed.then(|| self.sliver()))
    }

    /// Halfway between the horizon and the disc's upper edge.
    fn sliver(&self) -> Vec3 {
        let height = (0.5 * (self.toward.y + self.sin_radius())).max(0.0);
        let level = self.toward.with_y(0.0).normalize_or(Vec3::NEG_Z);
        level * (1.0 - height * height).sqrt() + Vec3::Y * height
    }

    fn sampled(&self, seed: u32) -> impl Iterator<Item = Vec3> {
        let sin = self.sin_radius();
        let count = if sin > 0.0 { self.samples.max(1) } else { 1 };
        let spread = if count > 1 { sin } else { 0.0 };
        let (across, along) = self.toward.any_orthonormal_pair();
        let (toward, offset) = (self.toward, shift(seed, PURPOSE));
        (0..count)
            .map(move |i| {
                let [x, y] = disc(lattice(i, count, offset)).map(|x| x * spread);
                across * x + along * y + toward * (1.0 - x * x - y * y).sqrt()
            })
            // A single sample stands for the disc wherever its centre is.
            .filter(move |direction| count == 1 || direction.y > 0.0)
    }
}

impl Illuminate for Sun {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let risen = self.risen();
        let sin = self.sin_radius();
        // Nothing is up, or the whole disc is behind the place's plane.
        if risen <= 0.0 || self.toward.dot(place.normal) < -sin || self.irradiance.is_zero() {
            return;
        }
        let (mut count, mut sum) = (0u32, Vec3::ZERO);
        for direction in self.directions(place.seed) {
            count += 1;
            sum += direction;
        }
        let toward =
            if self.toward.y >= sin { self.toward } else { sum.try_normalize().unwrap_or(self.toward) };
        let rays = self.directions(place.seed).filter(|d| d.dot(place.normal) > 0.0);
        let rays = rays.map(|direction| (place.leave(direction, f32::INFINITY), ()));
        let mut through = Spectrum::ZERO;
        transmit(occlude, rays, |(), transmittance| through += transmittance);
        if !through.is_zero() {
            let irradiance = self.irradiance * through * (risen / count as f32);
            receive(Arrival::Beam { toward, irradiance, radius: Some(sin.asin()) });
        }
    }

    /// L = E / (π sin² r) within the disc: a plane that faces it receives E.
    fn radiance(&self, ray: &Ray) -> Spectrum {
        let sin = self.sin_radius();
        // The chord between unit vectors, 2 sin(γ/2), keeps its digits where the cosine is near 1.
        let half_angle = 0.5 * (0.5 * self.angular_diameter_deg.clamp(0.0, 90.0)).to_radians();
        let within = ray.direction.distance(self.toward) <= 2.0 * half_angle.sin();
        if sin > 0.0 && within && ray.direction.y > 0.0 {
            self.irradiance * (1.0 / (PI * sin * sin))
        } else {
            Spectrum::ZERO
        }
    }
}

#[cfg(test)]
mod tests {
    use light::Vacuum;

    use super::*;

    fn at_altitude(degrees: f32) -> Vec3 {
        let h = degrees.to_radians();
        Vec3::new(0.0, h.sin(), -h.cos())
    }

    fn sun(altitude: f32, samples: u32) -> Sun {
        Sun {
            toward: at_altitude(altitude),
            irradiance: Spectrum::ONE,
            angular_diameter_deg: DIAMETER_DEG,
            samples,
        }
    }

    const PLACE: Place = Place { position: Vec3::ZERO, error: 1e-6, normal: Vec3::Y, seed: 3 };

    /// Blocks what goes to the side x > 0.
    struct HalfScreen;

    impl Occlude for HalfScreen {
        fn transmittance(&self, segment: &Ray) -> Spectrum {
            if segment.direction.x > 0.0 { Spectrum::ZERO } else { Spectrum::ONE }
        }
    }

    #[test]
    fn an_open_place_receives_e_times_the_cosine_without_noise() {
        for samples in [1, 5, 64, 100] {
            let e = sun(30.0, samples).irradiance(&PLACE, &Vacuum)[0];
            // Sums of up to 100 equal terms, each rounded once.
            assert!((e - 0.5).abs() <= 100.0 * f32::EPSILON, "{samples}: {e}");
        }
    }

    #[test]
    fn the_disc_seen_integrates_to_the_irradiance_facing_it() {
        let sun = sun(45.0, 1);
        let steps = 400;
        let size = 0.012_f32; // a square a little larger than the disc (0.0093 rad)
        let (across, along) = sun.toward.any_orthonormal_pair();
        let mut e = 0.0;
        for i in 0..steps * steps {
            let x = ((i % steps) as f32 + 0.5) / steps as f32 - 0.5;
            let y = ((i / steps) as f32 + 0.5) / steps as f32 - 0.5;
            let direction = (sun.toward + (across * x + along * y) * size).normalize();
            let radiance = sun.radiance(&Ray::new(Vec3::ZERO, direction))[0];
            e += f64::from(radiance) * f64::from(size / steps as f32).powi(2);
        }
        // Cells on the rim are all or nothing: perimeter/area of the disc in cells, 2 h/r = 1.3 %, at most,
        // and mostly cancelling.
        assert!((e - 1.0).abs() < 0.013, "{e}");
    }

    #[test]
    fn half_hidden_means_half_the_light() {
        for samples in [16, 64, 256] {
            for seed in 0..8 {
                let e = sun(90.0, samples).irradiance(&Place { seed, ..PLACE }, &HalfScreen)[0];
                // The edge through the centre meets fewer than 2 √n of the n evenly spread samples; on them
                // alone can the count be wrong, by half of them.
                assert!((e - 0.5).abs() <= 1.0 / (samples as f32).sqrt(), "{samples}: {e}");
            }
        }
    }

    #[test]
    fn it_sets_gradually_and_stays_down() {
        let mut last = 1.0;
        for i in 0..=60 {
            let sun = sun(0.3 - 0.01 * i as f32, 64);
            let risen = sun.risen();
            assert!((0.0..=1.0).contains(&risen) && risen <= last);
            // At most the middle's width: 0.01°/0.2665° · 2/π = 2.4 % a step.
            assert!(last - risen <= 0.025);
            last = risen;
        }
        assert_eq!(last, 0.0);
        // Half of it is up when its centre is on the horizon; x rounds to within a few 1e-8.
        assert!((sun(0.0, 1).risen() - 0.5).abs() < 1e-6);
        let wall = Place { normal: Vec3::NEG_Z, ..PLACE };
        assert!((sun(0.0, 64).irradiance(&wall, &Vacuum)[0] - 0.5).abs() < 1e-3, "cos 0.2° and rounding");
        assert_eq!(sun(-0.3, 64).irradiance(&wall, &Vacuum), Spectrum::ZERO);
        assert_eq!(sun(-90.0, 64).irradiance(&wall, &Vacuum), Spectrum::ZERO);
    }

    #[test]
    fn a_point_is_on_or_off_and_never_seen() {
        let point = Sun { angular_diameter_deg: 0.0, ..sun(20.0, 64) };
        assert!((point.irradiance(&PLACE, &Vacuum)[0] - 20f32.to_radians().sin()).abs() < 1e-6);
        assert_eq!(point.radiance(&Ray::new(Vec3::ZERO, point.toward)), Spectrum::ZERO);
        assert_eq!(Sun { toward: at_altitude(-1.0), ..point }.irradiance(&PLACE, &Vacuum), Spectrum::ZERO);
    }

    #[test]
    fn nothing_arrives_from_behind() {
        let ceiling = Place { normal: Vec3::NEG_Y, ..PLACE };
        assert_eq!(sun(30.0, 16).irradiance(&ceiling, &Vacuum), Spectrum::ZERO);
    }
}
