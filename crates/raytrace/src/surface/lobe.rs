//! The microfacet lobe: Trowbridge-Reitz (GGX) facets with Smith's height-correlated shadowing.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

/// Smallest width α: a highlight no sharper than the sun's disc (radius 0.0047 rad) itself.
///
/// It keeps the radiance of a point source's highlight finite; mirror images are found by rays instead.
pub(crate) const LEAST_WIDTH: f64 = 0.0047;

/// Width α of the distribution of facet slopes for a perceptual roughness within \[0, 1\].
pub(crate) fn width(roughness: f32) -> f32 {
    (roughness * roughness).max(LEAST_WIDTH as f32)
}

/// What of a lobe depends on the two directions, but for Fresnel's factor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lobe {
    /// D G / (4 cos θ_i cos θ_o) \[1/sr\].
    pub(crate) density: f32,
    /// Cosine between either direction and the facet that mirrors one into the other.
    pub(crate) cos_facet: f32,
}

/// The lobe between unit vectors `out` and `toward`, both above the plane of unit `normal`.
///
///   D = α² / (π (sin² θ_h + α² cos² θ_h)²),
///   G/(4 cos_i cos_o) = ½ / (cos_i √(α² + (1−α²) cos_o²) + cos_o √(α² + (1−α²) cos_i²))
///
/// Walter et al. 2007, Heitz 2014. Symmetric in the two directions.
pub(crate) fn lobe(normal: Vec3, out: Vec3, toward: Vec3, width: f32) -> Lobe {
    let half = (out + toward).normalize_or(normal);
    let squared = width * width;
    let cos_half = normal.dot(half);
    // sin² from the cross product: 1 − cos² would leave nothing of a narrow lobe in f32.
    let spread = normal.cross(half).length_squared() + squared * cos_half * cos_half;
    let facets = squared / (std::f32::consts::PI * spread * spread);
    let (i, o) = (normal.dot(toward), normal.dot(out));
    let slope = |cos: f32| (squared + (1.0 - squared) * cos * cos).sqrt();
    let masking = 0.5 / (i * slope(o) + o * slope(i));
    // The same number from either side, so that the lobe is reciprocal to the bit.
    let cos_facet = (0.5 * (half.dot(out) + half.dot(toward))).clamp(0.0, 1.0);
    Lobe { density: facets * masking, cos_facet }
}

/// Points of the quadrature in [`reflected`].
const POINTS: usize = 1024;

/// (√5 − 1)/2
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Share of light from one direction that facets of Fresnel factor `fresnel(cos)` reflect once.
///
/// `cos_out` within (0, 1\]. The mean of F G₂/G₁ over the facets visible from that direction, taken at the
/// points of a golden lattice in their uniform parametrisation (Dupuy and Benyoub 2023), in f64: no lobe is
/// too narrow for it. Within 0.25 %: facets that mirror below the surface end the integrand steeply.
pub(crate) fn reflected(cos_out: f64, width: f64, fresnel: impl Fn(f64) -> f64) -> f64 {
    let out = DVec3::new((1.0 - cos_out * cos_out).max(0.0).sqrt(), 0.0, cos_out);
    let stretched = (out * DVec3::new(width, width, 1.0)).normalize();
    let smith = |cos: f64| {
        let tan2 = (1.0 - cos * cos).max(0.0) / (cos * cos);
        0.5 * ((1.0 + width * width * tan2).sqrt() - 1.0)
    };
    let masked = smith(cos_out);
    let mut sum = 0.0;
    for i in 0..POINTS {
        let (u, v) = ((i as f64 + 0.5) / POINTS as f64, i as f64 * GOLDEN % 1.0);
        let z = (1.0 - u) * (1.0 + stretched.z) - stretched.z;
        let (sin, cos) = (2.0 * PI * v).sin_cos();
        let cap = DVec3::new(cos, sin, 0.0) * (1.0 - z * z).max(0.0).sqrt() + DVec3::Z * z + stretched;
        let facet = (cap * DVec3::new(width, width, 1.0)).normalize();
        let cos_facet = out.dot(facet);
        let toward = facet * (2.0 * cos_facet) - out;
        if toward.z > 0.0 {
            sum += fresnel(cos_facet.clamp(0.0, 1.0)) * (1.0 + masked) / (1.0 + masked + smith(toward.z));
        }
    }
    sum / POINTS as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(cos: f64, turn: f64) -> Vec3 {
        let sin = (1.0 - cos * cos).sqrt();
        Vec3::new((sin * turn.cos()) as f32, (sin * turn.sin()) as f32, cos as f32)
    }

    /// ∫ density cos dω by the midpoint rule in cos² and azimuth.
    fn integral(out: Vec3, width: f32, steps: usize) -> f64 {
        let mut sum = 0.0;
        for i in 0..steps * steps {
            let cos = ((i / steps) as f64 + 0.5) / steps as f64;
            let toward = direction(cos.sqrt(), 2.0 * PI * ((i % steps) as f64 + 0.5) / steps as f64);
            sum += f64::from(lobe(Vec3::Z, out, toward, width).density);
        }
        sum * PI / (steps * steps) as f64
    }

    #[test]
    fn sampling_facets_and_integrating_directions_agree() {
        for roughness in [0.5f32, 0.7, 1.0] {
            for cos in [0.2, 0.5, 0.9, 1.0] {
                let width = width(roughness);
                let sampled = reflected(cos, f64::from(width), |_| 1.0);
                let integrated = integral(direction(cos, 0.3), width, 400);
                // The lattice's stated error; the other sum's is far smaller at these widths.
                assert!((sampled - integrated).abs() < 0.0025, "{roughness} {cos}: {sampled} {integrated}");
            }
        }
    }

    #[test]
    fn a_narrow_lobe_reflects_what_its_mirror_does() {
        for cos in [0.3, 0.6, 1.0] {
            let mirror = light::fresnel(1.5, cos);
            let lobe = reflected(cos, LEAST_WIDTH, |cos| light::fresnel(1.5, cos));
            // Facets lean by up to some 3 α; F changes by less than 2 a radian of lean here, mostly cancelling.
            assert!((lobe - mirror).abs() < LEAST_WIDTH, "{cos}: {lobe} {mirror}");
        }
    }

    #[test]
    fn highlights_of_point_sources_are_finite() {
        let top = lobe(Vec3::Z, Vec3::Z, Vec3::Z, width(0.0));
        // D(0)/4 = 1/(4 π α²).
        let exact = 1.0 / (4.0 * PI * LEAST_WIDTH * LEAST_WIDTH);
        assert!((f64::from(top.density) / exact - 1.0).abs() < 1e-5, "f32 rounding of ten operations");
    }
}
