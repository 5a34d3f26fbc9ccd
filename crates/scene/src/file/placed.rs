//! Tables of things that stand in the scene: materials, models, lamps.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;

use super::{Colour, OneOrThree};

/// What a surface is made of. In `[model.materials.NAME]`, keys that are left out keep what the file says.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct MaterialTable {
    /// Its name; required in `[[material]]`, not allowed in `[model.materials.NAME]`.
    pub(crate) name: Option<String>,
    /// Diffuse reflectance (of a metal: its colour). Replaces a texture. Default 0.5.
    pub(crate) colour: Option<Colour>,
    /// 0 = dielectric, 1 = metal. Default 0.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(crate) metallic: Option<f64>,
    /// 0 = mirror, 1 = matt. Default 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(crate) roughness: Option<f64>,
    /// Share of light that passes through. Default 0.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(crate) transmission: Option<f64>,
    /// Index of refraction. Default 1.5; but a material that states none of ior, metallic, transmission and a
    /// roughness below 1 is matt, and reflects its colour and nothing else.
    #[schemars(range(min = 1.0, max = 10.0))]
    pub(crate) ior: Option<f64>,
    /// What is left of white light after `attenuation_distance` inside a transparent body.
    pub(crate) attenuation_colour: Option<Colour>,
    /// [m], > 0; makes the thing a body filled with a medium instead of a thin pane.
    pub(crate) attenuation_distance: Option<f64>,
    /// Luminance [cd/m²], one number or per linear sRGB channel. Default 0.
    pub(crate) emission: Option<OneOrThree>,
    /// Share of light transmitted diffusely (leaves, paper). Default 0.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub(crate) diffuse_transmission: Option<f64>,
    /// Its colour. Default white.
    pub(crate) diffuse_transmission_colour: Option<Colour>,
}

/// A glTF file or inline geometry, placed. Exactly one of file, box, prism, plane, polygon, terrain.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct ModelTable {
    /// For messages. Default `model-1`, `model-2`, …
    pub(crate) name: Option<String>,
    /// A `.gltf` or `.glb` file, relative to this file.
    pub(crate) file: Option<PathBuf>,
    /// A box that stands on its position.
    #[serde(rename = "box")]
    pub(crate) cuboid: Option<BoxTable>,
    /// A regular prism that stands on its position.
    pub(crate) prism: Option<PrismTable>,
    /// A horizontal rectangle around its position, facing up.
    pub(crate) plane: Option<PlaneTable>,
    /// A flat face, concave and with holes as you like.
    pub(crate) polygon: Option<PolygonTable>,
    /// A surface through scattered points.
    pub(crate) terrain: Option<TerrainTable>,
    /// Name of a `[[material]]`; for inline geometry only. Default: a grey of 0.5.
    pub(crate) material: Option<String>,
    /// Where its origin goes [m]. Default [0, 0, 0].
    pub(crate) position: Option<[f64; 3]>,
    /// Degrees: one number turns about the vertical; [x, y, z] turns first about z, then x, then y. Default 0.
    pub(crate) rotation: Option<OneOrThree>,
    /// Factor on its size, or one for each axis; not 0. Default 1.
    pub(crate) scale: Option<OneOrThree>,
    /// Changes to the file's materials, by their names in it.
    pub(crate) materials: BTreeMap<String, MaterialTable>,
}

/// A box.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxTable {
    /// Along x, y (height) and z [m], > 0.
    pub(crate) size: [f64; 3],
}

/// A regular prism.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PrismTable {
    /// Corners of its base; the first lies at +x.
    #[schemars(range(min = 3, max = 64))]
    pub(crate) sides: u32,
    /// From the axis to the corners [m], > 0.
    pub(crate) radius: f64,
    /// Along y [m], > 0.
    pub(crate) height: f64,
}

/// A horizontal rectangle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneTable {
    /// Along x and z [m], > 0.
    pub(crate) size: [f64; 2],
}

/// A flat face.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PolygonTable {
    /// Corners [m], counter-clockwise seen from its front, in one plane.
    pub(crate) points: Vec<[f64; 3]>,
    /// Corners of holes.
    #[serde(default)]
    pub(crate) holes: Vec<Vec<[f64; 3]>>,
}

/// A surface through points. Exactly one of file, points.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct TerrainTable {
    /// A text file, relative to this file: east, north and height of a point [m] on each line.
    pub(crate) file: Option<PathBuf>,
    /// The points [x, y (height), z] [m].
    pub(crate) points: Option<Vec<[f64; 3]>>,
}

/// A lamp. One of intensity, flux, file; a file may be scaled to a flux. With rectangle or sphere, one of
/// luminance, flux.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct LightTable {
    /// Default `light-1`, `light-2`, …
    pub(crate) name: Option<String>,
    /// Where [m]. Required.
    pub(crate) position: Option<[f64; 3]>,
    /// Luminous intensity [cd]: in every direction, or along the axis of a `cone`.
    pub(crate) intensity: Option<f64>,
    /// Luminous flux [lm].
    pub(crate) flux: Option<f64>,
    /// Photometry: an IES (LM-63) or EULUMDAT file, relative to this file.
    pub(crate) file: Option<PathBuf>,
    /// Factor on the amount, ≥ 0 (dimming, maintenance). Default 1.
    pub(crate) multiplier: Option<f64>,
    /// Confines the light to a cone.
    pub(crate) cone: Option<ConeTable>,
    /// A luminous rectangle about its position that shines along the axis.
    pub(crate) rectangle: Option<RectangleTable>,
    /// A luminous sphere about its position.
    pub(crate) sphere: Option<LuminousSphereTable>,
    /// Of a rectangle or sphere [cd/m²].
    pub(crate) luminance: Option<f64>,
    /// A point that the axis goes through [m].
    pub(crate) aim: Option<[f64; 3]>,
    /// Instead of `aim`: where the axis goes. Default [0, −1, 0], straight down.
    pub(crate) direction: Option<[f64; 3]>,
    /// Degrees by which the lamp is turned about its axis, clockwise for who looks along it. Default 0.
    pub(crate) roll: Option<f64>,
    /// Correlated colour temperature [K].
    #[schemars(range(min = 1000.0, max = 25000.0))]
    pub(crate) temperature: Option<f64>,
    /// Colour in linear sRGB, only its hue and saturation count.
    pub(crate) rgb: Option<[f64; 3]>,
    /// Relative power: [[wavelength in nm, power], …], rising.
    pub(crate) spectrum: Option<Vec<[f64; 2]>>,
}

/// A luminous rectangle.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RectangleTable {
    /// Width and height [m], > 0: along +X and towards −Z for a lamp that looks straight down without roll.
    pub(crate) size: [f64; 2],
}

/// A luminous sphere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LuminousSphereTable {
    /// [m], > 0.
    pub(crate) radius: f64,
}

/// A cone of light, as glTF defines it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConeTable {
    /// Angle from the axis up to which the intensity is whole [°]. Default 0.
    #[serde(default)]
    pub(crate) inner: f64,
    /// Angle from the axis at which it has faded to 0 [°], within (inner, 90].
    pub(crate) outer: f64,
}
