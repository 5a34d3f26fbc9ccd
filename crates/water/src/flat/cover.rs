//! Whether there is a surface over a point.

use glam::DVec2;

/// Cells along each side are at most this many.
const MOST: f64 = 256.0;

/// A cell has the triangles that come this near to it, as a share of the whole extent: more than rounding moves anything by.
const MARGIN: f64 = 1e-9;

/// Triangles in the plane, by the cells of a grid that they touch: some √n cells to a side for n triangles, so that a point is tried against
/// a few of them.
#[derive(Clone, Debug)]
pub(super) struct Cover {
    /// Those with an area.
    triangles: Vec<[DVec2; 3]>,
    low: DVec2,
    high: DVec2,
    step: DVec2,
    across: usize,
    /// Where each cell's triangles begin in `numbers`, and where the last ends.
    starts: Vec<usize>,
    numbers: Vec<u32>,
}

impl Cover {
    /// Of these triangles, of any orientation; those without an area cover nothing.
    pub(super) fn new(triangles: impl Iterator<Item = [DVec2; 3]>) -> Self {
        let triangles: Vec<_> = triangles.filter(|[a, b, c]| (b - a).perp_dot(c - a) != 0.0).collect();
        let corners = || triangles.iter().flatten().copied();
        let low = corners().reduce(DVec2::min).unwrap_or(DVec2::INFINITY);
        let high = corners().reduce(DVec2::max).unwrap_or(DVec2::NEG_INFINITY);
        let across = (triangles.len() as f64).sqrt().ceil().clamp(1.0, MOST) as usize;
        let step = (high - low) / across as f64;
        let mut cover = Self { triangles, low, high, step, across, starts: Vec::new(), numbers: Vec::new() };
        let mut cells = vec![Vec::new(); across * across];
        for (n, triangle) in cover.triangles.iter().enumerate() {
            cover.touched(triangle, |cell| cells[cell].push(n as u32));
        }
        cover.starts.push(0);
        for cell in cells {
            cover.numbers.extend(cell);
            cover.starts.push(cover.numbers.len());
        }
        cover
    }

    /// The corners of least and largest coordinates about all of them.
    pub(super) fn extent(&self) -> [DVec2; 2] {
        [self.low, self.high]
    }

    /// Whether a point lies in one of them; their edges belong to them.
    pub(super) fn holds(&self, at: DVec2) -> bool {
        if !(at.cmpge(self.low).all() && at.cmple(self.high).all()) {
            return false;
        }
        let [i, j] = self.cell(at);
        let cell = j * self.across + i;
        let here = &self.numbers[self.starts[cell]..self.starts[cell + 1]];
        here.iter().any(|&n| holds(&self.triangles[n as usize], at))
    }

    /// The cell along each axis that a point lies in, or the nearest to it.
    fn cell(&self, at: DVec2) -> [usize; 2] {
        ((at - self.low) / self.step).to_array().map(|u| (u.max(0.0) as usize).min(self.across - 1))
    }

    /// Calls `visit` with each cell that a triangle comes near: no side of the triangle, and none of the cell, lies between them.
    fn touched(&self, triangle: &[DVec2; 3], mut visit: impl FnMut(usize)) {
        let [a, b, c] = *triangle;
        let margin = (self.high - self.low) * MARGIN;
        let first = self.cell(a.min(b).min(c) - margin);
        let last = self.cell(a.max(b).max(c) + margin);
        let turn = (b - a).perp_dot(c - a).signum();
        for j in first[1]..=last[1] {
            for i in first[0]..=last[0] {
                let low = self.low + self.step * DVec2::new(i as f64, j as f64) - margin;
                let half = 0.5 * self.step + margin;
                let middle = low + half;
                let beyond = |(from, to): (DVec2, DVec2)| {
                    let inward = (to - from).perp() * turn;
                    inward.dot(middle - from) + inward.abs().dot(half) < 0.0
                };
                if ![(a, b), (b, c), (c, a)].into_iter().any(beyond) {
                    visit(j * self.across + i);
                }
            }
        }
    }
}

/// Whether a point lies in a triangle of either orientation.
fn holds(&[a, b, c]: &[DVec2; 3], p: DVec2) -> bool {
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(p - from));
    sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// By the corners of each: whether the point is between them by its barycentric coordinates, rims within ± `rim`.
    fn among(triangles: &[[DVec2; 3]], at: DVec2, rim: f64) -> bool {
        triangles.iter().any(|&[a, b, c]| {
            let area = (b - a).perp_dot(c - a);
            let u = (c - b).perp_dot(at - b) / area;
            let v = (a - c).perp_dot(at - c) / area;
            u >= -rim && v >= -rim && 1.0 - u - v >= -rim
        })
    }

    fn corner() -> impl Strategy<Value = DVec2> {
        prop_oneof![
            (-3.0..3.0f64, -3.0..3.0f64).prop_map(|(x, y)| DVec2::new(x, y)),
            // Where edges meet and lie on the grid's lines.
            (-3i32..=3, -3i32..=3).prop_map(|(x, y)| DVec2::new(x.into(), y.into())),
        ]
    }

    proptest! {
        #[test]
        fn it_is_what_trying_all_finds(
            triangles in prop::collection::vec([corner(), corner(), corner()], 0..60), points in prop::collection::vec(corner(), 40),
        ) {
            let cover = Cover::new(triangles.iter().copied());
            let whole: Vec<_> = triangles.into_iter().filter(|[a, b, c]| (b - a).perp_dot(c - a) != 0.0).collect();
            let middles: Vec<_> = whole.iter().map(|[a, b, c]| (a + b + c) / 3.0).collect();
            for at in points.into_iter().chain(whole.iter().flatten().copied()).chain(middles) {
                // Rounding decides at rims alone.
                let [sure, maybe] = [-1e-9, 1e-9].map(|rim| among(&whole, at, rim));
                let got = cover.holds(at);
                prop_assert!(got || !sure, "{at} is in one of them");
                prop_assert!(!got || maybe, "{at} is in none of them");
                prop_assert_eq!(got, whole.iter().any(|triangle| holds(triangle, at)));
            }
        }
    }

    #[test]
    fn many_triangles_take_little_longer_than_few() {
        // A lake of 10,082 triangles, as slivers about its middle: the worst for a grid.
        let n = 10_082;
        let at = |i: u32| DVec2::from_angle(f64::from(i % n) / f64::from(n) * std::f64::consts::TAU);
        let cover = Cover::new((0..n).map(|i| [DVec2::ZERO, at(i), at(i + 1)]));
        let tried = |cell: usize| cover.starts[cell + 1] - cover.starts[cell];
        let all: usize = (0..cover.across * cover.across).map(tried).sum();
        // On average some n/across of them: each passes as many cells.
        println!("{} to a cell", all as f64 / (cover.across * cover.across) as f64);
        assert!(all < 2 * cover.across * n as usize);
        assert!(cover.holds(DVec2::new(0.3, -0.2)) && !cover.holds(DVec2::new(0.8, 0.7)));
    }
}
