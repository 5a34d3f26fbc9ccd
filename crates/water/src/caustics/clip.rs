//! How much of a triangle lies in a square.

use glam::DVec2;

/// A triangle is a line when its area is below this share of its longest side's square: there rounding decides about the area, which is good to
/// some 1e-15 of that square.
const FLAT: f64 = 1e-9;

/// Corners of what four half-planes leave of a triangle: one more for each.
const CORNERS: usize = 7;

/// The share of a triangle's area that lies in the square \[−half, half\]², within \[0, 1\]. Of triangles without area, the share of
/// ten points spread over it.
pub(super) fn share_in_square(triangle: [DVec2; 3], half: f64) -> f64 {
    let [a, b, c] = triangle;
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    if low.cmpge(DVec2::splat(-half)).all() && high.cmple(DVec2::splat(half)).all() {
        return 1.0;
    }
    if low.cmpgt(DVec2::splat(half)).any() || high.cmplt(DVec2::splat(-half)).any() {
        return 0.0;
    }
    let area = (b - a).perp_dot(c - a).abs();
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    if area <= FLAT * longest {
        return of_points(triangle, half);
    }
    let mut corners = [DVec2::ZERO; CORNERS];
    corners[..3].copy_from_slice(&triangle);
    let mut count = 3;
    for normal in [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y] {
        count = cut(&mut corners, count, normal, half);
    }
    let left = &corners[..count];
    let twice: f64 =
        (1..count.saturating_sub(1)).map(|i| (left[i] - left[0]).perp_dot(left[i + 1] - left[0])).sum();
    (twice.abs() / area).min(1.0)
}

/// Leaves of a convex polygon what lies within p·normal ≤ `limit`, and says how many corners that has.
fn cut(corners: &mut [DVec2; CORNERS], count: usize, normal: DVec2, limit: f64) -> usize {
    let before = *corners;
    let mut left = 0;
    for i in 0..count {
        let (p, q) = (before[i], before[(i + 1) % count]);
        let (over_p, over_q) = (p.dot(normal) - limit, q.dot(normal) - limit);
        let mut keep = |corner| {
            if let Some(slot) = corners.get_mut(left) {
                *slot = corner;
                left += 1;
            }
        };
        if over_p <= 0.0 {
            keep(p);
        }
        if (over_p < 0.0 && over_q > 0.0) || (over_p > 0.0 && over_q < 0.0) {
            keep(p.lerp(q, over_p / (over_p - over_q)));
        }
    }
    left
}

/// The share of ten points, spread evenly over the triangle, that lie in the square, whose far edges do not belong to it.
fn of_points([a, b, c]: [DVec2; 3], half: f64) -> f64 {
    let mut inside = 0u32;
    for i in 0..4u32 {
        for j in 0..(4 - i) {
            let [u, v] = [i, j].map(|n| (f64::from(n) + 1.0 / 3.0) / 4.0);
            let p = a * (1.0 - u - v) + b * u + c * v;
            inside += u32::from(p.cmpge(DVec2::splat(-half)).all() && p.cmplt(DVec2::splat(half)).all());
        }
    }
    f64::from(inside) / 10.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn corner() -> impl Strategy<Value = DVec2> {
        (-3.0..3.0f64, -3.0..3.0f64).prop_map(|(x, y)| DVec2::new(x, y))
    }

    proptest! {
        /// Squares that tile the plane share a triangle between them: nothing is lost, nothing counted twice.
        #[test]
        fn tiles_have_all_of_a_triangle(a in corner(), b in corner(), c in corner(), thin in 0usize..3) {
            let c = if thin == 0 { a.lerp(b, 0.3) } else { c };
            let half = 0.25;
            let mut sum = 0.0;
            for i in -8..8 {
                for j in -8..8 {
                    let middle = DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) * (2.0 * half);
                    let share = share_in_square([a, b, c].map(|p| p - middle), half);
                    prop_assert!((0.0..=1.0).contains(&share));
                    sum += share;
                }
            }
            // Rounding of areas, over the least area that counts as one: 1e-15/1e-9.
            prop_assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        }
    }

    #[test]
    fn shares_known_by_hand() {
        let triangle = [DVec2::ZERO, DVec2::new(2.0, 0.0), DVec2::new(0.0, 2.0)];
        // The unit square's first quadrant, of an area of 2.
        assert!((share_in_square(triangle, 1.0) - 0.5).abs() < 1e-15);
        assert_eq!(share_in_square(triangle, 2.0), 1.0);
        assert_eq!(share_in_square(triangle.map(|p| p + DVec2::splat(5.0)), 1.0), 0.0);
        assert_eq!(share_in_square([DVec2::ZERO; 3], 1.0), 1.0);
    }
}
