//! Tables of water.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{PolygonTable, WaveTable, WindTable};

/// Water: everything below a level surface. One of polygon, node, material; at most one of quality, secchi, chlorophyll, and two of
/// absorption, scattering, extinction.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct WaterTable {
    /// For messages. Default `water-1`, `water-2`, …
    pub(crate) name: Option<String>,
    /// The surface: level, its corners [m] in either order seen from above. Draw it a little into the banks.
    pub(crate) polygon: Option<PolygonTable>,
    /// The surface: the node of that name in a model file, which must be level; it is not drawn itself.
    pub(crate) node: Option<String>,
    /// The surface: of the faces in the material of that name in a model file, those that lie level at the top. The others are drawn as
    /// they are: they are the bed.
    pub(crate) material: Option<String>,
    /// Name of the `[[model]]` that the node or material is in. Default: any.
    pub(crate) model: Option<String>,
    /// Which water: `clear`, which absorbs and scatters nothing, or one by name such as `pool`, `sea` or `jerlov-3C`. Default `pool`.
    pub(crate) quality: Option<String>,
    /// Which water: depth at which a white disc vanishes [m]: that of chlorophyll 100 down to 0 mg/m³, 1.4 to 208.
    pub(crate) secchi: Option<f64>,
    /// Which water: chlorophyll [mg/m³], 0 to 100.
    pub(crate) chlorophyll: Option<f64>,
    /// Absorption a: [[wavelength in nm, 1/m], …], rising.
    pub(crate) absorption: Option<Vec<[f64; 2]>>,
    /// Scattering b, likewise.
    pub(crate) scattering: Option<Vec<[f64; 2]>>,
    /// Extinction c = a + b, likewise.
    pub(crate) extinction: Option<Vec<[f64; 2]>>,
    /// Where measured water scatters light. Default `petzold`.
    pub(crate) phase: Option<PhaseTable>,
    /// Factor on its scattering, ≥ 0; what is absorbed stays. Default 1.
    pub(crate) scattering_times: Option<f64>,
    /// Index of refraction relative to air. Default: the water's own.
    #[schemars(range(min = 1.0, max = 2.0))]
    pub(crate) index: Option<f64>,
    /// Waves on its surface, up to 1024. Default none: it is flat.
    pub(crate) waves: Option<Vec<WaveTable>>,
    /// A wind that raises more of them.
    pub(crate) wind: Option<WindTable>,
    /// When the waves are looked at [s]. Default 0.
    pub(crate) moment: Option<f64>,
}

/// Where water scatters light: a name, the numbers of a formula, or a table.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected \"petzold\", \"molecular\", \"thesis\", { forward, backward }, { index, slope } or [[degrees, value], …]"
)]
pub(crate) enum PhaseTable {
    /// `petzold`, `molecular` or `thesis`.
    Named(String),
    /// Beardsley and Zaneveld (thesis A.2): e_f and e_b, both from 0 to 0.9999.
    BeardsleyZaneveld {
        /// e_f.
        forward: f64,
        /// e_b.
        backward: f64,
    },
    /// Fournier and Forand.
    FournierForand {
        /// Index of the particles relative to water, 1.01 to 1.35.
        index: f64,
        /// Slope of their sizes, 3.3 to 4.9.
        slope: f64,
    },
    /// Scattering angle [degrees], rising within 0 to 180, and value in any unit, above 0.
    Table(Vec<[f64; 2]>),
}
