//! How fine a map is.

/// How fine a map is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Edges of cells are no longer \[m\], but for faces longer than 64 times that. Things that change the light
    /// only between points of this spacing are missed.
    pub coarse: f32,
    /// Edges of cells are no shorter \[m\], nor than 1/4096 of the face's; shadows of things on the ground end
    /// within this.
    pub least: f32,
    /// Cells are cut while the middle of an edge is off its ends' mean by more than this, as a share of what an
    /// open place receives, per band. Below the inner stage's noise (see `Description::samples`) everything is
    /// cut as finely as may be.
    pub tolerance: f32,
    /// Points are taken this far inside their face \[m\], so that a wall on its edge stands beside them.
    pub inset: f32,
    /// Of every place asked for: one for all, so that noise varies as slowly over a face as the light does.
    pub seed: u32,
}

impl Default for Settings {
    /// As fine as the light on a street needs it.
    fn default() -> Self {
        Self { coarse: 4.0, least: 0.25, tolerance: 0.02, inset: 0.01, seed: 0 }
    }
}
