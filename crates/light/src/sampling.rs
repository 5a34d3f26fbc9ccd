//! Sets of points, stratified and decided by a seed, and the occlusion of segments asked for in batches.

use std::f32::consts::TAU;

use crate::{Occlude, Ray, Spectrum};

/// A place for a point of the unit square that one seed and one purpose decide.
///
/// `purpose` keeps sets apart that share a seed: those of two sources must not move together.
pub fn shift(seed: u32, purpose: u32) -> [u32; 2] {
    let first = scramble(seed ^ purpose.wrapping_mul(0x9E37_79B9));
    [first, scramble(first ^ 0x85EB_CA6B)]
}

/// A bijection of the 32-bit numbers without visible pattern (the finaliser of MurmurHash3).
pub fn scramble(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x85EB_CA6B);
    x = (x ^ (x >> 13)).wrapping_mul(0xC2B2_AE35);
    x ^ (x >> 16)
}

/// Point `i` of `count` of the golden lattice, moved by `shift` around the torus; each within \[0, 1).
///
///   ( i/count, i (√5 − 1)/2 ) mod 1
///
/// One point in each of `count` columns, and the rows filled as evenly as any row of points can be.
pub fn lattice(i: u32, count: u32, shift: [u32; 2]) -> [f32; 2] {
    let column = ((u64::from(i) << 32) / u64::from(count.max(1))) as u32;
    let row = i.wrapping_mul(0x9E37_79B9);
    [column.wrapping_add(shift[0]), row.wrapping_add(shift[1])].map(|x| (x >> 8) as f32 / 16_777_216.0)
}

/// Point `i` of Sobol's sequence, its bits turned by `scramble`; each within \[0, 1).
///
/// Any first 2ᵏ points have one in each rectangle of area 2⁻ᵏ whose sides are powers of two: good for whoever may
/// stop early. Sobol' 1967; x is van der Corput's sequence.
///
/// ```
/// let first: Vec<_> = (0..4).map(|i| keikan_light::sampling::sobol(i, [0; 2])).collect();
/// assert_eq!(first, [[0.0, 0.0], [0.5, 0.5], [0.25, 0.75], [0.75, 0.25]]);
/// ```
pub fn sobol(i: u32, scramble: [u32; 2]) -> [f64; 2] {
    let (mut y, mut direction, mut left) = (0, 1u32 << 31, i);
    while left != 0 {
        y ^= if left & 1 == 1 { direction } else { 0 };
        direction ^= direction >> 1;
        left >>= 1;
    }
    [i.reverse_bits() ^ scramble[0], y ^ scramble[1]].map(|bits| f64::from(bits) / 4_294_967_296.0)
}

/// The point of the unit disc that belongs to a point of the unit square, areas kept.
pub fn disc(at: [f32; 2]) -> [f32; 2] {
    let radius = at[0].sqrt();
    let (sin, cos) = (TAU * at[1]).sin_cos();
    [radius * cos, radius * sin]
}

/// Segments asked for in one call to an occluder.
const BATCH: usize = 64;

/// The share of the light along weighed segments that arrives: Σ weight · transmittance / Σ weight; none where the
/// weights sum to 0. Exactly 1 where nothing is in the way.
pub(crate) fn share(
    occlude: &dyn Occlude,
    mut segments: impl Iterator<Item = (Ray, f32)>,
) -> Option<Spectrum> {
    let nothing = Ray::between(glam::Vec3::ZERO, glam::Vec3::ZERO);
    let (mut rays, mut weights, mut answers) = ([nothing; BATCH], [0.0; BATCH], [Spectrum::ZERO; BATCH]);
    let (mut through, mut total) = (Spectrum::ZERO, Spectrum::ZERO);
    loop {
        let mut count = 0;
        for (slot, (ray, weight)) in segments.by_ref().take(BATCH).enumerate() {
            (rays[slot], weights[slot]) = (ray, weight);
            count = slot + 1;
        }
        if count == 0 {
            break;
        }
        occlude.transmittances(&rays[..count], &mut answers[..count]);
        for (weight, answer) in weights[..count].iter().zip(&answers) {
            // Both sums take the same roundings, so that all of the light is exactly all of it.
            through += *answer * *weight;
            total += Spectrum::splat(*weight);
        }
    }
    (total[0] > 0.0).then(|| through / total)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The (0, 2) property, to 2⁻ᵏ for every way to divide it among the sides, whatever the scramble.
    #[test]
    fn sobol_fills_every_rectangle_once() {
        for seed in 0..20 {
            let scramble = if seed == 0 { [0; 2] } else { shift(seed, 7) };
            for power in 0..=10u32 {
                let points: Vec<_> = (0..1 << power).map(|i| sobol(i, scramble)).collect();
                for columns in 0..=power {
                    let (wide, high) = (f64::from(1u32 << columns), f64::from(1u32 << (power - columns)));
                    let mut met = vec![0; 1 << power];
                    for [x, y] in &points {
                        assert!((0.0..1.0).contains(x) && (0.0..1.0).contains(y));
                        met[(y * high) as usize * (1 << columns) + (x * wide) as usize] += 1;
                    }
                    assert!(met.iter().all(|count| *count == 1), "{seed}: 2^{power}, 2^{columns} columns");
                }
            }
        }
    }
}
