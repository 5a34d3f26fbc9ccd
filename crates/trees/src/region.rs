//! Leaf regions: which leaf a point of a texture belongs to, and where that leaf faces (thesis 5.3.1 and 5.3.2).
//!
//! Everything random here is decided by the region's own number: the same leaf faces the same way in every picture.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Vec2, Vec3};
use light::sampling::scramble;

/// Length over breadth of a leaf's ellipse.
const SLENDER: f32 = 2.0;

/// Normals tried before one is taken as it comes: at a = 5/3 each is kept with 0.24.
const TRIES: u32 = 64;

/// A number within \[0, 1) that `seed` and `purpose` decide.
pub(crate) fn random(seed: u32, purpose: u32) -> f32 {
    let mixed = scramble(seed ^ scramble(purpose.wrapping_mul(0x9E37_79B9).wrapping_add(0x85EB_CA6B)));
    (mixed >> 8) as f32 / 16_777_216.0
}

/// Number of the leaf region that point `at` \[m\] of a plane belongs to, for leaves of length `size` \[m\].
///
/// One ellipse lies in each square of a grid, anywhere and turned anyhow; a point belongs to the one it is nearest to, as
/// measured in that one's own axes. Squares have an ellipse's area, π size²/(4 · 2).
pub(crate) fn region(at: Vec2, size: f32, seed: u32) -> u32 {
    let square = size * (PI / (4.0 * SLENDER)).sqrt();
    let at = at / square;
    let cell = at.floor();
    let mut nearest = (f32::INFINITY, seed);
    for (dy, dx) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dy, dx))) {
        let other = cell + Vec2::new(dx as f32, dy as f32);
        let number = scramble(
            seed ^ scramble(
                (other.x as i32 as u32).wrapping_add(scramble(other.y as i32 as u32 ^ 0x51ED_270B)),
            ),
        );
        let way = at - other - Vec2::new(random(number, 0), random(number, 1));
        let along = Vec2::from_angle(PI * random(number, 2));
        let (u, v) = (way.dot(along), way.perp_dot(along) * SLENDER);
        let distance = u * u + v * v;
        if distance < nearest.0 {
            nearest = (distance, number);
        }
    }
    nearest.1
}

/// Unit normal of region `number` for scatter `a`, x outwards (thesis eq. 5.5 to 5.7):
///
///   N = (cos φ, sin φ cos ξ, sin φ sin ξ),   φ = π a |randn| kept if ≤ π/2,   ξ = 2π rand
pub(crate) fn normal(number: u32, a: f32) -> Vec3 {
    let angle = |i: u32| {
        // Box and Muller 1958; 1 − u is never 0.
        let radius = (-2.0 * (1.0 - random(number, 4 + 2 * i)).ln()).sqrt();
        PI * a * (radius * (TAU * random(number, 5 + 2 * i)).cos()).abs()
    };
    let kept = (0..TRIES).map(angle).find(|angle| *angle <= FRAC_PI_2);
    let (sin, cos) = kept.unwrap_or_else(|| FRAC_PI_2 * random(number, 4)).sin_cos();
    let (y, z) = (TAU * random(number, 3)).sin_cos();
    Vec3::new(cos, sin * z, sin * y)
}

/// `local` (x outwards) with its x axis turned to the unit vector `outward`, z staying level.
pub(crate) fn turned(local: Vec3, outward: Vec3) -> Vec3 {
    let level = Vec3::new(-outward.z, 0.0, outward.x).try_normalize().unwrap_or(Vec3::Z);
    outward * local.x + level.cross(outward) * local.y + level * local.z
}

/// What a crowd of leaves catches of a beam: the mean of max(0, N · L) over the normals of a scatter, by the cosine between L
/// and the outward direction. For where a pixel holds many leaves.
#[derive(Clone, Debug)]
pub(crate) struct Crowd {
    /// At cosines from −1 to 1, equally far apart.
    caught: [f32; CROWD],
    /// Mean of cos φ.
    pub(crate) straight: f32,
}

/// Entries of the table: the mean bends by at most 1 per unit of cosine, so linear interpolation errs by 1/8 · (2/32)² < 0.0005.
const CROWD: usize = 33;

/// Steps of the integral over φ.
const STEPS: usize = 256;

