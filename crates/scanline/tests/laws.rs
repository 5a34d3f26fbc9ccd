//! Laws of the picture: closed surfaces leave no gap, and how the picture is cut does not matter.

mod common;

use std::sync::Arc;

use common::{ahead, picture, placed, soup, stage, terrain, totals};
use glam::{DAffine3, DVec3, Vec2, Vec3};
use keikan_scanline::{Knobs, Rule, Shading, reference};
use light::{Geometry, Instance, Mesh, Opacity, View};
use proptest::prelude::*;

const RULES: [Rule; 3] = [Rule::Trapezoid, Rule::Midpoint, Rule::Exact];

/// A sum of `n` shares, each rounded to f32 and made of up to 65 f64 terms.
fn ulps(n: usize) -> f64 {
    n as f64 * f64::from(f32::EPSILON)
}

/// A wall at depth `z`, wider than the view, of 2 n² triangles, bent by `bend` metres.
fn wall(n: u32, z: f32, bend: impl Fn(f32, f32) -> f32) -> Mesh {
    let mut mesh = terrain(n, 4.0 * z.abs(), bend);
    for p in &mut mesh.positions {
        *p = Vec3::new(p.x, p.z, z + p.y);
    }
    mesh
}

#[test]
fn a_surface_that_fills_the_picture_leaves_nothing_open() {
    for rule in RULES {
        for n in [1, 7, 50] {
            let wavy = |x: f32, y: f32| (3.1 * x).sin() + (2.3 * y + x).cos();
            let stage = stage(placed(wall(n, -7.0, wavy)), ahead(40), Knobs { rule, ..Knobs::default() });
            let pieces = picture(&stage, 0..40, 0..40).len();
            for total in totals(&stage, 40, 40) {
                assert!(total <= 1.0 && total >= 1.0 - ulps(pieces), "{total}");
            }
        }
    }
}

#[test]
fn from_inside_a_closed_room_all_is_filled_through_the_near_plane() {
    // The eye stands in a corner of a finely meshed box: many faces pass beside and behind it.
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [-1.0f32, 1.0] {
            let face = terrain(9, 2.0, |_, _| side);
            let base = mesh.positions.len() as u32;
            mesh.positions.extend(face.positions.iter().map(|p| match axis {
                0 => Vec3::new(p.y, p.x, p.z),
                1 => *p,
                _ => Vec3::new(p.x, p.z, p.y),
            }));
            mesh.triangles.extend(face.triangles.iter().map(|t| t.map(|i| i + base)));
        }
    }
    let eye = DVec3::new(0.991, -0.37, 0.42);
    for target in [DVec3::ZERO, DVec3::new(1.0, -0.37, 0.42), DVec3::new(0.9, 5.0, 0.3)] {
        let view = View::look_at(eye, target, 100.0, 48, 32);
        for total in totals(&stage(placed(mesh.clone()), view, Knobs::default()), 48, 32) {
            assert!(total <= 1.0 && total >= 1.0 - ulps(200), "{total}");
        }
    }
}

#[test]
fn how_finely_a_plane_is_meshed_does_not_show() {
    let plane = |_: f32, _: f32| 0.0;
    let tilted = DAffine3::from_axis_angle(DVec3::new(0.6, 0.8, 0.0), 0.7);
    let of = |n| Geometry {
        meshes: vec![terrain(n, 2.0, plane)],
        instances: vec![Instance {
            mesh: 0,
            world_from_mesh: DAffine3::from_translation(-3.0 * DVec3::Z) * tilted,
        }],
    };
    // The corners of the plane on the screen. In the coarse one the exact rule ends strips there; in the fine one
    // they are too many for that, and what the strips with corners show may differ by all their height.
    let mut corners = Vec::new();
    for triangle in 0..2 {
        corners.extend(reference::screen(&of(1), &ahead(48), 0, triangle).map(|corner| corner.y.floor()));
    }
    let strip = 1.0 / f64::from(Knobs::default().sub_scanlines);
    for rule in RULES {
        let knobs = Knobs { rule, ..Knobs::default() };
        let coarse = totals(&stage(of(1), ahead(48), knobs), 48, 48);
        // 64 is a power of two: the corners of the fine mesh lie on the coarse one to the bit before placing.
        let fine = totals(&stage(of(64), ahead(48), knobs), 48, 48);
        assert!(coarse.iter().any(|&t| t > 0.0 && t < 1.0));
        for (i, (a, b)) in (0u32..).zip(coarse.iter().zip(&fine)) {
            let cornered = rule == Rule::Exact && corners.contains(&f64::from(i / 48));
            let bound = if cornered { strip } else { ulps(60) };
            assert!((a - b).abs() <= bound, "{rule:?} {i}: {a} {b}");
        }
    }
}

