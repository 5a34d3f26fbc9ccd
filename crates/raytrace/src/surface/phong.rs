//! The thesis' own surface: Phong's, with its energy accounted for.

use std::f32::consts::{FRAC_1_PI, PI};

use light::{Arrival, Hit, Shade, Spectrum, Surroundings};

use super::normals::{facing, shading_normal, terminator};

/// Diffuse reflection with a highlight around the mirror direction (thesis eq. 2.1, k_d and k_s).
///
///   f = k_d/π + k_s (n + 2)/(2π) cosⁿ α
///
/// α is the angle between the light and the eye's mirror direction. Reciprocal; (n + 2)/(2π) makes the
/// highlight reflect k_s head on and less at grazing, so that k_d + k_s ≤ 1 never reflects more than
/// arrives (Lafortune and Willems 1994). Extended light is reflected evenly, (k_d + k_s) E/π.
///
/// ```
/// use keikan_raytrace::surface::Phong;
/// use light::Spectrum;
/// let tiles = Phong { diffuse: Spectrum::splat(0.4), specular: Spectrum::splat(0.1), exponent: 50.0 };
/// assert!(tiles.diffuse.max() + tiles.specular.max() <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    /// k_d per band, ≥ 0.
    pub diffuse: Spectrum,
    /// k_s per band, ≥ 0; k_d + k_s ≤ 1.
    pub specular: Spectrum,
    /// n ≥ 0: the greater, the smaller the highlight.
    pub exponent: f32,
}

impl Shade for Phong {
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let normal = shading_normal(hit, None);
        let mirror = normal * (2.0 * normal.dot(hit.toward_eye)) - hit.toward_eye;
        let agreement = normal.dot(hit.place.normal);
        let n = self.exponent.max(0.0);
        let mut radiance = Spectrum::ZERO;
        around.arrivals(&facing(&hit.place, normal), &mut |arrival| match arrival {
            Arrival::Beam { toward, irradiance, .. } => {
                let cos = toward.dot(normal);
                let fade = terminator(toward.dot(hit.place.normal), cos, agreement);
                let peak = mirror.dot(toward).clamp(0.0, 1.0).powf(n) * (n + 2.0) / (2.0 * PI);
                let f = self.diffuse * FRAC_1_PI + self.specular * peak;
                radiance += irradiance * f * (cos.max(0.0) * fade);
            }
            Arrival::Field { irradiance } => {
                radiance += irradiance * (self.diffuse + self.specular) * FRAC_1_PI;
            }
        });
        radiance
    }
}
