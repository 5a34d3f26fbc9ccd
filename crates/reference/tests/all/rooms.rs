//! Furnaces.

use glam::{DVec3, Vec3};
use keikan_reference::{Effort, Surface, World, irradiance, picture};
use light::View;

use crate::support::{agrees, block, effort, parts};

#[test]
fn a_closed_room_holds_what_it_emits_over_what_it_absorbs() {
    for (grey, e) in [(0.0f32, 3.0f32), (0.5, 1.0), (0.8, 2.0)] {
        let walls = Surface { emission: Vec3::splat(e), ..Surface::grey(grey) };
        let world = World::new(parts(&block([-3.0, 0.0, -2.0], [3.0, 3.0, 2.0], 0), vec![walls]));
        let found = irradiance(&world, DVec3::new(0.7, 1e-6, 0.3), DVec3::Y, &effort(4000, 1));
        let truth = std::f64::consts::PI * f64::from(e) / (1.0 - f64::from(grey));
        // Colours in f32 bands: a millionth.
        agrees(&format!("furnace, ρ = {grey}"), &found, truth, 1e-5 * truth);
    }
}

#[test]
fn leaves_keep_light_too() {
    // A leaf of 0.3 there and 0.5 through in a furnace: 0.8 of it leaves towards the eye, on average over where it came from.
    let leaf = Surface {
        base_colour: Vec3::splat(0.6),
        diffuse_transmission: 0.5,
        diffuse_transmission_colour: Vec3::ONE,
        ..Surface::default()
    };
    let mut world = parts(&[crate::support::level(1.0, 50.0, 0)], vec![leaf]);
    world.sky = Some(crate::support::even(1.0));
    let world = World::new(world);
    let found = irradiance(&world, DVec3::ZERO, DVec3::Y, &effort(20_000, 2));
    // Beyond the leaf's rim, sin² = 1/2501 of the hemisphere is the sky itself.
    let truth = std::f64::consts::PI * (0.8 + 0.2 / 2501.0 * 1.5);
    agrees("leaf", &found, truth, 1e-3 * truth);
}

#[test]
fn a_picture_shows_floor_and_sky_and_how_sure_it_is() {
    let mut world = parts(&[crate::support::level(0.0, 1e5, 0)], vec![Surface::grey(0.5)]);
    world.sky = Some(crate::support::even(2.0));
    let world = World::new(world);
    let view = View::look_at(DVec3::Y * 2.0, DVec3::new(0.0, 2.0, -9.0), 40.0, 6, 4);
    let found = picture(&world, &view, &Effort { samples: 400, faces: None, seed: 3 });
    for (i, (pixel, error)) in found.film.layers[0].pixels.iter().zip(&found.errors).enumerate() {
        // The horizon is in the middle: sky above, and a floor of half its luminance.
        let truth = if i < 12 { 2.0 } else { 1.0 };
        let luminance = f64::from(pixel.luminance());
        // Of 24 pixels one in 700 is beyond four standard errors; f32.
        assert!((luminance - truth).abs() < 4.0 * error + 1e-5, "{i}: {luminance} ± {error}");
        assert!(*error < 0.1, "{error}");
    }
}
