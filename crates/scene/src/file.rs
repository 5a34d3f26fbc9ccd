//! The scene file as it is written: tables and keys, nothing checked beyond their types.
//!
//! The doc comments here are the descriptions of the JSON Schema; `docs/scene-file.md` explains by example.

mod placed;
mod seen;
mod solids;
mod tree;
mod values;
mod water;
mod waves;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

pub(crate) use placed::{
    ConeTable, LightTable, MaterialTable, ModelTable, PolygonTable, PrismTable, TerrainTable,
};
pub(crate) use seen::{
    CameraTable, Ease, GridTable, KeyTable, LineTable, SensorTable, SiteTable, SkyTable, SunTable,
};
pub(crate) use solids::SolidTable;
pub(crate) use tree::{Coordinates, TreeTable};
pub(crate) use values::{Colour, Moment, OneOrThree, Setting};
pub(crate) use water::{PhaseTable, WaterTable};
pub(crate) use waves::{WaveTable, WindTable};

/// A scene of keikan. Lengths in metres, angles in degrees, +Y up, north is −Z unless `[site] north` says otherwise.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "keikan scene file")]
pub(crate) struct SceneFile {
    /// Place, time and north. With a `time`, sun and sky shine by default.
    pub(crate) site: Option<SiteTable>,
    /// Named surfaces for inline geometry.
    pub(crate) material: Vec<MaterialTable>,
    /// Models: glTF files or inline geometry, placed.
    pub(crate) model: Vec<ModelTable>,
    /// Lamps.
    pub(crate) light: Vec<LightTable>,
    /// The sun, if not simply the one of place and time.
    pub(crate) sun: Option<SunTable>,
    /// What lights from all around.
    pub(crate) sky: Option<SkyTable>,
    /// Eyes.
    pub(crate) camera: Vec<CameraTable>,
    /// Where illuminance is asked for.
    pub(crate) sensor: Vec<SensorTable>,
    /// Stage names and knobs; nested tables are joined with dots.
    pub(crate) settings: BTreeMap<String, Setting>,
    /// Curved solids, convex polyhedra and set operations of them.
    pub(crate) solid: Vec<SolidTable>,
    /// Bodies of water, by their surface.
    pub(crate) water: Vec<WaterTable>,
    /// Trees.
    pub(crate) tree: Vec<TreeTable>,
}
