//! A luminous parallelogram: Lambert's contour formula, and points on it.

use glam::{DVec3, Vec3};

use crate::sampling::lattice;

/// ∫ ω dω over the part of the parallelogram `to_centre` ± u ± v above the plane through the origin with `normal`
/// \[sr\]; zero from behind its own plane and on it.
///
/// Lambert: the integral over a polygon is one over its outline, ½ Σ γᵢ Γᵢ, where γᵢ is the angle under which
/// edge i is seen and Γᵢ the unit normal of the plane through it and the eye.
pub(super) fn vector(to_centre: DVec3, [u, v]: [DVec3; 2], normal: DVec3) -> DVec3 {
    if to_centre.dot(u.cross(v)) >= 0.0 {
        return DVec3::ZERO; // the place is not on the side that shines
    }
    let corners = [to_centre - u - v, to_centre - u + v, to_centre + u + v, to_centre + u - v];
    let mut polygon = [DVec3::ZERO; 6];
    let count = clip(&corners, normal, &mut polygon);
    let mut sum = DVec3::ZERO;
    for i in 0..count {
        sum += edge(polygon[i], polygon[(i + 1) % count]);
    }
    0.5 * sum
}

/// γ Γ of the edge from `a` to `b`. The cross product with b − a keeps the digits that a × b loses far away.
fn edge(a: DVec3, b: DVec3) -> DVec3 {
    let cross = a.cross(b - a);
    let (sin, cos) = (cross.length(), a.dot(b));
    match sin {
        s if s > 0.0 => cross * (s.atan2(cos) / s),
        _ => DVec3::ZERO, // in line with the eye: no angle, or the eye is on the edge itself
    }
}

/// The part of a convex quadrilateral with corner · normal ≥ 0, in order; how many corners it has.
fn clip(corners: &[DVec3; 4], normal: DVec3, out: &mut [DVec3; 6]) -> usize {
    let mut count = 0;
    for i in 0..4 {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        let (height_a, height_b) = (a.dot(normal), b.dot(normal));
        if height_a >= 0.0 {
            out[count] = a;
            count += 1;
        }
        // Rounding cannot make more than two crossings: signs change around a cycle of convex position twice.
        if (height_a >= 0.0) != (height_b >= 0.0) && count < out.len() {
            out[count] = a + (b - a) * (height_a / (height_a - height_b));
            count += 1;
        }
    }
    count
}

/// A point of the parallelogram and cos θ cos θ' / r², what it contributes up to a common factor.
pub(super) fn sample(
    to_centre: Vec3,
    [u, v]: [Vec3; 2],
    normal: Vec3,
    (i, count, shift): (u32, u32, [u32; 2]),
) -> (Vec3, f32) {
    let [s, t] = if count == 1 { [0.5; 2] } else { lattice(i, count, shift) };
    let way = to_centre + u * (2.0 * s - 1.0) + v * (2.0 * t - 1.0);
    let Some(toward) = way.try_normalize() else { return (way, 0.0) };
    let cosines = toward.dot(normal).max(0.0) * -toward.dot(u.cross(v)).min(0.0);
    // Where it touches, one point must not outweigh numbers.
    (way, (cosines / way.length_squared()).min(1e30))
}
