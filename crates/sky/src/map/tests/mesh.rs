//! The tree of one face by itself, and seams.

use std::collections::HashMap;

use light::Triangle;

use super::super::refine::refine;
use super::super::tree::{LEAF, parts, uncut};
use super::*;

fn triangle(corners: [[f64; 3]; 3]) -> Triangle {
    Triangle(corners.map(DVec3::from_array))
}

/// Corners of all cells that are not cut.
fn leaves(map: &FaceMap) -> Vec<[u32; 3]> {
    let (mut cells, mut leaves) = (vec![[0, 1, 2]], Vec::new());
    for node in &map.nodes {
        let corners = cells.pop().unwrap();
        if node.cut == LEAF {
            leaves.push(corners);
        } else {
            let (apex, middle) = uncut(node.cut);
            let [one, other] = parts(corners, apex, middle);
            cells.extend([other, one]);
        }
    }
    assert!(cells.is_empty());
    leaves
}

/// A field over weights with a step and waves.
fn field(at: DVec2, [a, b, c]: [f64; 3]) -> Spectrum {
    let step = f64::from(a * at.x + b * at.y > c);
    Spectrum::splat((0.4 * step + 0.3 + 0.2 * (7.0 * a * at.x - 3.0 * at.y).sin()) as f32)
}

fn corner() -> impl Strategy<Value = [f64; 3]> {
    // Slender and pointed ones among them.
    [-10.0..10.0, -0.5..0.5, -2.0..2.0]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Every edge between two cells is one for both, and the others lie on the face's own edges: no value can have
    /// a step.
    #[test]
    fn cells_of_different_sizes_share_their_edges(
        corners in [corner(), corner(), corner()], shape in [-1.0..1.0, -1.0..1.0, -0.5..0.5f64],
    ) {
        let world = triangle(corners);
        let mut points = Vec::new();
        let map = refine(&world, &EXACT, &mut |at| { points.push(at); field(at, shape) });
        let mut edges: HashMap<[u32; 2], usize> = HashMap::new();
        for [a, b, c] in leaves(&map) {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                *edges.entry([a.min(b), a.max(b)]).or_default() += 1;
            }
        }
        for ([a, b], count) in edges {
            let weights = [a, b].map(|i| points[i as usize]).map(|p| [1.0 - p.x - p.y, p.x, p.y]);
            let outer = (0..3).any(|k| weights[0][k] == 0.0 && weights[1][k] == 0.0);
            prop_assert_eq!(count, if outer { 1 } else { 2 });
        }
        // Points have their own values.
        for (point, value) in points.iter().zip(&map.values) {
            prop_assert_eq!(map.value([1.0 - point.x - point.y, point.x, point.y]), *value);
        }
    }

    /// Two faces that share an edge halve it alike, whatever is within them.
    #[test]
    fn an_edge_is_halved_the_same_from_both_of_its_faces(
        corners in [corner(), corner(), corner(), corner()], shape in [-1.0..1.0, -1.0..1.0, -0.5..0.5f64], k in 0u32..65536,
    ) {
        let [a, b, c, d] = corners;
        // One edge is the first's first, the second's second, and turned round.
        let one = refine(&triangle([a, b, c]), &EXACT, &mut |at| {
            field(if at.y == 0.0 { at } else { at * 1.7 }, shape)
        });
        let other = refine(&triangle([d, b, a]), &EXACT, &mut |at| {
            field(if 1.0 - at.x - at.y == 0.0 { DVec2::new(at.x, 0.0) } else { at * 0.6 }, shape)
        });
        let t = f64::from(k) / 65536.0;
        let difference = one.value([1.0 - t, t, 0.0]) - other.value([0.0, t, 1.0 - t]);
        // Two products and a sum of numbers below 1, in another order.
        prop_assert!(difference.map(f32::abs).max() <= 2.0 * f32::EPSILON);
    }
}

#[test]
fn edges_end_between_least_and_twice_that_where_values_bend_and_at_coarse_elsewhere() {
    let world = triangle([[0.0, 0.0, 0.0], [0.0, 0.0, 12.0], [0.3, 0.0, 0.0]]);
    let mut points = Vec::new();
    let map = refine(&world, &EXACT, &mut |at| {
        points.push(at);
        Spectrum::splat(f32::from(u8::from(at.x > 0.4)))
    });
    let metres = |i: u32| {
        world.0[0]
            + (world.0[1] - world.0[0]) * points[i as usize].x
            + (world.0[2] - world.0[0]) * points[i as usize].y
    };
    let lengths = |near: bool| {
        let cells = leaves(&map).into_iter();
        let at = |i: u32| points[i as usize].x - 0.4;
        let cells = cells.filter(move |cell| {
            cell.iter().any(|&i| at(i) > 0.0) && cell.iter().any(|&i| at(i) <= 0.0) || !near
        });
        cells
            .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[a, b]| metres(a).distance(metres(b)))
            .fold(0.0, f64::max)
    };
    assert!(lengths(true) < 4.0 * 0.1, "{}", lengths(true)); // two edges below 2 × least, the third below their sum
    assert!(lengths(false) <= 2.0 && lengths(false) > 1.0, "{}", lengths(false));
}

#[test]
fn a_square_s_diagonal_is_one_and_a_roof_s_ridge_is_two() {
    let flat = Seams::new(&lawn(2.0));
    assert!(flat.edges[0][2].shared && flat.edges[1][0].shared);
    assert_eq!(flat.edges[0][2], flat.edges[1][0]);
    assert_eq!(flat.corners[0][0], flat.corners[1][0]);
    assert!(!flat.corners[0][1].shared && !flat.edges[0][0].shared);

    let ridge = [Vec3::ZERO, Vec3::Z, Vec3::new(1.0, -0.6, 0.5), Vec3::new(-1.0, -0.6, 0.5)];
    let roof = mesh(&ridge, &[[0, 1, 2], [1, 0, 3]]);
    assert!(Seams::new(&roof).edges.as_flattened().iter().all(|edge| !edge.shared));
    // With normals that agree it is a round back.
    let round = Mesh { normals: vec![Vec3::Y; 4], ..roof.clone() };
    assert!(Seams::new(&round).edges[0][0].shared);
    // Wound against each other, or three at one edge: nobody knows which side is whose.
    let against = mesh(&ridge, &[[0, 1, 2], [0, 1, 3]]);
    assert!(Seams::new(&against).edges.as_flattened().iter().all(|edge| !edge.shared));
    let folded = Mesh { triangles: vec![[0, 1, 2], [1, 0, 2]], ..round.clone() };
    assert!(Seams::new(&folded).edges.as_flattened().iter().all(|edge| !edge.shared));
    let fifth = [&ridge[..], &[Vec3::new(1.0, -0.5, 0.5)]].concat();
    let three = Mesh { normals: vec![Vec3::Y; 5], ..mesh(&fifth, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]) };
    assert!(Seams::new(&three).edges.as_flattened().iter().all(|edge| !edge.shared));
}

#[test]
fn corners_written_twice_are_one() {
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| lawn(2.0).positions[i]);
    let split = Seams::new(&mesh(&[a, b, c, a, c, d], &[[0, 1, 2], [3, 4, 5]]));
    assert_eq!(split.edges, Seams::new(&lawn(2.0)).edges);
    assert_eq!(split.corners, Seams::new(&lawn(2.0)).corners);
}
