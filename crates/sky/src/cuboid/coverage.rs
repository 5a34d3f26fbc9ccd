//! Which elements are covered: a bit each, in tiles that can be asked and filled as a whole.

/// Width and height of a tile: 64 bits in one word.
const TILE: usize = 8;
/// The first column of a tile.
const COLUMN: u64 = 0x0101_0101_0101_0101;
/// Bit i of byte i.
const DIAGONAL: u64 = 0x8040_2010_0804_0201;

/// Coverage of one face: a bit per element (or part of one), set = covered or not asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    columns: usize,
    rows: usize,
    across: usize,
    /// Tiles row by row; within a tile bit 8 · row + column. What lies beyond the grid counts as covered.
    tiles: Vec<u64>,
    /// Bits that are not set.
    open: usize,
}

impl Coverage {
    /// Nothing covered.
    pub fn new([columns, rows]: [usize; 2]) -> Self {
        let [across, down] = [columns, rows].map(|count| count.div_ceil(TILE));
        let within = |tile: usize, count: usize| low_bits((count - tile * TILE).min(TILE));
        let tile = |index: usize| {
            let inside = square(within(index % across, columns), within(index / across, rows));
            !inside
        };
        let tiles = (0..across * down).map(tile).collect();
        Self { columns, rows, across, tiles, open: columns * rows }
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// How many bits are not covered.
    pub fn open(&self) -> usize {
        self.open
    }

    /// Whether a bit is covered.
    pub fn is_covered(&self, [column, row]: [usize; 2]) -> bool {
        self.row_byte(column / TILE, row) >> (column % TILE) & 1 == 1
    }

    /// Covers the columns `from` ..= `to` of a row.
    pub fn cover(&mut self, row: usize, from: usize, to: usize) {
        let (start, shift) = (row / TILE * self.across, row % TILE * TILE);
        for tile in from / TILE..=to / TILE {
            self.add(start + tile, u64::from(columns_of(tile, from, to)) << shift);
        }
    }

    /// Covers what `other`, of the same size, covers.
    pub fn cover_all(&mut self, other: &Self) {
        (0..self.tiles.len()).for_each(|tile| self.add(tile, other.tiles[tile]));
    }

    /// Whether all of the columns `x[0]` ..= `x[1]` of the rows `y[0]` ..= `y[1]` are covered.
    pub fn all_covered(&self, x: [usize; 2], y: [usize; 2]) -> bool {
        if self.open == 0 {
            return true;
        }
        (y[0] / TILE..=y[1] / TILE).all(|j| {
            let rows = columns_of(j, y[0], y[1]);
            (x[0] / TILE..=x[1] / TILE).all(|i| {
                let tile = self.tiles[j * self.across + i];
                tile == u64::MAX || !tile & square(columns_of(i, x[0], x[1]), rows) == 0
            })
        })
    }

    /// Calls `receive` with the first column and the one after the last of each run of open bits in a row. Long runs come
    /// in pieces of up to 64.
    pub fn open_runs(&self, row: usize, mut receive: impl FnMut(usize, usize)) {
        for first in (0..self.across).step_by(TILE) {
            let mut open = 0u64;
            for tile in first..(first + TILE).min(self.across) {
                open |= u64::from(!self.row_byte(tile, row)) << ((tile - first) * TILE);
            }
            let mut at = 0;
            while open >> at != 0 {
                at += (open >> at).trailing_zeros();
                let run = (open >> at).trailing_ones();
                let start = first * TILE + at as usize;
                receive(start, start + run as usize);
                at += run;
                if at == u64::BITS {
                    break;
                }
            }
        }
    }

    fn row_byte(&self, tile: usize, row: usize) -> u8 {
        (self.tiles[row / TILE * self.across + tile] >> (row % TILE * TILE)) as u8
    }

    fn add(&mut self, tile: usize, bits: u64) {
        let new = bits & !self.tiles[tile];
        self.tiles[tile] |= new;
        self.open -= new.count_ones() as usize;
    }
}

/// The lowest `count` ≤ 8 bits.
fn low_bits(count: usize) -> u8 {
    ((1u16 << count) - 1) as u8
}

/// Which of a tile's columns (or rows) are within `from` ..= `to`; the tile holds at least one of them.
fn columns_of(tile: usize, from: usize, to: usize) -> u8 {
    let first = from.saturating_sub(tile * TILE);
    let last = (to - tile * TILE).min(TILE - 1);
    low_bits(last + 1) & !low_bits(first)
}

/// The bits of a tile in both these columns and these rows.
fn square(columns: u8, rows: u8) -> u64 {
    // A byte of ones for each row, by way of a bit for each row at the start of its byte.
    let bits = (u64::from(rows) * COLUMN) & DIAGONAL;
    let starts = ((bits + COLUMN * 0x7f) >> 7) & COLUMN;
    starts * u64::from(columns)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn answers_are_those_of_a_plain_table(
            size in [1usize..150, 1usize..40],
            runs in prop::collection::vec((0.0f64..1.0, 0.0f64..1.0, 0.0f64..1.0), 0..60),
            asked in prop::collection::vec([0.0f64..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0], 20),
        ) {
            let mut coverage = Coverage::new(size);
            let mut plain = vec![vec![false; size[0]]; size[1]];
            let index = |at: f64, count: usize| (at * count as f64) as usize;
            let pair = |a: usize, b: usize| [a.min(b), a.max(b)];
            for (row, a, b) in runs {
                let row = index(row, size[1]);
                let [from, to] = pair(index(a, size[0]), index(b, size[0]));
                coverage.cover(row, from, to);
                plain[row][from..=to].fill(true);
            }
            let mut open = Coverage::new(size);
            for (row, plain) in plain.iter().enumerate() {
                for (column, &set) in plain.iter().enumerate() {
                    prop_assert_eq!(coverage.is_covered([column, row]), set);
                }
                let mut seen = vec![true; size[0]];
                coverage.open_runs(row, |from, to| seen[from..to].fill(false));
                prop_assert_eq!(&seen, plain);
            }
            prop_assert_eq!(coverage.open(), plain.iter().flatten().filter(|set| !**set).count());
            for [a, b, c, d] in asked {
                let (x, y) = (pair(index(a, size[0]), index(b, size[0])), pair(index(c, size[1]), index(d, size[1])));
                let all = plain[y[0]..=y[1]].iter().all(|row| row[x[0]..=x[1]].iter().all(|set| *set));
                prop_assert_eq!(coverage.all_covered(x, y), all);
            }
            open.cover_all(&coverage);
            prop_assert_eq!(open, coverage);
        }
    }
}
