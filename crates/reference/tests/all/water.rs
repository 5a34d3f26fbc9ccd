//! Flat water: Fresnel, Snell, Beer, and light that is scattered often.

use std::f64::consts::PI;

use glam::{DMat3, DVec2, DVec3, Vec3};
use keikan_reference::{Bands, Lamp, Phase, Surface, Water, World, irradiance};
use light::{Distribution, fresnel};

use crate::support::{UP, agrees, block, effort, even, level, parts, white};

const N: f64 = 1.33;

fn square(half: f64) -> Vec<[DVec2; 3]> {
    let [a, b, c, d] = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|at| DVec2::from(at) * half);
    vec![[a, b, c], [a, c, d]]
}

/// Clear water below y = 0, `half` m to each side.
fn clear(half: f64) -> Water {
    Water { level: 0.0, triangles: square(half), index: N, absorption: Bands::ZERO, scatterers: Vec::new() }
}

#[test]
fn below_a_surface_arrives_what_passes_it() {
    // ∫ (1 − F) 2 cos d cos of an even sky, whatever the light bends to; midpoints.
    let steps = 100_000;
    let h = 1.0 / f64::from(steps);
    let passes: f64 =
        (0..steps).map(|i| (f64::from(i) + 0.5) * h).map(|cos| 2.0 * cos * (1.0 - fresnel(N, cos)) * h).sum();
    let mut world = parts(&[level(-2.0, 2e4, 0)], vec![Surface::grey(0.0)]);
    world.sky = Some(even(1.0));
    world.waters.push(clear(1e4));
    let world = World::new(world);
    let found = irradiance(&world, DVec3::Y * -1.0, UP, &effort(40_000, 1));
    agrees("sky below water", &found, PI * passes, 1e-4);
}

#[test]
fn a_white_basin_under_an_even_sky_is_n_squared_as_bright() {
    let mut faces = block([-2.0, -1.5, -2.0], [2.0, 0.0, 2.0], 0);
    faces.remove(1); // open at its top
    let mut world = parts(&faces, vec![Surface::grey(1.0)]);
    world.sky = Some(even(1.0));
    world.waters.push(clear(2.0));
    let found = irradiance(&World::new(world), DVec3::new(0.3, -0.8, 0.2), DVec3::X, &effort(20_000, 2));
    agrees("white basin", &found, PI * N * N, 1e-4);
}

#[test]
fn the_sun_passes_by_fresnel_and_fades_by_beer() {
    for height in [90f64, 40.0] {
        let h = height.to_radians();
        let mut world = parts(&[level(-2.0, 50.0, 0)], vec![Surface::grey(0.0)]);
        let toward = DVec3::new(h.cos(), h.sin(), 0.0);
        world.lamps.push(Lamp::Sun { toward, radius: 0.0, irradiance: white() * 1e5 });
        world.waters.push(Water { absorption: Bands::splat(0.3), ..clear(50.0) });
        let found = irradiance(&World::new(world), DVec3::Y * -1.999, UP, &effort(2, 1));
        let cos_below = (1.0 - (h.cos() / N).powi(2)).sqrt();
        let truth = 1e5 * h.sin() * (1.0 - fresnel(N, h.sin())) * (-0.3 * 1.999 / cos_below).exp();
        assert!((found.luminance / truth - 1.0).abs() < 1e-6, "{height}: {found:?} {truth}");
    }
}

#[test]
fn a_lamp_right_above_is_as_near_as_it_looks() {
    let mut world = parts(&[], Vec::new());
    world.lamps.push(Lamp::Point {
        position: DVec3::Y * 2.0,
        world_from_lamp: DMat3::IDENTITY,
        distribution: Distribution::isotropic(100.0),
        spectrum: white(),
    });
    world.waters.push(clear(50.0));
    let found = irradiance(&World::new(world), DVec3::Y * -1.0, UP, &effort(2, 1)).luminance;
    let truth = 100.0 * (1.0 - fresnel(N, 1.0)) / (2.0 + 1.0 / N).powi(2);
    assert!((found / truth - 1.0).abs() < 1e-6, "{found} {truth}");
}

