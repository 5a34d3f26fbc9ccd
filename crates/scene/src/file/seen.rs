//! Tables of place, time and what is asked: site, sun, sky, cameras, sensors.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;

use super::Moment;

/// Place, time, north.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SiteTable {
    /// Degrees, north positive. Required, but with a weather file: then the station's.
    #[schemars(range(min = -90.0, max = 90.0))]
    pub(crate) latitude: Option<f64>,
    /// Degrees, EAST positive. Required, but with a weather file: then the station's.
    #[schemars(range(min = -180.0, max = 180.0))]
    pub(crate) longitude: Option<f64>,
    /// Height above the sea [m]. Default 0, or the station's if its place is taken over.
    #[schemars(range(min = -500.0, max = 9000.0))]
    pub(crate) elevation: Option<f64>,
    /// ISO-8601 with offset: `2026-06-21T10:00:00+09:00`. With it, the sun shines by default.
    pub(crate) time: Option<Moment>,
    /// Degrees clockwise from −Z (seen from above) to true north. Default 0.
    pub(crate) north: Option<f64>,
}

/// The sun.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SunTable {
    /// No sun at all. Default false.
    pub(crate) off: bool,
    /// Degrees above the horizon; with `azimuth` instead of place and time.
    #[schemars(range(min = -90.0, max = 90.0))]
    pub(crate) altitude: Option<f64>,
    /// Degrees clockwise from true north.
    pub(crate) azimuth: Option<f64>,
    /// Illuminance facing the sun [lx]. Default: what the atmosphere lets through.
    pub(crate) illuminance: Option<f64>,
    /// Correlated colour temperature [K].
    #[schemars(range(min = 1000.0, max = 25000.0))]
    pub(crate) temperature: Option<f64>,
    /// Colour in linear sRGB, only its hue and saturation count.
    pub(crate) rgb: Option<[f64; 3]>,
    /// Relative power: [[wavelength in nm, power], …], rising.
    pub(crate) spectrum: Option<Vec<[f64; 2]>>,
    /// Of the disc, degrees; 0 = a point. Default 0.533.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub(crate) diameter: Option<f64>,
}

/// What lights from all around.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(crate) struct SkyTable {
    /// No sky at all. Default false.
    pub(crate) off: bool,
    /// `clear`, `overcast`, `uniform`, …: `keikan plan` lists them. Default `clear`.
    pub(crate) model: Option<String>,
    /// Horizontal diffuse illuminance [lx]. Default: the model's own.
    pub(crate) illuminance: Option<f64>,
    /// An EnergyPlus weather file (`.epw`), relative to this file; needs a `[site] time`.
    pub(crate) weather: Option<PathBuf>,
    /// Measured luminances by altitude and azimuth (CSV as `keikan sky --table` writes it), relative to this file;
    /// instead of `model` and `weather`.
    pub(crate) table: Option<PathBuf>,
    /// Further keys are handed to the model as settings `sky.KEY`.
    #[serde(flatten)]
    pub(crate) more: std::collections::BTreeMap<String, super::Setting>,
}

/// An eye. It looks at `target` or along `direction`; one of field_of_view, focal_length, orthographic.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct CameraTable {
    /// Default `camera-1`, `camera-2`, …
    pub(crate) name: Option<String>,
    /// Where [m]. Required.
    pub(crate) position: Option<[f64; 3]>,
    /// The point in the middle of the picture [m].
    pub(crate) target: Option<[f64; 3]>,
    /// Instead of `target`: where it looks.
    pub(crate) direction: Option<[f64; 3]>,
    /// What is up in the picture. Default [0, 1, 0]; looking straight up or down: [0, 0, −1].
    pub(crate) up: Option<[f64; 3]>,
    /// Vertical, degrees. Default 40.
    pub(crate) field_of_view: Option<f64>,
    /// [mm] on a frame of 36 × 24 mm: 28 sees 46.4° vertically.
    pub(crate) focal_length: Option<f64>,
    /// Parallel projection: height of the picture in the scene [m].
    pub(crate) orthographic: Option<f64>,
    /// Width / height. Default: that of the picture asked for.
    pub(crate) aspect: Option<f64>,
    /// Nothing nearer than this is seen [m]. Default 0.01.
    pub(crate) near: Option<f64>,
    /// Where it goes, in place of `position`: keys in the order of their times.
    pub(crate) path: Option<Vec<KeyTable>>,
    /// How it goes from key to key. Default `smooth`.
    pub(crate) ease: Option<Ease>,
}

/// How a camera goes from key to key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Ease {
    /// On a curve without kinks, without jumps of speed.
    #[default]
    Smooth,
    /// Straight, at an even speed between two keys.
    Linear,
}

/// Where a camera is at a time.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct KeyTable {
    /// Seconds from the beginning; may be negative.
    pub(crate) time: f64,
    /// Where [m].
    pub(crate) position: [f64; 3],
    /// The point in the middle of the picture [m]. Default: the camera's `target` or `direction`.
    #[serde(default)]
    pub(crate) target: Option<[f64; 3]>,
    /// Vertical, degrees. Default: the camera's.
    #[serde(default)]
    pub(crate) field_of_view: Option<f64>,
}

/// Points at which illuminance is asked for. Exactly one of points, line, grid.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SensorTable {
    /// Default `sensor-1`, `sensor-2`, …
    pub(crate) name: Option<String>,
    /// The points [m].
    pub(crate) points: Option<Vec<[f64; 3]>>,
    /// Equally spaced points, both ends included.
    pub(crate) line: Option<LineTable>,
    /// The middles of the cells of a parallelogram.
    pub(crate) grid: Option<GridTable>,
    /// Which way the receiving plane faces. Default [0, 1, 0], upwards.
    pub(crate) normal: Option<[f64; 3]>,
}

/// Points on a line.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LineTable {
    /// First point [m].
    pub(crate) from: [f64; 3],
    /// Last point [m].
    pub(crate) to: [f64; 3],
    /// How many, ≥ 2.
    pub(crate) count: u32,
}

/// Points in the middles of nu × nv cells; u runs fastest.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GridTable {
    /// A corner [m].
    pub(crate) origin: [f64; 3],
    /// Along the whole first side [m].
    pub(crate) u: [f64; 3],
    /// Along the whole second side [m].
    pub(crate) v: [f64; 3],
    /// Cells along u and v, ≥ 1.
    pub(crate) counts: [u32; 2],
}
