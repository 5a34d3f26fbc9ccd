//! Where scattered light goes: any phase function, and directions drawn by a table of it.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::dice::{Dice, about};

/// Bins of the table over the logarithm of the scattering angle.
const BINS: usize = 400;
/// The smallest angle that has a bin of its own \[rad\]; the first reaches down to 0.
const LEAST: f64 = 1e-6;

/// A phase function p(cos θ) \[1/sr\] with ∫ p dω = 1.
pub struct Phase {
    value: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    /// Rising cosine-wise measure: 1 − cos at the bins' ends, from 0.
    ends: Vec<f64>,
    /// Cumulated shares at the bins' ends.
    shares: Vec<f64>,
}

impl Phase {
    /// Of a function of the cosine of the scattering angle. Directions are drawn by a table of it, bin by bin evenly; what a bin gets wrong
    /// is weighed, so that any function > 0 is right on average.
    pub fn new(value: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        let angle = |bin: usize| LEAST * (PI / LEAST).powf(bin as f64 / (BINS - 1) as f64);
        // 1 − cos θ = 2 sin²(θ/2).
        let less = |angle: f64| 2.0 * (0.5 * angle).sin().powi(2);
        let ends: Vec<f64> =
            std::iter::once(0.0).chain((0..BINS).map(|bin| less(angle(bin).min(PI)))).collect();
        let mut shares = vec![0.0];
        for pair in ends.windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]);
            // A little of everything, so that no direction that may be met is never tried.
            let share = TAU * (pair[1] - pair[0]) * (value(1.0 - middle).max(0.0) + 1e-6);
            shares.push(shares[shares.len() - 1] + share);
        }
        let whole = shares[shares.len() - 1];
        shares.iter_mut().for_each(|share| *share /= whole);
        Self { value: Box::new(value), ends, shares }
    }

    /// p \[1/sr\].
    pub(crate) fn value(&self, cos: f64) -> f64 {
        (self.value)(cos.clamp(-1.0, 1.0))
    }

    /// Density with which [`Self::draw`] finds this cosine \[1/sr\].
    pub(crate) fn density(&self, cos: f64) -> f64 {
        let less = (1.0 - cos).clamp(0.0, 2.0);
        let bin = self.ends.partition_point(|&end| end <= less).clamp(1, self.ends.len() - 1) - 1;
        (self.shares[bin + 1] - self.shares[bin]) / (TAU * (self.ends[bin + 1] - self.ends[bin]))
    }

    /// A direction that light of direction `along` is scattered to.
    pub(crate) fn draw(&self, along: DVec3, dice: &mut Dice) -> DVec3 {
        let [u, v] = dice.pair();
        let bin = self.shares.partition_point(|&share| share <= u).clamp(1, self.shares.len() - 1) - 1;
        let within = ((u - self.shares[bin]) / (self.shares[bin + 1] - self.shares[bin])).clamp(0.0, 1.0);
        let less = self.ends[bin] + within * (self.ends[bin + 1] - self.ends[bin]);
        about(along, 1.0 - less, TAU * v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_weighs_one_and_keeps_its_mean_cosine() {
        for g in [-0.5f64, 0.0, 0.9] {
            let phase =
                Phase::new(move |cos| (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cos).powf(1.5)));
            let (mut dice, n) = (Dice::new(1, 0), 100_000);
            let (mut whole, mut mean) = (0.0, 0.0);
            for _ in 0..n {
                let cos = phase.draw(DVec3::Y, &mut dice).y;
                let weight = phase.value(cos) / phase.density(cos);
                whole += weight / f64::from(n);
                mean += weight * cos / f64::from(n);
            }
            // Weights within some 2 % of 1; cosines spread by at most 0.58: 4/√n of both.
            assert!(
                (whole - 1.0).abs() < 0.001 && (mean - g).abs() < 4.0 * 0.6 / f64::from(n).sqrt(),
                "{g}: {whole} {mean}"
            );
        }
    }
}
