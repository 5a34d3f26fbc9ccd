//! The lobe of beams: Trowbridge-Reitz (GGX) facets with Smith's height-correlated shadowing, and the small disc that a
//! point source shows in a mirror.

use std::f32::consts::PI;

use glam::{DVec3, Vec3};

/// Smallest width α of rough facets. What is smoother turns into a mirror, which shows sources as they are, without the
/// long tail that facets of this kind have: it would veil all else that the mirror shows.
pub(crate) const LEAST_WIDTH: f64 = 0.0047;

/// Width α of the distribution of facet slopes for a perceptual roughness within \[0, 1\].
pub(crate) fn width(roughness: f32) -> f32 {
    (roughness * roughness).max(LEAST_WIDTH as f32)
}

/// The slopes of a surface, as a bundle of rays sees them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facets {
    /// Width α of the rough part.
    width: f32,
    /// Angle by which the half vector turns across the bundle \[rad\].
    turn: f32,
    /// Share of the rough part, within \[0, 1\].
    rough: f32,
}

impl Facets {
    /// Of a perceptual roughness within \[0, 1\].
    pub(crate) fn new(roughness: f32, turn: f32) -> Self {
        let rough = (roughness * roughness / LEAST_WIDTH as f32).min(1.0);
        Self { width: width(roughness), turn, rough }
    }

    /// Their distribution as a source of angular radius `radius` \[rad\] shows it.
    ///
    /// What spreads a highlight adds up as variances do: facets, the turn δ of the surface across the bundle, and the
    /// source, of which the half vector sees half the angle.
    ///
    ///   rough    α'² = α² + 2 σ² + 2 ρ²,   σ = δ/2 (Kaplanyan et al. 2016), ρ = radius/4 (a disc's along an axis)
    ///   smooth   R² = δ²/2 + radius²/2:    the least circle around a square bundle, and the kernel of a disc's variance
    fn of(&self, radius: f32) -> Slopes {
        let more = 0.5 * self.turn * self.turn;
        let widest = self.width.max(BLUREST);
        Slopes {
            rough2: (self.width * self.width + more + 0.125 * radius * radius).min(widest * widest),
            smooth2: (more + 0.5 * radius * radius).min(BLUREST * BLUREST),
            // An ideal mirror shows an ideal point as a point, which has no area.
            shares: [self.rough, if radius > 0.0 { 1.0 - self.rough } else { 0.0 }],
        }
    }
}

/// No bundle makes facets wider than this: a highlight as large as a hemisphere is none.
const BLUREST: f32 = 0.5;

/// A distribution of slopes: rough and smooth.
struct Slopes {
    /// α².
    rough2: f32,
    /// R².
    smooth2: f32,
    shares: [f32; 2],
}

impl Slopes {
    /// Density \[1/sr\]: D = α² / (π (sin² θ_h + α² cos² θ_h)²), and 3/(π R²) (1 − sin² θ_h/R²)² within R.
    fn density(&self, sin2: f32, cos: f32) -> f32 {
        let spread = sin2 + self.rough2 * cos * cos;
        let rough = self.rough2 / (PI * spread * spread);
        let within = if sin2 < self.smooth2 { 1.0 - sin2 / self.smooth2 } else { 0.0 };
        let smooth = if within > 0.0 { 3.0 / (PI * self.smooth2) * within * within } else { 0.0 };
        self.shares[0] * rough + self.shares[1] * smooth
    }

