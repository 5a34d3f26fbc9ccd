//! The sky as bundles of rays under water.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};
use light::Spectrum;

use crate::Surface;
use crate::path::transmitted;
use crate::quadrature::points;

/// Azimuths of each ring.
const AZIMUTHS: usize = 36;

/// Rays of one zenith angle.
pub(crate) struct Ring {
    /// 1/cos of the angle from the zenith under water.
    pub(crate) sec: f64,
    /// Unit vector towards where the ray comes from, under water, and irradiance just under the surface on a plane that faces it
    /// \[W m⁻² nm⁻¹\].
    pub(crate) rays: Vec<(Vec3, Spectrum)>,
}

/// The sky through a horizontal surface: 15 rings of 36 rays within Snell's cone.
///
/// Rings are Kronrod's points in the cosine of the zenith angle in *air*, over which T cos θ/cos θ' is smooth up to the horizon.
/// A sky that varies within 10° (near the sun) is sampled there, not resolved.
pub(crate) struct Rays(pub(crate) Vec<Ring>);

impl Rays {
    pub(crate) fn new(surface: &Surface, radiance: impl Fn(Vec3) -> Spectrum) -> Self {
        let n = surface.index;
        let ring = |(cos, weight): (f64, f64)| {
            let below = ((n - 1.0) * (n + 1.0) + cos * cos).sqrt() / n;
            let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
            // dω = dcos dφ; (1 − α) cos θ/cos θ' as in 3.7.
            let share = transmitted(n, cos, below) * cos / below * weight * TAU / AZIMUTHS as f64;
            let ray = |i: usize| {
                let (east, north) = (TAU * (i as f64 + 0.5) / AZIMUTHS as f64).sin_cos();
                let air = DVec3::new(sin * east, cos, -sin * north);
                let toward = DVec3::new(air.x / n, below, air.z / n);
                (toward.as_vec3(), radiance(air.as_vec3()) * share as f32)
            };
            Ring { sec: 1.0 / below, rays: (0..AZIMUTHS).map(ray).collect() }
        };
        Self(points().map(ring).into())
    }

    /// Σ E · kernel(towards where it comes from) over all rays, each with the loss of its way down to `depth` but for
    /// e^(−K z), which they have in common.
    pub(crate) fn sum(
        &self,
        depth: f64,
        coefficient: Spectrum,
        kernel: impl Fn(Vec3) -> Spectrum,
    ) -> Spectrum {
        let ring = |ring: &Ring| {
            let inner: Spectrum = ring.rays.iter().map(|&(toward, facing)| facing * kernel(toward)).sum();
            inner * coefficient.attenuate((depth * (ring.sec - 1.0)) as f32)
        };
        self.0.iter().map(ring).sum()
    }
}
