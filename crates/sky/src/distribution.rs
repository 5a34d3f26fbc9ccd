//! How luminance is spread over the sky: standard distributions, relative to the zenith, and measured ones.

use std::sync::Arc;

use glam::Vec3;

use crate::general_sky;
use crate::sky::lifted;
use crate::{LuminanceTable, Perez};

/// A distribution of luminance over the sky.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// The CIE overcast sky of Moon and Spencer (the 16th of ISO 15469): three times as bright at the zenith
    /// as at the horizon, L/L_z = (1 + 2 cos Z)/3, the same in every direction of the compass.
    MoonSpencer,
    /// A gradation towards the horizon times an indicatrix around the sun: all the others' form.
    Parametric(Gradation),
    /// Measured.
    Measured(Arc<LuminanceTable>),
}

/// Five parameters and a constant that make a sky out of the angle Z from the zenith and γ from the sun:
///
///   L ∝ (1 + a e^(b/cos Z)) (f₀ + c e^(dγ) + e cos² γ)
///
/// The first factor is the gradation, at the horizon 1 for b < 0; the second the indicatrix. Angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradation {
    /// Strength of the gradation: negative = brighter towards the horizon.
    pub a: f64,
    /// How far it reaches up; < 0.
    pub b: f64,
    /// What the indicatrix has far from the sun.
    pub f0: f64,
    /// Brightness of the sun's surroundings.
    pub c: f64,
    /// How fast that falls off with the angle \[per rad\]; < 0.
    pub d: f64,
    /// Backscatter: the brightening opposite the sun.
    pub e: f64,
}

impl Gradation {
    /// The same luminance everywhere.
    pub const UNIFORM: Self = Self { a: 0.0, b: -1.0, f0: 1.0, c: 0.0, d: -1.0, e: 0.0 };
    /// The CIE clear sky of 1973 (CIE 22, Kittler; type 12 of ISO 15469 to 0.02 %):
    /// L/L_z = f(γ) φ(Z) / (f(Z_s) φ(0)), f = 0.91 + 10 e^(−3γ) + 0.45 cos² γ, φ = 1 − e^(−0.32/cos Z).
    pub const CIE_CLEAR: Self = Self { a: -1.0, b: -0.32, f0: 0.91, c: 10.0, d: -3.0, e: 0.45 };
    /// The same for polluted air: f = 0.856 + 16 e^(−3γ) + 0.3 cos² γ.
    pub const CIE_POLLUTED: Self = Self { a: -1.0, b: -0.32, f0: 0.856, c: 16.0, d: -3.0, e: 0.3 };

    /// Luminance but for a factor that depends on the sun alone; direction and sun are not below the horizon.
    fn shape(&self, direction: Vec3, sun: Vec3) -> f64 {
        // b = 0 would make 0/0 of the horizon, b > 0 ∞.
        let reach = self.b.min(-f64::MIN_POSITIVE) / f64::from(direction.y);
        let gradation = if self.a == 0.0 { 1.0 } else { 1.0 + self.a * reach.exp() };
        // The chord between unit vectors, 2 sin(γ/2), keeps its digits at the cusp γ = 0.
        let half_chord = f64::from(0.5 * direction.distance(sun)).min(1.0);
        let cos = 1.0 - 2.0 * half_chord * half_chord;
        let lobe = if self.c == 0.0 { 0.0 } else { self.c * (2.0 * self.d * half_chord.asin()).exp() };
        // Neither factor is a luminance by itself below zero.
        gradation.max(0.0) * (self.f0 + lobe + self.e * cos * cos).max(0.0)
    }
}

impl Distribution {
    /// The same luminance everywhere.
    pub const UNIFORM: Self = Self::Parametric(Gradation::UNIFORM);
    /// The CIE clear sky of 1973.
    pub const CIE_CLEAR: Self = Self::Parametric(Gradation::CIE_CLEAR);

    /// Type 1 to 15 of ISO 15469; none for other numbers.
    ///
    /// ```
    /// use keikan_sky::Distribution;
    /// assert!(Distribution::cie(12).is_some() && Distribution::cie(16).is_none());
    /// ```
    pub fn cie(number: usize) -> Option<Self> {
        general_sky::parameters(number).map(Self::Parametric)
    }

    /// Perez' all-weather sky.
    pub fn perez(sky: &Perez) -> Self {
        Self::Parametric(sky.gradation())
    }

    /// Luminance along the unit vector `direction` as a multiple of that at the zenith, of a measured one as
    /// it was measured; 0 below the horizon.
    ///
    /// `toward_sun` is a unit vector; a sun below the horizon counts as on it.
    pub fn relative_luminance(&self, direction: Vec3, toward_sun: Vec3) -> f32 {
        if direction.y < 0.0 {
            return 0.0;
        }
        let sun = lifted(toward_sun);
        (self.shape(direction, sun) * self.per_zenith(sun)) as f32
    }

    /// Inverse of the shape at the zenith, 1 where that is not its scale.
    pub(crate) fn per_zenith(&self, sun: Vec3) -> f64 {
        let zenith = match self {
            Self::Measured(_) => 1.0,
            _ => self.shape(Vec3::Y, sun),
        };
        if zenith > 0.0 { 1.0 / zenith } else { 1.0 }
    }

    /// Luminance but for a factor that depends on the sun alone; direction and sun are not below the horizon.
    pub(crate) fn shape(&self, direction: Vec3, sun: Vec3) -> f64 {
        match self {
            Self::MoonSpencer => (1.0 + 2.0 * f64::from(direction.y)) / 3.0,
            Self::Parametric(gradation) => gradation.shape(direction, sun),
            Self::Measured(table) => f64::from(table.luminance(direction)),
        }
    }

    /// Whether the sky is the same in every direction of the compass.
    pub fn is_round(&self) -> bool {
        match self {
            Self::MoonSpencer => true,
            Self::Parametric(Gradation { c, e, .. }) => *c == 0.0 && *e == 0.0,
            Self::Measured(_) => false,
        }
    }
}

#[cfg(test)]
mod tests;
