//! Whether two parts of the scene can see each other, and how much of one another at most.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use crate::patch::reach;
use crate::tree::Node;

/// What is known of two nodes from their spheres, cones of normals and planes alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sight {
    /// They turn their backs on each other.
    None,
    /// They may; of what the first sends out no more than this share arrives at the second (infinite when too near to tell).
    Within(f64),
}

/// Corners this share of the largest coordinate off a plane count as lying in it: what f64 transforms leave.
const ROUNDING: f64 = 1e-12;

pub(crate) fn sight(a: &Node, b: &Node) -> Sight {
    if is_behind(a, b) || is_behind(b, a) {
        return Sight::None;
    }
    let way = b.centre - a.centre;
    let distance = way.length();
    let radii = a.radius + b.radius;
    if distance <= radii {
        return Sight::Within(f64::INFINITY);
    }
    let toward = way / distance;
    // The sine: no way between the two is farther from that between the centres.
    let slack = radii / distance;
    let (Some(cos_a), Some(cos_b)) = (best_cosine(a, toward, slack), best_cosine(b, -toward, slack)) else {
        return Sight::None;
    };
    let gap = distance - radii;
    Sight::Within(b.area * cos_a * cos_b / (PI * gap * gap))
}

/// Whether all of `b` is behind the plane of piece `a`.
fn is_behind(a: &Node, b: &Node) -> bool {
    if !a.is_piece {
        return false;
    }
    let height = (b.centre - a.centre).dot(a.normal);
    if height + b.radius <= 0.0 {
        return true;
    }
    let least = ROUNDING * (reach(&a.corners) + reach(&b.corners));
    b.is_piece && b.corners.iter().all(|corner| (*corner - a.corners[0]).dot(a.normal) <= least)
}

/// The largest cosine between one of the node's normals and a direction within asin `slack` of `toward`; none when all
/// are beyond 90°.
pub(crate) fn best_cosine(node: &Node, toward: DVec3, slack: f64) -> Option<f64> {
    let cos = node.normal.dot(toward).clamp(-1.0, 1.0);
    if node.spread > 0.0 {
        let angle = cos.acos() - slack.asin() - node.spread;
        return (angle < FRAC_PI_2).then(|| angle.max(0.0).cos());
    }
    // The cosine of the difference of two angles, both known by their sines and cosines.
    let least = (1.0 - slack * slack).max(0.0).sqrt();
    if cos >= least {
        return Some(1.0);
    }
    let best = cos * least + (1.0 - cos * cos).sqrt() * slack;
    (best > 0.0).then_some(best)
}
