//! The sky, and directions drawn by how bright it is there.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::dice::Dice;
use crate::world::Sky;

/// Rows of one height y each, and columns around: cells of one solid angle.
const ROWS: usize = 160;
const COLUMNS: usize = 256;
/// Share of the draws that goes to all directions alike, so that none that shines is never tried.
const EVEN: f64 = 0.1;

/// A sky with a table of its brightness: the table decides where is looked, never how bright it is there.
pub(crate) struct Heaven {
    pub(crate) sky: Sky,
    /// Cumulated shares at the cells' ends.
    shares: Vec<f64>,
}

impl Heaven {
    pub(crate) fn new(sky: Sky) -> Self {
        let middle = |cell: usize| direction(cell, [0.5, 0.5]);
        let bright: Vec<f64> =
            (0..ROWS * COLUMNS).map(|cell| sky(middle(cell)).luminance().max(0.0)).collect();
        let whole: f64 = bright.iter().sum();
        let cells = (ROWS * COLUMNS) as f64;
        let mut sum = 0.0;
        let shares = bright.iter().map(|own| {
            let share = if whole > 0.0 { own / whole } else { 1.0 / cells };
            sum += (1.0 - EVEN) * share + EVEN / cells;
            sum
        });
        Self { shares: shares.collect(), sky }
    }

    fn share(&self, cell: usize) -> f64 {
        self.shares[cell] - cell.checked_sub(1).map_or(0.0, |before| self.shares[before])
    }

    /// A direction, and its density \[1/sr\].
    pub(crate) fn draw(&self, dice: &mut Dice) -> (DVec3, f64) {
        let choice = dice.roll() * self.shares[self.shares.len() - 1];
        let cell = self.shares.partition_point(|&end| end <= choice).min(self.shares.len() - 1);
        let toward = direction(cell, dice.pair());
        (toward, self.share(cell) * (ROWS * COLUMNS) as f64 / (4.0 * PI))
    }

    /// Density with which [`Self::draw`] finds this direction \[1/sr\].
    pub(crate) fn density(&self, toward: DVec3) -> f64 {
        let row = ((0.5 - 0.5 * toward.y) * ROWS as f64) as usize;
        let column = (toward.z.atan2(toward.x).rem_euclid(TAU) / TAU * COLUMNS as f64) as usize;
        let cell = row.min(ROWS - 1) * COLUMNS + column.min(COLUMNS - 1);
        self.share(cell) * (ROWS * COLUMNS) as f64 / (4.0 * PI)
    }
}

/// The direction at a place, within \[0, 1\]², of a cell.
fn direction(cell: usize, [u, v]: [f64; 2]) -> DVec3 {
    let (row, column) = ((cell / COLUMNS) as f64, (cell % COLUMNS) as f64);
    let y = 1.0 - 2.0 * (row + u) / ROWS as f64;
    let (sin, cos) = (TAU * (column + v) / COLUMNS as f64).sin_cos();
    let level = (1.0 - y * y).max(0.0).sqrt();
    DVec3::new(level * cos, y, level * sin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bands::Bands;

    #[test]
    fn what_is_drawn_has_the_density_that_is_told_and_is_everything() {
        let heaven = Heaven::new(Box::new(|toward| Bands::splat((8.0 * toward.y).exp() + 1e-3)));
        let (mut dice, n) = (Dice::new(3, 0), 100_000);
        let mut solid_angle = 0.0;
        for _ in 0..n {
            let (toward, density) = heaven.draw(&mut dice);
            // The same number from either side, but for cells' rims by rounding.
            assert!((heaven.density(toward) / density - 1.0).abs() < 1e-9);
            solid_angle += 1.0 / density / f64::from(n);
        }
        // 1/density is at most 4π/0.1: four standard errors of 4π · 3 at most.
        assert!((solid_angle / (4.0 * PI) - 1.0).abs() < 4.0 * 3.0 / f64::from(n).sqrt(), "{solid_angle}");
    }
}
