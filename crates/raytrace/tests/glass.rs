//! Laws of transparent bodies: their shadows, and how they are seen.

use std::cell::Cell;
use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use keikan_raytrace::surface::{Finish, Glass};
use keikan_raytrace::{BruteForce, Crossing, Quality, World, through};
use light::{
    Arrival, Geometry, Instance, Medium, Mesh, Nearest, Occlude, Path, Place, Ray, Shade, Spectrum,
    Surroundings, check::reciprocity,
};
use proptest::prelude::*;

fn cube() -> Mesh {
    let positions = (0..8u8).map(|i| {
        let at = |bit: u8| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Vec3::new(at(0), at(1), at(2))
    });
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { positions: positions.collect(), triangles, ..Mesh::default() }
}

/// A ball of flat faces: an octahedron, each face cut in four three times.
fn ball() -> Mesh {
    let corners = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let mut faces: Vec<[Vec3; 3]> = (0..8)
        .map(|i| {
            let [x, y, z] = [corners[i & 1], corners[2 + (i >> 1 & 1)], corners[4 + (i >> 2 & 1)]];
            if (y - x).cross(z - x).dot(x) > 0.0 { [x, y, z] } else { [x, z, y] }
        })
        .collect();
    for _ in 0..3 {
        faces = faces
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [d, e, f] = [a + b, b + c, c + a].map(Vec3::normalize);
                [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
            })
            .collect();
    }
    let triangles = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh { positions: faces.into_iter().flatten().collect(), triangles, ..Mesh::default() }
}

fn world(mesh: Mesh, medium: Medium) -> World {
    let mesh = Mesh { medium: Some(Arc::new(medium)), ..mesh };
    let instances = vec![Instance { mesh: 0, world_from_mesh: DAffine3::from_rotation_y(0.4) }];
    World::build(Arc::new(Geometry { meshes: vec![mesh], instances }), Quality::Medium)
}

fn glass(index: f32) -> Medium {
    Medium { index, ..Medium::default() }
}

/// A furnace of radiance 1 around a world of glass. Counts what its limits leave out.
struct Room<'a> {
    world: &'a World,
    glass: &'a Glass,
    depth: u8,
    least: f32,
    lost: Cell<f32>,
}

impl Surroundings for Room<'_> {
    fn arrivals(&self, _: &Place, receive: &mut dyn FnMut(Arrival)) {
        receive(Arrival::Field { irradiance: Spectrum::splat(std::f32::consts::PI) });
    }

    fn radiance(&self, ray: &Ray, path: Path) -> Spectrum {
        if path.depth > self.depth || path.share < self.least {
            self.lost.set(self.lost.get() + path.share);
            return Spectrum::ZERO;
        }
        match self.world.nearest(ray) {
            Some(hit) => self.glass.radiance(&light::Hit { path, ..hit }, self),
            None => Spectrum::ONE,
        }
    }
}

/// Radiance of one ray in the furnace, and what the limits left out of it.
fn seen(world: &World, medium: Medium, ray: &Ray, depth: u8, least: f32) -> (Spectrum, f32) {
    let finish = Finish { roughness: 0.0, ..Finish::default() };
    let glass = Glass::new(finish, medium);
    let room = Room { world, glass: &glass, depth, least, lost: Cell::new(0.0) };
    (room.radiance(ray, Path::EYE), room.lost.get())
}

#[test]
fn clear_bodies_are_invisible_in_a_furnace() {
    let bodies = [(cube(), false), (ball(), false), (cube(), true), (ball(), true)];
    for (mesh, thin) in bodies {
        let medium = Medium { thin, ..glass(1.52) };
        let world = world(mesh, medium);
        for i in 0..200 {
            let turn = f64::from(i) * 2.399_963;
            let aim = DVec3::new(turn.cos(), turn.sin(), 0.3) * (f64::from(i) / 200.0);
            let eye = DVec3::new(3.0, 2.0, 4.0);
            let ray = Ray::new(eye.as_vec3(), (aim - eye).normalize().as_vec3());
            let (light, lost) = seen(&world, medium, &ray, 24, 1e-3);
            // What is left out is counted exactly; the rest is rounding, some ten operations a turn.
            let rounding = 24.0 * 10.0 * f32::EPSILON;
            assert!((light[0] + lost - 1.0).abs() <= rounding, "{thin} {i}: {light:?} {lost}");
        }
    }
}

#[test]
fn energy_never_grows_with_depth_beyond_what_is_there() {
    let medium = glass(1.52);
    let world = world(cube(), medium);
    let ray = Ray::new(Vec3::new(3.0, 2.0, 4.0), Vec3::new(-3.0, -1.9, -4.0).normalize());
    let mut last = 0.0;
    for depth in 0..12 {
        let (light, _) = seen(&world, medium, &ray, depth, 0.0);
        assert!(light[0] >= last && light[0] <= 1.0 + 24.0 * 10.0 * f32::EPSILON, "{depth}: {light:?}");
        last = light[0];
    }
}

#[test]
fn beer_and_lambert_hold_along_the_way_inside() {
    let medium = Medium { absorption: Spectrum::splat(0.7), ..glass(1.0) };
    let world = world(cube(), medium);
    let ray = Ray::new(Vec3::new(0.1, 5.0, 0.2), Vec3::NEG_Y);
    let left = (-1.4f32).exp();
    let (light, _) = seen(&world, medium, &ray, 24, 0.0);
    assert!((light[0] - left).abs() < 1e-5, "positions are good to some 1e-7 m; f32");
    assert!((world.transmittance(&ray)[0] - left).abs() < 1e-6, "f32 rounding of exp and the way");
    let inside = Ray { length: 5.0, ..ray };
    assert!((world.transmittance(&inside)[0] - (-0.7f32).exp()).abs() < 1e-6, "a metre inside");
    assert!(reciprocity(&world, &inside) < 1e-6);
}

