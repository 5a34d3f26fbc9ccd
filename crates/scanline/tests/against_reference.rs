//! Spans against a ray that asks every face.

mod common;

use common::{ahead, placed, soup, stage};
use glam::{DVec2, Vec3};
use keikan_scanline::{Knobs, Rule, reference};
use light::{Geometry, View};
use proptest::prelude::*;

/// Bounds for scenes of coordinates up to `reach` metres: f64 keeps 2⁻⁵³ · reach of a position, a
/// barycentric weight divides that by the face's height, which the soups below keep above 10⁻³ of reach
/// for all but slivers; 10⁴ spare ulps. Points nearer than that to an edge are left undecided.
const MARGIN: f64 = 1e-9;

fn check(geometry: &Geometry, view: View, knobs: Knobs, lines: impl Iterator<Item = u32>) {
    let stage = stage(geometry.clone(), view, knobs);
    for line in lines {
        let spans = stage.spans(line);
        let (y, _) = stage.line(line);
        for pair in spans.opaque.windows(2) {
            assert!(pair[0].x[1] <= pair[1].x[0], "spans overlap: {pair:?}");
        }
        let mut xs: Vec<f64> = (0..view.width).map(|i| f64::from(i) + 0.3137).collect();
        xs.extend(spans.opaque.iter().map(|span| 0.5 * (span.x[0] + span.x[1])));
        for x in xs {
            let shown = spans.opaque.iter().find(|span| span.x[0] <= x && x <= span.x[1]);
            let met = reference::met(geometry, &view, DVec2::new(x, y), MARGIN);
            let surely = met.iter().find(|met| met.inside > MARGIN);
            match shown {
                None => assert!(surely.is_none(), "a hole at {x}, {y}: {surely:?}"),
                Some(span) => {
                    let own = met.iter().find(|m| (m.instance, m.triangle) == (span.instance, span.triangle));
                    // A span narrower than the margin is met by no ray for certain.
                    let narrow = span.x[1] - span.x[0] < 1e-6;
                    let Some(own) = own else {
                        assert!(narrow, "nothing at {x}, {y} of {span:?}");
                        continue;
                    };
                    if let Some(nearest) = surely {
                        let slack = 1e-7 * own.depth;
                        assert!(own.depth <= nearest.depth + slack || narrow, "{nearest:?} hides {own:?}");
                    }
                }
            }
        }
    }
}

fn corner(reach: f32) -> impl Strategy<Value = Vec3> {
    (-1.0f32..1.0, -1.0f32..1.0, -1.2f32..0.3).prop_map(move |(x, y, z)| Vec3::new(x, y, z) * reach)
}

fn triangles(reach: f32, count: usize) -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    prop::collection::vec([corner(reach), corner(reach), corner(reach)], 1..count)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Large faces that pass through one another and through the plane of the eye.
    #[test]
    fn soup_of_crossing_faces(triangles in triangles(10.0, 40)) {
        let geometry = placed(soup(&triangles));
        for rule in [Rule::Trapezoid, Rule::Midpoint, Rule::Exact] {
            check(&geometry, ahead(24), Knobs { rule, ..Knobs::default() }, (0..96).step_by(5));
        }
    }

    #[test]
    fn soup_far_from_the_origin(triangles in triangles(1e6, 12)) {
        check(&placed(soup(&triangles)), ahead(16), Knobs::default(), (0..64).step_by(7));
    }

    /// Deep enough for the heap of chains.
    #[test]
    fn deep_soup(triangles in triangles(3.0, 200)) {
        check(&placed(soup(&triangles)), ahead(8), Knobs::default(), [13, 16].into_iter());
    }

    /// Few distinct coordinates: shared edges, T-junctions, coplanar, degenerate and edge-on faces.
    #[test]
    fn faces_on_a_lattice(
        corners in prop::collection::vec([(-2i8..3, -2i8..3, -4i8..-1), (-2i8..3, -2i8..3, -4i8..-1), (-2i8..3, -2i8..3, -4i8..-1)], 1..30),
    ) {
        let point = |(x, y, z): (i8, i8, i8)| Vec3::new(x.into(), y.into(), z.into());
        let triangles: Vec<_> = corners.iter().map(|face| face.map(point)).collect();
        check(&placed(soup(&triangles)), ahead(16), Knobs::default(), (0..64).step_by(3));
    }
}

#[test]
fn three_faces_that_overlap_in_a_ring() {
    // Each bar is above the next at one end and below the previous at the other.
    let bar = |turn: f32| {
        let at = |x: f32, y: f32, z: f32| {
            let (sin, cos) = (turn.to_radians()).sin_cos();
            Vec3::new(x * cos - y * sin, x * sin + y * cos, z)
        };
        [at(-2.0, 0.2, -4.2), at(2.0, 0.3, -3.8), at(2.0, 0.9, -3.8)]
    };
    let geometry = placed(soup(&[bar(0.0), bar(120.0), bar(240.0)]));
    check(&geometry, ahead(64), Knobs::default(), 0..256);
    let stage = stage(geometry, ahead(64), Knobs::default());
    let seen: std::collections::BTreeSet<u32> =
        (0..256).flat_map(|line| stage.spans(line).opaque).map(|span| span.triangle).collect();
    assert_eq!(seen.len(), 3);
}

#[test]
fn slivers_and_points_make_no_holes_and_no_nan() {
    let thin = 1e-7;
    let geometry = placed(soup(&[
        [Vec3::new(-1.0, 0.0, -2.0), Vec3::new(1.0, thin, -2.0), Vec3::new(1.0, -thin, -3.0)],
        [Vec3::new(0.0, -1.0, -2.0), Vec3::new(thin, 1.0, -2.0), Vec3::new(-thin, 1.0, -2.0)],
        [Vec3::new(0.0, 0.0, -2.0); 3],
        [Vec3::new(f32::NAN, 0.0, -2.0), Vec3::X, Vec3::Y],
    ]));
    let stage = stage(geometry, ahead(32), Knobs::default());
    for (_, piece) in common::picture(&stage, 0..32, 0..32) {
        assert!(piece.share.is_finite() && piece.hit.place.position.is_finite());
    }
}
