//! Finite, not negative, continuous: whatever is asked.

use light::{AreaLight, AreaShape, Traverse, Vacuum};
use proptest::prelude::*;

use super::*;

/// 0, and 10⁻⁶ to 10⁶ evenly in the logarithm.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 6 => (-6.0f64..6.0).prop_map(|power| 10f64.powf(power))]
}

/// Extinction from 0 to 100 1/m.
fn extinction() -> impl Strategy<Value = f32> {
    prop_oneof![1 => Just(0.0f32), 4 => (-4.0f32..2.0).prop_map(|power| 10f32.powf(power))]
}

/// Angles above the horizon \[rad\], down to grazing.
fn altitude() -> impl Strategy<Value = f64> {
    prop_oneof![2 => (-6.0f64..0.19).prop_map(|power| 10f64.powf(power)), 1 => Just(std::f64::consts::FRAC_PI_2)]
}

fn sound(light: Spectrum) -> bool {
    light.is_finite() && light.0.iter().all(|&band| band >= 0.0)
}

/// Sources of every kind, at height `y` where they are anywhere.
fn sources(y: f64, altitude: f64, waters: &Arc<[FlatWater]>) -> Vec<Lit> {
    let at = DVec3::new(0.0, y, 0.0);
    let (sin, cos) = altitude.sin_cos();
    let toward = DVec3::new(cos, sin, 0.0);
    let shape = AreaShape::Rectangle { half_u: Vec3::X * 0.1, half_v: Vec3::Z * 0.1 };
    let panel = AreaLight { shape, centre: at.as_vec3(), radiance: Spectrum::ONE, samples: 2 };
    let ball = AreaLight { shape: AreaShape::Sphere { radius: 0.05 }, ..panel };
    let rules = Rules { window: 4, shafts: 2, ..Rules::default() };
    let lit = |inner: Box<dyn Illuminate>, source| Lit::new(inner, source, Arc::clone(waters), rules);
    vec![
        lit(Box::new(Sun(toward.as_vec3())), Source::Toward(toward)),
        lit(Box::new(luminaire(at)), Source::At(at)),
        lit(Box::new(panel), Source::Area(panel)),
        lit(Box::new(ball), Source::Area(ball)),
    ]
}

/// The sky, whose tables take their time.
fn sky(waters: &Arc<[FlatWater]>) -> Lit {
    let rules = Rules { window: 4, shafts: 2, ..Rules::default() };
    Lit::new(Box::new(Sky(|d| 1.0 + d.y)), Source::Around, Arc::clone(waters), rules)
}