#[test]
fn a_body_of_glass_passes_two_interfaces() {
    let world = world(cube(), glass(1.52));
    let r = (0.52f32 / 2.52).powi(2);
    for origin in [Vec3::new(0.1, 5.0, 0.2), Vec3::new(0.0, 5.0, 0.0)] {
        // The second goes through the diagonals of two faces: four triangles, two crossings.
        let through = world.transmittance(&Ray::new(origin, Vec3::NEG_Y))[0];
        assert!((through - (1.0 - r) * (1.0 - r)).abs() < 1e-6, "{through}");
    }
    let prism =
        world.transmittance(&Ray::new(Vec3::new(5.0, 0.0, 5.0), Vec3::new(-1.0, 0.0, -1.0).normalize()));
    assert!(prism.max() <= 1.0);
}

#[test]
fn light_beyond_the_critical_angle_does_not_pass() {
    // Head on through one leg of a prism of 45°, then at 45° > 41.1° against its long side; and backwards.
    let out = DVec3::new(1.0, 1.0, 0.0).normalize();
    let mut crossings = [Crossing { t: 1.0, outward: DVec3::NEG_X }, Crossing { t: 1.5, outward: out }];
    assert_eq!(through(DVec3::X, &mut crossings, 9.0, 1e-9, &glass(1.52)), Spectrum::ZERO);
    let mut back = [Crossing { t: 1.0, outward: out }, Crossing { t: 1.5, outward: DVec3::NEG_X }];
    assert_eq!(through(DVec3::NEG_X, &mut back, 9.0, 1e-9, &glass(1.52)), Spectrum::ZERO);
}

#[test]
fn faces_in_each_other_and_parts_that_touch_count_once() {
    let face = |t: f64, y: f64| Crossing { t, outward: DVec3::Y * y };
    let plain = through(DVec3::NEG_Y, &mut [face(1.0, 1.0), face(2.0, -1.0)], 9.0, 1e-6, &glass(1.5));
    let twice = [face(1.0, 1.0), face(1.0, 1.0), face(2.0, -1.0), face(2.0, -1.0)];
    let touching = [face(1.0, 1.0), face(1.5, -1.0), face(1.5, 1.0), face(2.0, -1.0)];
    for mut crossings in [twice, touching] {
        assert_eq!(through(DVec3::NEG_Y, &mut crossings, 9.0, 1e-6, &glass(1.5)), plain);
    }
    let pane = Medium { thin: true, ..glass(1.5) };
    let once = through(DVec3::NEG_Y, &mut [face(1.0, 1.0)], 9.0, 1e-6, &pane);
    let both = through(DVec3::NEG_Y, &mut [face(1.0, 1.0), face(1.0, -1.0)], 9.0, 1e-6, &pane);
    assert_eq!(once, both);
    assert_eq!(through(DVec3::NEG_Y, &mut [], 9.0, 1e-6, &glass(1.5)), Spectrum::ONE);
}

fn unit() -> impl Strategy<Value = DVec3> {
    (-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0)
        .prop_map(|(x, y, z)| DVec3::new(x, y, z))
        .prop_filter_map("a direction", DVec3::try_normalize)
}

proptest! {
    #[test]
    fn shadows_are_symmetric_shares(
        direction in unit(),
        faces in prop::collection::vec((0.0f64..10.0, unit()), 0..6),
        index in 0.5f32..2.5,
        absorption in 0.0f32..3.0,
        transmission in 0.0f32..=1.0,
        thin in any::<bool>(),
    ) {
        let medium =
            Medium { index, absorption: Spectrum::splat(absorption), transmission, thin, ..Medium::default() };
        let mut there: Vec<_> = faces.iter().map(|&(t, outward)| Crossing { t, outward }).collect();
        let mut back: Vec<_> = faces.iter().map(|&(t, outward)| Crossing { t: 10.0 - t, outward }).collect();
        let there = through(direction, &mut there, 10.0, 0.0, &medium)[0];
        let back = through(-direction, &mut back, 10.0, 0.0, &medium)[0];
        prop_assert!((0.0..=1.0).contains(&there), "{there}");
        // 10 − t rounds by 1e-15 m; the rest is f32 rounding of at most 3 pieces of body.
        prop_assert!((there - back).abs() <= 16.0 * f32::EPSILON, "{there} {back}");
    }

    #[test]
    fn what_nobody_can_see_casts_no_shadow(direction in unit(), at in unit()) {
        let world = world(ball(), glass(1.0));
        let origin = (at * 0.9 - direction * 4.0).as_vec3();
        let ray = Ray::new(origin, direction.as_vec3().normalize());
        prop_assert_eq!(world.transmittance(&ray), Spectrum::ONE);
    }

    #[test]
    fn the_hierarchy_agrees_with_every_face(direction in unit(), at in unit(), length in 1.0f32..8.0) {
        let medium = Medium { absorption: Spectrum::splat(0.5), ..glass(1.5) };
        let fast = world(cube(), medium);
        let slow = BruteForce::new(Arc::clone(fast.geometry()));
        let ray = Ray { length, ..Ray::new((at - direction * 3.0).as_vec3(), direction.as_vec3().normalize()) };
        let (a, b) = (fast.transmittance(&ray)[0], slow.transmittance(&ray)[0]);
        // Corners are rounded to f32 here and not there: 1e-7 m of way.
        prop_assert!((a - b).abs() < 1e-5, "{a} {b}");
    }
}
