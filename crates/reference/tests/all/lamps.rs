//! Lamps in the open.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Vec3};
use keikan_reference::{Lamp, Surface, World, irradiance};
use light::Distribution;

use crate::support::{UP, agrees, effort, level, parts, white};

#[test]
fn a_point_lights_by_cos_over_distance_squared() {
    let position = DVec3::new(1.0, 2.0, -2.0);
    let lamp = Lamp::Point {
        position,
        world_from_lamp: DMat3::IDENTITY,
        distribution: Distribution::isotropic(100.0),
        spectrum: white(),
    };
    let mut world = parts(&[], Vec::new());
    world.lamps.push(lamp);
    let found = irradiance(&World::new(world), DVec3::ZERO, UP, &effort(2, 1));
    // I cos/r² = 100 · 2/27, no sampling at all; luminances in f32 weights.
    assert!((found.luminance / (200.0 / 27.0) - 1.0).abs() < 1e-6, "{found:?}");
    assert!(found.luminance_error < 1e-9);
}

#[test]
fn the_sun_lights_by_its_height() {
    let h = 30f64.to_radians();
    let toward = DVec3::new(0.0, h.sin(), -h.cos());
    for radius in [0.0, 0.00465] {
        let mut world = parts(&[level(0.0, 10.0, 0)], vec![Surface::grey(0.5)]);
        world.lamps.push(Lamp::Sun { toward, radius, irradiance: white() * 80_000.0 });
        let found = irradiance(&World::new(world), DVec3::Y * 1e-6, UP, &effort(2000, 3));
        agrees("sun", &found, 40_000.0, 1.0);
    }
}

/// Howell's configuration factor from a plane element to a parallel unit square over it, one corner right above, one side away.
const CORNER: f64 = 0.138_531_6;

#[test]
fn a_square_lights_by_its_form_factor() {
    let radiance = white() * 100.0;
    let (u, v) = (DVec3::X, DVec3::Z);
    // 2 m by 2 m, 1 m over the place: shines down, u × v = X × Z = −Y.
    let lamp = || Lamp::Rectangle { centre: DVec3::Y, half_u: u, half_v: v, radiance };
    let truth = PI * 100.0 * 4.0 * CORNER;
    let mut open = parts(&[], Vec::new());
    open.lamps.push(lamp());
    let found = irradiance(&World::new(open), DVec3::ZERO, UP, &effort(4000, 1));
    agrees("square lamp", &found, truth, 1e-6 * truth);
    // The same as a face that is met by chance.
    let shining = Surface { emission: Vec3::splat(100.0), ..Surface::grey(0.0) };
    let met = World::new(parts(&[level(1.0, 1.0, 0)], vec![shining]));
    let met = irradiance(&met, DVec3::ZERO, UP, &effort(20_000, 1));
    agrees("square face", &met, truth, 1e-5 * truth);
    // Half of it behind a screen that ends above the place.
    let mut hidden = parts(
        &[([[0.0, 0.5, -9.0], [0.0, 0.5, 9.0], [9.0, 0.5, 9.0], [9.0, 0.5, -9.0]], 0)],
        vec![Surface::grey(0.0)],
    );
    hidden.lamps.push(lamp());
    let found = irradiance(&World::new(hidden), DVec3::ZERO, UP, &effort(4000, 1));
    agrees("half a square", &found, 0.5 * truth, 1e-6 * truth);
}

#[test]
fn a_sphere_lights_as_its_disc() {
    let mut world = parts(&[], Vec::new());
    let (centre, radiance) = (DVec3::new(0.0, 3.0, 0.0), white() * 50.0);
    world.lamps.push(Lamp::Sphere { centre, radius: 1.0, radiance });
    let found = irradiance(&World::new(world), DVec3::ZERO, UP, &effort(4000, 1));
    agrees("sphere", &found, PI * 50.0 / 9.0, 1e-4);
}

#[test]
fn a_mirrored_lamp_is_met_behind_the_mirror() {
    // A perfect metal beside the place doubles a lamp by its image.
    let mirror = Surface { metallic: 1.0, roughness: 0.0, ..Surface::default() };
    let wall = ([[2.0, -50.0, -50.0], [2.0, -50.0, 50.0], [2.0, 50.0, 50.0], [2.0, 50.0, -50.0]], 0);
    let mut world = parts(&[wall], vec![mirror]);
    let lamp = |x: f64| Lamp::Rectangle {
        centre: DVec3::new(x, 3.0, 0.0),
        half_u: DVec3::X,
        half_v: DVec3::Z,
        radiance: white() * 100.0,
    };
    world.lamps.push(lamp(0.0));
    let found = irradiance(&World::new(world), DVec3::ZERO, UP, &effort(40_000, 5));
    let mut image = parts(&[], Vec::new());
    image.lamps.extend([lamp(0.0), lamp(4.0)]);
    let truth = irradiance(&World::new(image), DVec3::ZERO, UP, &effort(40_000, 6));
    agrees("mirrored", &found, truth.luminance, 4.0 * truth.luminance_error);
}
