//! Curved solids and set operations, met exactly.
//!
//! **Answers.** [`Solids`] is a set of bodies, each a tree ([`Node`]) of unions, intersections and differences of
//! placed spheres, cylinders, cones, truncated cones and convex polyhedra ([`Shape`]). It says which polyhedra
//! contain them ([`light::Bodies::hulls`]), where a line meets the surface of one, what a ray meets first
//! ([`light::Nearest`]) and what of the light along a segment arrives ([`light::Occlude`]).
//!
//! **How.** A line meets a convex solid in one chord. A quadric F(o + t d) = A t² + 2 B t + C ≤ 0 has
//!
//!   q = −(B + sign B · √(B² − AC)),   t₁ = q / A,   t₂ = C / q
//!
//! and half-spaces n · (o + t d) ≤ k clip it at t = (k − n · o) / (n · d). The ends of all members' chords are
//! sorted along the line; where the value of the set expression changes, there is a wall. Each end carries
//! a bound on its error: walls nearer to each other than their errors are faces in common, and vanish in pairs.
//! On a cut face the material is that of the solid that cuts, the normal that solid's, reversed.
//!
//! **How exactly.** All in f64. Of a solid of size s whose origin is at c in the world, seen from o, a wall lies
//! within about 24 √3 · 2⁻⁵³ · (|o − c| + |c| + s) of the true surface, times how skew its placement's axes are: 5 nm
//! for 10⁶ m. [`light::Hit`] carries the bound of its place, the rounding to f32 included.
//!
//! **Shadows.** An opaque body lets nothing through, one with a medium what [`crate::through`] says of its walls.
//! Shadow intervals ([`light::Occlude::shadows`]) end where the shadow does: dark behind opaque bodies, to be asked for
//! behind clear ones. The plane through source and segment cuts members in conics and edges; shadows end at ways that
//! touch these or pass their corners, each confirmed by rays. To 1e-12 of the segment and the accuracy of walls; where
//! a body stands on the segment or pierces it rays cannot tell nearer than 1e-9 of the coordinates, at the tip of a
//! cone no nearer than 1e-8 of its size.
//!
//! **Where it is wrong.** Slivers and gaps thinner than that bound are not there. Lines that run *within* a face,
//! to that bound, are taken as if they ran next to it, on the same side for all faces in common. Where the
//! faces of two members coincide, the one named first in the scene gives the material.
//!
//! **Leaves out.** Texture coordinates (uv is 0), bodies that are not bounded.
//!
//! ```
//! use glam::{DAffine3, DVec3, Vec3};
//! use light::{Nearest, Ray};
//! use keikan_raytrace::solid::{Body, Node, Shape, Solids};
//!
//! let solid = |shape, world_from_solid, material| Node::Solid { shape, world_from_solid, material };
//! let ball = solid(Shape::Sphere, DAffine3::IDENTITY, 0);
//! let bore = DAffine3::from_scale(DVec3::new(0.5, 4.0, 0.5)) * DAffine3::from_translation(DVec3::Y * -0.5);
//! let ring = Node::Difference(Box::new(ball), vec![solid(Shape::Cylinder, bore, 1)]);
//! let solids = Solids::new(vec![Body { node: ring, medium: None }], 0).unwrap();
//!
//! let hit = solids.nearest(&Ray::new(Vec3::new(3.0, 0.0, 0.0), Vec3::NEG_X)).unwrap();
//! assert_eq!((hit.distance, hit.material, hit.front), (2.0, 0, true));
//! let hit = solids.nearest(&Ray::new(Vec3::ZERO, Vec3::NEG_X)).unwrap(); // in the bore
//! assert_eq!((hit.distance, hit.material, hit.front), (0.5, 1, true));
//! assert!(solids.nearest(&Ray::new(Vec3::new(0.0, 3.0, 0.0), Vec3::NEG_Y)).is_none());
//! ```

mod answers;
mod boxes;
mod build;
mod chord;
mod conic;
mod csg;
mod fan;
mod hull;
mod member;
mod node;
pub mod reference;
mod roots;
mod section;
mod shadow;
mod sheet;

use std::sync::Arc;

use glam::DVec3;
use light::{Hull, Medium};

use boxes::{Bounds, Boxes};
use csg::Compound;
pub use node::{DEEPEST, Fault, Node, Plane, Shape, Wrong};

/// A body of one medium.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// What shape it has.
    pub node: Node,
    /// What fills it, when light passes through it; none = opaque.
    pub medium: Option<Arc<Medium>>,
}

/// How bodies are searched. The answers are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Acceleration {
    /// One after the other (cases I and II of the thesis' table 2.1).
    None,
    /// By a hierarchy of bounding boxes.
    #[default]
    Boxes,
}

/// Bodies, ready for lines.
#[derive(Clone, Debug)]
pub struct Solids {
    bodies: Vec<Ready>,
    /// One or more for each body, those of a body together.
    hulls: Vec<Hull>,
    boxes: Boxes,
    acceleration: Acceleration,
    first_instance: u32,
}

/// A body with what its lines need.
#[derive(Clone, Debug)]
struct Ready {
    compound: Compound,
    medium: Option<Arc<Medium>>,
    /// Empty for a body without points.
    bounds: Bounds,
    /// Around each member.
    boxes: Vec<Bounds>,
    /// Members whose surfaces may cross, and where.
    pairs: Vec<(u32, u32, Bounds)>,
}

/// Where a line enters or leaves a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance along the line \[m\] (in lengths of its direction).
    pub t: f64,
    /// Outward unit normal of the body there.
    pub normal: DVec3,
    /// Into the body.
    pub entering: bool,
    /// Which [`light::Shade`] answers for the surface there.
    pub material: u32,
}

impl Solids {
    /// Makes bodies ready. [`light::Hit::instance`] of body i will be `first_instance` + i, and
    /// [`light::Hit::triangle`] the number of the member whose face it is, in the order of the tree.
    pub fn new(bodies: Vec<Body>, first_instance: u32) -> Result<Self, Fault> {
        build::solids(bodies, first_instance)
    }

    /// The same bodies, searched in another way.
    pub fn with(self, acceleration: Acceleration) -> Self {
        Self { acceleration, ..self }
    }

    /// How many bodies there are.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// True when there are none.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// What fills a body; none for an opaque one, and for one that is not there.
    pub fn medium(&self, body: u32) -> Option<&Arc<Medium>> {
        self.bodies.get(body as usize)?.medium.as_ref()
    }

    /// All places where the whole line (origin, direction) crosses the surface of `body`, in order, entering
    /// and leaving in turn.
    pub fn crossings(&self, body: u32, line: (DVec3, DVec3)) -> Vec<Crossing> {
        let mut crossings = Vec::new();
        if let Some(ready) = self.bodies.get(body as usize) {
            ready.compound.walls(line, |wall| {
                crossings.push(ready.compound.crossing(&wall, line));
                false
            });
        }
        crossings
    }
}
