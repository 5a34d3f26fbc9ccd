//! Slow and plain, by other ways than the stage itself: what tests hold it against.

use glam::{DVec2, DVec3};
use light::{Geometry, View};

/// A face that a viewing ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Depth along the line of sight \[m\].
    pub depth: f64,
    /// Smallest of the three barycentric weights: how far inside, < 0 = outside.
    pub inside: f64,
    /// Index into [`Geometry::instances`].
    pub instance: u32,
    /// Index of the triangle within its mesh.
    pub triangle: u32,
}

/// All faces whose plane the ray through screen point `at` meets beyond the near plane with barycentric
/// weights of at least −`margin`, nearest first. Asks every face: O(n).
pub fn met(geometry: &Geometry, view: &View, at: DVec2, margin: f64) -> Vec<Met> {
    let (origin, direction) = view.line(at);
    let forward = -view.world_from_view.z_axis;
    let mut found = Vec::new();
    for (instance, placed) in (0u32..).zip(&geometry.instances) {
        for triangle in 0..geometry.meshes[placed.mesh as usize].triangles.len() as u32 {
            let corners = geometry.triangle(instance, triangle);
            let Some(weights) = corners.meet(origin, direction) else { continue };
            let inside = weights.min_element().min(1.0 - weights.element_sum());
            let point = corners.0[0]
                + (corners.0[1] - corners.0[0]) * weights.x
                + (corners.0[2] - corners.0[0]) * weights.y;
            let depth = (point - view.eye).dot(forward);
            if inside >= -margin && depth >= view.near {
                found.push(Met { depth, inside, instance, triangle });
            }
        }
    }
    found.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    found
}

/// Exact area of a convex polygon, in screen coordinates, within the pixel (`column`, `row`).
///
/// Cut by the four borders one after the other, then ½ Σ (pᵢ × pᵢ₊₁), about the pixel's corner.
pub fn area(polygon: &[DVec2], column: u32, row: u32) -> f64 {
    let corner = DVec2::new(f64::from(column), f64::from(row));
    let mut points: Vec<DVec2> = polygon.iter().map(|p| *p - corner).collect();
    let borders: [fn(DVec2) -> f64; 4] = [|p| p.x, |p| 1.0 - p.x, |p| p.y, |p| 1.0 - p.y];
    for inside in borders {
        let mut kept = Vec::with_capacity(points.len() + 1);
        for (i, &p) in points.iter().enumerate() {
            let q = points[(i + 1) % points.len()];
            let (dp, dq) = (inside(p), inside(q));
            if dp >= 0.0 {
                kept.push(p);
            }
            if (dp >= 0.0) != (dq >= 0.0) {
                kept.push(p + (q - p) * (dp / (dp - dq)));
            }
        }
        points = kept;
    }
    let twice: f64 = points.iter().enumerate().map(|(i, p)| p.perp_dot(points[(i + 1) % points.len()])).sum();
    0.5 * twice.abs()
}

/// Screen positions of a face that lies beyond the near plane.
pub fn screen(geometry: &Geometry, view: &View, instance: u32, triangle: u32) -> [DVec3; 3] {
    geometry.triangle(instance, triangle).0.map(|corner| view.screen_from_view(view.view_from_world(corner)))
}
