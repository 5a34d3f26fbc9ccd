//! Water that is coloured by what grows in it.

use light::Spectrum;

use super::tables::pure;
use super::{QualityError, SEA, Scatterer, Water, within};
use crate::Phase;

/// Chlorophyll that the model takes \[mg/m³\]; it was fitted to 0.03 to 30 of the open ocean.
pub const CHLOROPHYLL_RANGE: [f64; 2] = [0.0, 100.0];

/// Absorption of phytoplankton relative to 440 nm, 400 to 700 nm every 10 nm (Prieur and Sathyendranath 1981, Limnology and
/// Oceanography 26:671).
#[rustfmt::skip]
const PLANKTON: [f64; 31] = [
    0.687, 0.828, 0.913, 0.973, 1.000, 0.944, 0.917, 0.870, 0.798, 0.750,
    0.668, 0.618, 0.528, 0.474, 0.416, 0.357, 0.294, 0.276, 0.291, 0.282,
    0.236, 0.252, 0.276, 0.317, 0.334, 0.356, 0.441, 0.595, 0.502, 0.329,
    0.215,
];

impl Water {
    /// Open sea (Case 1: all else goes with the chlorophyll) with `chlorophyll` \[mg/m³\], within [`CHLOROPHYLL_RANGE`].
    ///
    ///   a = (a_w + 0.06 A(λ) C^0.65) (1 + 0.2 e^(−0.014 (λ − 440)))      (Morel 1991; the last factor is yellow substance)
    ///   b = b_w + 0.30 C^0.62 · 550/λ                                     (Gordon and Morel 1983)
    ///
    /// with Petzold's phase function for the particles. Waters of the same chlorophyll differ by a factor of two; lakes and
    /// coasts with clay or peat are another case.
    pub fn of_chlorophyll(chlorophyll: f64) -> Result<Self, QualityError> {
        within("chlorophyll", "mg/m³", chlorophyll, CHLOROPHYLL_RANGE)?;
        let absorption = Spectrum::from_fn(|nm| {
            let plankton = 0.06 * uniform(&PLANKTON, 10.0, nm) * chlorophyll.powf(0.65);
            (pure_absorption(nm) + plankton) * (1.0 + 0.2 * (-0.014 * (nm - 440.0)).exp())
        });
        let particles = Spectrum::from_fn(|nm| 0.30 * chlorophyll.powf(0.62) * 550.0 / nm);
        Self::new(
            absorption,
            vec![sea_molecules(), Scatterer { scattering: particles, phase: Phase::petzold() }],
            SEA,
        )
    }
}

/// The molecules of sea water.
pub(super) fn sea_molecules() -> Scatterer {
    let scattering = Spectrum::from_fn(|nm| uniform(&pure::SCATTERING_SEA, 10.0, nm));
    Scatterer { scattering, phase: Phase::water() }
}

/// The molecules of fresh water.
pub(super) fn fresh_molecules() -> Scatterer {
    let scattering = Spectrum::from_fn(|nm| uniform(&pure::SCATTERING_FRESH, 10.0, nm));
    Scatterer { scattering, phase: Phase::water() }
}

/// Absorption of pure water at a wavelength \[1/m\].
pub(super) fn pure_absorption(nm: f64) -> f64 {
    uniform(&pure::ABSORPTION, 5.0, nm)
}

/// A table from 400 nm in equal steps, linear in between, constant beyond its ends.
pub(super) fn uniform(table: &[f64], step: f64, nm: f64) -> f64 {
    let last = table.len() - 1;
    let position = ((nm - pure::FIRST_NM) / step).clamp(0.0, last as f64);
    let below = (position as usize).min(last - 1);
    table[below] + (table[below + 1] - table[below]) * (position - below as f64)
}
