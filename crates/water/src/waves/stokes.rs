//! One wave.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::{Covariance, Facet, G, WaveError};

/// A wave breaks when its height from trough to crest is this share of its length (Michell 1893).
pub const BREAKS_AT: f64 = 0.142;

/// A Stokes wave to the third order, in deep water (thesis reference 10).
///
/// With t = k·(x, z) − ω τ + φ at the time τ:
///
///   η = a cos t + ½ k a² cos 2t + ⅜ k² a³ cos 3t,   ω² = g k (1 + k² a²)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stokes {
    amplitude: f64,
    /// Wave vector \[rad/m\].
    k: DVec2,
    wavenumber: f64,
    frequency: f64,
    phase: f64,
}

impl Stokes {
    /// A wave of amplitude a ≥ 0 and `wavelength` \[m\] that runs along `toward` (x and z, any length but 0), with its crest where
    /// it is said to be for a `phase` of 0 \[rad\].
    ///
    /// # Errors
    /// Numbers that are none, and a wave that breaks.
    pub fn new(amplitude: f64, wavelength: f64, toward: DVec2, phase: f64) -> Result<Self, WaveError> {
        let sound = |what, value: f64, least: f64| match value.is_finite() && value >= least {
            true => Ok(value),
            false => Err(WaveError::Number(what, value)),
        };
        sound("the amplitude of a wave", amplitude, 0.0)?;
        sound("the length of a wave", wavelength, f64::MIN_POSITIVE)?;
        sound("the phase of a wave", phase, f64::MIN)?;
        let toward =
            toward.try_normalize().ok_or(WaveError::Number("the direction of a wave", toward.length()))?;
        let wavenumber = TAU / wavelength;
        let ka = wavenumber * amplitude;
        let steepness = ka / PI * (1.0 + 0.375 * ka * ka);
        if steepness >= BREAKS_AT {
            return Err(WaveError::Breaks { amplitude, wavelength, steepness });
        }
        let frequency = (G * wavenumber * (1.0 + ka * ka)).sqrt();
        Ok(Self { amplitude, k: toward * wavenumber, wavenumber, frequency, phase })
    }

    /// The same with the angular frequency ω \[rad/s\] that it has in water of some depth.
    #[must_use]
    pub(super) fn with_frequency(self, frequency: f64) -> Self {
        Self { frequency, ..self }
    }

    /// a \[m\].
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// λ \[m\].
    pub fn wavelength(&self) -> f64 {
        TAU / self.wavenumber
    }

    /// ω \[rad/s\].
    pub fn frequency(&self) -> f64 {
        self.frequency
    }

    /// Height from trough to crest, 2 a (1 + ⅜ k² a²) \[m\].
    pub fn height(&self) -> f64 {
        2.0 * self.amplitude * (1.0 + 0.375 * self.ka().powi(2))
    }

    /// Radians of phase to a metre along a way of this run.
    pub(super) fn along(&self, run: DVec2) -> f64 {
        self.k.dot(run).abs()
    }

    /// The same along itself: k.
    pub(super) fn wavenumber(&self) -> f64 {
        self.wavenumber
    }

    /// What a footprint leaves of its first harmonic; of the others it leaves less.
    pub(super) fn kept(&self, footprint: Covariance) -> f64 {
        (-0.5 * footprint.along(self.k).max(0.0)).exp()
    }

    fn ka(&self) -> f64 {
        self.wavenumber * self.amplitude
    }

    /// max |η|, at the crest.
    pub(super) fn highest(&self) -> f64 {
        let ka = self.ka();
        self.amplitude * (1.0 + 0.5 * ka + 0.375 * ka * ka)
    }

    /// A bound on |∂η/∂x|: all three sines at 1.
    pub(super) fn steepest(&self) -> f64 {
        let ka = self.ka();
        ka * (1.0 + ka + 1.125 * ka * ka)
    }

    /// Mean of η², whose mean is 0: half the sum of the squares of the three amplitudes.
    pub(super) fn variance(&self) -> f64 {
        let ka = self.ka();
        0.5 * self.amplitude.powi(2) * (1.0 + 0.25 * ka.powi(2) + (0.375 * ka * ka).powi(2))
    }

    /// Adds this wave's share at a point (from where phases count) and time to a facet.
    ///
    /// Over a footprint with covariance C a harmonic m keeps f^(m²) of itself, f = exp(−½ kᵀ C k). What its slope varies by within
    /// the footprint is, of the first harmonic, which has nearly all of it,
    ///
    ///   ½ (k a)² (1 − f²)(1 + f² cos 2t).
    pub(super) fn add_to(&self, facet: &mut Facet, from: DVec2, time: f64, footprint: Covariance) {
        let a = self.amplitude;
        let ka = self.ka();
        let (sin, cos) = (self.k.dot(from) - self.frequency * time + self.phase).sin_cos();
        let (sin_2, cos_2) = (2.0 * sin * cos, 1.0 - 2.0 * sin * sin);
        let (sin_3, cos_3) = (sin * cos_2 + cos * sin_2, cos * cos_2 - sin * sin_2);
        let width = footprint.along(self.k);
        let f = if width > 0.0 { (-0.5 * width).exp() } else { 1.0 };
        let f4 = f.powi(4);
        let [first, second, third] = [f, f4, f4 * f4 * f];
        facet.height += a * (first * cos + 0.5 * ka * second * cos_2 + 0.375 * ka * ka * third * cos_3);
        facet.slope -= self.k * (a * (first * sin + ka * second * sin_2 + 1.125 * ka * ka * third * sin_3));
        if width > 0.0 {
            let varies = 0.5 * a * a * -(-width).exp_m1() * (1.0 + f * f * cos_2);
            facet.spread = facet.spread.and(self.k, varies);
        }
    }
}
