//! Gloss, metal and glass in an even light, which none of them may change.

use glam::{DVec3, Vec3};
use keikan_reference::{Surface, World, radiance};
use light::Medium;

use crate::support::{block, even, level, parts};

/// Mean luminance and its standard error along a line.
fn seen(world: &World, from: DVec3, toward: DVec3, walks: u64) -> [f64; 2] {
    let of = |sample: u64| radiance(world, [from, toward.normalize()], 7, sample).luminance();
    let all: Vec<f64> = (0..walks).map(of).collect();
    let mean = all.iter().sum::<f64>() / walks as f64;
    let squares = all.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    [mean, (squares / (walks * (walks - 1)) as f64).sqrt()]
}

#[test]
fn white_surfaces_keep_all_light_whatever_their_gloss() {
    for (name, metallic, index) in [("dielectric", 0.0, 1.5), ("metal", 1.0, 1.5), ("half", 0.5, 1.3)] {
        for roughness in [0.0, 0.05, 0.3, 0.6, 1.0] {
            let surface = Surface { metallic, roughness, index, ..Surface::default() };
            let mut world = parts(&[level(0.0, 1e4, 0)], vec![surface]);
            world.sky = Some(even(1.0));
            let world = World::new(world);
            for slope in [0.2, 1.0, 5.0] {
                let [mean, error] = seen(&world, DVec3::Y, DVec3::new(1.0, -slope, 0.3), 20_000);
                println!("{name}, roughness {roughness}, slope {slope}: {mean:.4} ± {error:.4}");
                // The tables of E: midpoints of facets, linear between cosines.
                assert!(
                    (mean - 1.0).abs() < 4.0 * error + 0.01,
                    "{name} {roughness} {slope}: {mean} {error}"
                );
            }
        }
    }
}

#[test]
fn clear_glass_cannot_be_seen_in_even_light() {
    for (thin, from) in [(true, [-0.2, 3.0, 0.1]), (false, [-0.2, 3.0, 0.1]), (false, [2.0, 2.5, 0.4])] {
        let body = Medium { index: 1.5, thin, ..Medium::default() };
        let glass = Surface { body: Some(body), ..Surface::default() };
        let mut world = parts(&block([-1.0, 0.0, -1.0], [1.0, 1.0, 1.0], 0), vec![glass]);
        world.sky = Some(even(1.0));
        let world = World::new(world);
        let toward = DVec3::new(0.0, 0.5, 0.0) - DVec3::from(from);
        let [mean, error] = seen(&world, DVec3::from(from), toward, 4000);
        // Every walk ends in the sky with its whole share, but for those that chance ends and others that count for them.
        assert!((mean - 1.0).abs() < 4.0 * error + 1e-6, "{thin}: {mean} {error}");
    }
}

#[test]
fn glass_takes_by_beer_and_fresnel() {
    let body = Medium { index: 1.5, absorption: light::Spectrum::splat(2.0), ..Medium::default() };
    let surface = Surface { body: Some(body), ..Surface::default() };
    let black = Surface::grey(0.0);
    let shining = Surface { emission: Vec3::ONE, ..black.clone() };
    let mut faces = block([-9.0, 0.0, -9.0], [9.0, 0.5, 9.0], 0);
    faces.push(level(-1.0, 9.0, 1));
    let world = World::new(parts(&faces, vec![surface, shining]));
    let [mean, error] = seen(&world, DVec3::Y * 2.0, DVec3::NEG_Y, 40_000);
    // T² Σ (R e^−qd)²ᵏ e^−qd, head on: R = 0.04, e^−qd = e⁻¹.
    let (r, left) = (0.04f64, (-1.0f64).exp());
    let truth = (1.0 - r).powi(2) * left / (1.0 - (r * left).powi(2));
    assert!((mean - truth).abs() < 4.0 * error + 1e-5, "{mean} ± {error}, {truth}");
}

#[test]
fn a_ball_of_glass_cannot_be_seen_in_even_light_and_a_grey_one_lights_as_its_faces() {
    use glam::DAffine3;
    use keikan_reference::{Convex, Solid};
    let ball = |surface| Solid::Shape {
        shape: Convex::Sphere,
        world_from_solid: DAffine3::from_translation(DVec3::Y * 2.0),
        surface,
    };
    let body = Medium { index: 1.5, ..Medium::default() };
    let surfaces = vec![Surface { body: Some(body), ..Surface::default() }, Surface::grey(0.4)];
    for (surface, truth) in [(0, 1.0), (1, 0.4)] {
        let mut world = parts(&[], surfaces.clone());
        world.solids.push(ball(surface));
        world.sky = Some(even(1.0));
        let [mean, error] = seen(&World::new(world), DVec3::new(0.1, 5.0, 0.4), DVec3::NEG_Y, 8000);
        assert!((mean - truth).abs() < 4.0 * error + 1e-6, "{surface}: {mean} {error}");
    }
}
