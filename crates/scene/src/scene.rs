//! The scene as data.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DMat3, DVec3, Vec3};
use light::{Distribution, Geometry, Projection};

use crate::{CameraPath, Daylight, Material, SkyTable, Solid, Trees, Warning, Water, Weather};

/// Everything a picture or a calculation needs, checked.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Place, time and north.
    pub site: Site,
    /// Subtracted from all coordinates of the files: world + origin = file coordinates \[m\].
    pub origin: DVec3,
    /// All triangles.
    pub geometry: Arc<Geometry>,
    /// Curved solids and set operations that are seen.
    pub solids: Vec<Solid>,
    /// Bodies of water.
    pub waters: Vec<Water>,
    /// Trees, by table.
    pub trees: Vec<Trees>,
    /// By the index that meshes and solids carry.
    pub materials: Vec<Material>,
    /// Lamps that are points; the names of all lamps differ, and none is `sun`, `sky`, `interreflected` or `emission`.
    pub lights: Vec<Light>,
    /// Lamps that have an extent.
    pub area_lights: Vec<AreaLight>,
    /// The sun, also while it is below the horizon; none = switched off, or neither placed nor timed.
    pub sun: Option<Sun>,
    /// What lights the scene from all around, if anything.
    pub sky: Option<Sky>,
    /// At least one; their names differ.
    pub cameras: Vec<Camera>,
    /// Where lux are asked for; their names differ.
    pub sensors: Vec<Sensor>,
    /// Stage names and knobs, as given: `"visibility"` → `"rays"`, `"sub-scanlines"` → `"8"`.
    pub settings: BTreeMap<String, String>,
    /// What was repaired on the way.
    pub warnings: Vec<Warning>,
    /// How sun and sky follow from the time.
    pub(crate) daylight: Daylight,
}

/// Place, time, north.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// Degrees, north +, within \[−90, 90\].
    pub latitude: f64,
    /// Degrees, EAST +, within \[−180, 180\].
    pub longitude: f64,
    /// Height above the sea \[m\].
    pub elevation: f64,
    /// ISO-8601 with offset.
    pub time: jiff::Timestamp,
    /// Offset of the local clock from UTC \[s\].
    pub offset: jiff::tz::Offset,
    /// Degrees clockwise from −Z (seen from above) to true north; 0 = north is −Z.
    pub north: f64,
}

/// A lamp.
#[derive(Clone, Debug)]
pub struct Light {
    /// Its name, or `light-3`.
    pub name: String,
    /// World \[m\].
    pub position: DVec3,
    /// From the lamp's frame (axis −Z, C0 at +X) to the world.
    pub world_from_light: DMat3,
    /// Intensity over direction \[cd\], all multipliers applied.
    pub distribution: Arc<Distribution>,
    /// What colour.
    pub spectrum: LightSpectrum,
}

/// A lamp with an extent: Lambertian, of the same luminance everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaLight {
    /// Its name, or `light-3`.
    pub name: String,
    /// Its middle in the world \[m\].
    pub position: DVec3,
    /// From the lamp's frame (axis −Z, width along +X, height along +Y) to the world.
    pub world_from_light: DMat3,
    /// What shines.
    pub shape: AreaShape,
    /// Luminance \[cd/m²\], the multiplier applied.
    pub luminance: f64,
    /// What colour.
    pub spectrum: LightSpectrum,
    /// Index of the material whose face shows it: what that emits is the lamp's own light, not more of it. None where it is not seen.
    pub face: Option<u32>,
}

/// The shape of a lamp with an extent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaShape {
    /// Shines along the axis (−Z) only.
    Rectangle {
        /// Width along +X and height along +Y \[m\], > 0.
        size: [f64; 2],
    },
    /// Shines outwards.
    Sphere {
        /// Radius \[m\], > 0.
        radius: f64,
    },
}

impl AreaShape {
    /// Area that shines \[m²\].
    pub fn area(&self) -> f64 {
        match *self {
            Self::Rectangle { size: [width, height] } => width * height,
            Self::Sphere { radius } => 4.0 * std::f64::consts::PI * radius * radius,
        }
    }
}

/// The colour of a light; its amount stands elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub enum LightSpectrum {
    /// Correlated colour temperature \[K\], within \[1000, 25000\].
    Temperature(f64),
    /// Linear sRGB.
    Rgb(Vec3),
    /// (wavelength \[nm\], relative power), rising.
    Table(Vec<(f64, f64)>),
}

/// The sun. It shines only while some of its disc is above the horizon: altitude > −diameter / 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector towards it.
    pub toward: DVec3,
    /// Degrees above the horizon, refraction included where it was computed from a date; negative at night.
    pub altitude: f64,
    /// Degrees clockwise from true north.
    pub azimuth: f64,
    /// Illuminance facing it while it is up \[lx\]; none = what the atmosphere lets through.
    pub illuminance: Option<f64>,
    /// Colour; none = what the atmosphere lets through.
    pub spectrum: Option<LightSpectrum>,
    /// Diameter of the disc in degrees; 0 = a point.
    pub diameter: f64,
}

/// What lights from all around.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Name of the model: `clear`, `overcast`, `uniform`, `measured`, …; `cli` knows which exist.
    pub model: String,
    /// Horizontal diffuse illuminance \[lx\]; none = the model's own.
    pub illuminance: Option<f64>,
    /// What was observed at this time of the year, if the file names a weather file.
    pub weather: Option<Weather>,
    /// What was measured, if the file names a table; the model is then `measured`.
    pub table: Option<Arc<SkyTable>>,
}

/// An eye.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Its name, or `camera-1`.
    pub name: String,
    /// World \[m\].
    pub position: DVec3,
    /// Columns: right, up, backward.
    pub world_from_camera: DMat3,
    /// How it projects.
    pub projection: Projection,
    /// Width / height, if the file states one.
    pub aspect: Option<f64>,
    /// Nearest visible depth \[m\].
    pub near: f64,
    /// Where it goes, if it moves; the rest is how it stands at the path's beginning ([`Camera::at`]).
    pub path: Option<CameraPath>,
}

/// Points at which illuminance is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Its name, or `sensor-1`.
    pub name: String,
    /// World \[m\], in the order of the rows of the answer.
    pub points: Vec<DVec3>,
    /// Unit normal of the receiving plane.
    pub normal: DVec3,
}
