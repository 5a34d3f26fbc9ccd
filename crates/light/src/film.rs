//! The picture before it is developed.

use crate::Spectrum;

/// One named picture of radiances.
#[derive(Clone, Debug)]
pub struct Layer {
    /// `""` for the whole picture, or the name of a part (`sun`, `sky`, a luminaire's name).
    pub name: String,
    /// Radiance per pixel, rows from the top \[W m⁻² sr⁻¹ nm⁻¹\].
    pub pixels: Vec<Spectrum>,
}

/// Radiances of a picture, spectral until it is developed.
#[derive(Clone, Debug)]
pub struct Film {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The whole picture first, then its parts, if asked for.
    pub layers: Vec<Layer>,
}
