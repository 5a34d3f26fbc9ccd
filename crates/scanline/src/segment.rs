//! A face cut by a line: a segment in (x, nearness).

use std::ops::Range;

use glam::DVec3;
use light::{Projection, View};

use crate::grid::Grid;

/// Unit round-off of f64.
const UNIT: f64 = f64::EPSILON * 0.5;

/// What a face shows on one line if nothing is in front: nearness is w + (x − x0) · slope on \[x0, x1\].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Segment {
    pub(crate) x0: f64,
    pub(crate) x1: f64,
    /// Nearness at x0.
    pub(crate) w: f64,
    /// ∂nearness/∂x.
    pub(crate) slope: f64,
    /// How wrong the nearness may be: within the sum of both errors two segments are equally near.
    pub(crate) error: f32,
    /// Number of the face, in the order of (instance, triangle).
    pub(crate) face: u32,
    /// Index of its [`Lean`] among those of the line.
    pub(crate) lean: u32,
    /// What is known of the light on it ([`crate::known::Table`]).
    pub(crate) known: u32,
}

/// How a segment changes from line to line.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lean {
    /// Left and right end, which may lie beyond the picture.
    pub(crate) x: [f64; 2],
    /// dx/dy of the edges at both ends. An f32 errs along the edge by 2⁻²⁴ of the strip's height.
    pub(crate) edges: [f32; 2],
    /// ∂nearness/∂y of the face.
    pub(crate) fall: f64,
    /// How far the face goes on up and down along these edges, each; no end at its middle corner.
    pub(crate) reach: [[f32; 2]; 2],
    /// Heights of these edges.
    pub(crate) heights: [f32; 2],
}

impl Segment {
    pub(crate) fn nearness(&self, x: f64) -> f64 {
        self.w + (x - self.x0) * self.slope
    }
}

impl Lean {
    /// Left and right exchanged.
    fn turned(self) -> Self {
        let Self { x: [a, b], edges: [c, d], fall, reach: [e, f], heights: [g, h] } = self;
        Self { x: [b, a], edges: [d, c], fall, reach: [f, e], heights: [h, g] }
    }
}

/// What bounds the rounding errors of a view's screen coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounding {
    /// Largest coordinate of anything in the world, and of the eye \[m\].
    reach: f64,
    scale: f64,
    perspective: bool,
    width: f64,
}

impl Rounding {
    pub(crate) fn new(view: &View, reach: f64) -> Self {
        Self {
            reach,
            scale: view.scale(),
            perspective: matches!(view.projection, Projection::Perspective { .. }),
            width: f64::from(view.width),
        }
    }

    /// Bound on the error of a segment's nearness.
    ///
    /// View coordinates come from a rotation and a subtraction at magnitude `reach`: wrong by a few
    /// u · reach metres. Nearness 1/d passes that on times 1/d² (parallel: times 1), x on the screen times
    /// scale/d, and an x wrong by δ means a nearness wrong by δ · slope. To this come the roundings of the
    /// interpolation itself at the magnitude of the face's corners (`largest`: |x| and nearness). Eight
    /// roundings on the way to each: projection 3, edge 3, segment 2.
    fn of(&self, near: f64, slope: f64, largest: (f64, f64), change: f64) -> f32 {
        let seen = UNIT * self.reach;
        let (depth, lateral) = if self.perspective {
            (near * near * seen, near * self.scale * seen)
        } else {
            (seen, self.scale * seen)
        };
        // A segment cannot be wronger by sliding along itself than its own rise.
        let along = ((UNIT * largest.0 + lateral) * slope.abs()).min(change.abs());
        (8.0 * (UNIT * largest.1 + depth + along)) as f32
    }
}

/// One edge of a face on the screen, from its upper to its lower corner.
///
/// Both faces at an edge see the same two corners in the same order, so that they get the same bits.
struct Edge {
    from: DVec3,
    height: f64,
    dx: f64,
    dw: f64,
}

