//! The sky under water.

use glam::Vec3;
use light::Spectrum;

use super::{Rays, Table};
use crate::Surface;

/// What the sky gives surfaces under water, by depth and normal (thesis 3.7):
///
///   E(z, N) = ∫ (1 − α) (cos θ/cos θ') (V'·N)⁺ e^(−K z sec θ') L(ω) dω
///
/// over the sky above, V' the direction after refraction. The surface is horizontal and endless and nothing stands in the way,
/// so the place does not matter: it is tabulated once.
///
/// The table's error (`the_table_is_as_good_as_its_rays`) is below 1 % of what a horizontal plane gets there.
pub struct SkyBelow {
    rays: Rays,
    coefficient: Spectrum,
    table: Table,
}

impl SkyBelow {
    /// The sky of `radiance` \[W m⁻² sr⁻¹ nm⁻¹\] by unit vector (asked at 540 directions above the horizon) in water that
    /// takes `coefficient` \[1/m\]: K = a + b_b of [`crate::Loss::Diffuse`] for what lights things. Takes some 0.1 s.
    pub fn new(surface: &Surface, coefficient: Spectrum, radiance: impl Fn(Vec3) -> Spectrum) -> Self {
        let rays = Rays::new(surface, radiance);
        let table =
            Table::new(&rays, coefficient, |normal, toward| Spectrum::splat(normal.dot(toward).max(0.0)));
        Self { rays, coefficient, table }
    }

    /// Irradiance `depth` \[m\] below the surface on a plane of unit normal `normal` \[W m⁻² nm⁻¹\].
    pub fn irradiance(&self, depth: f64, normal: Vec3) -> Spectrum {
        self.table.value(depth, normal)
    }

    /// The same by summing up all rays: the slow reference.
    pub fn irradiance_by_rays(&self, depth: f64, normal: Vec3) -> Spectrum {
        let depth = depth.max(0.0);
        let kernel = |toward: Vec3| Spectrum::splat(normal.dot(toward).max(0.0));
        self.rays.sum(depth, self.coefficient, kernel) * self.coefficient.attenuate(depth as f32)
    }

    /// Scalar irradiance from above, of a small ball \[W m⁻² nm⁻¹\].
    pub fn scalar_irradiance(&self, depth: f64) -> Spectrum {
        let depth = depth.max(0.0);
        self.rays.sum(depth, self.coefficient, |_| Spectrum::ONE) * self.coefficient.attenuate(depth as f32)
    }
}
