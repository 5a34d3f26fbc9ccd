//! Light per band in f64.

use std::ops::{Add, AddAssign, Index, Mul, MulAssign};

use light::Spectrum;
use light::bands::{BANDS, XYZ_WEIGHTS};
use light::colour::LUMENS_PER_WATT;

/// A spectral quantity in f64: sums of many small parts keep their digits. The unit is that of what it holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bands(pub [f64; BANDS]);

impl Bands {
    /// Nothing.
    pub const ZERO: Self = Self([0.0; BANDS]);
    /// 1 in every band.
    pub const ONE: Self = Self([1.0; BANDS]);

    /// The same value in every band.
    pub const fn splat(value: f64) -> Self {
        Self([value; BANDS])
    }

    /// Applies `f` to every band.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    /// exp(−self · length), `self` being a coefficient \[1/m\].
    pub(crate) fn attenuate(self, length: f64) -> Self {
        // 0 · ∞ is no loss.
        self.map(|coefficient| if coefficient > 0.0 { (-coefficient * length).exp() } else { 1.0 })
    }

    /// The largest band.
    pub(crate) fn largest(self) -> f64 {
        self.0.into_iter().fold(0.0, f64::max)
    }

    /// The plain mean over the bands.
    pub(crate) fn mean(self) -> f64 {
        self.0.iter().sum::<f64>() / BANDS as f64
    }

    /// True when every band is 0.
    pub(crate) fn is_zero(self) -> bool {
        self.0.iter().all(|&band| band == 0.0)
    }

    /// cd/m² of a radiance, lx of an irradiance: 683 lm/W · Σ w_b L_b.
    pub fn luminance(self) -> f64 {
        let sum: f64 =
            XYZ_WEIGHTS[1].iter().zip(self.0).map(|(&weight, band)| f64::from(weight) * band).sum();
        LUMENS_PER_WATT * sum
    }

    /// Rounded to what everyone else uses.
    pub fn spectrum(self) -> Spectrum {
        Spectrum(self.0.map(|band| band as f32))
    }
}

impl From<Spectrum> for Bands {
    fn from(spectrum: Spectrum) -> Self {
        Self(spectrum.0.map(f64::from))
    }
}

impl Add for Bands {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|b| self.0[b] + other.0[b]))
    }
}

impl AddAssign for Bands {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul for Bands {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(std::array::from_fn(|b| self.0[b] * other.0[b]))
    }
}

impl Mul<f64> for Bands {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.map(|band| band * factor)
    }
}

impl MulAssign for Bands {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl MulAssign<f64> for Bands {
    fn mul_assign(&mut self, factor: f64) {
        *self = *self * factor;
    }
}

impl Index<usize> for Bands {
    type Output = f64;
    fn index(&self, band: usize) -> &f64 {
        &self.0[band]
    }
}