impl Edge {
    fn new(from: DVec3, to: DVec3) -> Self {
        let height = to.y - from.y;
        Self { from, height, dx: (to.x - from.x) / height, dw: (to.z - from.z) / height }
    }

    /// (x, nearness) at a line.
    fn at(&self, y: f64) -> (f64, f64) {
        let down = y - self.from.y;
        (self.from.x + down * self.dx, self.from.z + down * self.dw)
    }

    /// How far it goes up and down from a line that it crosses.
    fn reach(&self, y: f64) -> [f32; 2] {
        let up = y - self.from.y;
        [up as f32, (self.height - up) as f32]
    }
}

/// Lines that a face crosses: those with top ≤ y < bottom.
pub(crate) fn lines(grid: &Grid, corners: &[DVec3; 3]) -> Range<u32> {
    let [a, b, c] = corners.map(|corner| corner.y);
    grid.first_at_or_below(a.min(b).min(c))..grid.first_at_or_below(a.max(b).max(c))
}

/// Cuts a face by the lines at `ys`, which rise, and hands out (index into `ys`, segment), clipped to the
/// picture.
pub(crate) fn cut(
    ys: &[f64],
    rounding: &Rounding,
    corners: [DVec3; 3],
    face: u32,
    mut receive: impl FnMut(usize, Segment, Lean),
) {
    let [mut a, mut b, mut c] = corners;
    if b.y < a.y {
        std::mem::swap(&mut a, &mut b);
    }
    if c.y < b.y {
        std::mem::swap(&mut b, &mut c);
        if b.y < a.y {
            std::mem::swap(&mut a, &mut b);
        }
    }
    let above = |y: f64| ys.iter().take_while(|line| **line < y).count();
    let (start, end) = (above(a.y), above(c.y));
    if start == end {
        return;
    }
    let middle = above(b.y);
    let largest = {
        let largest = a.abs().max(b.abs()).max(c.abs());
        (largest.x, largest.z)
    };
    let long = Edge::new(a, c);
    // An edge that no line crosses may have no height; its slope is not asked for.
    for (short, lines, inner) in [((a, b), start..middle, 1), ((b, c), middle..end, 0)] {
        if lines.is_empty() {
            continue;
        }
        let short = Edge::new(short.0, short.1);
        for line in lines {
            let (p, q) = (long.at(ys[line]), short.at(ys[line]));
            if let Some(segment) = between(rounding, (p, q), largest, face) {
                let fall = long.dw - long.dx * segment.slope;
                let mut reach = short.reach(ys[line]);
                reach[inner] = f32::INFINITY;
                let lean = Lean {
                    x: [p.0, q.0],
                    edges: [long.dx as f32, short.dx as f32],
                    fall,
                    reach: [long.reach(ys[line]), reach],
                    heights: [long.height as f32, short.height as f32],
                };
                let lean = if q.0 < p.0 { lean.turned() } else { lean };
                receive(line, segment, lean);
            }
        }
    }
}

/// The segment between two (x, nearness), in any order; none where nothing of it is in the picture.
fn between(
    rounding: &Rounding,
    (p, q): ((f64, f64), (f64, f64)),
    largest: (f64, f64),
    face: u32,
) -> Option<Segment> {
    let ((x0, w0), (x1, w1)) = if q.0 < p.0 { (q, p) } else { (p, q) };
    // Also false for a NaN.
    if !(x0 < x1 && x1 > 0.0 && x0 < rounding.width) {
        return None;
    }
    let slope = (w1 - w0) / (x1 - x0);
    let mut segment =
        Segment { x0, x1: x1.min(rounding.width), w: w0, slope, error: 0.0, face, lean: 0, known: 0 };
    if x0 < 0.0 {
        segment.w = w0 - x0 * slope;
        segment.x0 = 0.0;
    }
    let end = segment.nearness(segment.x1);
    let near = segment.w.abs().max(end.abs());
    segment.error = rounding.of(near, slope, largest, end - segment.w);
    Some(segment)
}
