//! Outlines and terrain: area kept, crossings refused, millimetres kept.

use glam::{DMat3, DVec3};
use keikan_scene::triangulate::{Fault, polygon, terrain, unevenness};
use proptest::prelude::*;

/// Twice the area vector of the triangles.
fn area(points: &[DVec3], triangles: &[[u32; 3]]) -> DVec3 {
    triangles.iter().map(|t| t.map(|i| points[i as usize])).map(|[a, b, c]| (b - a).cross(c - a)).sum()
}

/// Twice the area vector of a loop, about its first corner.
fn loop_area(corners: &[DVec3]) -> DVec3 {
    corners.windows(2).map(|w| (w[0] - corners[0]).cross(w[1] - corners[0])).sum()
}

fn square(low: f64, high: f64) -> Vec<DVec3> {
    [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec()
}

/// A star about the origin: never crosses itself, concave nearly always.
fn star(radii: &[f64], phase: f64) -> Vec<DVec3> {
    let step = std::f64::consts::TAU / radii.len() as f64;
    let corner = |(i, r): (usize, &f64)| {
        let (sin, cos) = (phase + step * i as f64).sin_cos();
        DVec3::new(r * cos, r * sin, 0.0)
    };
    radii.iter().enumerate().map(corner).collect()
}

#[test]
fn a_frame_is_a_square_less_a_square() {
    for reverse in [false, true] {
        let mut hole = square(1.0, 2.0);
        if reverse {
            hole.reverse();
        }
        let triangles = polygon(&square(0.0, 3.0), std::slice::from_ref(&hole)).unwrap();
        let points = [square(0.0, 3.0), hole].concat();
        assert_eq!(triangles.len(), 8);
        // Small integers: exact.
        assert_eq!(area(&points, &triangles), DVec3::Z * 16.0);
    }
}

#[test]
fn crossings_touches_and_nonsense_are_errors() {
    let at = |list: &[(f64, f64)]| list.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect::<Vec<_>>();
    // A bow tie with unequal wings, a loop that passes through its own corner, one that touches its own side.
    let crossing = at(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 3.0)]);
    let touching = at(&[(0.0, 0.0), (4.0, 0.0), (2.0, 2.0), (4.0, 4.0), (0.0, 4.0), (2.0, 2.0)]);
    let leaning = at(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 0.0), (0.0, 4.0)]);
    // Bow ties whose wings cancel, plain, turned out of all axes, and far away.
    let tie = at(&[(0.0, 0.0), (3.0, 2.0), (3.0, 0.0), (0.0, 2.0)]);
    let turn = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let turned: Vec<DVec3> = tie.iter().map(|p| turn * p).collect();
    let far: Vec<DVec3> = turned.iter().map(|p| p + DVec3::splat(1024.0)).collect();
    for outline in [crossing, touching, leaning, tie, turned, far] {
        assert!(matches!(polygon(&outline, &[]), Err(Fault::Crossing(..))), "{outline:?}");
    }
    for outline in [at(&[]), at(&[(0.0, 0.0), (1.0, 0.0)]), at(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)])] {
        assert!(polygon(&outline, &[]).is_err(), "{outline:?}");
    }
    assert_eq!(polygon(&at(&[(0.0, 0.0), (1.0, f64::NAN), (2.0, 2.0)]), &[]), Err(Fault::NotFinite(1)));
    let outside = square(5.0, 6.0);
    assert!(matches!(polygon(&square(0.0, 3.0), &[outside]), Err(Fault::HoleOutside(_))));
    let nested = [square(0.5, 2.5), square(1.0, 2.0)];
    assert!(matches!(polygon(&square(0.0, 3.0), &nested), Err(Fault::HoleOutside(_))));
}

#[test]
fn corners_off_their_plane_are_measured() {
    let mut outline = square(0.0, 4.0);
    assert_eq!(unevenness(&outline, &[]), 0.0);
    // A corner lifted by h turns the normal as well: n ∝ (−h/2, −h/2, 4) · 4, the corners' heights along it are
    // 0, −h/2, 0, −h/2 … times 4/√(16 + h²/2), half their range h/4 times that.
    outline[2].z = 0.4;
    let expected = 0.1 * 4.0 / (16.0 + 0.5 * 0.4 * 0.4f64).sqrt();
    assert!(
        (unevenness(&outline, &[]) - expected).abs() < 4.0 * f64::EPSILON,
        "{}",
        unevenness(&outline, &[])
    );
    let hole = vec![DVec3::new(1.0, 1.0, -0.5), DVec3::new(2.0, 1.0, 0.5), DVec3::new(2.0, 2.0, 0.0)];
    assert_eq!(unevenness(&square(0.0, 4.0), &[hole]), 0.5);
    assert_eq!(unevenness(&[], &[]), 0.0);
}

