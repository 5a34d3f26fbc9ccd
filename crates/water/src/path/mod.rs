//! How light of a point source gets to a point: direct, mirrored at the surface, or through it (thesis 3.9 to 3.17).

mod leg;
mod refraction_point;
#[cfg(test)]
mod tests;

pub use leg::{Leg, Paths, Surface, Way};
pub use refraction_point::{Crossing, crossing, crossing_thesis};

/// Share of unpolarised light that passes the surface, 1 − α, from the cosines on both sides and n = n₂/n₁ of the side that it goes to.
///
///   T = 2 n c₁ c₂ (1/(c₁ + n c₂)² + 1/(n c₁ + c₂)²)
///
/// The same from both sides, and without the loss of digits of 1 − α where α is near 1.
pub(crate) fn transmitted(n: f64, cos_1: f64, cos_2: f64) -> f64 {
    if cos_1 <= 0.0 || cos_2 <= 0.0 {
        return 0.0;
    }
    let (s, p) = (cos_1 + n * cos_2, n * cos_1 + cos_2);
    2.0 * n * cos_1 * cos_2 * (1.0 / (s * s) + 1.0 / (p * p))
}
