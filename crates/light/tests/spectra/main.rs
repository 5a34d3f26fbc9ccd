//! Eight bands against 5 nm: the colours that keikan promises to get right.
//!
//! Adapted white, stated because CIEDE2000 depends on it: for a light, D65 of the light's own luminance; for a
//! surface, the light that falls on it (in water: the daylight that the water has left).

mod colours;
mod reference;
mod tables;

use keikan_light::Spectrum;
use keikan_light::bands::{BANDS, HALF_WIDTHS_NM, WAVELENGTHS_NM, XYZ_WEIGHTS};
use keikan_light::data::{FIRST_NM, STEP_NM, leaf, observer};
use reference::{Samples, daylight_of, difference, planck, product, transmittance, xyz};

/// The promise: a difference that a trained eye just misses side by side.
const BARELY_VISIBLE: f64 = 1.0;
/// White of sRGB, Y = 1.
const WHITE: [f64; 3] = [0.3127 / 0.3290, 1.0, (1.0 - 0.3127 - 0.3290) / 0.3290];

fn bands(samples: &Samples) -> Spectrum {
    Spectrum::from_fn(|nm| samples[((nm - FIRST_NM) / STEP_NM) as usize])
}

/// CIEDE2000 and relative error of luminance of light × reflectance × exp(−a · metres).
fn errors(light: &Samples, surface: Option<&Samples>, metres: f64) -> (f64, f64) {
    let arriving = product(light, &transmittance(&tables::WATER_ABSORPTION, metres));
    let (mut ours, mut exact) =
        (bands(light) * bands(&tables::WATER_ABSORPTION).attenuate(metres as f32), arriving);
    if let Some(surface) = surface {
        ours *= bands(surface);
        exact = product(&arriving, surface);
    }
    let (ours, exact) = (ours.xyz().to_array().map(f64::from), xyz(&exact));
    let white = if surface.is_some() { xyz(&arriving) } else { WHITE.map(|w| w * exact[1]) };
    (difference(ours, exact, white), ours[1] / exact[1] - 1.0)
}

fn lights() -> Vec<(&'static str, Samples)> {
    // Chromaticities of the D illuminants: CIE 015:2018, table T.3; 10000 K by its formula.
    vec![
        ("D50", daylight_of(0.34567, 0.35851)),
        ("D55", daylight_of(0.33243, 0.34744)),
        ("D65", daylight_of(0.31272, 0.32903)),
        ("D75", daylight_of(0.29903, 0.31488)),
        ("D 10000 K", daylight_of(0.27880, 0.29194)),
        ("sun in space", tables::SUN),
        ("tungsten 2700 K", planck(2700.0)),
        ("tungsten 2856 K", planck(2856.0)),
        ("tungsten 3200 K", planck(3200.0)),
        ("LED-B3", tables::LED_B3),
    ]
}

#[test]
fn promised_colours_are_within_one_unit_of_5_nm() {
    println!("CIEDE2000 (luminance error %) of 8 bands against 5 nm");
    println!(
        "{:16} {:16} {:>14} {:>14} {:>14} {:>14} {:>14}",
        "light", "seen", "in air", "1 m", "2 m", "5 m", "10 m"
    );
    let seen = [
        ("itself", None),
        ("leaf", Some(&leaf::REFLECTANCE)),
        ("leaf, through", Some(&leaf::TRANSMITTANCE)),
        ("foliage patch", Some(&tables::FOLIAGE)),
    ];
    let mut failures = Vec::new();
    for (name, light) in lights() {
        for (what, surface) in seen {
            let row = [0.0, 1.0, 2.0, 5.0, 10.0].map(|metres| errors(&light, surface, metres));
            let cells = row.map(|(colour, bright)| format!("{colour:5.2} ({:+5.2})", 100.0 * bright));
            println!(
                "{name:16} {what:16} {:>14} {:>14} {:>14} {:>14} {:>14}",
                cells[0], cells[1], cells[2], cells[3], cells[4]
            );
            // Luminance to 1 %: below the 1.5 % step of brightness that a trained eye sees in daylight (Weber).
            if row.iter().any(|(colour, bright)| !(*colour < BARELY_VISIBLE && bright.abs() < 0.01)) {
                failures.push(format!("{name}, {what}: {row:?}"));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn weights_sum_to_the_integrals_of_the_observer() {
    let bars = [observer::X_BAR, observer::Y_BAR, observer::Z_BAR];
    for (weights, bar) in XYZ_WEIGHTS.iter().zip(bars) {
        let (sum, integral) =
            (weights.iter().map(|&w| f64::from(w)).sum::<f64>(), bar.iter().sum::<f64>() * STEP_NM);
        // Eight weights, each rounded to f32: half an ulp each, at most u · Σ w.
        assert!((sum / integral - 1.0).abs() <= f64::from(f32::EPSILON) / 2.0, "{sum} {integral}");
        assert!(weights.iter().all(|&w| w >= 0.0));
    }
}

#[test]
fn luminance_of_a_constant_spectrum_is_683_times_its_integral() {
    let integral = observer::Y_BAR.iter().sum::<f64>() * STEP_NM;
    for value in [1e-6_f32, 0.37, 1.0, 2.0e4] {
        let expected = 683.0 * integral * f64::from(value);
        // Nine products, seven sums and the rounding of each weight: under 20 units of round-off.
        let bound = expected * 20.0 * f64::from(f32::EPSILON) / 2.0;
        assert!((f64::from(Spectrum::splat(value).luminance()) - expected).abs() <= bound);
    }
}

#[test]
fn luminance_is_the_y_of_xyz_to_the_bit() {
    for (_, light) in lights() {
        assert_eq!(bands(&light).luminance(), bands(&light).xyz().y);
    }
}

#[test]
fn kernels_lie_within_the_visible_and_cover_it() {
    for band in 0..BANDS {
        let (centre, half) = (WAVELENGTHS_NM[band], HALF_WIDTHS_NM[band]);
        // Full kernels: not cut off by the ends of the tables.
        assert!(centre - half >= 380.0 && centre + half <= 780.0);
        assert!(
            band == 0 || centre - half < WAVELENGTHS_NM[band - 1] + HALF_WIDTHS_NM[band - 1],
            "gap below band {band}"
        );
    }
}

#[test]
fn tables_are_read_linearly_and_hold_beyond_their_ends() {
    // A linear function is its own interpolation; its mean under a kernel is the kernel's mean wavelength, which lies
    // within one step of the centre.
    let line = Spectrum::from_table(&[(300.0, 300.0), (800.0, 800.0)]);
    for (value, centre) in line.0.iter().zip(WAVELENGTHS_NM) {
        assert!((f64::from(*value) - centre).abs() < STEP_NM);
    }
    assert_eq!(Spectrum::from_table(&[]), Spectrum::ZERO);
    assert_eq!(Spectrum::from_table(&[(500.0, 0.25)]), Spectrum::splat(0.25));
    // Steps at one wavelength (a filter's edge) are legal.
    let step = Spectrum::from_table(&[(380.0, 0.0), (550.0, 0.0), (550.0, 1.0), (780.0, 1.0)]);
    assert!(step.0[0] == 0.0 && step.0[BANDS - 1] == 1.0);
}
