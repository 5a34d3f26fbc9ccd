//! Random numbers that a seed decides, and directions made of them.

use std::f64::consts::TAU;

use glam::DVec3;

/// Splitmix64 (Steele, Lea and Flood 2014): each sample of each pixel or sensor has a stream of its own, so that nobody's numbers depend
/// on threads.
#[derive(Clone, Debug)]
pub(crate) struct Dice(u64);

const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

impl Dice {
    /// For one sample of what `seed` names.
    pub(crate) fn new(seed: u64, sample: u64) -> Self {
        Self(mix(mix(seed.wrapping_add(GOLDEN)) ^ sample.wrapping_mul(GOLDEN)))
    }

    /// Evenly within \[0, 1), in steps of 2⁻⁵³.
    pub(crate) fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        (mix(self.0) >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Two at once.
    pub(crate) fn pair(&mut self) -> [f64; 2] {
        [self.roll(), self.roll()]
    }

    /// A number below `count`, which is ≥ 1.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.roll() * count as f64) as usize).min(count - 1)
    }

    /// A direction about the unit vector `axis` with density cos/π.
    pub(crate) fn cosine(&mut self, axis: DVec3) -> DVec3 {
        let [u, v] = self.pair();
        about(axis, (1.0 - u).sqrt(), TAU * v)
    }

    /// A direction within the cone about `axis` whose rim has the cosine 1 − `height`, all alike: density 1/(2π · height).
    pub(crate) fn cone(&mut self, axis: DVec3, height: f64) -> DVec3 {
        let [u, v] = self.pair();
        // 1 − cos keeps the digits of narrow cones.
        let less = u * height;
        let sin = (less * (2.0 - less)).sqrt();
        let (x, y) = axis.any_orthonormal_pair();
        let (s, c) = (TAU * v).sin_cos();
        (axis * (1.0 - less) + (x * c + y * s) * sin).normalize()
    }
}

/// The unit vector at this cosine from `axis`, turned about it by `turn` \[rad\].
pub(crate) fn about(axis: DVec3, cos: f64, turn: f64) -> DVec3 {
    let (x, y) = axis.any_orthonormal_pair();
    let (s, c) = turn.sin_cos();
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    (axis * cos + (x * c + y * s) * sin).normalize()
}

fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}
