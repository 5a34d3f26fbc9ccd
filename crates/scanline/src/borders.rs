//! How the borders of visible spans lean within their strip.
//!
//! A border is the straight line that goes on from the middle of the strip to its top and bottom as the edge
//! does that makes it, or the line in which two faces cross. Neighbouring spans have one border between
//! them, so that what one gains the other loses. Where two borders would meet within the strip, the
//! flatter one gives way, and those between faces of one surface give way to outlines.
//!
//! An edge that ends within the strip, because the strips were not cut there, leads a border only up to its end
//! if its face stands alone. Where the face is part of a surface, its neighbour's edge goes on much the same.

use crate::segment::{Lean, Segment};

/// A border: x at the top and at the bottom of the strip.
pub(crate) type Border = [f64; 2];

/// Left and right border of a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sides {
    pub(crate) left: Border,
    pub(crate) right: Border,
}

/// What makes a border.
#[derive(Clone, Copy, Debug)]
struct Made {
    /// x on the line.
    x: f64,
    /// dx/dy.
    slope: f64,
    yields: f32,
    /// How far the edge goes up and down from the line.
    reach: [f32; 2],
    /// Height of the edge.
    height: f32,
    /// Of which end of its span: the other border of that is one to the left (1) or to the right (0).
    end: usize,
}

impl Made {
    /// Upright, and here to stay.
    fn upright(x: f64) -> Self {
        Self { x, slope: 0.0, yields: 0.0, reach: [f32::INFINITY; 2], height: 0.0, end: 0 }
    }
}

/// Working memory.
#[derive(Default)]
pub(crate) struct Borders {
    made: Vec<Made>,
    all: Vec<Border>,
}

/// Is the left (0) or right (1) end of a visible span that of its face, clipped to the picture?
fn own(span: &Segment, lean: &Lean, end: usize, width: f64) -> bool {
    match end {
        0 => span.x0 == lean.x[0].max(0.0),
        _ => span.x1 == lean.x[1].min(width),
    }
}

impl Borders {
    /// Fills `out` with the sides of the `visible` spans of a strip of height `height`; `leans` are those of
    /// the line's segments.
    pub(crate) fn find(
        &mut self,
        visible: &[Segment],
        leans: &[Lean],
        height: f64,
        width: f64,
        out: &mut Vec<Sides>,
    ) {
        self.made.clear();
        let mut before: Option<&Segment> = None;
        for span in visible {
            match before {
                Some(before) if before.x1 == span.x0 => self.made.push(between(before, span, leans, width)),
                Some(before) => {
                    self.made.push(end_of(before, leans, 1, width));
                    self.made.push(end_of(span, leans, 0, width));
                }
                None => self.made.push(end_of(span, leans, 0, width)),
            }
            before = Some(span);
        }
        self.made.extend(before.map(|last| end_of(last, leans, 1, width)));
        self.lean(0.5 * height);
        self.order();
        out.clear();
        let mut left = 0;
        for (i, span) in visible.iter().enumerate() {
            // Spans that do not touch have two borders between them.
            if i > 0 && visible[i - 1].x1 != span.x0 {
                left += 1;
            }
            out.push(Sides { left: self.all[left], right: self.all[left + 1] });
            left += 1;
        }
    }

    /// From the line to the top and the bottom of the strip.
    fn lean(&mut self, half: f64) {
        let inner = |i: usize| self.made.get(i).is_none_or(|made| made.yields >= INNER);
        self.all.clear();
        for (i, made) in self.made.iter().enumerate() {
            let other = if made.end == 0 { i + 1 } else { i.wrapping_sub(1) };
            let on = if inner(i) || inner(other) { ON * made.height } else { 0.0 };
            let [up, down] = made.reach.map(|reach| half.min(f64::from(reach + on)));
            self.all.push([made.x - made.slope * up, made.x + made.slope * down]);
        }
    }

    /// Brings the borders in order at the top and at the bottom.
    fn order(&mut self) {
        for end in 0..2 {
            for i in 1..self.all.len() {
                let (x, yields) = (self.all[i][end], self.made[i].yields);
                // Back to the first that is in order, or stays.
                let mut k = i;
                while k > 0 && self.all[k - 1][end] > x && self.made[k - 1].yields > yields {
                    k -= 1;
                }
                let x = if k > 0 { self.all[k - 1][end].max(x) } else { x };
                self.all[k..=i].iter_mut().for_each(|border| border[end] = x);
            }
        }
    }
}

