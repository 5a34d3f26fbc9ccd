//! Whether a point belongs to a body, asked of the definitions: what lines are tested by.

use glam::DVec3;

use super::node::{Node, Shape};

/// How far outside a node a point is, in some increasing measure: negative inside, positive outside.
///
/// Each shape's own inequality decides: |p| ≤ 1; x² + z² ≤ r(y)² and 0 ≤ y ≤ 1; n · p ≤ k. Members are
/// united by min, intersected by max, and subtracted by their negative. No lines, no roots. Near 0 only rounding
/// decides; on a face in common it is 0 on both sides.
pub fn outside(node: &Node, point: DVec3) -> f64 {
    match node {
        Node::Solid { shape, world_from_solid, .. } => {
            let p = world_from_solid.inverse().transform_point3(point);
            match shape {
                Shape::Sphere => p.length() - 1.0,
                Shape::Cylinder => frustum(1.0, p),
                Shape::Cone => frustum(0.0, p),
                Shape::Frustum { top } => frustum(*top, p),
                Shape::Polyhedron(planes) => planes
                    .iter()
                    .map(|plane| (plane.normal.dot(p) - plane.offset) / plane.normal.length())
                    .fold(f64::NEG_INFINITY, f64::max),
            }
        }
        Node::Union(nodes) => nodes.iter().map(|n| outside(n, point)).fold(f64::INFINITY, f64::min),
        Node::Intersection(nodes) => {
            nodes.iter().map(|n| outside(n, point)).fold(f64::NEG_INFINITY, f64::max)
        }
        Node::Difference(whole, cuts) => {
            cuts.iter().map(|n| -outside(n, point)).fold(outside(whole, point), f64::max)
        }
    }
}

fn frustum(top: f64, p: DVec3) -> f64 {
    let radius = 1.0 + (top - 1.0) * p.y;
    (p.x.hypot(p.z) - radius).max(-p.y).max(p.y - 1.0)
}
