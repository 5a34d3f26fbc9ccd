//! Shadow intervals against samples, closed forms and the rays.

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3, Vec3};
use keikan_raytrace::{Quality, World};
use light::{Geometry, Instance, Mesh, Occlude, Opacity, Place, PointSource, Stretch, rounding::UNIT};
use proptest::prelude::*;

fn geometry(meshes: Vec<Mesh>) -> Arc<Geometry> {
    let once = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let instances = (0..meshes.len() as u32).map(once).collect();
    Arc::new(Geometry { meshes, instances })
}

fn mesh(corners: &[[DVec3; 3]]) -> Mesh {
    Mesh {
        positions: corners.iter().flatten().map(|corner| corner.as_vec3()).collect(),
        triangles: (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    }
}

/// Two triangles with the corners a, a + e, a + e + f, a + f.
fn quad(a: [f64; 3], e: [f64; 3], f: [f64; 3]) -> [[DVec3; 3]; 2] {
    let [a, e, f] = [a, e, f].map(DVec3::from);
    [[a, a + e, a + e + f], [a, a + e + f, a + f]]
}

/// The six faces of a box.
fn cuboid(low: [f64; 3], size: [f64; 3]) -> Vec<[DVec3; 3]> {
    let [x, y, z] = size;
    let top = [low[0] + x, low[1] + y, low[2] + z];
    let sides = |at: [f64; 3], s: f64| {
        let (x, y, z) = ([s * x, 0.0, 0.0], [0.0, s * y, 0.0], [0.0, 0.0, s * z]);
        [quad(at, x, y), quad(at, y, z), quad(at, z, x)]
    };
    [sides(low, 1.0), sides(top, -1.0)].concat().concat()
}

fn shadows(world: &World, source: PointSource, a: DVec3, b: DVec3) -> Vec<Stretch> {
    let mut out = Vec::new();
    assert!(world.shadows(&source, a, b, &mut out));
    out
}

/// Ends of the stretches, all of which must be dark.
fn dark(world: &World, source: PointSource, a: DVec3, b: DVec3) -> Vec<(f64, f64)> {
    let found = shadows(world, source, a, b);
    assert!(found.iter().all(|stretch| stretch.dark), "{found:?}");
    found.iter().map(|stretch| (stretch.from, stretch.to)).collect()
}

/// Equal up to `error`, and in number.
fn same(found: &[(f64, f64)], expected: &[(f64, f64)], error: f64) {
    let near = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).abs() <= error && (a.1 - b.1).abs() <= error;
    let all = found.len() == expected.len() && found.iter().zip(expected).all(near);
    assert!(all, "{found:?} instead of {expected:?}");
}

/// Rounding of a handful of f64 operations on numbers of size 1.
const EXACT: f64 = 16.0 * f64::EPSILON;

const FLOOR: [[f64; 3]; 3] = [[-50.0, 0.0, -50.0], [0.0, 0.0, 100.0], [100.0, 0.0, 0.0]];

