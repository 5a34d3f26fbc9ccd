//! Triangles from outlines and from scattered points, by constrained Delaunay triangulation with exact
//! predicates (spade), in f64.

mod points_file;
mod polygon;
mod terrain;

pub use points_file::{MAX_POINTS, parse_points, read_points};
pub use polygon::polygon;
pub use terrain::{Terrain, terrain};

/// Why there is no triangulation. Indices count through the outer corners first, then through the holes'.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// Fewer than three corners that differ and do not lie on a line.
    #[error("encloses no area: at least three corners that are not on one line are needed")]
    NoArea,
    /// A corner is not a finite number, or so large or small that areas overflow.
    #[error("corner {0} is not finite, or beyond 10³⁰ m")]
    NotFinite(usize),
    /// Edges cross, touch or coincide.
    #[error("the outline crosses or touches itself near the edge from corner {0} to corner {1}")]
    Crossing(usize, usize),
    /// A hole is not inside the outline, or inside another hole.
    #[error(
        "the hole that begins with corner {0} does not lie inside the outline and outside all other holes"
    )]
    HoleOutside(usize),
    /// The triangulation library gave up.
    #[error("the points could not be triangulated: {0}")]
    Library(String),
}
