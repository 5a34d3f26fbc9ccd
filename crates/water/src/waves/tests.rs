use std::f64::consts::TAU;

use glam::DVec2;
use proptest::prelude::*;

use super::*;

/// Crest, trough and largest error over the height of a deep-water wave with k = g = 1, from a numerically exact solution of the same
/// height (Fourier coefficients after Rienecker and Fenton 1981; own computation, residual 1e-14): ka, crest, trough, the
/// third order's own crest and trough.
const EXACT: [[f64; 5]; 4] = [
    [0.05, 0.051303, -0.048790, 0.051297, -0.048797],
    [0.1, 0.105482, -0.095268, 0.105375, -0.095375],
    [0.2, 0.224838, -0.181162, 0.223000, -0.183000],
    [0.3, 0.365975, -0.254275, 0.355125, -0.265125],
];

/// A wave of length 2π m along x: k = 1/m.
fn unit(ka: f64) -> Waves {
    Waves::new(vec![Stokes::new(ka, TAU, DVec2::X, 0.0).unwrap()], DVec2::ZERO)
}

#[test]
fn a_stokes_wave_against_the_exact_one() {
    // Errors over the height, as that computation states them.
    for ([ka, crest, trough, own_crest, own_trough], share) in
        EXACT.into_iter().zip([6.6e-5, 5.4e-4, 4.6e-3, 1.9e-2])
    {
        let waves = unit(ka);
        let [top, bottom] = [0.0, TAU / 2.0].map(|x| waves.height(DVec2::new(x, 3.0)));
        // Printed to six digits.
        assert!((top - own_crest).abs() < 6e-7 && (bottom - own_trough).abs() < 6e-7, "{ka}: {top} {bottom}");
        let height = waves.each()[0].height();
        assert!((top - bottom - height).abs() < 1e-12);
        let bound = share * height + 6e-7;
        assert!((top - crest).abs() < bound && (bottom - trough).abs() < bound, "{ka}");
    }
}

#[test]
fn it_runs_with_its_own_speed() {
    // c² = (g/k)(1 + k² a²): after one length over c everything is where it was.
    let wave = Stokes::new(0.3, 10.0, DVec2::new(3.0, -4.0), 0.7).unwrap();
    let speed = (G * 10.0 / TAU * (1.0 + (TAU * 0.03).powi(2))).sqrt();
    let at = |moment: f64, x: f64| {
        Waves::new(vec![wave], DVec2::ZERO).at_moment(moment).height(DVec2::new(0.6, -0.8) * x)
    };
    for x in [0.0, 1.3, 4.4] {
        assert!((at(10.0 / speed, x) - at(0.0, x)).abs() < 1e-12);
        assert!((at(1.0, x + speed) - at(0.0, x)).abs() < 1e-12);
    }
}

#[test]
fn a_wave_that_breaks_says_how_high_it_may_be() {
    let error = Stokes::new(0.08, 1.0, DVec2::X, 0.0).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("amplitude 0.08 m and length 1 m breaks") && message.contains("up to 0.067 m"),
        "{message}"
    );
    // What it names is where it breaks, to the digits that it prints.
    assert!(
        Stokes::new(0.0666, 1.0, DVec2::X, 0.0).is_ok() && Stokes::new(0.0667, 1.0, DVec2::X, 0.0).is_err()
    );
    for (amplitude, length, toward) in
        [(f64::NAN, 1.0, DVec2::X), (0.1, 0.0, DVec2::X), (0.1, 9.0, DVec2::ZERO)]
    {
        assert!(matches!(Stokes::new(amplitude, length, toward, 0.0), Err(WaveError::Number(..))));
    }
}

fn wind(speed: f64, fetch: f64, depth: Option<f64>) -> Wind {
    Wind { speed, fetch, toward: DVec2::new(0.0, 1.0), depth, waves: 64 }
}

/// ∫ S dω by trapezoids that share nothing with the sum.
fn integral(wind: &Wind) -> f64 {
    let [low, high] = wind.range();
    let n = 40_000;
    let step = (high - low) / f64::from(n);
    let ends = 0.5 * (wind.density(low) + wind.density(high));
    step * (ends + (1..n).map(|i| wind.density(low + f64::from(i) * step)).sum::<f64>())
}

#[test]
fn waves_of_a_wind_have_its_variance() {
    for wind in [wind(8.0, 10_000.0, None), wind(12.0, 50_000.0, Some(4.0)), wind(4.0, 200.0, None)] {
        let waves = wind.raise(7).unwrap();
        let sum: f64 = waves.iter().map(|wave| 0.5 * wave.amplitude().powi(2)).sum();
        // Midpoints of a 28th of a share of ln 10/64: the spectrum's peak is 0.07 wide, 5e-4 of it at most, and the two rules differ by less.
        let expected = integral(&wind);
        assert!((sum / expected - 1.0).abs() < 1e-3, "{sum} {expected}");
        // Harmonics add (ka)²/4 of each, and each wave's ka is below 0.1.
        let total = Waves::new(waves.clone(), DVec2::ZERO).variance();
        assert!(total >= sum && total < sum * (1.0 + 0.0026), "{total} {sum}");
        assert_eq!(waves, wind.raise(7).unwrap());
        assert_ne!(waves, wind.raise(8).unwrap());
    }
}

