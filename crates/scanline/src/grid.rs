//! Where the sub-scanlines are.

use std::ops::{Range, RangeInclusive};

use crate::{Knobs, Rule};

/// The sub-scanlines of a picture, numbered from the top. Group g holds the lines whose number divided by
/// the strips per row is g: the lines of row g, of which the trapezoid rule counts the first once more at
/// the end of row g − 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) strips: u32,
    pub(crate) rule: Rule,
    pub(crate) rows: u32,
}

impl Grid {
    pub(crate) fn new(knobs: &Knobs, rows: u32) -> Self {
        Self { strips: knobs.sub_scanlines.clamp(1, 64), rule: knobs.rule, rows }
    }

    /// Lines in the picture. Below 2³² for any picture of less than 2²⁶ rows.
    pub(crate) fn lines(&self) -> u32 {
        let strips = self.rows.saturating_mul(self.strips);
        match self.rule {
            Rule::Trapezoid => strips.saturating_add(1),
            Rule::Midpoint => strips,
        }
    }

    pub(crate) fn groups(&self) -> u32 {
        self.lines().div_ceil(self.strips)
    }

    /// Screen y of a line; rises strictly with the number.
    pub(crate) fn y(&self, line: u32) -> f64 {
        let offset = match self.rule {
            Rule::Trapezoid => 0.0,
            Rule::Midpoint => 0.5,
        };
        (f64::from(line) + offset) / f64::from(self.strips)
    }

    pub(crate) fn group(&self, group: u32) -> Range<u32> {
        let first = group * self.strips;
        first..(first + self.strips).min(self.lines())
    }

    /// The lines that count for a row.
    pub(crate) fn of_row(&self, row: u32) -> RangeInclusive<u32> {
        let first = row * self.strips;
        match self.rule {
            Rule::Trapezoid => first..=first + self.strips,
            Rule::Midpoint => first..=first + self.strips - 1,
        }
    }

    /// What a line weighs in a row.
    pub(crate) fn weight(&self, row: u32, line: u32) -> f64 {
        let h = 1.0 / f64::from(self.strips);
        let ends = line == row * self.strips || line == (row + 1) * self.strips;
        if self.rule == Rule::Trapezoid && ends { 0.5 * h } else { h }
    }

    /// The first line whose y is at least `y`, clamped to 0..=lines. `y` may be any finite number.
    pub(crate) fn first_at_or_below(&self, y: f64) -> u32 {
        let lines = self.lines();
        // The cast saturates and cuts off; the guess is off by one line at most, then exact.
        let mut line = ((y * f64::from(self.strips)) as u32).min(lines);
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
        for rule in [Rule::Trapezoid, Rule::Midpoint] {
            for strips in [1, 3, 4, 64] {
                let grid = Grid { strips, rule, rows: 5 };
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
        for rule in [Rule::Trapezoid, Rule::Midpoint] {
            for strips in 1..=64 {
                let grid = Grid { strips, rule, rows: 2 };
                let sum: f64 = grid.of_row(1).map(|line| grid.weight(1, line)).sum();
                // 65 additions of numbers below 1.
                assert!((sum - 1.0).abs() <= 65.0 * f64::EPSILON);
            }
        }
    }
}
