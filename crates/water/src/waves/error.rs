//! Why there are no such waves.

use std::fmt;

use super::BREAKS_AT;

/// Why there are no such waves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WaveError {
    /// A number is not finite, or lower than it may be: what, value.
    Number(&'static str, f64),
    /// A wave of this amplitude and wavelength \[m\] breaks.
    Breaks {
        /// Of the wave \[m\].
        amplitude: f64,
        /// Of the wave \[m\].
        wavelength: f64,
        /// Its height from trough to crest over its length.
        steepness: f64,
    },
    /// The wind (its speed \[m/s\] and fetch \[m\]) raises no waves longer than ripples.
    Ripples(f64, f64),
}

impl fmt::Display for WaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(what, value) => write!(
                f,
                "{what} is {value}: lengths, speeds and depths must be numbers above 0, amplitudes 0 or more, phases finite"
            ),
            Self::Breaks { amplitude, wavelength, steepness } => write!(
                f,
                "a wave of amplitude {amplitude} m and length {wavelength} m breaks: its height is {steepness:.3} of its length, \
                 and must stay below {BREAKS_AT}; the amplitude can be up to {:.3} m",
                // H/λ = 0.142 is at k a = 0.4186.
                0.4186 / std::f64::consts::TAU * wavelength
            ),
            Self::Ripples(speed, fetch) => write!(
                f,
                "a wind of {speed} m/s over {fetch} m raises no more than ripples of some centimetres, which are no gravity waves; more of either does"
            ),
        }
    }
}

impl std::error::Error for WaveError {}