#[test]
fn repeated_corners_count_once() {
    let mut outline = square(0.0, 1.0);
    outline.insert(1, outline[0]);
    outline.push(outline[0]);
    let triangles = polygon(&outline, &[]).unwrap();
    assert_eq!(area(&outline, &triangles), DVec3::Z * 2.0);
}

proptest! {
    #[test]
    fn area_and_orientation_are_kept(
        radii in prop::collection::vec(2.0f64..9.0, 3..40), hole in prop::collection::vec(0.2f64..0.9, 3..12),
        turn in prop::array::uniform3(-3.0f64..3.0), shift in prop::array::uniform3(-1e6f64..1e6),
    ) {
        // Three directions 120° apart with r ≥ 2 leave a circle of radius 1 free in the middle.
        let rotation = DMat3::from_euler(glam::EulerRot::XYZ, turn[0], turn[1], turn[2]);
        let place = |list: Vec<DVec3>| -> Vec<DVec3> { list.into_iter().map(|p| rotation * p + DVec3::from_array(shift)).collect() };
        let (outer, hole) = (place(star(&radii, 0.1)), place(star(&hole, 0.7)));
        let triangles = polygon(&outer, std::slice::from_ref(&hole)).unwrap();
        prop_assert_eq!(triangles.len(), outer.len() + hole.len());
        let points = [outer.clone(), hole.clone()].concat();
        // Corners moved off their plane by rounding, ½ ulp of 1e6 = 6e-11 a coordinate: over all n sides (of
        // length ≤ 18) the area vector of loops and of triangles differ by rounding of products only:
        // 3n cross products of factors ≤ 18 with relative error 4·2⁻⁵³.
        let bound = 3.0 * points.len() as f64 * 18.0 * 18.0 * 4.0 * 1.2e-16;
        let expected = loop_area(&outer) - loop_area(&hole);
        prop_assert!(area(&points, &triangles).abs_diff_eq(expected, bound));
        for triangle in triangles {
            // Corners are off their plane by 1e-10 m, triangles are ≤ 18 m long, the outline's 2A ≤ 510 m²:
            // a sliver may lean by 1e-10 × 18 × 510.
            prop_assert!(area(&points, &[triangle]).dot(loop_area(&outer)) > -1e-6);
        }
    }

    #[test]
    fn any_outline_gives_triangles_or_an_error(
        outline in prop::collection::vec(prop::array::uniform3(-3i8..3), 0..12),
        hole in prop::collection::vec(prop::array::uniform3(-3i8..3), 0..5),
    ) {
        // Small integers: corners coincide, sides run through corners and over one another all the time.
        let points = |list: &[[i8; 3]]| list.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect::<Vec<_>>();
        let _ = polygon(&points(&outline), &[points(&hole)]);
        let _ = terrain(&points(&outline));
    }
}

#[test]
fn terrain_keeps_millimetres_at_a_million_metres() {
    let corner = DVec3::new(4_512_345.678, 1234.567, -5_987_654.321);
    let mut points: Vec<DVec3> = (0..50)
        .flat_map(|i| (0..50).map(move |j| (i, j)))
        .map(|(i, j)| {
            corner + DVec3::new(f64::from(i) * 10.001, f64::from(i * j % 7) * 0.001, f64::from(j) * 10.003)
        })
        .collect();
    let clean = points.len();
    points.insert(7, points[3]);
    points.insert(9, DVec3::new(f64::NAN, 0.0, 0.0));
    let ground = terrain(&points).unwrap();
    assert_eq!((ground.duplicates, ground.not_finite, ground.mesh.positions.len()), (1, 1, clean));
    points.remove(9);
    points.remove(7);
    for (local, point) in ground.mesh.positions.iter().zip(&points) {
        // Half a step of f32 at 260 m from the middle: 2⁻²⁴ × 512 m = 3e-5 m, far below a millimetre.
        assert!((ground.origin + local.as_dvec3()).abs_diff_eq(*point, 3.1e-5));
    }
    assert_eq!(ground.mesh.triangles.len(), 2 * 49 * 49);
    // Seen from above all of it, once: the plan's area, facing up. f32 positions: 2 × 490 m × 3e-5 m per side.
    let positions: Vec<DVec3> = ground.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
    let up = area(&positions, &ground.mesh.triangles).y;
    assert!((up - 2.0 * 49.0 * 10.001 * 49.0 * 10.003).abs() < 2.0 * 4.0 * 490.0 * 3.1e-5);
    assert!(ground.mesh.triangles.iter().all(|t| area(&positions, &[*t]).y > 0.0));
}
