//! Tables of trees.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;

use super::PolygonTable;

/// Trees of one species. One of position, positions, file, points, polygon.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct TreeTable {
    /// One that comes with the program (`broadleaf`, `zelkova`, `poplar`, `spruce`), or a folder with a `tree.toml`, relative to this file.
    pub(crate) species: Option<String>,
    /// Where its foot is [m].
    pub(crate) position: Option<[f64; 3]>,
    /// Where the feet of several are [m].
    pub(crate) positions: Option<Vec<[f64; 3]>>,
    /// The same in a text file (XYZ or CSV: east, north, height), relative to this file.
    pub(crate) file: Option<PathBuf>,
    /// Those of a GeoJSON file, relative to this file: points with the properties height [m], species and rotation [degrees].
    pub(crate) points: Option<PathBuf>,
    /// What the coordinates of points are. Default: longitude and latitude if there is a [site] and the file names no other system; else metres.
    pub(crate) coordinates: Option<Coordinates>,
    /// Scattered over a level polygon.
    pub(crate) polygon: Option<PolygonTable>,
    /// Between scattered trees, on average [m], > 0. Default: two thirds of their height.
    pub(crate) spacing: Option<f64>,
    /// How high they are [m], > 0. Default: as the species was made.
    pub(crate) height: Option<f64>,
    /// By how much heights differ, as a share, each way. Default 0; of scattered trees 0.2.
    #[schemars(range(min = 0.0, max = 0.9))]
    pub(crate) variation: Option<f64>,
    /// Degrees by which they are turned about their axes. Default: each by its own.
    pub(crate) rotation: Option<f64>,
    /// Whether they stand on what is below (or above) their positions, whatever height these have. Default false.
    pub(crate) ground: Option<bool>,
    /// Decides what is random. Default 1.
    pub(crate) seed: Option<u32>,
}

/// What the coordinates of a GeoJSON file are.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Coordinates {
    /// Longitude and latitude; the site is the origin of the scene file's coordinates.
    Degrees,
    /// East and north in the scene file's coordinates: x and −z.
    Metres,
}
