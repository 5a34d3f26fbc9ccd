//! What shows in these pixels, and what does this ray meet first?

use std::ops::Range;

use crate::{Hit, Ray};

/// A piece of surface that shows in a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Pixel column.
    pub column: u32,
    /// Share of the pixel's radiance that comes from this piece: its visible area in pixels, times its own
    /// opacity, times what pieces in front of it let through. Within \[0, 1\].
    pub share: f32,
    /// Where on the surface the piece is to be shaded.
    pub hit: Hit,
}

/// Which pieces of surface show in these pixels?
///
/// The pieces of one pixel stand together, in any fixed order; their shares sum to at most 1, and what is
/// missing shows the background. The same pixel has the same answer to the bit, on any thread and however
/// the picture is cut into calls.
pub trait See: Send + Sync {
    /// Calls `receive(row, pieces)` once for each of `rows`, from the top, with the pieces in `columns`,
    /// column by column. `receive` may take or change the vector; it is emptied between rows.
    fn see(&self, rows: Range<u32>, columns: Range<u32>, receive: &mut dyn FnMut(u32, &mut Vec<Piece>));
}

/// What does this ray meet first?
///
/// Faces with an opacity of their own (alpha textures) are met where their opacity, read at the ray's
/// footprint, is at least one half. `None` = the ray leaves the scene.
pub trait Nearest: Send + Sync {
    /// The first hit, if any. `hit.path` is [`crate::Path::EYE`]; the caller sets its own.
    fn nearest(&self, ray: &Ray) -> Option<Hit>;
}
