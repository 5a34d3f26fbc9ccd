//! The generated town in `scenes/thesis`: what the example prints, and sound as a model.

#[path = "../examples/town/design/mod.rs"]
mod design;

use std::path::Path;

use glam::{DVec2, DVec3};
use light::{Geometry, Triangle};

const FILE: &str = include_str!("../../../scenes/thesis/town.gltf");

fn geometry() -> Geometry {
    let model = keikan_scene::gltf::parse(FILE.as_bytes(), Path::new("."), Path::new("town.gltf")).unwrap();
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
    Geometry { meshes: model.meshes, instances: model.instances }
}

#[test]
fn the_file_is_what_the_example_prints() {
    // Not assert_eq: nobody wants to read 100 kB twice.
    assert!(
        FILE == design::gltf(),
        "run: cargo run -p keikan-scene --example town > scenes/thesis/town.gltf"
    );
}

#[test]
fn it_has_the_size_it_states() {
    let geometry = geometry();
    // "about 800" (thesis 4.5).
    assert!((750..=900).contains(&geometry.instances.len()), "{} objects", geometry.instances.len());
    let (low, high) = geometry.bounds().unwrap();
    assert!(high.y > 118.0 && high.y < 140.0 && low.y < 0.0, "{low} {high}");
}

/// Volume inside each mesh is positive: its faces go counter-clockwise seen from outside.
#[test]
fn every_face_looks_outward() {
    for mesh in geometry().meshes {
        let corner = |i: u32| mesh.positions[i as usize].as_dvec3();
        let six_volumes: f64 =
            mesh.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c)))).sum();
        assert!(six_volumes > 0.0, "{six_volumes}");
    }
}

/// Two faces in one plane that cover each other and face the same way: which of them is seen is anybody's guess. Those that
/// face each other hide each other, and undersides are in the ground.
#[test]
fn no_two_faces_share_a_plane() {
    let geometry = geometry();
    let mut faces: Vec<(f64, f64, usize, Triangle)> = Vec::new();
    for (i, instance) in geometry.instances.iter().enumerate() {
        for t in 0..geometry.meshes[instance.mesh as usize].triangles.len() {
            let face = geometry.triangle(i as u32, t as u32);
            let xs = face.0.map(|corner| corner.x);
            let bound = |pick: fn(f64, f64) -> f64| xs.into_iter().reduce(pick).unwrap();
            faces.push((bound(f64::min), bound(f64::max), i, face));
        }
    }
    faces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found = Vec::new();
    for (k, (_, end, i, face)) in faces.iter().enumerate() {
        for (_, _, j, other) in
            faces[k + 1..].iter().take_while(|next| next.0 < *end).filter(|next| next.2 != *i)
        {
            if cover(face, other) {
                found.push(format!("{} {:?} and {} {:?}", i, face.0, j, other.0));
            }
        }
    }
    assert!(found.is_empty(), "{} pairs: {:#?}", found.len(), &found[..found.len().min(5)]);
}

/// Whether both face the same way, all corners of `b` lie within 1 cm of the plane of `a`, and both have a common part wider than 1 cm, seen
/// along the normal.
fn cover(a: &Triangle, b: &Triangle) -> bool {
    let normal = a.cross().normalize();
    if normal.y < -0.5 || normal.dot(b.cross()) < 0.0 {
        return false;
    }
    if b.0.iter().any(|corner| (*corner - a.0[0]).dot(normal).abs() > 0.01) {
        return false;
    }
    let u = (a.0[1] - a.0[0]).normalize();
    let v = normal.cross(u);
    let flat = |face: &Triangle| face.0.map(|p: DVec3| DVec2::new(p.dot(u), p.dot(v)));
    let (a, b) = (flat(a), flat(b));
    // Convex sets are apart if and only if some edge of one of them separates them.
    let apart = |one: &[DVec2; 3], other: &[DVec2; 3]| {
        (0..3).any(|i| {
            let across = (one[(i + 1) % 3] - one[i]).perp().normalize();
            let reach = |set: &[DVec2; 3]| {
                let along = set.map(|p| p.dot(across));
                (along.into_iter().fold(f64::MAX, f64::min), along.into_iter().fold(f64::MIN, f64::max))
            };
            let ((a, b), (c, d)) = (reach(one), reach(other));
            b.min(d) - a.max(c) < 0.01
        })
    };
    !apart(&a, &b) && !apart(&b, &a)
}
