//! One way of light from a point to a point, and what it brings.

use glam::DVec3;
use light::{Spectrum, fresnel};

use super::refraction_point::crossing;
use super::transmitted;
use crate::Water;

/// How the widening of a bundle of rays through the surface is reckoned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paths {
    /// As it is (in place of 3.11 and 3.12).
    #[default]
    Exact,
    /// As the thesis prints it (3.11, 3.12), which holds only straight down from a source at the surface: up to 10 times too much.
    Thesis,
}

/// Which way light takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Straight, in one medium.
    Direct,
    /// By the surface as a mirror, in one medium.
    Mirrored,
    /// Through the surface.
    Refracted,
}

/// One way of light from a source to a receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Which way it is.
    pub way: Way,
    /// Unit vector along which light leaves the source.
    pub leaving: DVec3,
    /// Unit vector at the receiver towards where light comes from.
    pub toward: DVec3,
    /// Where it meets the surface \[m\]; none if it does not.
    pub at_surface: Option<DVec3>,
    /// Length of the way in air \[m\].
    pub air: f64,
    /// Length of the way under water \[m\].
    pub water: f64,
    /// Share that the surface lets through or mirrors, within \[0, 1\]; 1 for direct light.
    pub share: f64,
    /// Irradiance on a plane that faces the light, over intensity, with nothing lost at the surface or in the water \[1/m²\].
    pub spread: f64,
}

impl Leg {
    /// Irradiance on a plane that faces the arriving light \[W m⁻² nm⁻¹\], of a source of `intensity` along [`Leg::leaving`]
    /// \[W sr⁻¹ nm⁻¹\], in water that takes `coefficient` \[1/m\] of it ([`Water::loss`] says which).
    pub fn irradiance(&self, intensity: Spectrum, coefficient: Spectrum) -> Spectrum {
        intensity * coefficient.attenuate(self.water as f32) * (self.share * self.spread) as f32
    }
}

/// The horizontal surface that light meets; for waves see [`crate::caustics`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Height y of the surface \[m\].
    pub level: f64,
    /// Index of refraction of the water relative to air, ≥ 1.
    pub index: f64,
}

impl Surface {
    /// The surface of `water` at height `level` \[m\].
    pub fn of(water: &Water, level: f64) -> Self {
        Self { level, index: water.index() }
    }

    /// True for points under water; the surface itself is in air.
    pub fn is_below(&self, point: DVec3) -> bool {
        point.y < self.level
    }

    /// Every way from `source` to `receiver`: through the surface, or direct and mirrored. None where the two coincide.
    pub fn legs(&self, source: DVec3, receiver: DVec3, paths: Paths) -> [Option<Leg>; 2] {
        if self.is_below(source) == self.is_below(receiver) {
            [self.direct(source, receiver), self.mirrored(source, receiver)]
        } else {
            [self.refracted(source, receiver, paths), None]
        }
    }

    /// Straight from one to the other on one side (3.9, 3.13); which side the source says.
    pub fn direct(&self, source: DVec3, receiver: DVec3) -> Option<Leg> {
        let way = receiver - source;
        let length = way.length();
        let leaving = unit(way, length)?;
        let below = self.is_below(source);
        Some(Leg {
            way: Way::Direct,
            leaving,
            toward: -leaving,
            at_surface: None,
            air: if below { 0.0 } else { length },
            water: if below { length } else { 0.0 },
            share: 1.0,
            spread: 1.0 / (length * length),
        })
    }