#[test]
fn heights_over_the_water_have_that_variance() {
    let wind = wind(8.0, 10_000.0, None);
    let waves = Waves::new(wind.raise(3).unwrap(), DVec2::ZERO);
    // Far apart heights know nothing of each other: the variance of n of them has a deviation of √(2/n) of itself; five of those.
    let n = 20_000u32;
    let squares: f64 = (0..n)
        .map(|i| waves.height(DVec2::new(f64::from(i) * 977.13, f64::from(i % 149) * 3011.7)).powi(2))
        .sum();
    let ratio = squares / f64::from(n) / integral(&wind);
    assert!((ratio - 1.0).abs() < 5.0 * (2.0 / f64::from(n)).sqrt() + 0.0026, "{ratio}");
    // By the closed form for the spectrum's variance, α g²/(5 ω_p⁴ (1 − 0.287 ln 3.3)) (DNV-RP-C205, 3.5.5), good to 1 %.
    let alpha = 0.076 * (64.0f64 / (10_000.0 * G)).powf(0.22);
    let closed = alpha * G * G / (5.0 * wind.peak().powi(4) * (1.0 - 0.287 * 3.3f64.ln()));
    assert!((waves.variance() / closed - 1.0).abs() < 0.01, "{} {closed}", waves.variance());
}

#[test]
fn waves_in_shallow_water_are_shorter() {
    let wind = wind(12.0, 50_000.0, Some(4.0));
    for wave in wind.raise(1).unwrap() {
        let k = TAU / wave.wavelength();
        let residual = G * k * (k * 4.0).tanh() / wave.frequency().powi(2);
        assert!((residual - 1.0).abs() < 1e-12, "{residual}");
    }
    assert!(matches!(Wind { speed: 1.0, fetch: 1.0, ..wind }.raise(1), Err(WaveError::Ripples(..))));
    assert!(matches!(Wind { speed: f64::NAN, ..wind }.raise(1), Err(WaveError::Number(..))));
}

fn few() -> impl Strategy<Value = Waves> {
    let one = (0.0..0.12f64, 0.2..9.0f64, 0.0..TAU, -4.0..4.0f64);
    prop::collection::vec(one, 1..5).prop_map(|waves| {
        let wave = |(steep, length, angle, phase): (f64, f64, f64, f64)| {
            Stokes::new(0.5 * steep * length, length, DVec2::from_angle(angle), phase).unwrap()
        };
        Waves::new(waves.into_iter().map(wave).collect(), DVec2::new(3.0, 5.0)).at_moment(2.5)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_slope_is_that_of_the_height(waves in few(), x in -50.0..50.0f64, z in -50.0..50.0f64) {
        let at = DVec2::new(x, z);
        let h = 1e-5;
        let differ = |v: DVec2| (waves.height(at + v * h) - waves.height(at - v * h)) / (2.0 * h);
        let slope = waves.facet(at, POINT).slope;
        let shortest = waves.shortest().unwrap_or(1.0);
        // h²/6 of the third derivative, at most 9 times k² times the slope's bound; and rounding over h.
        let bound = h * h / 6.0 * 9.0 * (TAU / shortest).powi(2) * waves.steepest() + 1e-9;
        prop_assert!((slope - DVec2::new(differ(DVec2::X), differ(DVec2::Y))).length() < bound);
        prop_assert!(slope.length() <= waves.steepest() && waves.height(at).abs() <= waves.highest());
    }

    #[test]
    fn a_footprint_has_the_mean_and_the_variance_of_what_is_in_it(waves in few(), x in -9.0..9.0f64, width in 0.001..1.0f64) {
        // One wave alone: spreads of several simply add, products of different waves left out.
        let waves = Waves::new(waves.each()[..1].to_vec(), DVec2::ZERO);
        let at = DVec2::new(x, 0.3);
        let footprint = Covariance { xx: width * width, xz: 0.0, zz: 0.0 };
        // A normal distribution along x, by 400 midpoints to 6 deviations (2e-9 beyond).
        let mut sum = Facet::default();
        let mut squares = 0.0;
        for i in 0..400 {
            let s = (f64::from(i) + 0.5) / 400.0 * 12.0 - 6.0;
            let weight = (-0.5 * s * s).exp() / TAU.sqrt() * 12.0 / 400.0;
            let facet = waves.facet(at + DVec2::X * (s * width), POINT);
            sum.height += weight * facet.height;
            sum.slope += facet.slope * weight;
            squares += weight * facet.slope.x.powi(2);
        }
        let got = waves.facet(at, footprint);
        prop_assert!((got.height - sum.height).abs() < 1e-6 && (got.slope - sum.slope).length() < 1e-6);
        // The harmonics' own part of the variance is left out: ka and its square of the first harmonic's.
        let steep = waves.steepest();
        let truth = squares - sum.slope.x.powi(2);
        prop_assert!((got.spread.xx - truth).abs() <= 1.5 * steep.powi(3) + 1e-9, "{} {truth}", got.spread.xx);
    }
}
