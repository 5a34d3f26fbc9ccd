use super::*;
use crate::horizontal_illuminance;

fn at_altitude(degrees: f32) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vec3::new(0.6 * cos, sin, 0.8 * cos)
}

#[test]
fn names_are_their_own() {
    for model in Model::all() {
        assert_eq!(Model::named(model.name()), Some(model));
    }
    assert_eq!(Model::all().count(), 22);
}

#[test]
fn every_sky_shines_by_day_as_bright_as_asked_and_its_horizon_goes_on_below() {
    for model in [
        Model::Clear,
        Model::Overcast,
        Model::Uniform,
        Model::Physical,
        Model::Thesis,
        Model::Repaired,
        Model::Perez,
        Model::Cie(9),
    ] {
        let conditions =
            Conditions { scale: Scale::Horizontal(12_345.0), ..Conditions::new(at_altitude(35.0)) };
        let sky = model.sky(&conditions);
        let lux = horizontal_illuminance(&*sky);
        // A factor in f32, and f32 radiances.
        assert!((lux / 12_345.0 - 1.0).abs() < 1e-5, "{}: {lux}", model.name());
        assert_eq!(sky.radiance(Vec3::new(0.6, -0.8, 0.0)), sky.radiance(Vec3::X), "{}", model.name());
        assert!(sky.radiance(Vec3::NEG_Y).luminance() > 0.0);
        let round = matches!(model, Model::Overcast | Model::Uniform);
        assert_eq!(sky.brightest(), if round { Vec3::Y } else { conditions.toward_sun });
    }
}

#[test]
fn scales_are_met() {
    let sky = |scale| Model::Thesis.sky(&Conditions { scale, ..Conditions::new(at_altitude(30.0)) });
    // A factor in f32.
    assert!((sky(Scale::Zenith(2500.0)).radiance(Vec3::Y).luminance() / 2500.0 - 1.0).abs() < 1e-5);
    let nagata = horizontal_illuminance(&*sky(Scale::Nagata(0.7)));
    assert!((nagata / bouguer::sky_illuminance(0.7, 30.0) - 1.0).abs() < 1e-5);
    // A night stays dark, whatever is asked.
    let night =
        Model::Thesis.sky(&Conditions { scale: Scale::Horizontal(5.0), ..Conditions::new(Vec3::NEG_Y) });
    assert!(night.radiance(Vec3::Y).is_finite());
    assert!(sky(Scale::Horizontal(-1.0)).radiance(Vec3::Y).is_zero());
}

#[test]
fn own_brightness_is_that_of_the_ies_or_of_the_air() {
    let sun = at_altitude(30.0);
    for (model, lux, bound) in [
        (Model::Clear, 11_760.16, 1e-5),
        (Model::Overcast, 10_800.0, 1e-5),
        (Model::Cie(8), 0.5 * (11_760.16 + 10_800.0), 1e-5),
        (Model::Physical, 11_760.0, 0.15), // what its air was chosen by
        (Model::Thesis, 6913.0, 0.01),     // an independent computation in steps of 20 nm
    ] {
        let ours = horizontal_illuminance(&*model.sky(&Conditions::new(sun)));
        assert!((ours / lux - 1.0).abs() < bound, "{}: {ours}", model.name());
    }
    let weather = Perez::new(500.0, 150.0, 30.0, None);
    let sky = Model::Perez.sky(&Conditions { weather: Some(weather), ..Conditions::new(sun) });
    assert!((horizontal_illuminance(&*sky) / weather.illuminances(PRECIPITABLE_WATER)[0] - 1.0).abs() < 1e-5);
}
