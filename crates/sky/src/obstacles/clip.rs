//! What of a triangle lies above a plane.

use glam::DVec3;

/// The part of a triangle where `up` · p ≥ `floor`, as a convex polygon of 0, 3 or 4 corners.
///
/// A cut edge is cut at the same point, to the bit, in both triangles that share it.
pub(crate) fn above(corners: [DVec3; 3], up: DVec3, floor: f64) -> ([DVec3; 4], usize) {
    let heights = corners.map(|corner| up.dot(corner) - floor);
    let (mut polygon, mut count) = ([DVec3::ZERO; 4], 0);
    let mut add = |corner: DVec3| {
        // Rounding cannot make a fifth: each of two crossings replaces at least one corner.
        if count < polygon.len() {
            polygon[count] = corner;
            count += 1;
        }
    };
    for i in 0..3 {
        let next = (i + 1) % 3;
        if heights[i] >= 0.0 {
            add(corners[i]);
        }
        if (heights[i] >= 0.0) != (heights[next] >= 0.0) {
            let [below, over] = if heights[i] < 0.0 { [i, next] } else { [next, i] };
            let way = -heights[below] / (heights[over] - heights[below]);
            add(corners[below] + (corners[over] - corners[below]) * way);
        }
    }
    (polygon, if count < 3 { 0 } else { count })
}
