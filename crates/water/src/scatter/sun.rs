//! The sun's light scattered once along a view ray.

use light::Spectrum;

use super::fade::fading;
use super::{Scattering, ViewRay};
use crate::SunBelow;

impl Scattering {
    /// Radiance at P of the sun's light scattered along `ray`, where it is lit \[W m⁻² sr⁻¹ nm⁻¹\] (thesis 3.30, 3.31).
    ///
    /// `lit` are distances along the ray \[m\], from and to. With θ' the sun's and θ_j the view ray's angle
    /// from the vertical, z_P the depth of P:
    ///
    ///   L = E₀ sec θ' β(Θ) Σ ∫ e^(−κ (z_P sec θ' + r (1 + cos θ_j sec θ'))) dr
    ///
    /// ```
    /// use glam::DVec3;
    /// use keikan_water::{Loss, Scattering, SunBelow, ViewRay, Water};
    /// use light::Spectrum;
    /// let sea = Scattering::new(Water::named("jerlov-II").unwrap(), 0.0, Loss::Diffuse);
    /// let sun = SunBelow::new(sea.surface(), DVec3::Y, Spectrum::ONE).unwrap();
    /// let down = ViewRay { from: DVec3::ZERO, direction: DVec3::NEG_Y, length: f64::INFINITY };
    /// let radiance = sea.sun(&sun, &down, &[[0.0, f64::INFINITY]]);
    /// let closed = sun.horizontal * sea.water().volume_scattering(-1.0) / (2.0 * sea.coefficient());
    /// assert!((radiance[2] / closed[2] - 1.0).abs() < 1e-6); // B.1 in deep water; f32
    /// ```
    pub fn sun(&self, sun: &SunBelow, ray: &ViewRay, lit: &[[f64; 2]]) -> Spectrum {
        let sec = 1.0 / sun.toward.y;
        let depth = self.depth(ray.from);
        let faster = 1.0 - ray.direction.y * sec;
        let reached = |k: f64| -> f64 {
            let piece = |&[from, to]: &[f64; 2]| {
                let (from, to) = (from.max(0.0), to.min(ray.length));
                if from < to { fading(k * (depth * sec + from * faster), k * faster, to - from) } else { 0.0 }
            };
            lit.iter().map(piece).sum()
        };
        let along = Spectrum(self.coefficient.0.map(|k| reached(f64::from(k)) as f32));
        let scattered = self.scattered(sun.toward, ray.direction) + self.evenly(ray);
        sun.horizontal * along * scattered * sec as f32
    }
}
