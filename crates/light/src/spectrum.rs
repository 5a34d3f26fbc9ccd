//! A spectrum: one number per band.

use std::ops::{Add, AddAssign, Div, Index, Mul, MulAssign, Sub};

use crate::bands::BANDS;

/// A spectral quantity (radiance, reflectance, transmittance, coefficient, …), one value per band.
///
/// The unit is that of the quantity it holds. Arithmetic is band by band: that is the whole model of
/// spectral light transport here. What a band means is [`crate::bands`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Spectrum(pub [f32; BANDS]);

impl Spectrum {
    /// No light, or nothing let through.
    pub const ZERO: Self = Self([0.0; BANDS]);
    /// Everything let through or reflected.
    pub const ONE: Self = Self([1.0; BANDS]);

    /// The same value in every band.
    pub const fn splat(value: f32) -> Self {
        Self([value; BANDS])
    }

    /// Applies `f` to every band.
    pub fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Self(self.0.map(f))
    }

    /// exp(−self · length): what Lambert-Beer leaves after `length` \[m\] when `self` is a coefficient \[1/m\].
    pub fn attenuate(self, length: f32) -> Self {
        self.map(|coefficient| (-coefficient * length).exp())
    }

    /// The largest band; 0 for a spectrum without positive bands.
    pub fn max(self) -> f32 {
        self.0.iter().fold(0.0, |largest, &band| largest.max(band))
    }

    /// The plain mean over the bands.
    pub fn mean(self) -> f32 {
        self.0.iter().sum::<f32>() / BANDS as f32
    }

    /// True when every band is a finite number.
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|band| band.is_finite())
    }

    /// True when every band is 0.
    pub fn is_zero(self) -> bool {
        self.0.iter().all(|&band| band == 0.0)
    }

    /// self · a + b without intermediate rounding of intent: the accumulation every sum of light uses.
    pub fn mul_add(self, a: Self, b: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] * a.0[i] + b.0[i]))
    }
}

macro_rules! band_by_band {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait for Spectrum {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(std::array::from_fn(|i| self.0[i] $op other.0[i]))
            }
        }
    };
}
band_by_band!(Add, add, +);
band_by_band!(Sub, sub, -);
band_by_band!(Mul, mul, *);
band_by_band!(Div, div, /);

impl Mul<f32> for Spectrum {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        self.map(|band| band * factor)
    }
}

impl Mul<Spectrum> for f32 {
    type Output = Spectrum;
    fn mul(self, spectrum: Spectrum) -> Spectrum {
        spectrum * self
    }
}

impl AddAssign for Spectrum {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl MulAssign for Spectrum {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl MulAssign<f32> for Spectrum {
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

impl std::iter::Sum for Spectrum {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::ZERO, Add::add)
    }
}

impl Index<usize> for Spectrum {
    type Output = f32;
    fn index(&self, band: usize) -> &f32 {
        &self.0[band]
    }
}
