//! Which stretches of the half circles does the scene hide?

use std::cmp::Ordering;
use std::f64::consts::PI;

use glam::DVec3;

use super::table::middle;
use crate::obstacles::{Bounds, Oriented, Visit, above, is_edge_on};

/// A stretch of a band's half circle \[rad\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) band: u32,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl Interval {
    /// By band, then by start.
    pub(crate) fn order(&self, other: &Self) -> Ordering {
        self.band.cmp(&other.band).then(self.from.total_cmp(&other.from)).then(self.to.total_cmp(&other.to))
    }
}

/// Collects them around one place.
pub(crate) struct Shadows {
    /// Upwards, in the plane's coordinates.
    up: DVec3,
    middles: Vec<DVec3>,
    floor: f64,
    error: f64,
    found: Vec<Interval>,
}

impl Shadows {
    pub(crate) fn new(up: DVec3, count: usize, floor: f64, error: f64) -> Self {
        Self {
            up,
            middles: (0..count).map(|band| middle(band, count)).collect(),
            floor,
            error,
            found: Vec::new(),
        }
    }

    pub(crate) fn sorted(mut self) -> Vec<Interval> {
        self.found.sort_by(Interval::order);
        self.found
    }

    /// First and last band whose middle may pass between these coordinates along b and, over the plane, along n.
    fn bands(&self, b: [f64; 2], n: [f64; 2]) -> Option<[usize; 2]> {
        let n = [n[0].max(0.0), n[1].max(0.0)];
        let cosine = |b: f64, n: f64| if b == 0.0 { 0.0 } else { b / b.hypot(n) };
        // The cosine rises with b; with n it falls where b is positive.
        let low = cosine(b[0], if b[0] < 0.0 { n[0] } else { n[1] });
        let high = cosine(b[1], if b[1] > 0.0 { n[0] } else { n[1] });
        let count = self.middles.len() as f64;
        // Far more than rounding, far less than a band.
        let at = |cosine: f64, slack: f64| 0.5 * ((cosine + 1.0) * count - 1.0) + slack;
        let first = at(low, -1e-6).ceil().max(0.0);
        let last = at(high, 1e-6).floor().min(count - 1.0);
        (first <= last).then_some([first as usize, last as usize])
    }

    /// Adds what a convex polygon, in the plane's coordinates, hides.
    fn hide(&mut self, polygon: &[DVec3]) {
        let along = |f: fn(f64, f64) -> f64, k: usize| polygon.iter().map(|p| p[k]).reduce(f).unwrap_or(0.0);
        let [b, n] = [1, 2].map(|k| [along(f64::min, k), along(f64::max, k)]);
        let Some([first, last]) = (n[1] > 0.0).then(|| self.bands(b, n)).flatten() else { return };
        for band in first..=last {
            if let Some([from, to]) = cut(polygon, self.middles[band]) {
                self.found.push(Interval { band: band as u32, from, to });
            }
        }
    }
}

/// The stretch of the half circle through a and `middle` that a convex polygon hides.
///
/// The plane of the half circle cuts the polygon in a segment; what of it is not beyond a counts.
fn cut(polygon: &[DVec3], middle: DVec3) -> Option<[f64; 2]> {
    let across = DVec3::new(0.0, middle.z, -middle.y);
    let (mut ends, mut count) = ([[0.0; 2]; 2], 0);
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (before, after) = (across.dot(p), across.dot(q));
        if (before >= 0.0) == (after >= 0.0) || count == 2 {
            continue;
        }
        // From the same end in both faces that share the edge.
        let (low, high, down, up) =
            if before < after { (p, q, before, after) } else { (q, p, after, before) };
        let met = low + (high - low) * (-down / (up - down));
        ends[count] = [met.x, met.dot(middle)];
        count += 1;
    }
    let [mut p, mut q] = ends;
    if count < 2 || (p[1] <= 0.0 && q[1] <= 0.0) {
        return None;
    }
    if p[1] < 0.0 || q[1] < 0.0 {
        // The part over a: where the segment passes it there is neither up nor down.
        let zero = p[0] + (q[0] - p[0]) * (p[1] / (p[1] - q[1]));
        if p[1] < 0.0 {
            p = [zero, 0.0];
        } else {
            q = [zero, 0.0];
        }
    }
    let [from, to] = [p, q].map(|[x, y]| y.atan2(x).clamp(0.0, PI));
    Some(if from < to { [from, to] } else { [to, from] })
}

impl Visit for Shadows {
    fn wants(&mut self, bounds: &Bounds, solid: &Oriented) -> bool {
        let Bounds { low, high } = bounds;
        solid.most(self.up) > self.floor
            && high.z > 0.0
            && self.bands([low.y, high.y], [low.z, high.z]).is_some()
    }

    fn triangle(&mut self, corners: [DVec3; 3]) {
        if is_edge_on(&corners, self.error) {
            return;
        }
        if corners.iter().all(|&corner| self.up.dot(corner) >= self.floor) {
            return self.hide(&corners);
        }
        let (polygon, count) = above(corners, self.up, self.floor);
        self.hide(&polygon[..count]);
    }
}
