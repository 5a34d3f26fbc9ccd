mod table;

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use light::Spectrum;
use proptest::prelude::*;

use super::*;
use crate::{Surface, Water};

const WATER: Surface = Surface { level: 0.0, index: 1.34 };

#[test]
fn the_sun_arrives_as_tabulated() {
    // n = 1.34: zenith angle in air, under water, T cos θ, T cos θ/cos θ', e^(−sec θ'); six to seven digits.
    let mut worst = 0.0f64;
    for [air, water, horizontal, facing, left] in [
        [0.0, 0.0, 0.978888, 0.978888, 0.367879],
        [10.0, 7.4458, 0.964006, 0.972204, 0.364764],
        [20.0, 14.7877, 0.919679, 0.951184, 0.355491],
        [30.0, 21.9090, 0.846801, 0.912720, 0.340328],
        [40.0, 28.6653, 0.746644, 0.850938, 0.319920],
        [50.0, 34.8671, 0.620518, 0.756286, 0.295585],
        [60.0, 40.2623, 0.469498, 0.615255, 0.269697],
        [70.0, 44.5284, 0.295724, 0.414817, 0.245928],
        [80.0, 47.3014, 0.112837, 0.166391, 0.228866],
        [85.0, 48.0243, 0.036141, 0.054037, 0.224208],
    ] {
        let (sin, cos) = f64::to_radians(air).sin_cos();
        let toward = DVec3::new(0.6 * sin, cos, 0.8 * sin);
        let sun = SunBelow::new(&WATER, toward, Spectrum::ONE).unwrap();
        assert!((sun.toward.y.acos().to_degrees() - water).abs() < 6e-5, "{air}");
        assert!((sun.toward.x * 0.8 - sun.toward.z * 0.6).abs() < 1e-15, "in one plane");
        let at_one = f64::from(sun.facing(1.0, Spectrum::ONE)[0] / sun.facing(0.0, Spectrum::ONE)[0]);
        for (found, expected) in [
            (f64::from(sun.horizontal[0]), horizontal),
            (f64::from(sun.facing(0.0, Spectrum::ONE)[0]), facing),
            (f64::from(sun.on_plane(0.0, DVec3::Y, Spectrum::ONE)[0]), horizontal),
            (at_one, left),
        ] {
            worst = worst.max((found - expected).abs());
            // Half a unit of the sixth decimal, and f32.
            assert!((found - expected).abs() < 6.5e-7, "{air}: {found} {expected}");
        }
    }
    println!("sun under water: worst deviation {worst:.1e}");
    assert!(SunBelow::new(&WATER, DVec3::NEG_Y, Spectrum::ONE).is_none());
    assert!(SunBelow::new(&WATER, DVec3::X, Spectrum::ONE).is_none());
    let (image, light) = mirrored_sun(&WATER, DVec3::new(0.6, 0.8, 0.0), Spectrum::ONE).unwrap();
    assert!(image == DVec3::new(0.6, -0.8, 0.0) && (0.02..0.03).contains(&light[0]));
}

/// The CIE's clear sky of 1973 without its scale, sun in the south.
fn clear(direction: Vec3, altitude: f64) -> f64 {
    let (sin, cos) = altitude.to_radians().sin_cos();
    let at = direction.as_dvec3();
    let g = (at.y * sin + at.z * cos).clamp(-1.0, 1.0).acos();
    (0.91 + 10.0 * (-3.0 * g).exp() + 0.45 * g.cos().powi(2)) * (1.0 - (-0.32 / at.y.max(1e-6)).exp())
}

/// E of a sky on the horizontal in air, by rings and sectors of 0.5°, their projected solid angles exact.
fn in_air(sky: &dyn Fn(Vec3) -> f64) -> f64 {
    let h = (0.5f64).to_radians();
    let mut sum = 0.0;
    for i in 0..180 {
        let (sin, cos) = ((f64::from(i) + 0.5) * h).sin_cos();
        let ring = 0.5 * ((f64::from(i + 1) * h).sin().powi(2) - (f64::from(i) * h).sin().powi(2));
        for j in 0..720 {
            let (x, z) = ((f64::from(j) + 0.5) * h).sin_cos();
            sum += sky(DVec3::new(sin * x, cos, sin * z).as_vec3()) * ring * h;
        }
    }
    sum
}

