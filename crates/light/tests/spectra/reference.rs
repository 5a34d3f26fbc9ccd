//! The independent reference: 5 nm sums in f64, CIE laws written out again, CIEDE2000 by `palette`.

use std::array::from_fn;

use keikan_light::data::{SAMPLES, daylight, observer, wavelength};
use palette::color_difference::Ciede2000;
use palette::white_point::E;
use palette::{FromColor, Lab, Xyz};

/// A quantity at every 5 nm.
pub(crate) type Samples = [f64; SAMPLES];

/// Product, sample by sample.
pub(crate) fn product(a: &Samples, b: &Samples) -> Samples {
    from_fn(|i| a[i] * b[i])
}

/// What is left behind `metres` of a medium of absorption `coefficient` \[1/m\].
pub(crate) fn transmittance(coefficient: &Samples, metres: f64) -> Samples {
    coefficient.map(|a| (-a * metres).exp())
}

/// Planck's law, relative, with c₂ of CODATA 2018.
pub(crate) fn planck(kelvin: f64) -> Samples {
    from_fn(|i| {
        let metres = wavelength(i) * 1e-9;
        metres.powi(-5) / ((1.438_776_877e-2 / (metres * kelvin)).exp() - 1.0) * 1e-25
    })
}

/// CIE D-series from the chromaticity that CIE 015:2018 publishes for the illuminant.
pub(crate) fn daylight_of(x: f64, y: f64) -> Samples {
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let (m1, m2) = ((-1.3515 - 1.7703 * x + 5.9114 * y) / m, (0.03 - 31.4424 * x + 30.0717 * y) / m);
    from_fn(|i| daylight::S0[i] + m1 * daylight::S1[i] + m2 * daylight::S2[i])
}

/// 683 lm/W · 5 nm · Σ s x̄, ȳ, z̄.
pub(crate) fn xyz(s: &Samples) -> [f64; 3] {
    [&observer::X_BAR, &observer::Y_BAR, &observer::Z_BAR]
        .map(|bar| 683.0 * 5.0 * s.iter().zip(bar).map(|(s, bar)| s * bar).sum::<f64>())
}

/// CIEDE2000 between two stimuli seen by an eye adapted to `white`.
pub(crate) fn difference(a: [f64; 3], b: [f64; 3], white: [f64; 3]) -> f64 {
    // Relative to white, whose own XYZ are then those of equal energy: CIELAB is a function of X/Xn, Y/Yn, Z/Zn alone.
    let lab = |c: [f64; 3]| lab(from_fn(|i| c[i] / white[i]));
    lab(a).difference(lab(b))
}

fn lab(relative: [f64; 3]) -> Lab<E, f64> {
    Lab::from_color(Xyz::<E, f64>::new(relative[0], relative[1], relative[2]))
}
