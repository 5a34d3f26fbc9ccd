//! Bodies among the faces of a line.

use super::runs::Run;
use crate::borders::{Border, Sides};
use crate::scanline::Line;
use crate::segment::Segment;
use crate::veil;

/// Makes of `line` one that shows the `runs` as well, as far as it matters from `left` to `right`. Bodies go by the
/// numbers from `base` on. `nears` says how near they are, for the veils.
/// `leaning` = by the exact rule.
pub(crate) fn insert(
    line: &Line,
    (runs, nears): (&[Run], &[Segment]),
    base: u32,
    [left, right]: [f64; 2],
    leaning: bool,
) -> Line {
    let mut all: Vec<(Segment, Sides)> = Vec::new();
    let first = line.first_right_of(left);
    let mut next = 0;
    for (i, span) in line.opaque.iter().enumerate().skip(first) {
        let upright = Sides { left: [span.x0; 2], right: [span.x1; 2] };
        let sides = line.sides.get(i).copied().unwrap_or(upright);
        if sides.left[0].min(sides.left[1]).min(span.x0) >= right {
            break;
        }
        while runs.get(next).is_some_and(|run| run.x[1] <= span.x0) {
            next += 1;
        }
        let mut rest = (*span, sides);
        for run in runs[next..].iter().take_while(|run| run.x[0] < span.x1) {
            let before = (Segment { x1: run.x[0], ..rest.0 }, Sides { right: run.borders[0], ..rest.1 });
            if before.0.x0 < before.0.x1 {
                all.push(before);
            }
            let x0 = run.x[1].max(rest.0.x0);
            rest.0 = Segment { x0, w: rest.0.nearness(x0), ..rest.0 };
            rest.1.left = run.borders[1];
        }
        if rest.0.x0 < rest.0.x1 {
            all.push(rest);
        }
    }
    for run in runs {
        let segment = Segment { x0: run.x[0], x1: run.x[1], face: base + run.body, ..Segment::default() };
        all.push((segment, Sides { left: run.borders[0], right: run.borders[1] }));
    }
    all.sort_by(|a, b| a.0.x0.total_cmp(&b.0.x0));
    order(&mut all, base);
    let mut veils = Vec::new();
    veil::in_front(&line.veils, nears, &mut veils);
    Line {
        opaque: all.iter().map(|(segment, _)| *segment).collect(),
        sides: if leaning { all.iter().map(|(_, sides)| *sides).collect() } else { Vec::new() },
        veils,
    }
}

/// Brings the borders in order at the top and at the bottom of the strip; faces give way to bodies.
fn order(all: &mut [(Segment, Sides)], base: u32) {
    for end in 0..2 {
        let mut least = f64::NEG_INFINITY;
        for (segment, sides) in all.iter_mut() {
            let (left, right) = (&mut sides.left[end], &mut sides.right[end]);
            if segment.face >= base && *left > *right {
                (*left, *right) = (0.5 * (*left + *right), 0.5 * (*left + *right));
            }
            *left = left.max(least);
            *right = right.max(*left);
            if segment.face >= base {
                least = *right;
            }
        }
        let mut most = f64::INFINITY;
        for (segment, sides) in all.iter_mut().rev() {
            let (left, right) = (&mut sides.left[end], &mut sides.right[end]);
            *right = right.min(most);
            *left = left.min(*right);
            if segment.face >= base {
                most = *left;
            }
        }
    }
}

impl Line {
    /// What the upper (0) or lower (1) half of its strip shows: borders go straight on.
    pub(super) fn half(&self, half: usize) -> Self {
        let part = |[top, bottom]: Border| {
            let middle = 0.5 * (top + bottom);
            if half == 0 { [top, middle] } else { [middle, bottom] }
        };
        let mut line = Self { opaque: Vec::new(), sides: Vec::new(), veils: self.veils.clone() };
        for (span, sides) in self.opaque.iter().zip(&self.sides) {
            let sides = Sides { left: part(sides.left), right: part(sides.right) };
            // Borders of what fills the picture up to its side lie infinitely far off.
            let middle = |[top, bottom]: Border, x: f64| {
                let middle = 0.5 * (top + bottom);
                if middle.is_finite() { middle } else { x }
            };
            let (x0, x1) = (middle(sides.left, span.x0), middle(sides.right, span.x1));
            if x0 < x1 {
                line.opaque.push(Segment { x0, x1, w: span.nearness(x0), ..*span });
                line.sides.push(sides);
            }
        }
        line
    }
}
