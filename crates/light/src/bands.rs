//! What a band means: eight smooth windows of wavelength, fitted to the light of landscapes.
//!
//! Light travels here as one number per band, and bands multiply: light × reflectance × transmittance. Two
//! choices make that good enough to stand in for a whole spectrum:
//!
//! 1. *Projection.* Band b of any spectral quantity s (light, reflectance, coefficient) is its mean under a kernel,
//!    s_b = Σ_λ K_b(λ) s(λ) / Σ_λ K_b(λ) with K_b(λ) = (1 − u²)², u = (λ − centre_b) / half-width_b, |u| < 1, summed in
//!    steps of 5 nm from 380 to 780 nm. A mean, not a point, so that the Fraunhofer lines of the sun do not matter.
//! 2. *Development.* X, Y, Z = 683 lm/W · Σ_b w_b s_b with one non-negative row of weights \[nm\] for each: no light
//!    has a negative tristimulus value, and luminance is exactly the second sum.
//!
//! Centres, half-widths and weights come from `docs/bands/fit.py`: an evolution strategy over the kernels, and for each
//! candidate the best weights by non-negative least squares in CIEDE2000 linearised around each colour, taken to the
//! sixth power (so that the worst cases count), luminance errors of 2 % counting as one unit. It trains on CIE
//! daylights of 4000 to 25000 K, sun and blue sky through clear and hazy air, black bodies of 1800 to 9000 K, white
//! LEDs, leaves by PROSPECT-D, smooth surfaces and the ColorChecker, up to 12 m of clear and yellow water. Two things are exact:
//! constant spectra (Σ w = ∫ of the colour matching function) and the white of sRGB under CIE D65.
//!
//! **Where it is wrong.** `tests/spectra` prints the errors against 5 nm. Lamps of spectral lines (fluorescent, sodium,
//! mercury) fall between bands, up to 16 units: [`Spectrum::light_of_table`] gives them their own colour and luminance,
//! though not their rendering of surfaces. A coefficient that varies greatly within a band (water beyond 600 nm over tens of metres) is a mean too.

use crate::Spectrum;
use crate::data::{SAMPLES, wavelength};

/// Number of bands.
pub const BANDS: usize = 8;

/// Centre of each band's kernel \[nm\].
pub const WAVELENGTHS_NM: [f64; BANDS] = [436.6, 464.4, 499.9, 535.9, 569.7, 603.9, 632.8, 672.6];

/// Distance from a kernel's centre to where it ends \[nm\].
pub const HALF_WIDTHS_NM: [f64; BANDS] = [29.2, 25.0, 20.9, 27.1, 15.0, 21.2, 15.0, 27.7];

/// Weights that turn bands into X, Y, Z before the factor of 683 lm/W \[nm\]; rows sum to ∫x̄, ∫ȳ, ∫z̄.
pub const XYZ_WEIGHTS: [[f32; BANDS]; 3] = [
    [11.209_718, 6.482_516_3, 0.0, 6.973_653_3, 27.519_604, 33.813_24, 16.929_811, 3.929_082_9],
    [0.536_386_5, 2.097_841_7, 11.197_774, 33.989_64, 31.427_347, 19.922_955, 6.259_955, 1.424_740_8],
    [53.323_883, 41.818_108, 11.155_606, 0.425_286_65, 0.134_817_88, 0.0, 0.0, 0.0],
];

/// Kernel of each band at each 5 nm sample, sum 1.
const KERNELS: [[f64; SAMPLES]; BANDS] = kernels();

const fn kernels() -> [[f64; SAMPLES]; BANDS] {
    let mut kernels = [[0.0; SAMPLES]; BANDS];
    let mut band = 0;
    while band < BANDS {
        kernels[band] = kernel(WAVELENGTHS_NM[band], HALF_WIDTHS_NM[band]);
        band += 1;
    }
    kernels
}

/// (1 − u²)² within |u| < 1, divided by its sum.
const fn kernel(centre: f64, half_width: f64) -> [f64; SAMPLES] {
    let (mut kernel, mut sum, mut i) = ([0.0; SAMPLES], 0.0, 0);
    while i < SAMPLES {
        let u = (wavelength(i) - centre) / half_width;
        if u * u < 1.0 {
            kernel[i] = (1.0 - u * u) * (1.0 - u * u);
            sum += kernel[i];
        }
        i += 1;
    }
    i = 0;
    while i < SAMPLES {
        kernel[i] /= sum;
        i += 1;
    }
    kernel
}

impl Spectrum {
    /// A spectrum from a function of wavelength \[nm\], which is asked every 5 nm within each band's kernel (about 70
    /// times in all). A constant comes back as itself.
    ///
    /// ```
    /// use keikan_light::Spectrum;
    /// assert_eq!(Spectrum::from_fn(|_| 0.5), Spectrum::splat(0.5));
    /// ```
    pub fn from_fn(value: impl Fn(f64) -> f64) -> Self {
        let mean = |kernel: &[f64; SAMPLES]| -> f64 {
            let inside = kernel.iter().enumerate().filter(|(_, weight)| **weight > 0.0);
            inside.map(|(i, weight)| weight * value(wavelength(i))).sum()
        };
        Self(std::array::from_fn(|band| mean(&KERNELS[band]) as f32))
    }

    /// A spectrum from a table of (wavelength \[nm\], value), rising in wavelength, linear in between,
    /// constant beyond its ends; zero for an empty table. It is asked every 5 nm: average a finer table first.
    pub fn from_table(table: &[(f64, f64)]) -> Self {
        Self::from_fn(|nm| read(table, nm))
    }
}

/// The value of `table` at `nm`, see [`Spectrum::from_table`].
pub(crate) fn read(table: &[(f64, f64)], nm: f64) -> f64 {
    let after = table.partition_point(|row| row.0 <= nm);
    match (after.checked_sub(1).and_then(|i| table.get(i)), table.get(after)) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (nm - a.0) / (b.0 - a.0),
        (Some(end), None) | (None, Some(end)) => end.1,
        (None, None) => 0.0,
    }
}
