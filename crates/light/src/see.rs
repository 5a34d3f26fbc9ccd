//! What shows in these pixels, and what does this ray meet first?

use std::ops::Range;
use std::sync::Arc;

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
    /// What is known of the lights that reach it.
    pub known: Known,
    /// How many pieces from this one on sample one and the same thing, which may look different at each; most often 1.
    /// They stand together, and any of them in front are spread as evenly over it as they can be: whoever shades
    /// them may stop where they look alike. Those after the first say 1 themselves.
    pub samples: u16,
}

/// What is known, before shading, of which point sources reach a piece of surface. Sources have numbers
/// from 0 to 63, which whoever asked for the knowledge gave them; most often nothing is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Known {
    /// Bit i: source i reaches all of it, with nothing in the way.
    pub lit: u64,
    /// Bit i: source i reaches nothing of it.
    pub dark: u64,
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

/// A shared eye is an eye.
impl<T: See + ?Sized> See for Arc<T> {
    fn see(&self, rows: Range<u32>, columns: Range<u32>, receive: &mut dyn FnMut(u32, &mut Vec<Piece>)) {
        (**self).see(rows, columns, receive);
    }
}

/// What does this ray meet first?
///
/// Faces with an opacity of their own (alpha textures) are met where their opacity, read at the ray's
/// footprint, is at least one half. `None` = the ray leaves the scene.
pub trait Nearest: Send + Sync {
    /// The first hit, if any. `hit.path` is [`crate::Path::EYE`]; the caller sets its own.
    fn nearest(&self, ray: &Ray) -> Option<Hit>;
}

/// The first hit of several: what is nearest among all that answer. An empty list meets nothing.
#[derive(Clone, Default)]
pub struct First(pub Vec<Arc<dyn Nearest>>);

impl Nearest for First {
    fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut reach = *ray;
        let mut first: Option<Hit> = None;
        for part in &self.0 {
            // What is farther than the nearest so far need not be found. Equal distances: the earlier part.
            if let Some(hit) = part.nearest(&reach)
                && first.is_none_or(|so_far| hit.distance < so_far.distance)
            {
                reach.length = hit.distance;
                first = Some(hit);
            }
        }
        first
    }
}
