//! Where the sub-scanlines are.

use std::ops::Range;

use crate::slabs::{Event, Slabs};
use crate::{Knobs, Rule};

/// The sub-scanlines of a picture, numbered from the top. Group g holds the lines whose number divided by
/// the strips per row is g (the exact rule: those of row g): the lines of row g, of which the trapezoid rule
/// counts the first once more at the end of row g − 1.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    strips: u32,
    pub(crate) rule: Rule,
    pub(crate) rows: u32,
    /// Strips of the exact rule; empty for the others.
    slabs: Slabs,
}

impl Grid {
    /// `events` are asked for with the height of a strip, by the exact rule only.
    pub(crate) fn new(knobs: &Knobs, rows: u32, events: impl FnOnce(f64) -> Vec<Event>) -> Self {
        let strips = knobs.sub_scanlines.clamp(1, 64);
        let slabs = match knobs.rule {
            Rule::Exact => Slabs::new(rows, strips, events(1.0 / f64::from(strips))),
            Rule::Trapezoid | Rule::Midpoint => Slabs::default(),
        };
        Self { strips, rule: knobs.rule, rows, slabs }
    }

    /// Lines in the picture. Below 2³² for any picture of less than 2²⁶ rows.
    pub(crate) fn lines(&self) -> u32 {
        let strips = self.rows.saturating_mul(self.strips);
        match self.rule {
            Rule::Trapezoid => strips.saturating_add(1),
            Rule::Midpoint => strips,
            Rule::Exact => self.slabs.lines(),
        }
    }

    pub(crate) fn groups(&self) -> u32 {
        match self.rule {
            Rule::Trapezoid => self.rows + 1,
            Rule::Midpoint | Rule::Exact => self.rows,
        }
    }

    /// Screen y of a line; rises strictly with the number.
    pub(crate) fn y(&self, line: u32) -> f64 {
        let offset = match self.rule {
            Rule::Trapezoid => 0.0,
            Rule::Midpoint => 0.5,
            Rule::Exact => {
                let (top, bottom) = self.slabs.strip(line);
                return 0.5 * (top + bottom);
            }
        };
        (f64::from(line) + offset) / f64::from(self.strips)
    }

    pub(crate) fn group(&self, group: u32) -> Range<u32> {
        if self.rule == Rule::Exact {
            return self.slabs.of_row(group);
        }
        let first = group * self.strips;
        first..(first + self.strips).min(self.lines())
    }

    /// The group of a line.
    pub(crate) fn group_of(&self, line: u32) -> u32 {
        if self.rule == Rule::Exact { self.slabs.row_of(line) } else { line / self.strips }
    }

    /// The lines that count for a row.
    pub(crate) fn of_row(&self, row: u32) -> Range<u32> {
        let lines = self.group(row);
        lines.start..lines.end + u32::from(self.rule == Rule::Trapezoid)
    }

    /// What a line weighs in a row: the height of its strip, by the trapezoid rule half of it at the ends.
    pub(crate) fn weight(&self, row: u32, line: u32) -> f64 {
        let h = 1.0 / f64::from(self.strips);
        match self.rule {
            Rule::Trapezoid if line == row * self.strips || line == (row + 1) * self.strips => 0.5 * h,
            Rule::Trapezoid | Rule::Midpoint => h,
            Rule::Exact => {
                let (top, bottom) = self.slabs.strip(line);
                bottom - top
            }
        }
    }

    /// The first line whose y is at least `y`, clamped to 0..=lines. `y` may be any finite number.
    pub(crate) fn first_at_or_below(&self, y: f64) -> u32 {
        let lines = self.lines();
        // The casts saturate and cut off; the guess is off by few lines, then exact.
        let mut line = match self.rule {
            Rule::Exact if y as u32 >= self.rows => lines,
            Rule::Exact => self.slabs.of_row(y as u32).start,
            Rule::Trapezoid | Rule::Midpoint => ((y * f64::from(self.strips)) as u32).min(lines),
        };
        while line > 0 && self.y(line - 1) >= y {
            line -= 1;
        }
        while line < lines && self.y(line) < y {
            line += 1;
        }
        line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_line_is_the_first_not_above() {
        for rule in [Rule::Trapezoid, Rule::Midpoint, Rule::Exact] {
            for strips in [1, 3, 4, 64] {
                let knobs = Knobs { sub_scanlines: strips, rule, ..Knobs::default() };
                let grid = Grid::new(&knobs, 5, |_| Vec::new());
                for y in [-1e300, -0.1, 0.0, 0.125, 1.0 / 3.0, 2.0, 4.99, 5.0, 5.1, 1e300] {
                    let line = grid.first_at_or_below(y);
                    assert!(line == grid.lines() || grid.y(line) >= y);
                    assert!(line == 0 || grid.y(line - 1) < y);
                }
            }
        }
    }

    #[test]
    fn weights_of_a_row_sum_to_one() {
        for rule in [Rule::Trapezoid, Rule::Midpoint, Rule::Exact] {
            for strips in 1..=64 {
                let knobs = Knobs { sub_scanlines: strips, rule, ..Knobs::default() };
                let grid = Grid::new(&knobs, 2, |_| Vec::new());
                let sum: f64 = grid.of_row(1).map(|line| grid.weight(1, line)).sum();
                // 65 additions of numbers below 1.
                assert!((sum - 1.0).abs() <= 65.0 * f64::EPSILON);
            }
        }
    }
}
