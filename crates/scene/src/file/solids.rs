//! Tables of curved solids, convex polyhedra and set operations.

use schemars::JsonSchema;
use serde::Deserialize;

use super::OneOrThree;
use super::placed::{BoxTable, PrismTable};

/// A body with exact curved faces. Exactly one of sphere, cylinder, cone, frustum, prism, box, polyhedron, union,
/// intersection, difference.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SolidTable {
    /// By which set operations refer to it. Default `solid-1`, `solid-2`, …
    pub(crate) name: Option<String>,
    /// A ball around its position.
    pub(crate) sphere: Option<SphereTable>,
    /// A cylinder that stands on its position.
    pub(crate) cylinder: Option<RoundTable>,
    /// A cone that stands on its position, apex up.
    pub(crate) cone: Option<RoundTable>,
    /// A truncated cone that stands on its position.
    pub(crate) frustum: Option<FrustumTable>,
    /// A regular prism that stands on its position.
    pub(crate) prism: Option<PrismTable>,
    /// A box that stands on its position.
    #[serde(rename = "box")]
    pub(crate) cuboid: Option<BoxTable>,
    /// The convex polyhedron of its corners.
    pub(crate) polyhedron: Option<PolyhedronTable>,
    /// Names of solids: what is in any of them.
    pub(crate) union: Option<Vec<String>>,
    /// Names of solids: what is in all of them.
    pub(crate) intersection: Option<Vec<String>>,
    /// Names of solids: what is in the first and in none of the others.
    pub(crate) difference: Option<Vec<String>>,
    /// Name of a `[[material]]`; of an operation: for its members that name none. Default: a grey of 0.5.
    pub(crate) material: Option<String>,
    /// Where its origin goes [m]. Default [0, 0, 0].
    pub(crate) position: Option<[f64; 3]>,
    /// Degrees: one number turns about the vertical; [x, y, z] turns first about z, then x, then y. Default 0.
    pub(crate) rotation: Option<OneOrThree>,
    /// Factor on its size, or one for each axis; not 0. Default 1.
    pub(crate) scale: Option<OneOrThree>,
    /// True = not drawn itself, as are those that an operation uses. Default false.
    pub(crate) hidden: bool,
}

/// A ball.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereTable {
    /// [m], > 0.
    pub(crate) radius: f64,
}

/// A cylinder or cone.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RoundTable {
    /// Of the base [m], > 0.
    pub(crate) radius: f64,
    /// Along y [m], > 0.
    pub(crate) height: f64,
}

/// A truncated cone.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FrustumTable {
    /// Radius at its position [m], > 0.
    pub(crate) bottom: f64,
    /// Radius at `height` [m], > 0.
    pub(crate) top: f64,
    /// Along y [m], > 0.
    pub(crate) height: f64,
}

/// A convex polyhedron.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PolyhedronTable {
    /// Its corners [m] in any order, 4 to 128; each must be a corner of the whole or lie on its surface.
    pub(crate) points: Vec<[f64; 3]>,
}