    /// By the surface as a mirror, above (3.10) or below it (3.14); which side the source says.
    pub fn mirrored(&self, source: DVec3, receiver: DVec3) -> Option<Leg> {
        let (h1, h2) = ((source.y - self.level).abs(), (receiver.y - self.level).abs());
        let below = self.is_below(source);
        let up = if below { -1.0 } else { 1.0 };
        let across = DVec3::new(receiver.x - source.x, 0.0, receiver.z - source.z);
        let way = across - DVec3::Y * (up * (h1 + h2));
        let length = way.length();
        let leaving = unit(way, length)?;
        let cos = (h1 + h2) / length;
        let share = if h1 + h2 > 0.0 { h1 / (h1 + h2) } else { 0.5 };
        Some(Leg {
            way: Way::Mirrored,
            leaving,
            toward: DVec3::new(-leaving.x, leaving.y, -leaving.z),
            at_surface: Some(self.point(source, across * share)),
            air: if below { 0.0 } else { length },
            water: if below { length } else { 0.0 },
            share: fresnel(if below { 1.0 / self.index } else { self.index }, cos),
            spread: 1.0 / (length * length),
        })
    }

    /// Through the surface, from air into water or out of it; which side the source says.
    ///
    /// With r₁ and θ₁ on the source's side, r₂ and θ₂ on the receiver's, n = n₂/n₁ and T = 1 − α, a plane that faces the light gets
    ///
    ///   E = I T n² cos θ₁ cos θ₂ / ((n r₁ + r₂)(n r₁ cos² θ₂ + r₂ cos² θ₁))
    ///
    /// since the bundle seems to come from r₂ + n r₁ away across the plane of incidence, from r₂ + n r₁ cos² θ₂/cos² θ₁ away within it.
    /// The thesis has I T n²/(cos θ₂ (r₁ + r₂)²) downwards (3.11), I T cos θ₁/(n_w² (r₁ + r₂)²) upwards (3.12).
    pub fn refracted(&self, source: DVec3, receiver: DVec3, paths: Paths) -> Option<Leg> {
        let (h1, h2) = ((source.y - self.level).abs(), (receiver.y - self.level).abs());
        let down = !self.is_below(source);
        let (height, depth) = if down { (h1, h2) } else { (h2, h1) };
        let across = DVec3::new(receiver.x - source.x, 0.0, receiver.z - source.z);
        let distance = across.length();
        if distance + height + depth == 0.0 || !(distance + height + depth).is_finite() {
            return None;
        }
        let path = crossing(self.index, height, depth, distance);
        let sides = [(path.air, path.cos_air, path.run_air), (path.water, path.cos_water, path.run_water)];
        let [(r1, cos_1, run_1), (r2, cos_2, _)] = if down { sides } else { [sides[1], sides[0]] };
        let n = if down { self.index } else { 1.0 / self.index };
        let spread = match paths {
            Paths::Exact => {
                let (c1, c2) = (cos_1 * cos_1, cos_2 * cos_2);
                n * n * cos_1 * cos_2 / ((n * r1 + r2) * (n * r1 * c2 + r2 * c1))
            }
            Paths::Thesis if down => n * n / (cos_2 * (r1 + r2) * (r1 + r2)),
            Paths::Thesis => n * n * cos_1 / ((r1 + r2) * (r1 + r2)),
        };
        let flat = if distance > 0.0 { across / distance } else { DVec3::ZERO };
        let fall = if down { -1.0 } else { 1.0 };
        let along = |cos: f64, sin: f64| flat * sin + DVec3::Y * (fall * cos);
        let [sin_1, sin_2] =
            if down { [path.sin_air, path.sin_air / n] } else { [path.sin_air * n, path.sin_air] };
        Some(Leg {
            way: Way::Refracted,
            leaving: along(cos_1, sin_1),
            toward: -along(cos_2, sin_2),
            at_surface: Some(self.point(source, flat * run_1)),
            air: path.air,
            water: path.water,
            share: transmitted(n, cos_1, cos_2),
            // Along the surface nothing gets through, and 0/0 is nothing.
            spread: if spread.is_finite() { spread } else { 0.0 },
        })
    }

    fn point(&self, foot: DVec3, across: DVec3) -> DVec3 {
        DVec3::new(foot.x + across.x, self.level, foot.z + across.z)
    }
}

/// `way` of `length` made 1; none where there is no way, or no finite one.
fn unit(way: DVec3, length: f64) -> Option<DVec3> {
    (length > 0.0 && length.is_finite()).then(|| way / length)
}
