//! Lamps and suns: KHR_lights_punctual and EXT_lights_ies.

use std::path::{Path, PathBuf};

use glam::{DAffine3, Vec3};
use gltf::json::extensions::scene::khr_lights_punctual::{Light, Type};
use gltf::json::validation;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::document::{Document, item};
use super::fault::{Checked, Fault, Notes};
use super::nodes::Placement;
use super::resource::{self, Resource};

/// A light that the model brings along; its numbers are the file's own.
#[derive(Clone, Debug, PartialEq)]
pub struct PunctualLight {
    /// Name of the node, else of the light, else "".
    pub name: String,
    /// What it is.
    pub kind: PunctualKind,
    /// Linear sRGB, each ≥ 0.
    pub colour: Vec3,
    /// Point and spot \[cd\], directional \[lx\]; with `ies` a factor on the profile. ≥ 0.
    pub intensity: f64,
    /// Where it is; it shines along −Z.
    pub placement: Placement,
    /// Intensity over direction; its zero direction (γ = 0) is −Z.
    pub ies: Option<IesProfile>,
}

/// How a light spreads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PunctualKind {
    /// The same in all directions (unless it has a profile).
    Point,
    /// Within a cone about −Z; half angles \[rad\], 0 ≤ inner < outer ≤ π/2.
    Spot {
        /// Full intensity up to here.
        inner: f64,
        /// None from here on.
        outer: f64,
    },
    /// Parallel light from infinity.
    Directional,
}

/// Where the photometry is (EXT_lights_ies).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IesProfile {
    /// A file below the model's folder, not opened yet.
    File(PathBuf),
    /// The text itself.
    Embedded(Vec<u8>),
}

/// A light with what it takes from its node.
struct Spot<'a> {
    name: Option<&'a str>,
    placement: Placement,
    user: &'a str,
}

/// The light of a node, if it has one. A profile (EXT_lights_ies) wins over the punctual light that files
/// carry beside it for readers without profiles.
pub(super) fn light(
    document: &Document<'_>,
    node: usize,
    world: &DAffine3,
    notes: &mut Notes,
) -> Checked<Option<PunctualLight>> {
    let place = format!("/nodes/{node}/extensions");
    let node = item(&document.root.nodes, node, "nodes", &place)?;
    let Some(extensions) = &node.extensions else { return Ok(None) };
    let profile = extensions.others.get("EXT_lights_ies");
    let punctual = extensions.khr_lights_punctual.as_ref();
    if profile.is_none() && punctual.is_none() {
        return Ok(None);
    }
    let Some(placement) = Placement::of(world) else {
        notes.add("a light's node is scaled to nothing; it is left out", 1, &place);
        return Ok(None);
    };
    let spot = Spot { name: node.name.as_deref(), placement, user: &place };
    match (profile, punctual) {
        (Some(profile), _) => with_profile(document, profile, &spot).map(Some),
        (None, Some(punctual)) => {
            let lights = document.root.extensions.as_ref().and_then(|root| root.khr_lights_punctual.as_ref());
            let lights = lights.map_or(&[][..], |list| &list.lights);
            let index = punctual.light.value();
            let light = item(lights, index, "extensions/KHR_lights_punctual/lights", &place)?;
            let place = format!("/extensions/KHR_lights_punctual/lights/{index}");
            plain(light, &spot, &place, notes).map(Some)
        }
        (None, None) => Ok(None),
    }
}

