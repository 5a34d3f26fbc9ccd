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
    patch(at, size, seed).0
}

/// The same with the way to the point from the middle of its ellipse \[m\].
pub(crate) fn patch(at: Vec2, size: f32, seed: u32) -> (u32, Vec2) {
    let square = size * (PI / (4.0 * SLENDER)).sqrt();
    let at = at / square;
    let cell = at.floor();
    let mut nearest = (f32::INFINITY, seed, Vec2::ZERO);
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
            nearest = (distance, number, way * square);
        }
    }
    (nearest.1, nearest.2)
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

/// Normals that stand for a crowd of leaves, where a pixel holds many: as many in equal shares of φ as of ξ.
#[derive(Clone, Debug)]
pub(crate) struct Crowd {
    /// x outwards.
    pub(crate) normals: [Vec3; CROWD],
    /// Mean of cos φ.
    pub(crate) straight: f32,
}

/// Rings of φ and normals on each.
const RINGS: [usize; 2] = [4, 5];

/// Normals of a crowd.
pub(crate) const CROWD: usize = RINGS[0] * RINGS[1];

/// Steps of the integral over φ.
const STEPS: usize = 512;

impl Crowd {
    /// For scatter `a` (thesis eq. 5.6), > 0.
    pub(crate) fn new(a: f32) -> Self {
        let sigma = f64::from(a.clamp(1e-3, 1e3)) * std::f64::consts::PI;
        // Only as far as the density reaches: small scatters are narrow.
        let end = std::f64::consts::FRAC_PI_2.min(6.0 * sigma);
        let angle = |step: usize| end * (step as f64 + 0.5) / STEPS as f64;
        let weight = |step: usize| (-0.5 * (angle(step) / sigma).powi(2)).exp();
        let total: f64 = (0..STEPS).map(weight).sum();
        let straight = (0..STEPS).map(|step| weight(step) * angle(step).cos()).sum::<f64>() / total;
        let mut normals = [Vec3::X; CROWD];
        let (mut ring, mut below) = (0, 0.0);
        for step in 0..STEPS {
            below += weight(step) / total;
            // The middle of the ring's share of φ.
            if ring < RINGS[0] && below >= (ring as f64 + 0.5) / RINGS[0] as f64 {
                let (sin, cos) = (angle(step) as f32).sin_cos();
                for i in 0..RINGS[1] {
                    // Rings turned against each other by half a step.
                    let xi = TAU * (i as f32 + 0.5 * (ring % 2) as f32) / RINGS[1] as f32;
                    normals[ring * RINGS[1] + i] = Vec3::new(cos, sin * xi.cos(), sin * xi.sin());
                }
                ring += 1;
            }
        }
        Self { normals, straight: straight as f32 }
    }
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
            let mean_of = |normals: &[Vec3], toward: Vec3| {
                normals.iter().map(|n| n.dot(toward).max(0.0)).sum::<f32>() / normals.len() as f32
            };
            // Values within [0, 1] spread by at most 1/2: four deviations of the mean.
            let noise = 4.0 * 0.5 / (normals.len() as f32).sqrt();
            assert!((mean_of(&normals, Vec3::X) - crowd.straight).abs() < noise);
            for toward in [Vec3::X, Vec3::Y, Vec3::new(-0.6, 0.0, 0.8), Vec3::new(0.6, -0.8, 0.0)] {
                // Four rings of φ, whose cosines bend by at most 1: 1/24 · (π/8)²; five normals on a ring, whose mean of
                // max(0, cos) is off by at most 0.02.
                let (mean, few) = (mean_of(&normals, toward), mean_of(&crowd.normals, toward));
                assert!((mean - few).abs() < noise + 0.027, "{a} {toward}: {mean} {few}");
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
