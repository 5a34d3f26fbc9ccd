//! The surface cut into cells.

use glam::DVec2;

/// No grid has more corners than this: 64 MiB of rays.
pub(super) const MOST: f64 = 4_194_304.0;

/// A level grid of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    /// Its corner of least x and z \[m\].
    low: DVec2,
    /// Of a cell along x and z \[m\].
    pub(super) step: DVec2,
    /// Along x and z, at least 1.
    pub(super) cells: [usize; 2],
}

impl Grid {
    /// Of the rectangle from `low` to `high`, in cells no wider than `step` \[m\] unless there were too many.
    pub(super) fn new(low: DVec2, high: DVec2, step: f64) -> Self {
        let size = (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
        let least = least_step(low, high);
        let step = if step > least { step } else { least };
        let cells = (size / step).to_array().map(|n| (n.ceil() as usize).max(1));
        let step = DVec2::new(size.x / cells[0] as f64, size.y / cells[1] as f64);
        Self { low, step, cells }
    }

    /// Corners along x.
    pub(super) fn corners(&self) -> [usize; 2] {
        self.cells.map(|n| n + 1)
    }

    /// The number of a corner.
    pub(super) fn index(&self, [i, j]: [usize; 2]) -> usize {
        j * (self.cells[0] + 1) + i
    }

    /// Where a corner lies.
    pub(super) fn at(&self, [i, j]: [usize; 2]) -> DVec2 {
        self.low + self.step * DVec2::new(i as f64, j as f64)
    }

    /// The corners of a cell's two triangles; the cut between them lies the other way in every other cell, as on a chessboard, so
    /// that no direction is favoured.
    pub(super) fn triangles(&self, [i, j]: [usize; 2]) -> [[[usize; 2]; 3]; 2] {
        let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        if (i + j).is_multiple_of(2) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
    }
}

/// The finest step \[m\] for which the rectangle from `low` to `high` has no more than [`MOST`] corners: (x/s + 1)(z/s + 1) ≤ MOST.
pub(super) fn least_step(low: DVec2, high: DVec2) -> f64 {
    let size = (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
    let (sum, area) = (size.x + size.y, size.x * size.y);
    (sum + (sum * sum + 4.0 * (MOST - 1.0) * area).sqrt()) / (2.0 * (MOST - 1.0))
}