/// Water nearly as far as the coordinates.
fn ocean(water: Water) -> Arc<[FlatWater]> {
    let mesh = Mesh {
        positions: vec![Vec3::new(-4e6, 0.0, -4e6), Vec3::new(-4e6, 0.0, 8e6), Vec3::new(8e6, 0.0, -4e6)],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    Arc::new([FlatWater::new(water, &mesh, &DAffine3::IDENTITY)])
}

/// Whatever is asked of a source `r` metres beside it, `d` below and above the surface, facing and looking along directions that graze
/// by `tilt`, `reach` metres far and without end.
fn sound_around(
    lit: &Lit,
    waters: &Arc<[FlatWater]>,
    [r, d, tilt, reach]: [f64; 4],
) -> Result<(), TestCaseError> {
    let around = Around(lit, &Vacuum);
    let (sin, cos) = tilt.sin_cos();
    let directions = [DVec3::new(-cos, -sin, 0.0), DVec3::new(-cos, sin, 0.0), DVec3::Y, DVec3::NEG_Y];
    for direction in directions.map(|d| d.normalize().as_vec3()) {
        for y in [-d, d] {
            let position = Vec3::new(r as f32, y as f32, 0.0);
            let place = Place { position, error: 0.0, normal: direction, seed: 1 };
            prop_assert!(sound(lit.irradiance(&place, &Vacuum)), "{:?}", place);
        }
        for length in [reach as f32, f32::INFINITY] {
            let ray = Ray { origin: Vec3::new(r as f32, -d as f32, 0.0), direction, length };
            let way = Fill::new(Arc::clone(waters)).way(&ray, Path::EYE, &around);
            prop_assert!(sound(way.added) && sound(way.transmittance), "{:?} {:?}", ray, way);
            prop_assert!(way.transmittance.max() <= 1.0);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn the_sky_is_finite_and_not_negative(
        r in length(), ds in prop::array::uniform12(length()), c in extinction(), tilt in altitude(), albedo in 0.0f32..0.99,
    ) {
        let waters = ocean(grey(c, albedo, Phase::petzold()));
        let lit = sky(&waters);
        for pair in ds.chunks(2) {
            sound_around(&lit, &waters, [r, pair[0], tilt, pair[1]])?;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn light_is_finite_and_not_negative_wherever_things_are(
        r in length(), h in length(), d in length(), c in extinction(), altitude in altitude(), tilt in altitude(),
        lamp_below in any::<bool>(), albedo in 0.0f32..0.99, reach in length(),
    ) {
        let waters = ocean(grey(c, albedo, Phase::petzold()));
        let lamp = if lamp_below { -h } else { h };
        for lit in sources(lamp, altitude, &waters) {
            sound_around(&lit, &waters, [r, d, tilt, reach])?;
        }
    }

    #[test]
    fn light_changes_little_where_places_move_little(
        r in 0.01f64..10.0, h in 0.1f64..10.0, d in 0.1f64..10.0, c in 0.01f32..3.0, altitude in 0.05f64..1.5, lamp_below in any::<bool>(),
    ) {
        // Close to a lamp, and in the plane of one that is flat, a ten-thousandth of the depth is much of the way to it.
        prop_assume!(!lamp_below || (d - h).abs() > 0.1 * d);
        let waters = sea(grey(c, 0.6, Phase::water()));
        let lamp = if lamp_below { -h } else { h };
        for lit in sources(lamp, altitude, &waters) {
            let irradiance = |move_by: f32| {
                let position = Vec3::new(r as f32 * (1.0 + move_by), -d as f32 * (1.0 + move_by), 0.0);
                lit.irradiance(&Place { position, error: 0.0, normal: Vec3::new(0.0, 0.8, 0.6), seed: 1 }, &Vacuum)[2]
            };
            let scattered = |move_by: f32| {
                let origin = Vec3::new(r as f32 * (1.0 + move_by), -0.01, 0.3);
                let ray = Ray { origin, direction: Vec3::new(0.0, -0.8, 0.6), length: d as f32 };
                lit.scattered(&ray, &Vacuum)[2]
            };
            for (name, f) in [("irradiance", &irradiance as &dyn Fn(f32) -> f32), ("scattered", &scattered)] {
                let (here, near) = (f(0.0), f(1e-4));
                // 1e-4 of everything: powers of distance up to the sixth (behind a grazing leg), e^(−K r) of K r up to some ten, and
                // a lamp's quadrature, whose hundredth may be met by other points.
                prop_assert!((here - near).abs() <= (0.01 + 1e-4 * (10.0 + 20.0 * c * 10.0)) * here.max(near) + 1e-20,
                    "{}: {} {}", name, here, near);
            }
        }
    }
}

#[test]
fn sources_and_places_at_the_very_surface() {
    let waters = sea(grey(0.5, 0.5, Phase::petzold()));
    for y in [0.0, f64::MIN_POSITIVE, -1e-12, 1e-12] {
        for lit in sources(y, 1e-6, &waters).into_iter().chain([sky(&waters)]) {
            for at in [0.0f32, -1e-7, 1e-7, -1.0, 1.0] {
                for normal in [Vec3::Y, Vec3::NEG_Y, Vec3::X] {
                    let place = Place { position: Vec3::new(0.0, at, 0.0), error: 1e-7, normal, seed: 0 };
                    assert!(sound(lit.irradiance(&place, &Vacuum)), "{y} {at} {normal}");
                    let ray = Ray { origin: place.position, direction: normal, length: 0.0 };
                    assert!(sound(lit.scattered(&ray, &Vacuum)), "{y} {at} {normal}");
                }
            }
        }
    }
}
