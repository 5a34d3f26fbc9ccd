//! The parts of a source's light.

use light::{AreaLight, AreaShape, Vacuum};
use proptest::prelude::*;

use super::*;

const PARTS: [Part; 3] = [Part::Direct, Part::Reflected, Part::Through];

/// All of a source and its three parts.
fn split(source: impl Fn() -> (Box<dyn Illuminate>, Source), waters: &Arc<[FlatWater]>) -> (Lit, Vec<Lit>) {
    let lit = || {
        let (inner, kind) = source();
        Lit::new(inner, kind, Arc::clone(waters), Rules { window: 16, shafts: 4, ..Rules::default() })
    };
    (lit(), PARTS.map(|part| lit().only(part)).into())
}

/// f32 sums of up to three times as many beams.
fn same(whole: Spectrum, parts: Spectrum) -> bool {
    (0..8).all(|b| (whole[b] - parts[b]).abs() <= 1e-5 * whole[b])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn parts_add_up_to_all(
        kind in 0u32..5, lamp in prop::array::uniform3(-3.0f64..3.0), at in prop::array::uniform3(-3.0f32..3.0),
        normal in prop::array::uniform3(-1.0f32..1.0), board in -1.5f32..1.5,
    ) {
        let waters = sea(grey(0.3, 0.6, Phase::petzold()));
        let lamp = DVec3::from(lamp);
        let normal = Vec3::from(normal).try_normalize().unwrap_or(Vec3::Y);
        let source = || -> (Box<dyn Illuminate>, Source) {
            let shape = match kind {
                3 => AreaShape::Rectangle { half_u: Vec3::X * 0.2, half_v: Vec3::Z * 0.1 },
                _ => AreaShape::Sphere { radius: 0.1 },
            };
            let area = AreaLight { shape, centre: lamp.as_vec3(), radiance: Spectrum::ONE, samples: 4 };
            match kind {
                0 => (Box::new(Sun(Vec3::new(0.6, 0.8, 0.0))), Source::Toward(DVec3::new(0.6, 0.8, 0.0))),
                1 => (Box::new(Sky(|d| 1.0 + d.y)), Source::Around),
                2 => (Box::new(luminaire(lamp)), Source::At(lamp)),
                _ => (Box::new(area), Source::Area(area)),
            }
        };
        let (all, parts) = split(source, &waters);
        let occlude = Board { y: board, low: [-0.5; 2], high: [0.4; 2] };
        let place = Place { position: Vec3::from(at), error: 1e-6, normal, seed: 7 };
        let sum = parts.iter().map(|part| part.irradiance(&place, &occlude)).sum();
        let whole = all.irradiance(&place, &occlude);
        prop_assert!(same(whole, sum), "{:?} {:?}", whole, sum);
        let ray = Ray { origin: Vec3::from(at), direction: normal, length: 2.0 };
        let sum = parts.iter().map(|part| part.scattered(&ray, &occlude)).sum();
        let whole = all.scattered(&ray, &occlude);
        prop_assert!(same(whole, sum), "{:?} {:?}", whole, sum);
        let sum = parts.iter().map(|part| part.radiance(&ray)).sum();
        prop_assert_eq!(all.radiance(&ray), sum);
    }
}

#[test]
fn parts_are_what_they_are_called() {
    let waters = sea(grey(0.3, 0.6, Phase::petzold()));
    let place = |y: f32, normal| Place { position: Vec3::new(0.0, y, 0.0), error: 0.0, normal, seed: 0 };
    let (air, deep) = (place(1.0, Vec3::NEG_Y), place(-1.0, Vec3::Y));
    let lamp = |y: f64| {
        move || -> (Box<dyn Illuminate>, Source) {
            let at = DVec3::new(1.0, y, 0.0);
            (Box::new(luminaire(at)), Source::At(at))
        }
    };
    // In air a plane that faces down has only the mirrored light of a lamp at its own height, and what comes through of one below.
    for (y, place, expected) in [
        (1.5, air, [false, true, false]),
        (-1.0, air, [false, false, true]),
        (1.5, deep, [false, false, true]),
        (-0.5, deep, [true, true, false]),
    ] {
        let (_, parts) = split(lamp(y), &waters);
        let found = parts.iter().map(|part| !part.irradiance(&place, &Vacuum).is_zero());
        assert!(found.eq(expected), "lamp at {y}, place at {}", place.position.y);
    }
}

#[test]
fn a_small_lamp_with_an_extent_is_a_point() {
    // A ball of 1 cm that shines as 1 W/sr, and a square of 1 cm: L A = 1. Both differ from a point by (size/distance)², 1e-4.
    let waters = sea(grey(0.3, 0.6, Phase::petzold()));
    let rules = Rules::default();
    for y in [2.0f64, -0.7] {
        let at = DVec3::new(0.5, y, 0.2);
        let point = Lit::new(Box::new(luminaire(at)), Source::At(at), Arc::clone(&waters), rules);
        let radius = 0.01f32;
        let radiance = Spectrum::splat(1.0 / (std::f32::consts::PI * radius * radius));
        let ball =
            AreaLight { shape: AreaShape::Sphere { radius }, centre: at.as_vec3(), radiance, samples: 16 };
        let area = Lit::new(Box::new(ball), Source::Area(ball), Arc::clone(&waters), rules);
        for position in [Vec3::new(0.0, -1.5, 0.0), Vec3::new(-0.4, 0.8, 0.0)] {
            let place = Place {
                position,
                error: 0.0,
                normal: Vec3::new(0.6, position.y.signum() * -0.8, 0.0),
                seed: 3,
            };
            let [a, b] = [&point, &area].map(|lit| lit.irradiance(&place, &Vacuum)[2]);
            assert!((a / b - 1.0).abs() < 1e-3, "{position} {y}: {a} {b}");
        }
        let ray = Ray { origin: Vec3::new(0.0, -0.01, 0.0), direction: Vec3::NEG_Y, length: 3.0 };
        let [a, b] = [&point, &area].map(|lit| lit.scattered(&ray, &Vacuum)[2]);
        assert!((a / b - 1.0).abs() < 1e-3, "{y}: {a} {b}");
    }
}