#[test]
fn a_board_above_a_floor() {
    let board = quad([-1.0, 2.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
    let [floor, e, f] = FLOOR;
    let world = World::build(geometry(vec![mesh(&quad(floor, e, f)), mesh(&board)]), Quality::Medium);
    let (a, b) = (DVec3::new(-8.0, 0.0, 0.25), DVec3::new(8.0, 0.0, 0.25));
    // Half as high as the lamp: twice as wide a shadow, −2 to 2 of −8 to 8.
    let lamp = PointSource::At(DVec3::new(0.0, 4.0, 0.0));
    same(&dark(&world, lamp, a, b), &[(6.0 / 16.0, 10.0 / 16.0)], EXACT);
    // A sun at 45°: moved by the height.
    let sun = PointSource::Toward(DVec3::new(1.0, 1.0, 0.0));
    same(&dark(&world, sun, a, b), &[(5.0 / 16.0, 7.0 / 16.0)], EXACT);
    // The lamp below the board, and on it: nothing in between.
    for height in [1.0, 2.0] {
        assert!(dark(&world, PointSource::At(DVec3::new(0.0, height, 0.0)), a, b).is_empty());
    }
}

#[test]
fn light_from_a_plane_is_hidden_by_what_is_below_it() {
    let toward = DVec3::new(1.0, 2.0, 0.0).normalize();
    let (a, b) = (DVec3::new(-8.0, 0.0, 0.25), DVec3::new(8.0, 0.0, 0.25));
    let below = |level: f64| PointSource::Below { toward, level };
    let board = mesh(&quad([-1.0, 2.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]));
    // A wall from −1 to 4: of light from y = 2 on, what passes its lower half, 1 m along; of a sun's, all of 2 m.
    let wall = mesh(&quad([4.0, -1.0, -1.0], [0.0, 5.0, 0.0], [0.0, 0.0, 2.0]));
    let world = World::build(geometry(vec![board, wall]), Quality::Medium);
    let wide = |from: f64, to: f64| ((from + 8.0) / 16.0, (to + 8.0) / 16.0);
    same(&dark(&world, below(1.5), a, b), &[wide(3.25, 4.0)], EXACT);
    same(&dark(&world, below(2.0), a, b), &[wide(3.0, 4.0)], EXACT);
    same(&dark(&world, below(2.5), a, b), &[wide(-2.0, 0.0), wide(2.75, 4.0)], EXACT);
    same(&dark(&world, PointSource::Toward(toward), a, b), &[wide(-2.0, 0.0), wide(2.0, 4.0)], EXACT);
}

#[test]
fn a_wall_throws_its_shadow_from_its_foot_on() {
    let [floor, e, f] = FLOOR;
    let (a, b) = (DVec3::new(-8.0, 0.0, 0.25), DVec3::new(8.0, 0.0, 0.25));
    let sun = PointSource::Toward(DVec3::new(1.0, 1.0, 0.0));
    // Standing on the floor, or through it, or so that its foot is a corner of the floor itself.
    for depth in [0.0, 1.0] {
        let wall = quad([0.0, -depth, -5.0], [0.0, 3.0 + depth, 0.0], [0.0, 0.0, 10.0]);
        let world = World::build(geometry(vec![mesh(&quad(floor, e, f)), mesh(&wall)]), Quality::Medium);
        same(&dark(&world, sun, a, b), &[(5.0 / 16.0, 0.5)], EXACT);
        // A segment that ends at the wall, on either side of it.
        let foot = DVec3::new(0.0, 0.0, 0.25);
        same(&dark(&world, sun, a, foot), &[(5.0 / 8.0, 1.0)], EXACT);
        assert!(dark(&world, sun, foot, b).is_empty());
        // On the wall itself, on its lit side and on its dark one (the same plane).
        assert!(dark(&world, sun, foot, foot + DVec3::new(0.0, 2.0, 1.0)).is_empty());
    }
}

#[test]
fn no_light_between_neighbours_but_through_a_hole() {
    // A wall of 40 × 40 quads with one left out, its corners at numbers that round.
    let step = 0.1f32;
    let at = |i: u32, j: u32| Vec3::new(1.0, i as f32 * step - 0.07, j as f32 * step - 2.03);
    let positions = (0..41 * 41).map(|n| at(n / 41, n % 41)).collect();
    let quads = (0..40 * 40).filter(|n| (n / 40, n % 40) != (10, 20));
    let triangles = quads.flat_map(|n| {
        let n = n / 40 * 41 + n % 40;
        [[n, n + 1, n + 42], [n, n + 42, n + 41]]
    });
    let wall = Mesh { triangles: triangles.collect(), positions, ..Mesh::default() };
    let world = World::build(geometry(vec![wall]), Quality::Medium);
    for i in 0..2000 {
        let i = f64::from(i);
        let lamp = DVec3::new(2.1 + (i * 0.37).sin(), 1.0 + (i * 0.73).sin() * 0.4, (i * 1.19).cos() * 0.5);
        let z = (i * 0.91).sin() * 0.3;
        let (a, b) = (DVec3::new(-0.2, 0.9, z - 0.5), DVec3::new(-0.2, 1.1, z + 0.5));
        let found = dark(&world, PointSource::At(lamp), a, b);
        // The hole is convex: one gap at most.
        let (from, to) = match found[..] {
            [] => (0.0, 1.0),
            [(0.0, 1.0)] => continue,
            [(0.0, from), (to, 1.0)] => (from, to),
            [(from, 1.0)] => (0.0, from),
            [(0.0, to)] => (to, 1.0),
            _ => panic!("{found:?}"),
        };
        let seen = lamp.lerp(a.lerp(b, (from + to) / 2.0), (lamp.x - 1.0) / (lamp.x + 0.2));
        let hole = [at(10, 20), at(11, 21)].map(|corner| corner.as_dvec3());
        assert!(seen.y > hole[0].y && seen.y < hole[1].y && seen.z > hole[0].z && seen.z < hole[1].z);
    }
}

#[test]
fn inside_and_outside_a_closed_box() {
    let world = World::build(geometry(vec![mesh(&cuboid([-1.0, -1.0, -1.0], [2.0; 3]))]), Quality::Medium);
    let inside = PointSource::At(DVec3::new(0.3, 0.2, -0.1));
    // Its own walls from within, up to the edges; everything without.
    assert!(dark(&world, inside, DVec3::new(-1.0, -1.0, -0.5), DVec3::new(1.0, -1.0, 0.5)).is_empty());
    same(&dark(&world, inside, DVec3::new(-9.0, 3.0, 2.0), DVec3::new(9.0, 4.0, 2.0)), &[(0.0, 1.0)], 0.0);
    // Its walls from without: those that face the source are lit, the others dark.
    let outside = PointSource::At(DVec3::new(0.0, 5.0, 0.0));
    assert!(dark(&world, outside, DVec3::new(-1.0, 1.0, -0.5), DVec3::new(1.0, 1.0, 0.5)).is_empty());
    let below = (DVec3::new(-1.0, -1.0, -0.5), DVec3::new(1.0, -1.0, 0.5));
    same(&dark(&world, outside, below.0, below.1), &[(0.0, 1.0)], 0.0);
    // A side that the light runs along: an edge of the box cannot hide it, nor does anything panic.
    let above = PointSource::At(DVec3::new(1.0, 5.0, 0.0));
    shadows(&world, above, DVec3::new(1.0, -1.0, -0.5), DVec3::new(1.0, 0.9, 0.5));
}

#[test]
fn veils_are_left_to_rays() {
    let opacity = Arc::new(Opacity { texture: None, factor: 0.5, cutoff: None });
    let board = mesh(&quad([-1.0, 2.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]));
    let veil = Mesh { opacity: Some(opacity), ..board };
    let world = World::build(geometry(vec![veil]), Quality::Medium);
    let sun = PointSource::Toward(DVec3::Y);
    let found = shadows(&world, sun, DVec3::new(-2.0, 0.0, 0.1), DVec3::new(2.0, 0.0, 0.1));
    assert_eq!(found, [Stretch { from: 0.25, to: 0.75, dark: false }]);
}

#[test]
fn what_cannot_be_told_is_said() {
    let board = quad([-1.0, 2.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
    let world = World::build(geometry(vec![mesh(&board)]), Quality::Medium);
    let (a, b) = (DVec3::new(-2.0, 0.0, 0.1), DVec3::new(2.0, 0.0, 0.1));
    let ask = [Stretch { from: 0.0, to: 1.0, dark: false }];
    let lamp = |at| PointSource::At(at);
    for at in [a, b, a.lerp(b, 0.3), b + (b - a), a - (b - a) * 7.0] {
        assert_eq!(shadows(&world, lamp(at), a, b), ask);
    }
    assert_eq!(shadows(&world, PointSource::Toward(DVec3::X), a, b), ask);
    assert_eq!(shadows(&world, PointSource::Toward(DVec3::ZERO), a, b), ask);
    assert_eq!(shadows(&world, lamp(DVec3::Y), a, a), ask);
    for bad in [f64::NAN, f64::INFINITY, 1e30] {
        let bad = DVec3::new(0.0, bad, 0.0);
        let mut out = Vec::new();
        assert!(!world.shadows(&lamp(bad), a, b, &mut out));
        assert!(!world.shadows(&PointSource::Toward(bad), a, b, &mut out));
        assert!(!world.shadows(&lamp(DVec3::Y), bad, b, &mut out));
        assert!(!world.shadows(&lamp(DVec3::Y), a, bad, &mut out));
        assert!(out.is_empty());
    }
    let nothing = World::build(geometry(vec![]), Quality::Medium);
    assert!(shadows(&nothing, lamp(DVec3::Y), a, b).is_empty());
}

#[test]
fn a_crowd_of_faces_is_left_to_rays() {
    // 5000 boards one above the other, none of which reaches across.
    let board = |i: u32| quad([-1.0, 1.0 + f64::from(i) * 0.01, -1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
    let world =
        World::build(geometry(vec![mesh(&(0..5000).flat_map(board).collect::<Vec<_>>())]), Quality::Medium);
    let (a, b) = (DVec3::new(-2.0, 0.0, 0.1), DVec3::new(2.0, 0.0, 0.1));
    let found = shadows(&world, PointSource::Toward(DVec3::Y), a, b);
    assert_eq!(found, [Stretch { from: 0.0, to: 1.0, dark: false }]);
    // Under one board it is dark, however many there are.
    let b = DVec3::new(-0.5, 0.0, 0.1);
    let dark = shadows(&world, PointSource::Toward(DVec3::Y), b, b - DVec3::X * 0.1);
    assert_eq!(dark, [Stretch { from: 0.0, to: 1.0, dark: true }]);
}

/// Whether any face stands strictly between `at` and the source, by signs of volumes, in f64.
fn blocked(faces: &[[DVec3; 3]], at: DVec3, source: PointSource) -> bool {
    let (toward, length) = match source {
        PointSource::At(lamp) => (lamp - at, 1.0),
        PointSource::Toward(toward) => (toward, f64::INFINITY),
        PointSource::Below { toward, level } => (toward * ((level - at.y) / toward.y), 1.0),
    };
    faces.iter().any(|&[a, b, c]| {
        let (a, b, c) = (a - at, b - at, c - at);
        let edges = [a.cross(b).dot(toward), b.cross(c).dot(toward), c.cross(a).dot(toward)];
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a) / normal.dot(toward);
        let one_sided = edges.iter().all(|&e| e >= 0.0) || edges.iter().all(|&e| e <= 0.0);
        one_sided && t > 0.0 && t < length
    })
}

/// Whether `answer` is right for some point within `apart` of `at`.
fn right(faces: &[[DVec3; 3]], at: DVec3, source: PointSource, answer: bool, apart: f64) -> bool {
    let steps = [-1.0, 0.0, 1.0];
    let moves =
        steps.iter().flat_map(|&x| steps.iter().flat_map(move |&y| steps.map(|z| DVec3::new(x, y, z))));
    blocked(faces, at, source) == answer
        || moves.into_iter().any(|by| blocked(faces, at + by.normalize_or_zero() * apart, source) == answer)
}

fn covered(stretches: &[(f64, f64)], s: f64) -> bool {
    stretches.iter().any(|&(from, to)| from < s && s < to)
}

fn corners() -> impl Strategy<Value = Vec<[DVec3; 3]>> {
    let near = (prop::array::uniform3(-3.0f32..3.0), 0.05f32..2.0);
    let one = (near, prop::array::uniform3(prop::array::uniform3(-1.0f32..1.0)));
    let one = one.prop_map(|((at, size), corners)| {
        corners.map(|corner| (Vec3::from(at) + Vec3::from(corner) * size).as_dvec3())
    });
    prop::collection::vec(one, 1..40)
}

fn point(most: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-most..most).prop_map(DVec3::from)
}

/// What positions may be off by, for coordinates up to `reach`: 4 u of each, along a normal with Σ|n| ≤ √3,
/// doubled for good measure of the bound's own corners (27 directions stand for a ball).
fn apart(reach: f64) -> f64 {
    2.0 * 4.0 * f64::from(UNIT) * 3f64.sqrt() * reach
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn a_soup_is_cut_where_samples_say(
        faces in corners(), a in point(4.0), b in point(4.0), at in point(8.0), sun in any::<bool>(),
        far in prop::sample::select(vec![0.0, 1e3, 1e6]), copies in prop::sample::select(vec![1u32, 300]),
    ) {
        let one = mesh(&faces);
        let shift = DVec3::new(1.0, -0.5, 0.25) * far;
        let size = if far > 1e5 { 1e3 } else { 1.0 };
        // Copies (an instance with a hierarchy of its own) stand aside, where no light passes.
        let place = |i: u32| DAffine3::from_scale_rotation_translation(
            DVec3::splat(size),
            DQuat::from_rotation_y(0.5),
            shift + DVec3::Y * f64::from(i) * 1e4 * size,
        );
        let instances: Vec<_> = (0..copies).map(|i| Instance { mesh: 0, world_from_mesh: place(i) }).collect();
        let geometry = Arc::new(Geometry { meshes: vec![one], instances });
        let world = World::build(geometry, Quality::Fast);
        let to = |p: DVec3| place(0).transform_point3(p);
        let faces: Vec<_> = faces.iter().map(|face| face.map(to)).collect();
        let source = match sun {
            true => PointSource::Toward(place(0).transform_vector3(DVec3::new(at.x, 0.1 * at.y, at.z))),
            false => PointSource::At(to(at)),
        };
        let (a, b) = (to(a), to(b));
        let found = dark(&world, source, a, b);
        prop_assert!(found.windows(2).all(|w| w[0].1 < w[1].0) && found.iter().all(|s| s.0 < s.1));
        for i in 0..200 {
            let s = (f64::from(i) + 0.5) / 200.0;
            let answer = covered(&found, s);
            let reach = far + 20.0 * size;
            prop_assert!(
                right(&faces, a.lerp(b, s), source, answer, apart(reach)),
                "{s} of {a} to {b} from {source:?}: {answer}, {found:?}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// From a plane above the segment, which faces may stand through.
    #[test]
    fn light_from_a_plane_is_cut_where_samples_say(
        faces in corners(), a in point(3.0), b in point(3.0), way in point(1.0), over in 1e-3..4.0f64,
    ) {
        let world = World::build(geometry(vec![mesh(&faces)]), Quality::Fast);
        let toward = DVec3::new(way.x, way.y.abs() + 0.3, way.z).normalize();
        let source = PointSource::Below { toward, level: a.y.max(b.y) + over };
        let found = dark(&world, source, a, b);
        prop_assert!(found.windows(2).all(|w| w[0].1 < w[1].0) && found.iter().all(|s| s.0 < s.1));
        prop_assert!(found.iter().all(|s| 0.0 <= s.0 && s.1 <= 1.0));
        for i in 0..200 {
            let s = (f64::from(i) + 0.5) / 200.0;
            let answer = covered(&found, s);
            prop_assert!(
                right(&faces, a.lerp(b, s), source, answer, apart(20.0)),
                "{s} of {a} to {b} from {source:?}: {answer}, {found:?}"
            );
        }
    }
}

/// The rays' own answer at the very place, whose error moves them off their face.
fn by_ray(world: &World, at: DVec3, normal: DVec3, source: PointSource, reach: f64) -> bool {
    let error = 4.0 * UNIT * reach as f32;
    let place = Place { position: at.as_vec3(), error, normal: normal.as_vec3(), seed: 0 };
    let ray = match source {
        PointSource::At(lamp) => place.toward(lamp.as_vec3()),
        PointSource::Toward(toward) | PointSource::Below { toward, .. } => {
            place.leave(toward.as_vec3(), f32::INFINITY)
        }
    };
    world.transmittance(&ray).is_zero()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn rays_say_the_same_on_faces(
        boxes in prop::collection::vec(((-5.0f32..5.0, 0.0f32..2.0, -5.0f32..5.0), 0.1f32..2.0, any::<bool>()), 1..12),
        lamp in point(7.0), sun in any::<bool>(), seed in any::<u32>(),
    ) {
        // Boxes, some of them standing on the floor: corners of three kinds, faces that meet and overlap.
        let mut faces = quad(FLOOR[0], FLOOR[1], FLOOR[2]).to_vec();
        for ((x, y, z), size, stands) in boxes {
            let low = [f64::from(x), if stands { 0.0 } else { f64::from(y) }, f64::from(z)];
            faces.extend(cuboid(low, [f64::from(size); 3]).into_iter().map(|f| f.map(|c| c.as_vec3().as_dvec3())));
        }
        let world = World::build(geometry(vec![mesh(&faces)]), Quality::Medium);
        let source = match sun {
            true => PointSource::Toward(DVec3::new(lamp.x, lamp.y.abs() + 0.5, lamp.z).normalize()),
            false => PointSource::At(DVec3::new(lamp.x, lamp.y.abs() + 0.5, lamp.z)),
        };
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            f64::from(state >> 8) / f64::from(1u32 << 24)
        };
        for _ in 0..20 {
            // A segment on some face, rims included.
            let face = faces[(random() * faces.len() as f64) as usize];
            let mut on = || face[0].lerp(face[1].lerp(face[2], random()), random());
            let (a, b) = (on(), on());
            let normal = (face[1] - face[0]).cross(face[2] - face[0]).normalize();
            let toward = match source {
                PointSource::At(lamp) => lamp - a,
                PointSource::Toward(toward) | PointSource::Below { toward, .. } => toward,
            };
            // Light along a face hardly arrives; there the way of a ray is as undecided as its start.
            if (a - b).length() < 0.01 || (normal.dot(toward) / toward.length()).abs() < 0.01 {
                continue;
            }
            let found = shadows(&world, source, a, b);
            prop_assume!(found.iter().all(|stretch| stretch.dark));
            let found: Vec<_> = found.iter().map(|stretch| (stretch.from, stretch.to)).collect();
            for i in 0..50 {
                let s = (f64::from(i) + 0.5) / 50.0;
                let (at, reach) = (a.lerp(b, s), 50.0);
                let (fan, ray) = (covered(&found, s), by_ray(&world, at, normal, source, reach));
                if fan == ray {
                    continue;
                }
                // A ray starts up to 4 u Σ|n| beside its place, its direction is off by 2 u and its test by 4 u of
                // the distance. Where it disagrees, one of the points as near must give its answer.
                let apart = 10.0 * f64::from(UNIT) * 3f64.sqrt() * (reach + 20.0);
                let ends = [s - apart / 0.01 / (b - a).length(), s + apart / 0.01 / (b - a).length()];
                let end = found.iter().any(|&(f, t)| [f, t].iter().any(|e| ends[0] <= *e && *e <= ends[1]));
                prop_assert!(
                    end || right(&faces, at, source, ray, apart),
                    "{s} of {a} to {b} from {source:?}: fan {fan}, ray {ray}, {found:?}"
                );
            }
        }
    }
}
