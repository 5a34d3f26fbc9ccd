//! A stream of random numbers that a seed decides.

use glam::Vec3;

use crate::region::random;

pub(super) struct Dice {
    seed: u32,
    thrown: u32,
}

impl Dice {
    pub(super) fn new(seed: u32) -> Self {
        Self { seed, thrown: 0 }
    }

    /// Within \[0, 1).
    pub(super) fn share(&mut self) -> f32 {
        self.thrown = self.thrown.wrapping_add(1);
        random(self.seed, self.thrown)
    }

    /// Within \[low, high).
    pub(super) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.share()
    }

    /// In the unit ball.
    pub(super) fn ball(&mut self) -> Vec3 {
        // Half of the cube's points are in the ball: 32 misses in a row never happen.
        for _ in 0..32 {
            let point = Vec3::new(self.share(), self.share(), self.share()) * 2.0 - 1.0;
            if point.length_squared() <= 1.0 {
                return point;
            }
        }
        Vec3::ZERO
    }

    /// A unit vector.
    pub(super) fn direction(&mut self) -> Vec3 {
        self.ball().try_normalize().unwrap_or(Vec3::Y)
    }
}