impl Crowd {
    /// For scatter `a` (thesis eq. 5.6), > 0.
    pub(crate) fn new(a: f32) -> Self {
        let sigma = f64::from(a.clamp(1e-3, 1e3)) * std::f64::consts::PI;
        let mut caught = [0.0f64; CROWD];
        let (mut total, mut straight) = (0.0, 0.0);
        // Only as far as the density reaches: small scatters are narrow.
        let end = std::f64::consts::FRAC_PI_2.min(6.0 * sigma);
        for step in 0..STEPS {
            let phi = end * (step as f64 + 0.5) / STEPS as f64;
            let weight = (-0.5 * (phi / sigma).powi(2)).exp();
            total += weight;
            straight += weight * phi.cos();
            for (i, caught) in caught.iter_mut().enumerate() {
                let cos = 2.0 * i as f64 / (CROWD - 1) as f64 - 1.0;
                *caught += weight * around(phi.cos() * cos, phi.sin() * (1.0 - cos * cos).max(0.0).sqrt());
            }
        }
        Self { caught: caught.map(|sum| (sum / total) as f32), straight: (straight / total) as f32 }
    }

    /// Mean of max(0, N · L) where L has cosine `cos` to the outward direction.
    pub(crate) fn caught(&self, cos: f32) -> f32 {
        let at = (cos.clamp(-1.0, 1.0) + 1.0) * 0.5 * (CROWD - 1) as f32;
        let i = (at as usize).min(CROWD - 2);
        self.caught[i] + (self.caught[i + 1] - self.caught[i]) * (at - i as f32)
    }
}

/// Mean of max(0, a + b cos ξ) over a turn of ξ, b ≥ 0.
fn around(a: f64, b: f64) -> f64 {
    if a >= b {
        return a;
    }
    if a <= -b {
        return 0.0;
    }
    let end = (-a / b).acos();
    (a * end + b * end.sin()) / std::f64::consts::PI
}

/// The scatter whose mean cosine is `cos` (see [`Crowd`]), between 0.01 and 10: from about 1 to 2/π = 0.64.
pub(crate) fn scatter_of(cos: f32) -> f32 {
    let (mut low, mut high) = (0.01f32, 10.0f32);
    for _ in 0..40 {
        let middle = (low * high).sqrt();
        if Crowd::new(middle).straight > cos { low = middle } else { high = middle }
    }
    (low * high).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_those_of_the_thesis() {
        for a in [1.0 / 6.0, 1.0, 5.0 / 3.0] {
            let crowd = Crowd::new(a);
            let normals: Vec<_> = (0..20_000).map(|i| normal(scramble(i), a)).collect();
            assert!(normals.iter().all(|n| n.x >= -1e-6 && (n.length() - 1.0).abs() < 1e-5));
            for (toward, expected) in [
                (Vec3::X, crowd.straight),
                (Vec3::Y, crowd.caught(0.0)),
                (Vec3::new(-0.6, 0.0, 0.8), crowd.caught(-0.6)),
            ] {
                let mean = normals.iter().map(|n| n.dot(toward).max(0.0)).sum::<f32>() / normals.len() as f32;
                // Values within [0, 1] spread by at most 1/2: four deviations of the mean.
                assert!((mean - expected).abs() < 4.0 * 0.5 / (normals.len() as f32).sqrt(), "{a} {toward}");
            }
        }
    }

    #[test]
    fn the_scatter_of_a_mean_cosine_has_it() {
        for a in [0.05, 1.0 / 6.0, 0.5, 1.0] {
            let found = scatter_of(Crowd::new(a).straight);
            // The mean cosine is f32 and flattens out at large scatter.
            assert!((found / a - 1.0).abs() < 0.01, "{a}: {found}");
        }
    }

    #[test]
    fn regions_are_as_large_as_leaves_and_stay() {
        let (size, seed) = (0.1f32, 7);
        let mut regions = std::collections::BTreeMap::new();
        let side = 400;
        for i in 0..side * side {
            let at = Vec2::new((i % side) as f32, (i / side) as f32) * (2.0 / side as f32);
            *regions.entry(region(at, size, seed)).or_insert(0u32) += 1;
        }
        // One region per square of the grid; those at the border are cut.
        let expected = 4.0 / (size * size * PI / 8.0);
        assert!((regions.len() as f32 / expected - 1.0).abs() < 0.2, "{} {expected}", regions.len());
        assert_eq!(region(Vec2::splat(0.5), size, seed), region(Vec2::splat(0.5), size, seed));
    }

    #[test]
    fn turning_puts_x_on_the_outward_direction() {
        for outward in [Vec3::X, Vec3::Y, Vec3::new(0.36, 0.48, -0.8)] {
            assert!((turned(Vec3::X, outward) - outward).length() < 1e-6);
            let n = turned(Vec3::new(0.6, 0.64, 0.48), outward);
            assert!((n.length() - 1.0).abs() < 1e-6 && (n.dot(outward) - 0.6).abs() < 1e-6);
        }
    }
}
