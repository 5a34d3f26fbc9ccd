use super::*;

/// A sky of 1 cd/m² at the zenith with the sun in the east (+X).
pub(crate) fn standard(name: &str, sun_altitude: f32) -> Luminous {
    let (sin, cos) = sun_altitude.to_radians().sin_cos();
    let distribution = match name {
        "uniform" => Distribution::UNIFORM,
        "overcast" => Distribution::MoonSpencer,
        _ => Distribution::CIE_CLEAR,
    };
    Luminous::new(distribution, Vec3::new(cos, sin, 0.0))
}

/// Blue opposite the sun and red around it, brighter than anything: only its colour may count.
struct Painted;

impl Sky for Painted {
    fn radiance(&self, direction: Vec3) -> Spectrum {
        let red = 0.5 + 0.5 * direction.x;
        Spectrum(std::array::from_fn(|band| 1e4 * if band < 4 { 1.0 - red } else { red }))
    }

    fn brightest(&self) -> Vec3 {
        Vec3::X
    }
}

#[test]
fn luminance_is_the_distribution_s_whatever_the_colour() {
    let plain = standard("clear", 30.0);
    for share in [0.0, 0.3, 1.0] {
        let sky = plain.clone().coloured(Arc::new(Painted), share);
        for direction in [Vec3::Y, Vec3::X, Vec3::new(-0.6, 0.8, 0.0), Vec3::new(0.36, 0.48, 0.8)] {
            let (light, expected) = (sky.radiance(direction), plain.luminance(direction));
            // Eight products and sums of f32, three times.
            assert!((light.luminance() / expected - 1.0).abs() < 24.0 * f32::EPSILON, "{share} {direction}");
            assert!((plain.radiance(direction).luminance() / expected - 1.0).abs() < 24.0 * f32::EPSILON);
        }
        let blue = |direction| sky.radiance(direction)[0] / sky.radiance(direction)[7];
        let ratio = blue(Vec3::new(-0.6, 0.8, 0.0)) / blue(Vec3::new(0.6, 0.8, 0.0));
        assert_eq!(ratio > 1.01, share > 0.0, "{ratio}");
    }
}

#[test]
fn a_night_without_a_colour_has_that_of_clouds() {
    let dark = light::Uniform { radiance: Spectrum::ZERO };
    let sky = standard("clear", 30.0).coloured(Arc::new(dark), 1.0);
    assert_eq!(sky.radiance(Vec3::Y), standard("clear", 30.0).radiance(Vec3::Y));
}

#[test]
fn the_clear_standard_sky_is_bluest_away_from_the_sun() {
    use crate::{Conditions, Model};
    let sun = Vec3::new(0.8, 0.6, 0.0);
    let sky = Model::Clear.sky(&Conditions::new(sun));
    let blue = |direction: Vec3| sky.radiance(direction)[0] / sky.radiance(direction)[7];
    let away = blue(Vec3::new(-0.6, 0.8, 0.0));
    assert!(away > blue(sun) && away > blue(Vec3::new(0.0, 0.05, 1.0).normalize()) && away > 1.5);
}
