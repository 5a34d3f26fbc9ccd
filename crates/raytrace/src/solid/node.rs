//! Solids and set operations as a scene gives them, and what may be wrong with them.

use std::fmt;

use glam::{DAffine3, DVec3};

/// Nested deeper than this, a set operation is refused: no picture needs it, and evaluation recurses.
pub const DEEPEST: usize = 64;

/// A half-space: all points x with normal · x ≤ offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Outward normal, of any length but 0.
    pub normal: DVec3,
    /// Distance of the plane from the origin, times the normal's length.
    pub offset: f64,
}

/// A convex solid in coordinates of its own, closed (capped) on all sides.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Radius 1 about the origin.
    Sphere,
    /// Radius 1 about the y axis, from y = 0 to y = 1.
    Cylinder,
    /// Base of radius 1 on y = 0, apex on the y axis at y = 1.
    Cone,
    /// Base of radius 1 on y = 0, top of radius `top` on y = 1.
    Frustum {
        /// Radius of the top ÷ radius of the base, ≥ 0.
        top: f64,
    },
    /// All that lies in every one of these half-spaces; bounded, not empty.
    Polyhedron(Vec<Plane>),
}

impl Shape {
    /// The unit cube \[−1, 1\]³.
    pub fn cube() -> Self {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        Self::Polyhedron(
            axes.iter().flat_map(|&n| [n, -n]).map(|normal| Plane { normal, offset: 1.0 }).collect(),
        )
    }
}

/// A solid, or a set of points made of solids.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// One placed solid.
    Solid {
        /// What it is.
        shape: Shape,
        /// From the shape's coordinates to the world \[m\]; invertible, mirrored ones included.
        world_from_solid: DAffine3,
        /// Which [`light::Shade`] answers for its surface, and for what it cuts out of others.
        material: u32,
    },
    /// What lies in any of them.
    Union(Vec<Node>),
    /// What lies in all of them; at least one.
    Intersection(Vec<Node>),
    /// What lies in the first but in none of the others.
    Difference(Box<Node>, Vec<Node>),
}

/// What is wrong with a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// The placement has no inverse or is not finite.
    Placement,
    /// The frustum's ratio of radii is negative or not finite.
    Top,
    /// A half-space of a polyhedron has no direction or is not finite.
    Plane,
    /// A polyhedron's half-spaces leave it open to infinity.
    Unbounded,
    /// A polyhedron's half-spaces have no volume in common.
    Empty,
    /// An intersection of nothing would be everything.
    NoMembers,
    /// Nested deeper than [`DEEPEST`].
    TooDeep,
}

/// A body that cannot be built.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Which body.
    pub body: usize,
    /// The way to the node: which member at each level. In a difference 0 is what is cut, 1 the first cutter.
    pub path: Vec<usize>,
    /// What is wrong with it.
    pub wrong: Wrong,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "body {}", self.body)?;
        for (depth, member) in self.path.iter().enumerate() {
            write!(f, "{}{member}", if depth == 0 { ", member " } else { "." })?;
        }
        f.write_str(match self.wrong {
            Wrong::Placement => ": the placement cannot be inverted",
            Wrong::Top => ": the top of a truncated cone must be a finite ratio ≥ 0",
            Wrong::Plane => ": a half-space needs a finite normal other than 0 and a finite offset",
            Wrong::Unbounded => ": the half-spaces do not close the polyhedron",
            Wrong::Empty => ": the half-spaces have no volume in common",
            Wrong::NoMembers => ": an intersection needs at least one member",
            Wrong::TooDeep => ": set operations are nested too deep",
        })
    }
}

impl std::error::Error for Fault {}