/// A lamp's light by the ways that are looked for, against faces of the same shape and place that walks meet by chance.
#[test]
fn bent_and_mirrored_ways_are_those_that_walks_find() {
    let (at, normal) = (DVec3::new(0.4, -1.2, 0.3), DVec3::new(0.5, 0.8, 0.1).normalize());
    for (what, y, at, normal) in [
        ("from above", 1.5f32, at, normal),
        ("from below", -2.0, at.with_y(0.7), normal.with_y(-normal.y)),
        ("off the surface", 1.5, at.with_y(0.7), normal.with_y(-normal.y)),
        ("off its back", -2.0, at, normal),
    ] {
        let mut world = parts(&[], Vec::new());
        // Above it shines down, below up.
        let half_v = if y > 0.0 { DVec3::Z } else { DVec3::NEG_Z };
        let centre = DVec3::new(0.0, f64::from(y), 0.0);
        world.lamps.push(Lamp::Rectangle { centre, half_u: DVec3::X, half_v, radiance: white() * 100.0 });
        world.waters.push(clear(50.0));
        let looked = irradiance(&World::new(world), at, normal, &effort(40_000, 3));
        let shining = Surface { emission: Vec3::splat(100.0), ..Surface::grey(0.0) };
        let mut world = parts(&[level(y, 1.0, 0)], vec![shining]);
        world.waters.push(clear(50.0));
        // Little of what a surface mirrors is met by chance.
        let walks = if (y > 0.0) == (at.y > 0.0) { 1_000_000 } else { 100_000 };
        let met = irradiance(&World::new(world), at, normal, &effort(walks, 4));
        agrees(what, &met, looked.luminance, 4.0 * looked.luminance_error + 1e-5 * looked.luminance);
    }
}

fn milk(absorption: f64, scattering: [f64; 2]) -> Water {
    let even =
        |g: f64| Phase::new(move |cos| (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cos).powf(1.5)));
    // Bands that scatter differently, which walks share.
    let [least, most] = scattering;
    let rising = Bands(std::array::from_fn(|b| least + (most - least) * b as f64 / 7.0));
    Water {
        index: 1.0,
        absorption: Bands::splat(absorption),
        scatterers: vec![(rising, even(0.0)), (rising * 0.5, even(0.7))],
        ..clear(1.0)
    }
}

#[test]
fn water_that_only_scatters_cannot_be_seen_in_even_light() {
    let mut world = parts(&[level(-2.0, 1.0, 0)], vec![Surface::grey(1.0)]);
    world.sky = Some(even(1.0));
    world.waters.push(milk(0.0, [0.3, 3.0]));
    let found = irradiance(&World::new(world), DVec3::new(0.1, -1.0, 0.2), UP, &effort(20_000, 5));
    agrees("milk", &found, PI, 1e-4);
}

/// A layer that scatters alike to all sides and takes nothing, 1 m thick and without end.
fn fog(b: f64) -> World {
    let mut world = parts(&[], Vec::new());
    world.lamps.push(Lamp::Sun { toward: UP, radius: 0.0, irradiance: white() * 1000.0 });
    let scatterers = vec![(Bands::splat(b), Phase::new(|_| 0.25 / PI))];
    world.waters.push(Water { index: 1.0, scatterers, ..clear(1e5) });
    // Black below, where the layer ends.
    let mut black = parts(&[level(-1.0, 2e5, 0)], vec![Surface::grey(0.0)]);
    (black.lamps, black.waters) = (world.lamps, world.waters);
    World::new(black)
}

#[test]
fn thin_fog_scatters_once_what_the_closed_form_says() {
    // E_once = E₀ b ∫₀^d e^(−b (d − z)) ½ E₂(b z) dz, midpoints over z, and over μ in E₂(x) = ∫₀¹ e^(−x/μ) dμ.
    let (b, steps) = (0.02, 2000);
    let h = 1.0 / f64::from(steps);
    let middle = |i: i32| (f64::from(i) + 0.5) * h;
    let e2 = |x: f64| (0..steps).map(|j| (-x / middle(j)).exp() * h).sum::<f64>();
    let once: f64 = (0..200)
        .map(|i| (f64::from(i) + 0.5) / 200.0)
        .map(|z| b * (-b * (1.0 - z)).exp() * 0.5 * e2(b * z) / 200.0)
        .sum();
    let straight = f64::exp(-b);
    let found = irradiance(&fog(b), DVec3::Y * (1e-9 - 1.0), UP, &effort(100_000, 6));
    // What is scattered twice is of the order of b ln(1/b) times what is scattered once, a tenth.
    agrees("fog", &found, 1000.0 * (straight + once), 1000.0 * once * b * 5.0);
    assert!(found.luminance_error < 100.0 * once, "fine enough to see what is scattered at all");
}

#[test]
fn thick_fog_loses_nothing() {
    let world = fog(3.0);
    let below = irradiance(&world, DVec3::Y * (1e-9 - 1.0), UP, &effort(40_000, 7));
    let above = irradiance(&world, DVec3::Y * 1e-6, DVec3::NEG_Y, &effort(40_000, 8));
    let (sum, error) =
        (below.luminance + above.luminance, below.luminance_error.hypot(above.luminance_error));
    println!("thick fog: {} through, {} back, ± {error}", below.luminance, above.luminance);
    // Its ends are 10⁵ thicknesses away.
    assert!((sum - 1000.0).abs() < 4.0 * error + 0.1 && error < 20.0, "{sum} ± {error}");
}
