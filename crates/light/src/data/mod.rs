//! Published spectra, each sampled every 5 nm from 380 to 780 nm.

pub mod daylight;
pub mod leaf;
pub mod observer;

/// Samples of each table.
pub const SAMPLES: usize = 81;
/// Wavelength of the first sample \[nm\].
pub const FIRST_NM: f64 = 380.0;
/// Distance between samples \[nm\].
pub const STEP_NM: f64 = 5.0;

/// Wavelength of sample `i` \[nm\].
pub const fn wavelength(i: usize) -> f64 {
    FIRST_NM + STEP_NM * i as f64
}

/// The value of `table` at wavelength `nm`: linear between samples, constant beyond the ends.
pub fn interpolate(table: &[f64; SAMPLES], nm: f64) -> f64 {
    let position = ((nm - FIRST_NM) / STEP_NM).clamp(0.0, (SAMPLES - 1) as f64);
    let below = (position as usize).min(SAMPLES - 2);
    table[below] + (table[below + 1] - table[below]) * (position - below as f64)
}