fn plain(light: &Light, spot: &Spot<'_>, place: &str, notes: &mut Notes) -> Checked<PunctualLight> {
    let validation::Checked::Valid(kind) = light.type_ else {
        return Err(Fault::new(place, "type is none of directional, point, spot"));
    };
    let kind = match kind {
        Type::Point => PunctualKind::Point,
        Type::Directional => PunctualKind::Directional,
        Type::Spot => {
            let cone = light.spot.as_ref().ok_or_else(|| Fault::new(place, "spot is missing"))?;
            let (inner, outer) = (f64::from(cone.inner_cone_angle), f64::from(cone.outer_cone_angle));
            // f32 rounds π/2 up.
            let right = f64::from(std::f32::consts::FRAC_PI_2);
            if !(outer > 0.0 && outer <= right && inner >= 0.0) {
                let what =
                    format!("cone angles {inner} and {outer}: 0 ≤ inner < outer ≤ π/2 is needed, in radians");
                return Err(Fault::new(place, what));
            }
            if inner >= outer {
                notes.add("a spot's inner cone is not inside the outer one; it is made just so", 1, place);
            }
            // A cone of no width at all would divide by zero.
            PunctualKind::Spot {
                inner: inner.min(outer * 0.999),
                outer: outer.min(std::f64::consts::FRAC_PI_2),
            }
        }
    };
    let (colour, intensity) = (Vec3::from_array(light.color), f64::from(light.intensity));
    check_amount(colour, intensity, place)?;
    let name = spot.name.or(light.name.as_deref()).unwrap_or_default().to_owned();
    Ok(PunctualLight { name, kind, colour, intensity, placement: spot.placement, ies: None })
}

/// EXT_lights_ies at a node.
#[derive(Deserialize)]
struct NodeProfile {
    light: usize,
    multiplier: Option<f32>,
    color: Option<[f32; 3]>,
}

/// EXT_lights_ies at the root.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ProfileSource {
    name: Option<String>,
    uri: Option<String>,
    buffer_view: Option<usize>,
}

fn with_profile(document: &Document<'_>, node: &Value, spot: &Spot<'_>) -> Checked<PunctualLight> {
    let wrong = |place: &str, error: serde_json::Error| Fault::new(place, error.to_string());
    let at_node = format!("{}/EXT_lights_ies", spot.user);
    let node = NodeProfile::deserialize(node).map_err(|error| wrong(&at_node, error))?;
    let root: Option<&Map<String, Value>> = document.root.extensions.as_ref().map(|root| &root.others);
    let list = root.and_then(|root| root.get("EXT_lights_ies")?.get("lights")?.as_array());
    let list = list.map_or(&[][..], Vec::as_slice);
    let source = item(list, node.light, "extensions/EXT_lights_ies/lights", &at_node)?;
    let place = format!("/extensions/EXT_lights_ies/lights/{}", node.light);
    let source = ProfileSource::deserialize(source).map_err(|error| wrong(&place, error))?;
    let ies = match (&source.uri, source.buffer_view) {
        (Some(uri), None) => profile_at(uri, document.folder, &format!("{place}/uri"))?,
        (None, Some(view)) => IesProfile::Embedded(document.view(view, &place)?.0.to_vec()),
        _ => return Err(Fault::new(place, "needs either uri or bufferView")),
    };
    let (colour, intensity) =
        (Vec3::from_array(node.color.unwrap_or([1.0; 3])), f64::from(node.multiplier.unwrap_or(1.0)));
    check_amount(colour, intensity, &at_node)?;
    let name = spot.name.map(str::to_owned).or(source.name).unwrap_or_default();
    let (kind, placement, ies) = (PunctualKind::Point, spot.placement, Some(ies));
    Ok(PunctualLight { name, kind, colour, intensity, placement, ies })
}

/// A file is opened by who places the lamp; where it is not there, that says so.
fn profile_at(uri: &str, folder: &Path, place: &str) -> Checked<IesProfile> {
    match resource::resolve(uri, folder, place)? {
        Resource::Embedded(bytes) => Ok(IesProfile::Embedded(bytes)),
        Resource::File(path) => match resource::real(&path, folder, place) {
            Ok(Err(outside)) => Err(outside),
            _ => Ok(IesProfile::File(path)),
        },
    }
}

fn check_amount(colour: Vec3, intensity: f64, place: &str) -> Checked<()> {
    let sound =
        colour.is_finite() && colour.min_element() >= 0.0 && intensity.is_finite() && intensity >= 0.0;
    if sound {
        return Ok(());
    }
    let what = format!("colour {colour} and intensity {intensity} must be finite and not negative");
    Err(Fault::new(place, what))
}
