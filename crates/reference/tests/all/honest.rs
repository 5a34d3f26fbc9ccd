//! Whether standard errors are what they say, and threads matter to nothing.

use glam::DVec3;
use keikan_reference::{Lamp, Surface, World, irradiance};

use crate::support::{UP, block, effort, even, level, parts, white};

/// A corner of a wall, a roof, a lamp and a sky: light by all ways that there are over a floor.
fn corner() -> World {
    let mut faces = block([1.0, 0.0, -3.0], [1.2, 3.0, 3.0], 1);
    faces.extend(block([-1.0, 2.4, -1.0], [1.0, 2.6, 1.0], 1));
    faces.push(level(0.0, 8.0, 0));
    let mut world = parts(&faces, vec![Surface::grey(0.3), Surface::grey(0.7)]);
    world.sky = Some(even(1000.0));
    world.lamps.extend([
        Lamp::Sun { toward: DVec3::new(-0.6, 0.8, 0.0), radius: 0.05, irradiance: white() * 5000.0 },
        Lamp::Sphere { centre: DVec3::new(0.0, 1.8, 0.5), radius: 0.2, radiance: white() * 20_000.0 },
    ]);
    World::new(world)
}

#[test]
fn errors_are_as_large_as_they_say() {
    let world = corner();
    let at = DVec3::new(0.2, 1e-6, 0.1);
    let truth = irradiance(&world, at, UP, &effort(200_000, 999)).luminance;
    let z: Vec<f64> = (0..100)
        .map(|seed| {
            let found = irradiance(&world, at, UP, &effort(1000, seed));
            (found.luminance - truth) / found.luminance_error
        })
        .collect();
    let mean = z.iter().sum::<f64>() / 100.0;
    let squares = z.iter().map(|z| z * z).sum::<f64>() / 100.0;
    let beyond = z.iter().filter(|z| z.abs() > 2.0).count();
    println!("z of 100 seeds: mean {mean:.3}, mean square {squares:.3}, {beyond} beyond 2");
    // The mean of 100 has a standard error of 0.1 (and the truth one of 1/√200 of a z), z² one of √2/10; 4.6 of 100 are beyond 2, give or
    // take 2.1: four of each.
    assert!(mean.abs() < 0.4 + 0.3 && (squares - 1.0).abs() < 4.0 * 0.1415 + 0.005 && beyond <= 13);
}

#[test]
fn threads_change_nothing() {
    let world = corner();
    let at = DVec3::new(-0.4, 1e-6, 0.6);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| irradiance(&world, at, UP, &effort(3000, 4)))
    };
    assert_eq!(with(1), with(3));
    assert_ne!(with(1).luminance, irradiance(&world, at, UP, &effort(3000, 5)).luminance);
}
