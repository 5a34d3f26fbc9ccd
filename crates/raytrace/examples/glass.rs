//! A ray of light through a 60° prism of glass, from face to face, and what a straight shadow ray is told of it.
//!
//! `cargo run --release -p keikan-raytrace --example glass -- [INDEX]` (1.52 without). At each face: where, at what angle, what share
//! is mirrored. Then, for rays at several angles, the share that gets through by refraction alone, and the transmittance of the prism's
//! shadow (`keikan_raytrace::through`), which keeps to the straight line.

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use keikan_raytrace::{Quality, World};
use light::{Geometry, Instance, Medium, Mesh, Nearest, Occlude, Ray, fresnel, refract};

/// Height of the triangle, whose sides are 1 m.
const HEIGHT: f64 = 0.866_025_403_784_438_6;

/// A prism that stands on its base, from z = −1 to 1 m.
fn prism(index: f32) -> World {
    let triangle = [Vec3::new(-0.5, 0.0, 0.0), Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.0, HEIGHT as f32, 0.0)];
    let positions =
        [1.0, -1.0].into_iter().flat_map(|z| triangle.map(|corner| corner + Vec3::Z * z)).collect();
    let sides = [[0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]];
    let sides = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let triangles = [[0, 1, 2], [3, 5, 4]].into_iter().chain(sides).collect();
    let medium = Some(Arc::new(Medium { index, ..Medium::default() }));
    let mesh = Mesh { positions, triangles, medium, ..Mesh::default() };
    let instances = vec![Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY }];
    World::build(Arc::new(Geometry { meshes: vec![mesh], instances }), Quality::Medium)
}

/// Follows refracted light until it leaves or is totally reflected: the share that gets through. `tell` hears of each face the
/// place, the angle off its normal \[degrees\] and the share that is mirrored.
fn follow(world: &World, index: f64, start: Ray, mut tell: impl FnMut(Vec3, f64, f64)) -> f64 {
    let (mut ray, mut left) = (start, 1.0);
    while let Some(hit) = world.nearest(&ray) {
        let (direction, normal) = (ray.direction.as_dvec3(), hit.place.normal.as_dvec3());
        let eta = if hit.front { index } else { 1.0 / index };
        let cos = -direction.dot(normal);
        let mirrored = fresnel(eta, cos);
        tell(hit.place.position, cos.min(1.0).acos().to_degrees(), mirrored);
        left *= 1.0 - mirrored;
        let Some(bent) = refract(direction, normal, eta) else { return 0.0 };
        ray = hit.place.leave(bent.as_vec3(), f32::INFINITY);
    }
    left
}

fn main() {
    let index = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1.52f32);
    let world = prism(index);
    // To the middle of the left face, `angle` off its normal, rising.
    let onto_face = |angle: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        let direction = DVec3::new(HEIGHT, -0.5, 0.0) * cos + DVec3::new(0.5, HEIGHT, 0.0) * sin;
        let middle = DVec3::new(-0.25, 0.5 * HEIGHT, 0.0);
        Ray::new((middle - direction * 3.0).as_vec3(), direction.as_vec3())
    };
    println!("n = {index}, 50° off the normal of the left face:");
    let share = follow(&world, f64::from(index), onto_face(50.0), |at, angle, mirrored| {
        println!("  at ({:.3}, {:.3}) m, {angle:.2}° off the normal, {mirrored:.4} mirrored", at.x, at.y);
    });
    println!("  {share:.4} gets through\n\nangle | refracted | straight shadow ray");
    for angle in [0.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0] {
        let ray = onto_face(angle);
        let refracted = follow(&world, f64::from(index), ray, |_, _, _| {});
        println!("{angle:4.0}° | {refracted:9.4} | {:.4}", world.transmittance(&ray).mean());
    }
}
