//! Triangles from outlines and from scattered points, by constrained Delaunay triangulation with exact
//! predicates (spade), in f64.

mod points_file;
mod polygon;
mod terrain;

pub use points_file::{MAX_POINTS, parse_points, read_points};
pub use polygon::{polygon, unevenness};
pub use terrain::{Terrain, terrain};

/// Why there is no triangulation. Indices (from 0; from 1 in the messages) count through the outer corners first,
/// then through the holes'.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// Fewer than three corners that differ and do not lie on a line.
    #[error("encloses no area: at least three corners that are not on one line are needed")]
    NoArea,
    /// A corner is not a finite number, or so large or small that areas overflow.
    #[error("corner {} is not finite, or beyond 10³⁰ m", .0 + 1)]
    NotFinite(usize),
    /// Edges cross, touch or coincide.
    #[error("the outline crosses or touches itself at the side from corner {} to corner {}", .0 + 1, .1 + 1)]
    Crossing(usize, usize),
    /// A hole is not inside the outline, or inside another hole.
    #[error(
        "the hole that begins with corner {} does not lie inside the outline and outside all other holes",
        .0 + 1
    )]
    HoleOutside(usize),
    /// The triangulation library gave up.
    #[error("the points could not be triangulated: {0}")]
    Library(String),
}
