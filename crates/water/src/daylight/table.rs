//! A quantity under water by depth and direction.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::Vec3;
use light::Spectrum;

use super::rays::Rays;

/// Angles from the zenith, 10° apart.
const TILTS: usize = 19;
/// Azimuths, 15° apart.
const TURNS: usize = 24;
/// Each depth over the one before.
const GROWTH: f64 = 1.2;
/// The first depth times the largest coefficient, and the last times the smallest.
const OPTICAL_DEPTHS: [f64; 2] = [0.05, 12.0];
/// The smallest coefficient counts as at least this share of the largest.
const SMALLEST: f64 = 1e-3;

/// A sum over the sky's rays for every depth and direction: linear between tabulated ones of the sum without
/// e^(−K z), the loss straight down, by which the looked-up value is multiplied. Below the last depth e^(−K z) alone goes on.
pub(crate) struct Table {
    coefficient: Spectrum,
    depths: Vec<f64>,
    values: Vec<Spectrum>,
}

impl Table {
    /// `kernel(direction, towards where light comes from)` weighs the rays.
    pub(crate) fn new(rays: &Rays, coefficient: Spectrum, kernel: impl Fn(Vec3, Vec3) -> Spectrum) -> Self {
        let depths = depths(coefficient);
        let mut values = vec![Spectrum::ZERO; depths.len() * TILTS * TURNS];
        for tilt in 0..TILTS {
            for turn in 0..TURNS {
                let (sin, cos) = (tilt as f32 * PI / (TILTS - 1) as f32).sin_cos();
                let (east, north) = (turn as f32 * TAU / TURNS as f32).sin_cos();
                let direction = Vec3::new(sin * east, cos, -sin * north);
                let rings = rays.0.iter().map(|ring| -> Spectrum {
                    ring.rays.iter().map(|&(toward, facing)| facing * kernel(direction, toward)).sum()
                });
                let rings: Vec<Spectrum> = rings.collect();
                for (level, &depth) in depths.iter().enumerate() {
                    let lost = |sec: f64| coefficient.attenuate((depth * (sec - 1.0)) as f32);
                    values[(level * TILTS + tilt) * TURNS + turn] =
                        rings.iter().zip(&rays.0).map(|(sum, ring)| *sum * lost(ring.sec)).sum();
                }
            }
        }
        Self { coefficient, depths, values }
    }

    /// The depths of the table, rising from 0.
    pub(crate) fn depths(&self) -> &[f64] {
        &self.depths
    }

    /// The tabulated quantity at `depth` \[m\] in unit vector `direction`, without e^(−K z).
    pub(crate) fn without_common_loss(&self, depth: f64, direction: Vec3) -> Spectrum {
        let at = self.depths.partition_point(|&d| d <= depth).clamp(1, self.depths.len().max(2) - 1);
        let (Some(&low), Some(&high)) = (self.depths.get(at - 1), self.depths.get(at)) else {
            return self.around(0, direction);
        };
        let share = ((depth - low) / (high - low)).clamp(0.0, 1.0) as f32;
        let above = self.around(at - 1, direction);
        above + (self.around(at, direction) - above) * share
    }

    /// The same with all its losses.
    pub(crate) fn value(&self, depth: f64, direction: Vec3) -> Spectrum {
        let depth = depth.max(0.0);
        self.without_common_loss(depth, direction) * self.coefficient.attenuate(depth as f32)
    }

    fn around(&self, level: usize, direction: Vec3) -> Spectrum {
        let flat = direction.x.hypot(direction.z);
        let tilt = (FRAC_PI_2 - direction.y.atan2(flat)) * ((TILTS - 1) as f32 / PI);
        let row = (tilt.max(0.0) as usize).min(TILTS - 2);
        let turn = direction.x.atan2(-direction.z).rem_euclid(TAU) * (TURNS as f32 / TAU);
        let column = (turn as usize).min(TURNS - 1);
        let (down, right) = ((tilt - row as f32).clamp(0.0, 1.0), (turn - column as f32).clamp(0.0, 1.0));
        let along = |row: usize| {
            let first = (level * TILTS + row) * TURNS;
            let [a, b] = [column, (column + 1) % TURNS].map(|column| self.values[first + column]);
            a + (b - a) * right
        };
        let upper = along(row);
        upper + (along(row + 1) - upper) * down
    }
}

/// 0, then geometric from where the most absorbed band notices it to where the least absorbed is dark.
fn depths(coefficient: Spectrum) -> Vec<f64> {
    let largest = f64::from(coefficient.max());
    let smallest = coefficient.0.iter().fold(f32::INFINITY, |least, &k| least.min(k));
    let smallest = f64::from(smallest).max(SMALLEST * largest);
    let mut depths = vec![0.0];
    if largest > 0.0 && largest.is_finite() {
        let [first, last] = OPTICAL_DEPTHS;
        let mut depth = first / largest;
        while depth < last / smallest {
            depths.push(depth);
            depth *= GROWTH;
        }
    }
    depths
}
