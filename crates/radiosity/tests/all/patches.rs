//! Patches: areas, order, limits, corners.

use glam::{DAffine3, DVec3, Vec3};
use keikan_radiosity::{Cut, Patch, Patches, Side, direct};
use light::{Geometry, Instance, Mesh, Spectrum, Uniform};

use crate::rooms::{Painted, Room, surface};

fn grey(_: &Patch) -> Spectrum {
    Spectrum::splat(0.5)
}

#[test]
fn patches_cover_their_faces_and_no_edge_is_too_long() {
    let room = Room::furnished();
    for edge in [5.0, 0.7, 0.2] {
        let patches = room.patches(edge, 0.5);
        let boxes = 2.0 * (1.1 * 0.9 + 0.9 * 1.3 + 1.3 * 1.1) + 2.0 * (0.9 * 1.7 + 1.7 * 0.8 + 0.8 * 0.9);
        let truth = 2.0 * (4.0 * 3.0 + 3.0 * 5.0 + 5.0 * 4.0) + boxes;
        // Corners are f32.
        assert!((surface(&patches) - truth).abs() < 1e-5, "{}", surface(&patches));
        for patch in patches.iter() {
            let [a, b, c] = patch.corners;
            assert!(a.distance(b).max(b.distance(c)).max(c.distance(a)) <= edge);
            // The room's inside: towards its middle.
            if patch.face[0] == 0 {
                assert!(patch.normal().dot(DVec3::new(2.0, 1.5, 2.5) - patch.centre()) > 0.0);
            }
        }
    }
}

#[test]
fn no_more_patches_than_asked_for() {
    let room = Room::furnished();
    for most in [36, 100, 3000] {
        let patches = Patches::new(&room.geometry, &Painted(0.5), &Cut { edge: 1e-6, most });
        // Halving all edges at once, the next finer division has at most four times as many.
        let faces = 36;
        assert!(patches.len() <= most + faces && 4 * patches.len() >= most, "{most}: {}", patches.len());
        assert!(patches.edge() > 1e-6);
    }
    // Faces are never joined.
    assert_eq!(Patches::new(&room.geometry, &Painted(0.5), &Cut { edge: 1.0, most: 1 }).len(), 36);
}

#[test]
fn both_sides_count_unless_told_otherwise_and_mirrored_placements_keep_their_fronts() {
    let mesh =
        Mesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let placed = |scale| Instance { mesh: 0, world_from_mesh: DAffine3::from_scale(scale) };
    let instances =
        vec![placed(DVec3::ONE), placed(DVec3::new(1.0, 1.0, -1.0)), placed(DVec3::new(-1.0, 1.0, 1.0))];
    let geometry = Geometry { meshes: vec![mesh], instances };
    let patches = Patches::new(&geometry, &grey, &Cut { edge: 9.0, ..Cut::default() });
    let found: Vec<_> = patches.iter().map(|patch| (patch.face[0], patch.side, patch.normal().z)).collect();
    // A mirror in z turns the front over, one in x does not.
    let fronts = [1.0, -1.0, 1.0];
    for (i, front) in fronts.into_iter().enumerate() {
        assert_eq!(found[2 * i], (i as u32, Side::Front, front));
        assert_eq!(found[2 * i + 1], (i as u32, Side::Back, -front));
    }
}

#[test]
fn nothing_broken_becomes_a_patch() {
    let mesh = |positions: Vec<Vec3>| Mesh { positions, triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let placed = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let meshes = vec![
        mesh(vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0]),
        mesh(vec![Vec3::X, Vec3::X * 2.0, Vec3::new(3.0, 1e-9, 0.0)]),
        mesh(vec![Vec3::NAN, Vec3::X, Vec3::Y]),
        mesh(vec![Vec3::INFINITY, Vec3::X, Vec3::Y]),
    ];
    let geometry = Geometry { meshes, instances: (0..4).map(placed).collect() };
    for edge in [0.5, 0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Patches::new(&geometry, &grey, &Cut { edge, most: 10 }).is_empty());
        let room = Room::empty(Vec3::ONE);
        let patches = Patches::new(&room.geometry, &grey, &Cut { edge, most: 100 });
        assert!((24..=100).contains(&patches.len()), "{edge}: {}", patches.len());
    }
    assert!(Patches::new(&Geometry::default(), &grey, &Cut::default()).is_empty());
}

#[test]
fn a_uniform_light_gives_pi_everywhere() {
    let room = Room::furnished();
    let patches = room.patches(1.0, 0.5);
    let sky = Uniform { radiance: Spectrum::ONE };
    let found = direct(&patches, &[&sky, &sky], &room.boxes, 4);
    assert_eq!(found.len(), patches.len());
    // A mean of three, of two each, in f32.
    let is_two_pi = |e: &Spectrum| (e[0] / (2.0 * std::f32::consts::PI) - 1.0).abs() < 8.0 * f32::EPSILON;
    assert!(found.iter().all(is_two_pi));
}

#[test]
fn reflectances_are_shares() {
    let room = Room::empty(Vec3::ONE);
    let wild = |_: &Patch| Spectrum([f32::NAN, -1.0, 2.0, 0.5, 0.0, 1.0, f32::INFINITY, 0.25]);
    let patches = Patches::new(&room.geometry, &wild, &Cut::default());
    assert_eq!(patches.reflectance(0), Spectrum([0.0, 0.0, 1.0, 0.5, 0.0, 1.0, 1.0, 0.25]));
}
