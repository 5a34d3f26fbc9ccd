//! What share of a point's hemisphere a polygon fills, weighed with the cosine: exact.

use std::f64::consts::TAU;

use glam::DVec3;

/// Form factor from an element at `at` with unit normal `normal` to a flat polygon: the share of what the element
/// sends out diffusely that meets the polygon, within \[0, 1\]; what lies below the element's horizon is cut off.
///
/// Lambert's formula (Photometria, 1760), with v the way to each corner in turn:
///
///   F = 1/(2π) | Σ_k γ_k n · (v_k × v_k+1)/|v_k × v_k+1| |,   γ_k the angle between v_k and v_k+1
///
/// Both sides of the polygon count: that it faces the element is for the caller to see. In the polygon's own plane F is
/// 0; on one of its edges it is that of a neighbouring point, to within what the edge itself would give.
///
/// ```
/// use glam::DVec3;
/// let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 1.0));
/// let f = keikan_radiosity::point_form_factor(DVec3::ZERO, DVec3::Z, &corners);
/// assert!((f - 0.138531605995).abs() < 1e-12); // a unit square 1 m above, its corner overhead (Howell's catalogue)
/// ```
pub fn point_form_factor(at: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let mut sum = 0.0;
    let mut ends: Option<[DVec3; 2]> = None; // first and last corner above the horizon so far
    let mut add = |v: DVec3| {
        if let Some([first, last]) = ends {
            sum += edge(normal, last, v);
            ends = Some([first, v]);
        } else {
            ends = Some([v, v]);
        }
    };
    for (k, corner) in corners.iter().enumerate() {
        let (v, next) = (*corner - at, corners[(k + 1) % corners.len()] - at);
        let [height, next_height] = [v, next].map(|v| v.dot(normal));
        if height >= 0.0 {
            add(v);
        }
        if (height > 0.0 && next_height < 0.0) || (height < 0.0 && next_height > 0.0) {
            let t = height / (height - next_height);
            add(v.lerp(next, t));
        }
    }
    if let Some([first, last]) = ends {
        sum += edge(normal, last, first);
    }
    let share = sum.abs() / TAU;
    if share <= 1.0 { share } else { f64::from(share.is_finite()) }
}

/// γ n · (v × w)/|v × w|; 0 for an edge that points at the element.
fn edge(normal: DVec3, v: DVec3, w: DVec3) -> f64 {
    let cross = v.cross(w);
    let sine = cross.length();
    if sine > 0.0 { angle(sine, v.dot(w)) * (normal.dot(cross) / sine) } else { 0.0 }
}

/// atan2(sine, cosine) for sine > 0. Most edges are seen under small angles, for which the series to x¹⁷ is right to rounding:
/// its next term is below (1/8)¹⁸/19 of the angle.
fn angle(sine: f64, cosine: f64) -> f64 {
    if 8.0 * sine > cosine {
        return sine.atan2(cosine);
    }
    let x = sine / cosine;
    let square = x * x;
    let series = (0..=8).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) - square * sum);
    x * series
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding: the angles of a handful of edges, each right to a few ulps.
    const ROUNDING: f64 = 1e-12;

    fn square(a: f64, b: f64, height: f64) -> [DVec3; 4] {
        [(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)].map(|(x, y)| DVec3::new(x, y, height))
    }

    #[test]
    fn parallel_and_perpendicular_elements_are_those_of_the_catalogue() {
        let parallel = [
            ([1.0, 1.0, 1.0], 0.138531605995),
            ([2.0, 2.0, 3.0], 0.089421186658),
            ([0.5, 0.5, 3.0], 0.008526698725),
            ([10.0, 10.0, 1.0], 0.247971408295),
        ];
        for ([a, b, c], truth) in parallel {
            let f = point_form_factor(DVec3::ZERO, DVec3::Z, &square(a, b, c));
            assert!((f - truth).abs() < ROUNDING, "{a} {b} {c}: {f}");
        }
        // The element's normal is along the edge a; the rectangle begins in its horizon.
        let perpendicular = [
            ([1.0, 1.0, 1.0], 0.055734197003),
            ([4.0, 2.0, 0.25], 0.225613017819),
            ([4.0, 2.0, 2.75], 0.064836862004),
            ([10.0, 10.0, 1.0], 0.221738670870),
        ];
        for ([a, b, c], truth) in perpendicular {
            let f = point_form_factor(DVec3::ZERO, DVec3::X, &square(a, b, c));
            assert!((f - truth).abs() < ROUNDING, "{a} {b} {c}: {f}");
        }
    }

    #[test]
    fn small_angles_are_right_to_rounding() {
        for i in 0..2000 {
            let x = 1e-9 * 1.01f64.powi(i);
            let [sine, cosine] = [x.min(1e3), 1.0];
            // Two roundings of either.
            assert!((angle(sine, cosine) / sine.atan2(cosine) - 1.0).abs() < 4.0 * f64::EPSILON, "{x}");
        }
        assert_eq!(angle(1.0, -1.0), 1f64.atan2(-1.0));
    }

    #[test]
    fn what_is_below_the_horizon_is_cut_off() {
        // A wall that stands through the horizon: its upper half alone.
        let wall =
            |low: f64| [(-1.0, low), (1.0, low), (1.0, 1.0), (-1.0, 1.0)].map(|(y, z)| DVec3::new(1.0, y, z));
        let [whole, upper] = [-1.0, 0.0].map(|low| point_form_factor(DVec3::ZERO, DVec3::Z, &wall(low)));
        assert!((whole - upper).abs() < ROUNDING && upper > 0.1, "{whole} {upper}");
        assert_eq!(point_form_factor(DVec3::ZERO, DVec3::NEG_Z, &square(1.0, 1.0, 1.0)), 0.0);
    }

    #[test]
    fn corners_of_the_domain_are_shares() {
        let far = DVec3::splat(1e6);
        let near = square(1.0, 1.0, 0.0);
        for (at, normal) in
            [(DVec3::ZERO, DVec3::Z), (near[1], DVec3::X), (DVec3::new(0.5, 0.0, 0.0), DVec3::Y)]
        {
            let f = point_form_factor(at, normal, &near);
            assert!((0.0..=1.0).contains(&f), "{f}");
        }
        assert_eq!(point_form_factor(DVec3::ZERO, DVec3::Z, &[DVec3::NAN; 3]), 0.0);
        assert_eq!(point_form_factor(DVec3::ZERO, DVec3::Z, &[]), 0.0);
        // 10⁶ m away the corners' coordinates are off by 10⁻¹⁰ m.
        let moved = square(1.0, 1.0, 1.0).map(|corner| corner + far);
        let f = point_form_factor(far, DVec3::Z, &moved);
        assert!((f - 0.138531605995).abs() < 1e-9);
    }
}
