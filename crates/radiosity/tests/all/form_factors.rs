//! Form factors against the catalogue's closed forms, and against contour integrals.

use glam::DVec3;
use keikan_radiosity::{attenuated_form_factor, form_factor, reference};
use proptest::prelude::*;

type Corners = [DVec3; 3];

/// Two triangles of a rectangle at `corner`; it faces u × v.
fn rectangle(corner: DVec3, u: DVec3, v: DVec3) -> [Corners; 2] {
    [[corner, corner + u, corner + u + v], [corner, corner + u + v, corner + v]]
}

/// Share of what leaves the one rectangle that meets the other.
fn between(from: [Corners; 2], to: [Corners; 2], mut pair: impl FnMut(&Corners, &Corners) -> f64) -> f64 {
    from.iter().map(|i| to.iter().map(|j| 0.5 * pair(i, j)).sum::<f64>()).sum()
}

fn parallel(a: f64, b: f64, c: f64) -> [[Corners; 2]; 2] {
    [rectangle(DVec3::ZERO, DVec3::X * a, DVec3::Y * b), rectangle(DVec3::Z * c, DVec3::Y * b, DVec3::X * a)]
}

/// Across a common edge l: w lies, h stands.
fn perpendicular(w: f64, h: f64, l: f64) -> [[Corners; 2]; 2] {
    [rectangle(DVec3::ZERO, DVec3::X * w, DVec3::Y * l), rectangle(DVec3::ZERO, DVec3::Y * l, DVec3::Z * h)]
}

#[test]
fn rectangles_are_those_of_the_catalogue() {
    // Howell's C-11 and C-14, evaluated in closed form.
    let cases = [
        (parallel(1.0, 1.0, 1.0), 0.199824895698),
        (parallel(1.0, 1.0, 0.5), 0.415253283577),
        (parallel(1.0, 1.0, 2.0), 0.068589588819),
        (parallel(1.0, 1.0, 5.0), 0.012403977313),
        (parallel(2.0, 1.0, 1.0), 0.285875384851),
        (parallel(1.0, 1.0, 0.1), 0.826994522397),
        (parallel(10.0, 1.0, 1.0), 0.386382489266),
        (parallel(4.0, 4.0, 3.0), 0.282732787397),
        (perpendicular(1.0, 1.0, 1.0), 0.200043776075),
        (perpendicular(1.0, 2.0, 1.0), 0.232852602795),
        (perpendicular(2.0, 1.0, 1.0), 0.116426301398),
        (perpendicular(4.0, 3.0, 4.0), 0.179316803151),
        (perpendicular(1.0, 1.0, 10.0), 0.281887806788),
        (perpendicular(1.0, 0.1, 1.0), 0.043251369401),
        (perpendicular(0.5, 3.0, 2.0), 0.376778149186),
    ];
    for ([from, to], truth) in cases {
        let mut stated = 0.0;
        let share = between(from, to, |i, j| {
            let found = form_factor(i, j, 1e-6);
            stated += 0.5 * found.error;
            found.share
        });
        // What the last halving changed is more than what is left, by the rule's order.
        assert!((share - truth).abs() <= stated.max(1e-12), "{truth}: {share} within {stated}");
        assert!(stated < 4e-6, "{truth}: {stated}");
    }
}

#[test]
fn a_medium_takes_what_the_closed_quadrature_says() {
    let [from, to] = parallel(1.0, 1.0, 1.0);
    let cases = [(0.133, 0.1724162945), (0.159, 0.1675180147), (0.718, 0.0902813818), (2.0, 0.0220928050)];
    for (extinction, truth) in cases {
        let mut stated = 0.0;
        let share = between(from, to, |i, j| {
            let found = attenuated_form_factor(i, j, extinction, 1e-4);
            stated += 0.5 * found.error;
            found.share
        });
        assert!((share - truth).abs() <= stated, "{extinction}: {share} {truth} within {stated}");
        assert!(stated < 8e-4, "{stated}");
    }
}

fn vector() -> impl Strategy<Value = DVec3> {
    [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from_array)
}

fn triangle() -> impl Strategy<Value = Corners> {
    [vector(), vector(), vector()]
        .prop_filter("has an area", |[a, b, c]| (*b - *a).cross(*c - *a).length() > 0.1)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    /// A_i F_ij = A_j F_ji, within the two errors stated; triangles may cut through each other's planes.
    #[test]
    fn exchange_is_reciprocal(i in triangle(), mut j in triangle(), apart in vector()) {
        j = j.map(|corner| corner + apart + DVec3::Z * 6.0);
        let area = |t: &Corners| 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length();
        let [there, back] = [form_factor(&i, &j, 1e-7), form_factor(&j, &i, 1e-7)];
        let [ai, aj] = [area(&i), area(&j)];
        // The errors stated, but where two halvings agree by chance: the tolerance then.
        let bound = ai * there.error.max(1e-7) + aj * back.error.max(1e-7);
        prop_assert!((ai * there.share - aj * back.share).abs() <= bound, "{} {}", ai * there.share, aj * back.share);
        // And it is what the contour integral says, whose edges (3.5 at most, 3 apart at least) ten points take to 10⁻¹¹.
        let contour = reference::exchange(&i, &j);
        prop_assert!((ai * there.share - contour).abs() <= bound, "{} {contour}", ai * there.share);
        prop_assert!(there.share <= 1.0 && there.share >= 0.0);
    }

    /// From any triangle inside of a closed box all light meets the box.
    #[test]
    fn a_closed_box_takes_everything(i in triangle(), size in 2.5..6.0f64) {
        let corner = DVec3::splat(-0.5 * size);
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| v * size);
        let walls = [
            rectangle(corner, y, z), rectangle(corner, z, x), rectangle(corner, x, y),
            rectangle(corner + x, z, y), rectangle(corner + y, x, z), rectangle(corner + z, y, x),
        ];
        let mut sum = keikan_radiosity::FormFactor { share: 0.0, error: 0.0 };
        for wall in walls.as_flattened() {
            let one = form_factor(&i, wall, 1e-5);
            sum.share += one.share;
            sum.error += one.error;
        }
        // The error stated, or where halvings agree by chance the tolerance of each of the twelve.
        prop_assert!((sum.share - 1.0).abs() <= sum.error.max(12e-5), "{sum:?}");
    }
}