/// Hills, a leaf wall in front, and a face through both.
fn mixed() -> Geometry {
    let leaves = Mesh {
        uvs: vec![Vec2::ZERO; 4],
        opacity: Some(Arc::new(Opacity { texture: None, factor: 0.4, cutoff: None })),
        positions: vec![
            Vec3::new(-3.0, -1.0, -4.0),
            Vec3::new(3.0, -1.0, -4.0),
            Vec3::new(3.0, 2.0, -5.0),
            Vec3::new(-3.0, 2.0, -3.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    };
    let blade = soup(&[[Vec3::new(-1.0, -2.0, -2.0), Vec3::new(1.0, 3.0, -6.0), Vec3::new(0.4, -2.0, -7.0)]]);
    let hills = terrain(40, 30.0, |x, z| (0.9 * x).sin() * (0.7 * z).cos() - 1.0);
    let at = |mesh, y: f64| Instance { mesh, world_from_mesh: DAffine3::from_translation(DVec3::Y * y) };
    Geometry {
        meshes: vec![hills, leaves, blade],
        instances: vec![at(0, 0.0), at(1, 0.0), at(1, 0.3), at(2, 0.0), at(0, -0.5)],
    }
}

#[test]
fn the_way_the_picture_is_cut_does_not_matter() {
    for rule in RULES {
        for shading in [Shading::PerPixel, Shading::PerSpan] {
            let stage = stage(mixed(), ahead(40), Knobs { rule, shading, sub_scanlines: 3 });
            let whole = picture(&stage, 0..40, 0..40);
            let mut rows = Vec::new();
            for start in (0..40).step_by(7) {
                rows.extend(picture(&stage, start..(start + 7).min(40), 0..40));
            }
            assert_eq!(whole, rows);
            let window = picture(&stage, 11..23, 5..17);
            let expected: Vec<_> = whole
                .iter()
                .filter(|(r, p)| (11..23).contains(r) && (5..17).contains(&p.column))
                .copied()
                .collect();
            assert_eq!(window, expected);
        }
    }
}

#[test]
fn threads_do_not_matter() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| picture(&stage(mixed(), ahead(40), Knobs::default()), 0..40, 0..40))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn a_veil_shares_with_what_lies_behind() {
    // Two veils of opacity 0.4 before a wall: 0.4, 0.6 · 0.4 and 0.36 are left for each.
    let veil = |z: f32| Mesh {
        opacity: Some(Arc::new(Opacity { texture: None, factor: 0.4, cutoff: None })),
        ..wall(1, z, |_, _| 0.0)
    };
    let at = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let geometry = Geometry {
        meshes: vec![veil(-3.0), wall(1, -9.0, |_, _| 0.0), veil(-2.0), veil(-10.0)],
        instances: (0..4).map(at).collect(),
    };
    let stage = stage(geometry, ahead(8), Knobs::default());
    let mut shares = [0.0; 4];
    for (_, piece) in picture(&stage, 3..4, 2..3) {
        shares[piece.hit.instance as usize] += f64::from(piece.share);
    }
    for (share, expected) in shares.iter().zip([0.24, 0.36, 0.4, 0.0]) {
        // The opacity is an f32 of 0.4.
        assert!((share - expected).abs() <= ulps(8), "{shares:?}");
    }
}

#[test]
fn no_background_comes_through_many_veils() {
    // 0.4¹⁰ = 10⁻⁴ is below what is followed: the last veil reached takes the rest.
    let veil = |z: i16| Mesh {
        opacity: Some(Arc::new(Opacity { texture: None, factor: 0.6, cutoff: None })),
        ..wall(1, -f32::from(z), |_, _| 0.0)
    };
    let at = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let geometry = Geometry { meshes: (2..12).map(veil).collect(), instances: (0..10).map(at).collect() };
    for total in totals(&stage(geometry, ahead(8), Knobs::default()), 8, 8) {
        assert!((1.0 - total).abs() <= ulps(10), "{total}");
    }
}

#[test]
fn an_empty_scene_shows_nothing() {
    assert!(picture(&stage(Geometry::default(), ahead(8), Knobs::default()), 0..99, 0..99).is_empty());
}

#[test]
fn coplanar_faces_show_the_first() {
    let plane = wall(1, -5.0, |_, _| 0.0);
    let at = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let geometry =
        Geometry { meshes: vec![plane, wall(16, -5.0, |_, _| 0.0)], instances: vec![at(0), at(1)] };
    let stage = stage(geometry, ahead(32), Knobs::default());
    assert!(picture(&stage, 0..32, 0..32).iter().all(|(_, piece)| piece.hit.instance == 0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Share of a veil = own opacity · Π (1 − opacity) of those nearer, whatever order they are given in.
    #[test]
    fn veils_are_layered_by_depth(
        order in Just([3u8, 5, 7, 9, 11]).prop_shuffle(),
        factors in prop::array::uniform5(0f32..0.7),
    ) {
        let mesh = |(&z, &factor): (&u8, &f32)| Mesh {
            opacity: Some(Arc::new(Opacity { texture: None, factor, cutoff: None })),
            ..wall(1, -f32::from(z), |_, _| 0.0)
        };
        let at = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
        let meshes = order.iter().zip(&factors).map(mesh).collect();
        let stage = stage(Geometry { meshes, instances: (0..5).map(at).collect() }, ahead(4), Knobs::default());
        let mut shares = [0.0; 5];
        for (_, piece) in picture(&stage, 1..2, 1..2) {
            shares[piece.hit.instance as usize] += f64::from(piece.share);
        }
        for i in 0..5 {
            let nearer = (0..5).filter(|&k| order[k] < order[i]);
            let through: f64 = nearer.map(|k| 1.0 - f64::from(factors[k])).product();
            // 0.3⁵ is above what is followed; a share is rounded to f32 once, twice where faces meet.
            prop_assert!((shares[i] - through * f64::from(factors[i])).abs() <= ulps(2));
        }
    }

    #[test]
    fn shares_never_exceed_one(
        corners in prop::collection::vec([(-5f32..5.0, -5f32..5.0, -9f32..2.0), (-5f32..5.0, -5f32..5.0, -9f32..2.0), (-5f32..5.0, -5f32..5.0, -9f32..2.0)], 1..30),
        factor in prop::option::of(0f32..1.0),
        strips in 1u32..9,
    ) {
        let triangles: Vec<_> = corners.iter().map(|face| face.map(|(x, y, z)| Vec3::new(x, y, z))).collect();
        let mut mesh = soup(&triangles);
        mesh.opacity = factor.map(|factor| Arc::new(Opacity { texture: None, factor, cutoff: None }));
        let back = soup(&triangles[..1]);
        let at = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
        let geometry = Geometry { meshes: vec![mesh, back], instances: vec![at(0), at(1)] };
        for rule in RULES {
            let knobs = Knobs { sub_scanlines: strips, rule, shading: Shading::PerPixel };
            for total in totals(&stage(geometry.clone(), ahead(16), knobs), 16, 16) {
                prop_assert!((0.0..=1.0).contains(&total), "{}", total);
            }
        }
    }
}
