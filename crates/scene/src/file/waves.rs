//! Tables of what moves a water's surface.

use schemars::JsonSchema;
use serde::Deserialize;

/// A wave on a water.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WaveTable {
    /// Half of its height, nearly [m], ≥ 0.
    pub(crate) amplitude: f64,
    /// From crest to crest [m], > 0.
    pub(crate) wavelength: f64,
    /// Where it runs to, degrees clockwise from true north. Default 0.
    #[serde(default)]
    pub(crate) direction: f64,
    /// Degrees by which its crest is late at the origin of the file. Default 0.
    #[serde(default)]
    pub(crate) phase: f64,
}

/// A steady wind over a water, for the waves that it raises.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WindTable {
    /// At 10 m above the water [m/s], > 0.
    pub(crate) speed: f64,
    /// How far it has blown over water [m], > 0.
    pub(crate) fetch: f64,
    /// Where it blows from, degrees clockwise from true north. Default 0.
    #[serde(default)]
    pub(crate) direction: f64,
    /// Of the water [m]; default deep.
    pub(crate) depth: Option<f64>,
    /// How many waves stand for all. Default 48.
    #[schemars(range(min = 1, max = 1024))]
    pub(crate) waves: Option<u32>,
    /// Chooses among seas that are alike. Default: by the water's name.
    pub(crate) seed: Option<u32>,
}
