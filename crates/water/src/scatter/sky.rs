//! The sky's light scattered once along a view ray.

use glam::Vec3;
use light::Spectrum;

use super::fade::fading_slope;
use super::{Scattering, ViewRay};
use crate::daylight::{Rays, Table};

/// The sky's light that water scatters into each direction at each depth (thesis 3.32, repaired):
///
///   S(z, u) = ∫ β(Θ) (1 − α) (cos θ/cos θ') L(ω) e^(−κ z sec θ') dω
///
/// tabulated once; shadows are ignored. For view rays that look down, as those from above the surface do, Θ is beyond 84° and S is
/// smooth; of rays that look up into Snell's cone the table blurs the forward peak over some 10°.
pub struct ScatteredSky {
    scattering: Scattering,
    rays: Rays,
    table: Table,
    /// Scalar irradiance, of which what is scattered more than once is a share; where it is wanted.
    scalar: Option<Table>,
}

impl ScatteredSky {
    /// The sky of `radiance` \[W m⁻² sr⁻¹ nm⁻¹\] by unit vector, asked at 540 directions above the horizon. Takes some 0.1 s.
    pub fn new(scattering: Scattering, radiance: impl Fn(Vec3) -> Spectrum) -> Self {
        let rays = Rays::new(scattering.surface(), radiance);
        let table = Table::new(&rays, scattering.coefficient(), |direction, toward| {
            scattering.scattered(toward.as_dvec3(), direction.as_dvec3())
        });
        let often = !scattering.evenly.is_zero();
        let scalar = often.then(|| Table::new(&rays, scattering.coefficient(), |_, _| Spectrum::ONE));
        Self { scattering, rays, table, scalar }
    }

    /// The water that scatters it.
    pub fn scattering(&self) -> &Scattering {
        &self.scattering
    }

    /// Radiance per metre scattered towards the eye at `depth` \[m\] of a view ray with unit vector `direction` \[W m⁻³ sr⁻¹ nm⁻¹\],
    /// in deep water.
    pub fn source(&self, depth: f64, direction: Vec3) -> Spectrum {
        let common = self.scattering.coefficient().attenuate(depth.max(0.0) as f32);
        self.without_common_loss(depth.max(0.0), direction, self.scattering.evenly) * common
    }

    fn without_common_loss(&self, depth: f64, direction: Vec3, evenly: Spectrum) -> Spectrum {
        let once = self.table.without_common_loss(depth, direction);
        self.scalar.as_ref().map_or(once, |scalar| once + evenly * scalar.without_common_loss(depth, Vec3::Y))
    }

    /// The same by summing up all rays: the slow reference.
    pub fn source_by_rays(&self, depth: f64, direction: Vec3) -> Spectrum {
        let (depth, coefficient) = (depth.max(0.0), self.scattering.coefficient());
        let kernel = |toward: Vec3| {
            self.scattering.scattered(toward.as_dvec3(), direction.as_dvec3()) + self.scattering.evenly
        };
        self.rays.sum(depth, coefficient, kernel) * coefficient.attenuate(depth as f32)
    }

    /// Radiance at P of the sky's light scattered along `ray` \[W m⁻² sr⁻¹ nm⁻¹\]: in closed form between the depths of the
    /// table, where all but the exponentials is linear.
    pub fn radiance(&self, ray: &ViewRay) -> Spectrum {
        let first = self.scattering.depth(ray.from);
        let (down, direction) = (-ray.direction.y, ray.direction.as_vec3());
        let coefficient = self.scattering.coefficient();
        let mut sum = Spectrum::ZERO;
        let evenly = self.scattering.evenly(ray);
        let mut before = (0.0, self.without_common_loss(first, direction, evenly));
        for end in self.ends(first, down, ray.length) {
            let after = (end, self.without_common_loss(first + end * down, direction, evenly));
            let piece = |b: usize| {
                let k = f64::from(coefficient[b]);
                let lost = (-k * (first + before.0 * (1.0 + down))).exp();
                let [from, to] = [before.1[b], after.1[b]].map(f64::from);
                (lost * fading_slope(from, to, k * (1.0 + down), after.0 - before.0)) as f32
            };
            sum += Spectrum(std::array::from_fn(piece));
            before = after;
        }
        sum
    }

    /// Distances along a ray from depth `first`, going down by `down` per metre, at which it crosses tabulated depths, and its end.
    fn ends(&self, first: f64, down: f64, length: f64) -> Vec<f64> {
        // Beyond the deepest twice over nothing is left; a level ray stays at one depth.
        let deepest = self.table.depths().last().copied().unwrap_or(0.0);
        let length = length.min(1e3 * (deepest + 1.0));
        let crossing = |depth: &f64| (depth - first) / down;
        let mut ends: Vec<f64> =
            self.table.depths().iter().map(crossing).filter(|r| *r > 0.0 && *r < length).collect();
        ends.push(length);
        ends.sort_by(f64::total_cmp);
        ends
    }
}