    /// √(α² + (1−α²) cos²) of Smith's shadowing.
    fn slope(&self, cos: f32) -> f32 {
        let squared = self.shares[0] * self.rough2 + self.shares[1] * self.smooth2;
        (squared + (1.0 - squared) * cos * cos).sqrt()
    }
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
///   G/(4 cos_i cos_o) = ½ / (cos_i √(α² + (1−α²) cos_o²) + cos_o √(α² + (1−α²) cos_i²))
///
/// Walter et al. 2007, Heitz 2014. Symmetric in the two directions.
/// `radius` is that of the source \[rad\].
pub(crate) fn lobe(normal: Vec3, out: Vec3, toward: Vec3, facets: &Facets, radius: f32) -> Lobe {
    let facets = facets.of(radius);
    let half = (out + toward).normalize_or(normal);
    // sin² from the cross product: 1 − cos² would leave nothing of a narrow lobe in f32.
    let density = facets.density(normal.cross(half).length_squared(), normal.dot(half));
    let (i, o) = (normal.dot(toward), normal.dot(out));
    let masking = 0.5 / (i * facets.slope(o) + o * facets.slope(i));
    // The same number from either side, so that the lobe is reciprocal to the bit.
    let cos_facet = (0.5 * (half.dot(out) + half.dot(toward))).clamp(0.0, 1.0);
    Lobe { density: density * masking, cos_facet }
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
        let (sin, cos) = (std::f64::consts::TAU * v).sin_cos();
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
    use std::f64::consts::PI;

    fn direction(cos: f64, turn: f64) -> Vec3 {
        let sin = (1.0 - cos * cos).sqrt();
        Vec3::new((sin * turn.cos()) as f32, (sin * turn.sin()) as f32, cos as f32)
    }

    /// ∫ density cos dω by the midpoint rule in cos² and azimuth.
    fn integral(out: Vec3, facets: &Facets, steps: usize) -> f64 {
        let mut sum = 0.0;
        for i in 0..steps * steps {
            let cos = ((i / steps) as f64 + 0.5) / steps as f64;
            let toward = direction(cos.sqrt(), 2.0 * PI * ((i % steps) as f64 + 0.5) / steps as f64);
            sum += f64::from(lobe(Vec3::Z, out, toward, facets, 0.0).density);
        }
        sum * PI / (steps * steps) as f64
    }

    #[test]
    fn sampling_facets_and_integrating_directions_agree() {
        for roughness in [0.5f32, 0.7, 1.0] {
            for cos in [0.2, 0.5, 0.9, 1.0] {
                let width = width(roughness);
                let sampled = reflected(cos, f64::from(width), |_| 1.0);
                let integrated = integral(direction(cos, 0.3), &Facets::new(roughness, 0.0), 400);
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
        let top = |roughness, radius| {
            f64::from(lobe(Vec3::Z, Vec3::Z, Vec3::Z, &Facets::new(roughness, 0.0), radius).density)
        };
        // D(0)/4 = 1/(4 π α²), and the sun's in a mirror 3/(4 π R²); a point in a mirror does not show.
        let exact = 1.0 / (4.0 * PI * 0.1f64.powi(4));
        assert!((top(0.1, 0.0) / exact - 1.0).abs() < 1e-5, "f32 rounding of ten operations");
        let exact = 3.0 / (2.0 * PI * 0.00465f64.powi(2));
        assert!((top(0.0, 0.00465) / exact - 1.0).abs() < 1e-5, "f32 rounding of ten operations");
        assert_eq!(top(0.0, 0.0), 0.0);
    }

    #[test]
    fn a_bundle_spreads_a_highlight_and_keeps_its_light() {
        for (turn, radius) in [(0.0, 0.02), (0.02, 0.1), (0.1, 0.00465), (0.3, 0.001)] {
            // ∫ D cos over the half vectors, which is 1 for every distribution: midpoint rule in the tangent of θ_h/2.
            for roughness in [0.0, 0.03, 0.2] {
                let facets = Facets::new(roughness, turn).of(radius);
                let steps = 200_000;
                let mut sum = 0.0;
                for i in 0..steps {
                    let sin2 = (f64::from(i) + 0.5) / f64::from(steps);
                    // sin² = x³ puts most points where D is high.
                    let x = sin2;
                    let density =
                        f64::from(facets.density((x * x * x) as f32, (1.0 - x * x * x).sqrt() as f32));
                    sum += density * PI * 3.0 * x * x / f64::from(steps);
                }
                // f32 densities of some ten operations, and a kernel cut off where sin is not quite the angle.
                assert!((sum - 1.0).abs() < 1e-4, "{roughness} {turn}: {sum}");
            }
        }
    }
}
