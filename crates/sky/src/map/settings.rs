//! How fine a map is.

/// How fine a map is.
///
/// On a lawn of 60 m with 40 boxes and 256 directions at each point, tolerance 0.05 with `least` 0.5 m, 0.02 with
/// 0.25 m and 0.02 with 0.125 m leave 2.0, 1.0 and 0.8 % of the open sky's light (root mean square over the lawn; 0.7 %
/// without a map) with 3 700, 11 000 and 20 000 points under an overcast sky, about the same under a clear one; with
/// 64 directions the first two leave 2.6 and 2.0 %, no map 2.0 %. The example `map_cost` measures it. A point takes 64
/// bytes with its cells.
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
