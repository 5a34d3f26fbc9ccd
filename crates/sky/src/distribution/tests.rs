use proptest::prelude::*;

use super::*;
use crate::open_sky::horizontal;

fn direction(altitude: f64, azimuth: f64) -> Vec3 {
    let (h, a) = (altitude.to_radians(), azimuth.to_radians());
    Vec3::new((h.cos() * a.sin()) as f32, h.sin() as f32, (-h.cos() * a.cos()) as f32)
}

#[test]
fn the_clear_sky_of_1973_has_the_values_of_its_formula() {
    // (sun's altitude, altitude, azimuth from the sun) → L/L_z, evaluated in f64 to five decimals.
    for (sun, altitude, azimuth, expected) in [
        (10.0, 90.0, 0.0, 1.00000),
        (10.0, 75.0, 45.0, 1.17359),
        (10.0, 75.0, 180.0, 0.94103),
        (10.0, 60.0, 135.0, 1.02507),
        (10.0, 30.0, 0.0, 7.73249),
        (10.0, 5.0, 0.0, 29.96432),
        (10.0, 1.0, 180.0, 4.56803),
        (20.0, 60.0, 90.0, 1.08389),
        (20.0, 45.0, 0.0, 4.34160),
    ] {
        let value =
            Distribution::CIE_CLEAR.relative_luminance(direction(altitude, azimuth), direction(sun, 0.0));
        // Half of the last decimal, and directions in f32 through 0.32/sin h and 3γ: 20 ulp.
        assert!(
            (value - expected).abs() <= 0.5e-5 + 20.0 * f32::EPSILON * expected,
            "{sun} {altitude} {azimuth}: {value}"
        );
    }
}

/// E_h/L_z by 400 × 200 points of Gauss, for suns 0°, 30°, 60° and 90° high.
const INTEGRALS: [[f64; 4]; 15] = [
    [2.44954, 2.44954, 2.44954, 2.44954],
    [2.69059, 2.55658, 2.08602, 1.38019],
    [2.76999, 2.76999, 2.76999, 2.76999],
    [3.07074, 2.89015, 2.31542, 1.51955],
    [std::f64::consts::PI; 4],
    [3.50955, 3.27783, 2.58416, 1.68315],
    [3.84790, 3.67305, 2.42123, 1.03664],
    [4.23836, 4.12308, 2.32838, 0.74320],
    [4.96541, 4.55275, 3.45932, 2.21460],
    [5.53449, 5.14491, 3.17026, 1.31619],
    [6.20162, 5.81763, 2.98906, 0.91545],
    [6.95599, 6.39411, 3.19057, 0.96736],
    [7.65361, 6.99522, 3.02585, 0.80910],
    [8.74650, 7.70810, 3.21696, 0.85074],
    [10.36008, 8.11602, 3.01586, 0.79961],
];

#[test]
fn all_fifteen_general_skies_have_their_integrals() {
    for (index, row) in INTEGRALS.iter().enumerate() {
        let distribution = Distribution::cie(index + 1).expect("types 1 to 15");
        for (altitude, expected) in [0.0, 30.0, 60.0, 90.0].into_iter().zip(row) {
            let sun = direction(altitude, 40.0);
            let sum = horizontal(|d| f64::from(distribution.relative_luminance(d, sun)));
            // The cusp at the sun (slope up to 24 · 2.8 of a whole of 24) within cells of 1.5°, the midpoint rule's
            // (3 · 0.026)²/12 of what is near it; half of the last decimal.
            assert!((sum / expected - 1.0).abs() <= 6e-4, "type {} {altitude}: {sum} {expected}", index + 1);
        }
    }
}

#[test]
fn moon_and_spencer_s_sky_gives_seven_ninths_of_pi() {
    let sum = horizontal(|d| f64::from(Distribution::MoonSpencer.relative_luminance(d, Vec3::Y)));
    // Bands with exact solid angles: h²/6.
    assert!((sum / (7.0 * std::f64::consts::PI / 9.0) - 1.0).abs() <= 1.5f64.to_radians().powi(2) / 6.0);
}

#[test]
fn type_12_is_the_clear_sky_of_1973_and_type_13_its_polluted_form() {
    for (number, gradation) in [(12, Gradation::CIE_CLEAR), (13, Gradation::CIE_POLLUTED)] {
        let (general, own) = (Distribution::cie(number).expect("known"), Distribution::Parametric(gradation));
        for altitude in [0.0, 20.0, 90.0] {
            for azimuth in [0.0, 90.0, 180.0] {
                let (d, sun) = (direction(altitude, azimuth), direction(30.0, 0.0));
                let ratio = general.relative_luminance(d, sun) / own.relative_luminance(d, sun);
                // 1 − 10 e^(−3π/2) = 0.9102 for 0.91, of an indicatrix of 0.9 at least, twice.
                assert!((ratio - 1.0).abs() < 1e-3, "{number}: {ratio}");
            }
        }
    }
}

#[test]
fn every_sky_is_one_at_the_zenith_positive_above_the_horizon_and_zero_below() {
    let skies = (1..=15).filter_map(Distribution::cie);
    for sky in skies.chain([Distribution::MoonSpencer, Distribution::UNIFORM, Distribution::CIE_CLEAR]) {
        for sun in (-90..=90).step_by(5) {
            let sun = direction(sun.into(), 123.0);
            assert_eq!(sky.relative_luminance(Vec3::Y, sun), 1.0);
            for altitude in -90..=90 {
                let value = sky.relative_luminance(direction(altitude.into(), 77.0), sun);
                assert!(
                    value.is_finite() && if altitude >= 0 { value > 0.0 } else { value == 0.0 },
                    "{altitude}"
                );
            }
        }
    }
}

proptest! {
    #[test]
    fn perez_is_positive_and_continuous_over_the_sky(
        direct in 0.0f64..1000.0, diffuse in 0.0f64..600.0, sun in -10.0f64..90.0,
        altitude in 0.05f64..89.9, azimuth in 0.0f64..360.0,
    ) {
        let sky = Distribution::perez(&Perez::new(direct, diffuse, sun, Some(100)));
        let toward = direction(sun, 0.0);
        let at = |h: f64, a: f64| f64::from(sky.relative_luminance(direction(h, a), toward));
        let here = at(altitude, azimuth);
        prop_assert!(here.is_finite() && here >= 0.0);
        // A hundredth of a degree apart: the steepest indicatrix is d = −8 per rad with c e^(dγ) up to c ≤ 40, the
        // steepest gradation b/h² with h ≥ 0.05°; relative to the sky's largest luminance nearby.
        let near = at(altitude + 0.01, azimuth + 0.01);
        prop_assert!((near - here).abs() <= 0.25 * here.max(near) + 1e-4, "{here} {near}");
    }
}
