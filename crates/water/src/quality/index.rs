//! The refractive index of water.

/// Index of water relative to air, by wavelength \[nm\], salinity \[psu\] and temperature \[°C\]: Quan and Fry 1995 (Applied
/// Optics 34:3477), fitted within 400 to 700 nm, 0 to 35 psu, 0 to 30 °C; what is outside counts as the nearest inside.
///
/// ```
/// assert!((keikan_water::quality::refractive_index(550.0, 0.0, 20.0) - 1.33434).abs() < 5e-6);
/// ```
pub fn refractive_index(nm: f64, salinity: f64, celsius: f64) -> f64 {
    let (nm, s, t) = (nm.clamp(400.0, 700.0), salinity.clamp(0.0, 35.0), celsius.clamp(0.0, 30.0));
    1.31405 + (1.779e-4 - 1.05e-6 * t + 1.6e-8 * t * t) * s - 2.02e-6 * t * t
        + (15.868 + 0.01155 * s - 0.00423 * t) / nm
        - 4382.0 / (nm * nm)
        + 1.1455e6 / (nm * nm * nm)
}

/// Index that bends every band of fresh water at 20 °C: that of 550 nm. Across the bands it varies by ±0.003, the colours
/// at the edge of Snell's cone.
pub const FRESH: f64 = 1.3343;
/// The same of sea water, 35 psu.
pub const SEA: f64 = 1.3408;
