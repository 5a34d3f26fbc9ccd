//! What a band means: provisional, equally spaced.

use crate::Spectrum;

/// Number of bands.
pub const BANDS: usize = 8;

/// Representative wavelength of each band \[nm\].
pub const WAVELENGTHS_NM: [f64; BANDS] = [430.0, 465.0, 500.0, 535.0, 570.0, 605.0, 640.0, 675.0];

impl Spectrum {
    /// A spectrum from a function of wavelength \[nm\].
    pub fn from_fn(value: impl Fn(f64) -> f64) -> Self {
        Self(WAVELENGTHS_NM.map(|nm| value(nm) as f32))
    }

    /// A spectrum from a table of (wavelength \[nm\], value), rising in wavelength, linear in between,
    /// constant beyond its ends; zero for an empty table.
    pub fn from_table(table: &[(f64, f64)]) -> Self {
        Self::from_fn(|nm| {
            let after = table.partition_point(|row| row.0 <= nm);
            match (after.checked_sub(1).and_then(|i| table.get(i)), table.get(after)) {
                (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (nm - a.0) / (b.0 - a.0),
                (Some(end), None) | (None, Some(end)) => end.1,
                (None, None) => 0.0,
            }
        })
    }
}
