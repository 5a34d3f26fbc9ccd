//! Colours to spectra and back.

use glam::Vec3;
use keikan_light::Spectrum;
use keikan_light::colour::{
    D65, TEMPERATURES, chromaticity, decode_srgb, encode_srgb, srgb_from_xyz, xyz_from_srgb,
};
use keikan_light::data::{SAMPLES, wavelength};
use proptest::prelude::*;

use crate::reference::xyz;

/// Rounding of basis, weights and matrices: the basis is quantised to 2⁻²⁰ (two of its parts by half of that, the
/// third by their sum: 2⁻²⁰), weights and D65 to f32 (2⁻²⁴), each of about 30 operations likewise; the inverse matrix amplifies by at
/// most the largest row sum of magnitudes, 3.24 + 1.54 + 0.50 = 5.3, the XYZ being at most 1.1.
const ROUND_TRIP: f32 = 5.3 * 1.1 * (9.5e-7 + 33.0 * 6.0e-8);

fn seen_in_d65(reflectance: Spectrum) -> Vec3 {
    srgb_from_xyz((reflectance * D65).xyz())
}

fn rgb() -> impl Strategy<Value = Vec3> {
    [0.0_f32..=1.0, 0.0_f32..=1.0, 0.0_f32..=1.0].prop_map(Vec3::from_array)
}

proptest! {
    #[test]
    fn a_colour_survives_as_a_reflectance(rgb in rgb()) {
        let back = seen_in_d65(Spectrum::reflectance(rgb));
        prop_assert!((back - rgb).abs().max_element() <= ROUND_TRIP, "{rgb} {back}");
    }

    #[test]
    fn reflectances_neither_amplify_nor_go_negative(rgb in rgb()) {
        prop_assert!(Spectrum::reflectance(rgb).0.iter().all(|band| (0.0..=1.0).contains(band)));
    }

    #[test]
    fn filtering_commutes_with_lookup(a in rgb(), b in rgb(), t in 0.0_f32..=1.0) {
        let before = Spectrum::reflectance(a * (1.0 - t) + b * t);
        let after = Spectrum::reflectance(a) * (1.0 - t) + Spectrum::reflectance(b) * t;
        // Values ≤ 1 and about ten roundings on either side.
        prop_assert!((before - after).map(f32::abs).max() <= 20.0 * f32::EPSILON / 2.0);
    }

    #[test]
    fn a_light_has_its_colour_and_luminance_one(rgb in rgb()) {
        prop_assume!(rgb.max_element() > 1e-3);
        let light = Spectrum::light_of_colour(rgb);
        prop_assert!(light.0.iter().all(|&band| band >= 0.0));
        let back = srgb_from_xyz(light.xyz());
        let luminance = xyz_from_srgb(rgb).y;
        // Relative to the largest part, as in the round trip of that colour; luminance is at least 0.07 of it.
        prop_assert!((back * luminance - rgb).abs().max_element() <= 2.0 / 0.07 * ROUND_TRIP * rgb.max_element(), "{rgb} {back}");
        prop_assert!((light.luminance() - 1.0).abs() <= 20.0 * f32::EPSILON);
    }

    #[test]
    fn any_temperature_gives_a_light(kelvin in prop_oneof![900.0_f64..30_000.0, any::<f64>()]) {
        let light = Spectrum::light_of_temperature(kelvin);
        prop_assert!(light.is_finite() && light.0.iter().all(|&band| band >= 0.0));
        prop_assert!((light.luminance() - 1.0).abs() <= 20.0 * f32::EPSILON);
    }

    #[test]
    fn any_colour_gives_something_finite(r in any::<f32>(), g in any::<f32>(), b in any::<f32>()) {
        let rgb = Vec3::new(r, g, b);
        prop_assert!(Spectrum::reflectance(rgb).is_finite());
        prop_assert!(Spectrum::light_of_colour(rgb).is_finite());
    }

    #[test]
    fn srgb_survives_xyz_and_its_transfer_function(rgb in rgb()) {
        // Matrix entries rounded to f32, six operations a row, amplified by at most 5.3 · 1.1.
        prop_assert!((srgb_from_xyz(xyz_from_srgb(rgb)) - rgb).abs().max_element() <= 5.3 * 1.1 * 8.0 * f32::EPSILON);
        // The curve's two pieces miss each other by 3e-8 at their joint; powf errs by a few ulps, amplified at most by 2.4.
        prop_assert!((decode_srgb(encode_srgb(rgb.x)) - rgb.x).abs() <= 16.0 * f32::EPSILON);
    }
}

