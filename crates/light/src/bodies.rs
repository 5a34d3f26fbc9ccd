//! Bodies whose border only rays find.

use glam::DVec3;

use crate::{Hit, Ray};

/// A convex polyhedron around a member of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    /// Which body it belongs to.
    pub body: u32,
    /// Corners in the world \[m\].
    pub corners: Vec<DVec3>,
    /// Triangles of its closed surface, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
}

/// Where are the true borders of curved solids and set operations?
///
/// The scanline knows such a body by the circumscribed polyhedra of its members (thesis 2.3.1) and asks here
/// for what is really there. A body is solid or hollow, opaque or clear: this is about its surface alone.
pub trait Bodies: Send + Sync {
    /// Polyhedra that together contain all of every body.
    fn hulls(&self) -> &[Hull];

    /// Distance \[m\] along the line (origin, unit direction) at which it first meets the surface of `body`
    /// beyond distance `after`; none when it does not.
    fn meet(&self, body: u32, line: (DVec3, DVec3), after: f64) -> Option<f64>;

    /// The hit at a distance that [`Self::meet`] found. `ray` is the viewing ray, `pixel_width` its footprint
    /// there \[m\].
    fn hit(&self, body: u32, line: (DVec3, DVec3), distance: f64, ray: &Ray, pixel_width: f32) -> Hit;
}
