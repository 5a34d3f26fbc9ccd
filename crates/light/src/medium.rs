//! What fills a transparent body.

use crate::Spectrum;

/// What fills a transparent body, and what its surface lets through.
///
/// The default is a clear body of n = 1 that nobody can see.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Index of refraction relative to what is outside, > 0; below 1 for a bubble.
    pub index: f32,
    /// Absorption coefficient inside \[1/m\], ≥ 0 per band (Lambert-Beer).
    pub absorption: Spectrum,
    /// Of the light that the interface does not mirror, the share that passes it instead of being scattered by
    /// the surface, within \[0, 1\].
    pub transmission: f32,
    /// Share of the passing light that the surface's own colour leaves, within \[0, 1\] per band, once for
    /// each face that light passes.
    pub tint: Spectrum,
    /// True for a pane without an inside: every face stands for two parallel interfaces at once.
    pub thin: bool,
}

impl Default for Medium {
    fn default() -> Self {
        Self { index: 1.0, absorption: Spectrum::ZERO, transmission: 1.0, tint: Spectrum::ONE, thin: false }
    }
}
