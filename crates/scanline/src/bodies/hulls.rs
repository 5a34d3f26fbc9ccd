//! Where on a line a body may show: its circumscribed polyhedra, projected.

use glam::DVec3;
use light::{Hull, View};

/// Where a body may show on a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) body: u32,
    pub(crate) x: [f64; 2],
    /// Nothing of the body is nearer on this line.
    pub(crate) nearness: f64,
}

/// A hull on the screen.
///
/// The projection takes a convex polyhedron beyond the near plane to one in (x, y, nearness), which a line cuts in
/// a convex polygon with corners on its edges.
#[derive(Clone, Debug)]
pub(crate) struct Projected {
    body: u32,
    edges: Vec<[DVec3; 2]>,
    /// Highest and lowest y.
    y: [f64; 2],
}

/// Corners are projected with few roundings: far less than this \[pixel\].
const SLACK: f64 = 1e-6;

impl Projected {
    /// None for what lies wholly before the near plane. What passes through it may show everywhere.
    pub(crate) fn new(view: &View, hull: &Hull) -> Option<Self> {
        let seen: Vec<DVec3> = hull.corners.iter().map(|corner| view.view_from_world(*corner)).collect();
        if seen.iter().all(|corner| corner.z > -view.near) {
            return None;
        }
        let everywhere = Self { body: hull.body, edges: Vec::new(), y: [f64::NEG_INFINITY, f64::INFINITY] };
        let beyond = |corner: &DVec3| corner.z <= -view.near && corner.is_finite();
        if !seen.iter().all(beyond) {
            return Some(everywhere);
        }
        let corners: Vec<DVec3> = seen.iter().map(|corner| view.screen_from_view(*corner)).collect();
        if !corners.iter().all(|corner| corner.is_finite()) {
            return Some(everywhere);
        }
        let mut edges = Vec::new();
        for &[a, b, c] in &hull.faces {
            // Each edge belongs to two faces, in opposite directions.
            edges.extend([[a, b], [b, c], [c, a]].into_iter().filter(|[from, to]| from < to));
        }
        let edges = edges.iter().map(|edge| edge.map(|i| corners[i as usize])).collect();
        let top = corners.iter().fold(f64::INFINITY, |top, corner| top.min(corner.y));
        let bottom = corners.iter().fold(f64::NEG_INFINITY, |bottom, corner| bottom.max(corner.y));
        Some(Self { body: hull.body, edges, y: [top, bottom] })
    }

    /// Its interval on a line, within the picture.
    pub(crate) fn at(&self, y: f64, width: f64) -> Option<Interval> {
        self.between([y, y], width)
    }

    /// All its intervals on lines from `top` to `bottom` together.
    pub(crate) fn between(&self, [top, bottom]: [f64; 2], width: f64) -> Option<Interval> {
        if self.y[0] > bottom || self.y[1] < top {
            return None;
        }
        let body = self.body;
        if self.edges.is_empty() {
            return Some(Interval { body, x: [0.0, width], nearness: f64::INFINITY });
        }
        let (mut x, mut nearness) = ([f64::INFINITY, f64::NEG_INFINITY], f64::NEG_INFINITY);
        for [p, q] in &self.edges {
            let (upper, lower) = if p.y <= q.y { (p, q) } else { (q, p) };
            if upper.y > bottom || lower.y < top {
                continue;
            }
            let height = lower.y - upper.y;
            let at = |y: f64| if height > 0.0 { ((y - upper.y) / height).clamp(0.0, 1.0) } else { 0.0 };
            let ends = if height > 0.0 { [at(top), at(bottom)] } else { [0.0, 1.0] };
            for t in ends {
                let point = *upper + (*lower - *upper) * t;
                x = [x[0].min(point.x), x[1].max(point.x)];
                nearness = nearness.max(point.z);
            }
        }
        let x = [(x[0] - SLACK).max(0.0), (x[1] + SLACK).min(width)];
        (x[0] < x[1]).then(|| Interval { body, x, nearness: nearness + SLACK * nearness.abs() })
    }
}

/// Intervals of one body that overlap become one; sorted by (body, left end).
pub(crate) fn unite(intervals: &mut Vec<Interval>) {
    intervals.sort_by(|a, b| a.body.cmp(&b.body).then(a.x[0].total_cmp(&b.x[0])));
    intervals.dedup_by(|next, kept| {
        let joined = next.body == kept.body && next.x[0] <= kept.x[1];
        if joined {
            kept.x[1] = kept.x[1].max(next.x[1]);
            kept.nearness = kept.nearness.max(next.nearness);
        }
        joined
    });
}

/// Stretches of \[left, right\] that overlap become one; sorted.
pub(crate) fn stretches(intervals: &[Interval]) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = intervals.iter().map(|interval| interval.x).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all.dedup_by(|next, kept| {
        let joined = next[0] <= kept[1];
        if joined {
            kept[1] = kept[1].max(next[1]);
        }
        joined
    });
    all
}