/// The border at the end of a span beside which nothing nearer shows.
fn end_of(span: &Segment, leans: &[Lean], end: usize, width: f64) -> Made {
    let lean = &leans[span.lean as usize];
    // What goes on beyond the picture fills it up to there.
    if end == 0 && lean.x[0] <= 0.0 && span.x0 <= 0.0 {
        Made::upright(f64::NEG_INFINITY)
    } else if end == 1 && lean.x[1] >= width && span.x1 >= width {
        Made::upright(f64::INFINITY)
    } else if own(span, lean, end, width) {
        // Finite, so that no product of it is a NaN.
        let slope = lean.edges[end].clamp(-1e30, 1e30);
        let (x, yields) = (lean.x[end], slope.abs());
        Made { x, slope: f64::from(slope), yields, reach: lean.reach[end], height: lean.heights[end], end }
    } else {
        Made::upright([span.x0, span.x1][end])
    }
}

/// The border between two spans that touch.
fn between(a: &Segment, b: &Segment, leans: &[Lean], width: f64) -> Made {
    let (a_lean, b_lean) = (&leans[a.lean as usize], &leans[b.lean as usize]);
    match (own(a, a_lean, 1, width), own(b, b_lean, 0, width)) {
        (true, true) => {
            let (a_near, b_near) = (a.nearness(a.x1), b.w);
            let nearer =
                if a_near >= b_near { end_of(a, leans, 1, width) } else { end_of(b, leans, 0, width) };
            // Between two faces of one surface there is little to see as a rule: such borders yield to outlines.
            let joined = (a_near - b_near).abs() <= f64::from(a.error + b.error);
            Made { yields: nearer.yields + if joined { INNER } else { 0.0 }, ..nearer }
        }
        (true, false) => end_of(a, leans, 1, width),
        (false, true) => end_of(b, leans, 0, width),
        // Where two planes are equally near: (slopes' difference) dx + (falls' difference) dy = 0.
        (false, false) => {
            let slope = (a_lean.fall - b_lean.fall) / (b.slope - a.slope);
            let slope = if slope.is_finite() { slope } else { 0.0 };
            Made { slope, yields: slope.abs() as f32, ..Made::upright(b.x0) }
        }
    }
}

/// Added to what borders within a surface yield by: more than any slope that matters.
const INNER: f32 = 1e9;

/// How many times its length an edge of a surface goes on beyond its end, within the strip. Measured on outlines
/// of terrain whose faces are from 0.1 to 10 pixels wide: less makes smooth outlines worse, more makes rough
/// ones worse than by the midpoint rule.
const ON: f32 = 16.0;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WIDTH: f64 = 64.0;

    proptest! {
        /// However wildly they lean: no span has a negative width at the top or the bottom, and spans that touch have
        /// one border between them.
        #[test]
        fn borders_are_in_order(
            numbers in prop::collection::vec((0f64..4.0, 0f64..4.0, -1e3f32..1e3, -1e3f32..1e3, 0f64..2.0), 1..30),
            touch in prop::bool::ANY,
        ) {
            let (mut visible, mut leans, mut x) = (Vec::new(), Vec::new(), 0.0);
            for (i, &(gap, length, left, right, w)) in (0u32..).zip(&numbers) {
                let x0 = if touch { x } else { x + gap };
                x = x0 + length;
                if x0 < x && x < WIDTH {
                    visible.push(Segment { x0, x1: x, w, slope: 0.0, error: 0.3, face: i, lean: leans.len() as u32, ..Segment::default() });
                    let (reach, heights) = ([[0.1, 1.0], [1.0, 0.0]], [1.1, 1.0]);
                    leans.push(Lean { x: [x0, x], edges: [left, right], fall: 0.0, reach, heights });
                }
            }
            let mut sides = Vec::new();
            Borders::default().find(&visible, &leans, 0.25, WIDTH, &mut sides);
            prop_assert_eq!(sides.len(), visible.len());
            for side in &sides {
                prop_assert!(side.left[0] <= side.right[0] && side.left[1] <= side.right[1]);
            }
            for (spans, sides) in visible.windows(2).zip(sides.windows(2)) {
                let (a, b) = (sides[0].right, sides[1].left);
                prop_assert!(a[0] <= b[0] && a[1] <= b[1]);
                prop_assert!(spans[0].x1 < spans[1].x0 || a == b);
            }
        }
    }
}
