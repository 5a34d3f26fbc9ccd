//! Trees as data: kinds, and where each stands.

use std::sync::Arc;

use glam::DVec3;
use light::bands::BANDS;
use serde::{Deserialize, Serialize};

/// Trees of one table, of one species.
#[derive(Clone, Debug)]
pub struct Trees {
    /// What kind.
    pub species: TreeSpecies,
    /// Each of them.
    pub placed: Vec<PlacedTree>,
    /// How high they are \[m\] but for their own factors; none = as the species was made.
    pub height: Option<f64>,
    /// Whether they stand on what is below or above their positions.
    pub on_ground: bool,
}

/// Where a tree stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedTree {
    /// Its foot in the world \[m\].
    pub position: DVec3,
    /// Factor on the height, > 0.
    pub scale: f32,
    /// About its axis \[rad\].
    pub rotation: f32,
}

/// A kind of tree.
#[derive(Clone, Debug)]
pub enum TreeSpecies {
    /// One that comes with the program, by name.
    Named(String),
    /// One with pictures of its own.
    Pictured(Arc<PicturedTree>),
}

/// A species as its folder has it; lengths in metres of the tree as it was made.
#[derive(Clone, Debug, PartialEq)]
pub struct PicturedTree {
    /// The folder, for messages.
    pub name: String,
    /// Height of the tree and of the side view \[m\].
    pub height: f64,
    /// Half the width of the side view and of every slice \[m\].
    pub half_width: f64,
    /// Height of each picture's plane \[m\] (none = the side view, which is the first), and the picture.
    pub pictures: Vec<(Option<f64>, TreePicture)>,
    /// Outline of the crown.
    pub envelope: TreeEnvelope,
    /// Length of a leaf \[m\].
    pub leaf: f64,
    /// Mean reflectance of leaves per band; none = as pictured.
    pub reflectance: Option<[f64; BANDS]>,
    /// Share of light that a leaf lets through, per band.
    pub transmittance: [f64; BANDS],
    /// a of thesis eq. 5.6.
    pub scatter: f64,
    /// How much leaves turn to the sky.
    pub lean: f64,
    /// Share of light that leaves stop \[1/m\]; none = fitted to the side view.
    pub extinction: Option<f64>,
    /// How much more leaves in clumps shade each other.
    pub shelter: f64,
    /// Decides everything random.
    pub seed: u32,
}

/// The outline of a crown, a surface of revolution.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(
    untagged,
    expecting = "envelope must be rows of [height, radius], or { shape = \"ellipsoid\", \"pencil\" or \"inverted-cone\", base, top, radius }"
)]
pub enum TreeEnvelope {
    /// Through (height, radius) \[m\].
    Knots(Vec<[f64; 2]>),
    /// By the name of its shape.
    Shape(ShapedEnvelope),
}

/// An outline by the name of its shape.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ShapedEnvelope {
    /// Its shape.
    pub shape: CrownShape,
    /// Height of its lowest point \[m\].
    pub base: f64,
    /// Height of its highest point \[m\]; none = as high as the tree.
    pub top: Option<f64>,
    /// Its largest radius \[m\].
    pub radius: f64,
}

/// Shapes of crowns (thesis 5.3.1).
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CrownShape {
    /// An ellipsoid about the axis.
    Ellipsoid,
    /// A column with a pointed top.
    Pencil,
    /// A cone that stands on its tip.
    InvertedCone,
}

/// A picture of a tree without background.
#[derive(Clone, Debug, PartialEq)]
pub struct TreePicture {
    /// Texels in a row, and rows.
    pub size: [u32; 2],
    /// sRGB with straight alpha, row by row from the top.
    pub texels: Vec<[u8; 4]>,
    /// 255 where leaves show, 0 where wood does; empty = leaves everywhere.
    pub leaves: Vec<u8>,
}