#[test]
fn skies_arrive_as_tabulated() {
    type Sky = (&'static str, Box<dyn Fn(Vec3) -> f64>, f64, &'static [[f64; 3]]);
    let skies: [Sky; 4] = [
        ("uniform", Box::new(|_| 1.0), 1e-5, &table::UNIFORM),
        ("overcast", Box::new(|d| f64::from(1.0 + 2.0 * d.y)), 1e-5, &table::OVERCAST),
        // Kronrod's rings and 10° of azimuth do not resolve the cusp 10 e^(−3γ) around the sun.
        ("clear 30", Box::new(|d| clear(d, 30.0)), 5e-4, &table::CLEAR_30),
        ("clear 60", Box::new(|d| clear(d, 60.0)), 5e-4, &table::CLEAR_60),
    ];
    for (name, sky, tolerance, rows) in skies {
        let below = SkyBelow::new(&WATER, Spectrum::ONE, |d| Spectrum::splat(sky(d) as f32));
        let whole = in_air(&sky);
        let mut worst = 0.0f64;
        for &[depth, plane, scalar] in rows {
            let found = [below.irradiance_by_rays(depth, Vec3::Y), below.scalar_irradiance(depth)];
            for (found, expected) in found.into_iter().zip([plane, scalar]) {
                let error = (f64::from(found[0]) / whole - expected).abs();
                worst = worst.max(error / expected.max(0.01));
                // Half a unit of the last decimal besides.
                assert!(
                    error < tolerance * expected + 6e-7,
                    "{name} {depth}: {} {expected}",
                    f64::from(found[0]) / whole
                );
            }
        }
        println!("sky under water, {name}: worst relative deviation {worst:.1e}");
    }
}

#[test]
fn a_uniform_world_looks_uniform_from_below() {
    // Radiance n² L in all directions under water goes with L in all directions above: what comes through the surface and what
    // it mirrors from below make π n² L on a plane that faces up, at every depth if nothing is lost.
    let n = WATER.index;
    let below = SkyBelow::new(&WATER, Spectrum::ZERO, |_| Spectrum::ONE);
    let mirrored: f64 = (0..20_000)
        .map(|i| {
            let cos = (f64::from(i) + 0.5) / 20_000.0;
            light::fresnel(1.0 / n, cos) * n * n * 2.0 * PI * cos / 20_000.0
        })
        .sum();
    let whole = f64::from(below.irradiance(3.0, Vec3::Y)[0]) + mirrored;
    // Midpoints of 5e-5 across the square root at the critical angle: 1e-6; f32 sums of 540 rays: 1e-6.
    assert!((whole / (PI * n * n) - 1.0).abs() < 5e-6, "{whole}");
}

#[test]
fn the_table_is_as_good_as_its_rays() {
    let water = Water::named("jerlov-III").unwrap();
    let below = SkyBelow::new(&WATER, water.diffuse(), |d| Spectrum::splat(clear(d, 30.0) as f32));
    let mut worst = 0.0f32;
    for i in 0..400u32 {
        // Directions and depths that are none of the table's.
        let (u, v, w) =
            (f64::from(i) / 400.0, f64::from(i) * 0.618_034 % 1.0, f64::from(i) * 0.754_877 % 1.0);
        let (sin, cos) = (1.0 - 2.0 * u).acos().sin_cos();
        let normal = DVec3::new(sin * (2.0 * PI * v).cos(), cos, sin * (2.0 * PI * v).sin()).as_vec3();
        let depth = 20.0 * w * w;
        let (table, rays) = (below.irradiance(depth, normal), below.irradiance_by_rays(depth, normal));
        let level = below.irradiance_by_rays(depth, Vec3::Y);
        for b in 0..8 {
            worst = worst.max((table[b] - rays[b]).abs() / level[b]);
        }
    }
    println!("sky table: worst error {:.2} % of the horizontal's", 100.0 * worst);
    // Linear over 10° of tilt and 15° of azimuth: h²/8 of a cosine, 0.4 and 0.9 %; over 1.2 in depth less.
    assert!(worst < 0.01, "{worst}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_sun_never_gains(altitude in 0.0f64..90.0, depth in 0.0f64..1e6, k in 0.0f32..10.0) {
        let (sin, cos) = altitude.to_radians().sin_cos();
        if let Some(sun) = SunBelow::new(&WATER, DVec3::new(cos, sin, 0.0), Spectrum::ONE) {
            let e = sun.on_plane(depth, DVec3::Y, Spectrum::splat(k));
            prop_assert!(e.is_finite() && e[0] >= 0.0 && f64::from(e[0]) <= sin * (1.0 + 1e-6));
            // Snell, and within the cone.
            prop_assert!((sun.toward.x * 1.34 - cos).abs() < 1e-15 * 8.0);
        }
    }
}