#[test]
fn white_stays_white_in_a_furnace() {
    assert_eq!(Spectrum::reflectance(Vec3::ONE), Spectrum::ONE);
    assert_eq!(Spectrum::reflectance(Vec3::ZERO), Spectrum::ZERO);
    // A thousand reflections of white light by white walls change nothing at all.
    let walls = Spectrum::reflectance(Vec3::ONE);
    assert_eq!((0..1000).fold(D65, |light, _| light * walls), D65);
    assert!((seen_in_d65(Spectrum::ONE) - 1.0).abs().max_element() <= ROUND_TRIP);
}

#[test]
fn temperatures_have_their_published_chromaticities() {
    // CIE 015:2018: illuminants A, D50 and D65. Bound: within one MacAdam step, whose least semi-axis among white lamps
    // is 0.0014 (ANSI C78.376, 2700 K); the bands' own error on black bodies and daylight, below 0.2 CIEDE2000, is half of that.
    for (kelvin, x, y) in [(2856.0, 0.44758, 0.40745), (5003.0, 0.34567, 0.35851), (6504.0, 0.31272, 0.32903)]
    {
        let found = chromaticity(Spectrum::light_of_temperature(kelvin).xyz());
        println!("{kelvin} K: {found}, CIE ({x}, {y})");
        assert!((found.x - x).hypot(found.y - y) < 0.0014, "{kelvin} K: {found}");
    }
}

#[test]
fn temperatures_grow_bluer_without_a_step() {
    // Blue share of a light rises with temperature, also across the seams at 4000 and 5000 K.
    let blue = |kelvin: f64| Spectrum::light_of_temperature(kelvin).xyz().z;
    let steps = (10..=250).map(|hundreds| blue(f64::from(hundreds) * 100.0));
    let values: Vec<f32> = steps.collect();
    assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{values:?}");
    assert_eq!(blue(1.0), blue(*TEMPERATURES.start()));
    assert_eq!(blue(f64::INFINITY), blue(*TEMPERATURES.end()));
    assert_eq!(blue(f64::NAN), blue(6504.0));
}

#[test]
fn d65_is_the_daylight_of_6504_kelvin() {
    // The constant was computed in f64 and rounded; the function sums in f64 from a chromaticity in f32.
    let difference = Spectrum::light_of_temperature(6504.0) - D65;
    assert!(difference.map(f32::abs).max() <= 1e-5 * D65.max());
}

#[test]
fn measured_lamps_keep_their_luminance_and_colour() {
    // A lamp of lines on a faint continuum: mercury blue, terbium green, sodium, europium red.
    let lines = [(435.0, 6.0), (545.0, 12.0), (590.0, 5.0), (610.0, 14.0)];
    let value = |nm: f64| 1e-3 * (1.0 + lines.iter().find(|line| line.0 == nm).map_or(0.0, |line| line.1));
    let samples = std::array::from_fn(|i| value(wavelength(i)));
    let table: Vec<_> = (0..SAMPLES).map(|i| (wavelength(i), samples[i])).collect();
    let (ours, exact) = (Spectrum::light_of_table(&table), xyz(&samples));
    assert!(ours.0.iter().all(|&band| band >= 0.0));
    for (ours, exact) in ours.xyz().to_array().into_iter().zip(exact) {
        // Solving 3 × 3 in f32: rounding of about 40 operations times the matrix's condition, below 30 here.
        assert!(
            (f64::from(ours) / exact - 1.0).abs() < 30.0 * 40.0 * f64::from(f32::EPSILON) / 2.0,
            "{ours} {exact}"
        );
    }
    // A laser has no smooth correction, but its luminance; no light stays none.
    let laser: Vec<_> = [(529.0, 0.0), (530.0, 1.0), (531.0, 0.0)].to_vec();
    let expected = 683.0 * 5.0 * 0.862;
    assert!((Spectrum::light_of_table(&laser).luminance() / expected - 1.0).abs() < 40.0 * f32::EPSILON);
    assert_eq!(Spectrum::light_of_table(&[]), Spectrum::ZERO);
}

#[test]
fn black_has_no_light() {
    assert_eq!(Spectrum::light_of_colour(Vec3::ZERO), Spectrum::ZERO);
    assert_eq!(Spectrum::light_of_colour(Vec3::NEG_ONE), Spectrum::ZERO);
    assert_eq!(Spectrum::ZERO.of_luminance(5.0), Spectrum::ZERO);
}
