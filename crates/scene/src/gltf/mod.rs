//! glTF 2.0 models (`.glb`, `.gltf`) as plain, checked data.
//!
//! **Answers.** [`read`] gives the triangles of the default scene (one [`light::Mesh`] per primitive, shared by
//! its placements), materials with decoded textures, cameras and lights, in model coordinates: metres, +Y up,
//! placements in f64 from the file's own digits, so that map coordinates of 10⁶ m keep millimetres.
//!
//! **Leaves out.** Animations, skins and morph targets (the default pose is shown, with a warning), points and
//! lines, compressed meshes and textures (an error that says how to unpack them), occlusion textures (light is
//! computed here), sampler filters (filtering is ours), vertex alpha, textures that refine transmission,
//! specular, thickness and diffuse transmission.
//!
//! **Hostile files.** Nothing is followed out of the model's folder; every index and size is checked where it
//! is used; memory grows in proportion to the file; images have limits. The `gltf` crate only parses the
//! JSON: its typed access panics on malformed files.

mod accessor;
mod cameras;
mod container;
mod document;
mod extensions;
mod fault;
mod images;
mod instancing;
mod lights;
mod materials;
mod nodes;
mod primitives;
mod resource;
mod triangles;
mod uv;

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

use glam::DAffine3;
use light::{Instance, Mesh};

pub use cameras::ModelCamera;
pub use lights::{IesProfile, PunctualKind, PunctualLight};
pub use nodes::Placement;

use crate::{Error, Material, Warning, regular_file};
use document::{Document, item};
use fault::{Checked, Fault, Notes};
use images::Images;
use materials::Surface;
use nodes::Placed;

/// What a model file contains.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// One per primitive; `material` is an index into `materials`.
    pub meshes: Vec<Mesh>,
    /// Their placements in model coordinates \[m\].
    pub instances: Vec<Instance>,
    /// For each instance the name of its node, else of its mesh, else "".
    pub instance_names: Vec<Arc<str>>,
    /// Those of the file in its order; a last, default one if some primitive has none. Materials that
    /// nothing wears have no textures.
    pub materials: Vec<Material>,
    /// Eyes.
    pub cameras: Vec<ModelCamera>,
    /// Lamps and suns.
    pub lights: Vec<PunctualLight>,
    /// What was repaired or left out.
    pub warnings: Vec<Warning>,
}

/// Reads a `.glb` or `.gltf` file and what it names below its folder.
pub fn read(path: &Path) -> Result<Model, Error> {
    let bytes = regular_file::read(path, u64::MAX)
        .map_err(|source| Error::Io { path: path.to_path_buf(), source })?;
    parse(&bytes, path.parent().unwrap_or(Path::new("")), path)
}

/// Reads a model from memory; `folder` is where its external files lie, `path` what errors call it.
pub fn parse(bytes: &[u8], folder: &Path, path: &Path) -> Result<Model, Error> {
    let mut notes = Notes::default();
    // Nothing here is known to panic; the decoders below are not ours, and a user's file must never end
    // the program.
    let result = catch_unwind(AssertUnwindSafe(|| model(bytes, folder, &mut notes)));
    let result = result.unwrap_or_else(|_| Err(Fault::new("", "is broken in a way that no check foresaw")));
    let mut model = result.map_err(|fault| fault.into_error(path))?;
    model.warnings = notes.into_warnings(path);
    Ok(model)
}

fn model(bytes: &[u8], folder: &Path, notes: &mut Notes) -> Checked<Model> {
    let container = container::split(bytes)?;
    let document = Document::new(&container, folder)?;
    let version = &document.root.asset.version;
    if !version.starts_with("2.") {
        return Err(Fault::new("/asset/version", format!("is \"{version}\"; only glTF 2 is understood")));
    }
    extensions::check(&document.root, notes)?;
    notes.add("animations are ignored: the default pose is shown", document.root.animations.len() as u64, "");
    let placed = nodes::walk(&document)?;
    let mut model = Model::default();
    let mut surfaces = surfaces(&document, &placed, notes)?;
    let parts = meshes(&document, &placed, &mut surfaces, &mut model, notes)?;
    model.materials = surfaces.into_iter().map(|surface| surface.material).collect();
    for placed in &placed {
        place(&document, placed, &parts, &mut model, notes)?;
    }
    Ok(model)
}

/// The meshes that the scene shows, in the order of the file.
fn shown<'d>(
    document: &'d Document<'_>,
    placed: &[Placed],
) -> Checked<BTreeMap<usize, &'d gltf::json::Mesh>> {
    let mut shown = BTreeMap::new();
    for placed in placed {
        if let Some(mesh) = document.root.nodes[placed.node].mesh {
            let place = format!("/nodes/{}/mesh", placed.node);
            shown.insert(mesh.value(), item(&document.root.meshes, mesh.value(), "meshes", &place)?);
        }
    }
    Ok(shown)
}

/// All materials of the file; textures are decoded for those that the scene shows.
fn surfaces(document: &Document<'_>, placed: &[Placed], notes: &mut Notes) -> Checked<Vec<Surface>> {
    let materials = &document.root.materials;
    let mut worn = BTreeSet::new();
    for (index, mesh) in shown(document, placed)? {
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            if let Some(material) = primitive.material {
                let place = format!("/meshes/{index}/primitives/{i}/material");
                item(materials, material.value(), "materials", &place)?;
                worn.insert(material.value());
            }
        }
    }
    // First see which images are needed and how, then decode them all at once, then read in earnest.
    let mut images = Images::Wanted(BTreeSet::new());
    for &index in &worn {
        materials::surface(document, &materials[index], index, &mut images, &mut Notes::default())?;
    }
    let mut images = images.decode(document)?;
    let mut none = Images::Wanted(BTreeSet::new());
    let read = |(index, material)| {
        let images = if worn.contains(&index) { &mut images } else { &mut none };
        materials::surface(document, material, index, images, notes)
    };
    materials.iter().enumerate().map(read).collect()
}

/// Converts the meshes shown; for each the indices of its parts. May add a default material.
fn meshes(
    document: &Document<'_>,
    placed: &[Placed],
    surfaces: &mut Vec<Surface>,
    model: &mut Model,
    notes: &mut Notes,
) -> Checked<BTreeMap<usize, Vec<u32>>> {
    let own = surfaces.len();
    let mut parts = BTreeMap::new();
    for (index, mesh) in shown(document, placed)? {
        let list: &mut Vec<u32> = parts.entry(index).or_default();
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("/meshes/{index}/primitives/{i}");
            let material = primitive.material.map_or(own, |material| material.value());
            if material == surfaces.len() {
                surfaces.push(Surface::default());
            }
            let surface = item(surfaces, material, "materials", &place)?;
            if let Some(mesh) =
                primitives::mesh(document, primitive, surface, material as u32, &place, notes)?
            {
                list.push(model.meshes.len() as u32);
                model.meshes.push(mesh);
            }
        }
    }
    Ok(parts)
}

/// Puts what a node carries into the model.
fn place(
    document: &Document<'_>,
    placed: &Placed,
    parts: &BTreeMap<usize, Vec<u32>>,
    model: &mut Model,
    notes: &mut Notes,
) -> Checked<()> {
    let node = &document.root.nodes[placed.node];
    let place = format!("/nodes/{}", placed.node);
    if let Some(camera) = node.camera {
        let user = format!("{place}/camera");
        let name = node.name.as_deref();
        let camera = cameras::camera(document, camera.value(), name, &placed.world, &user, notes)?;
        model.cameras.extend(camera);
    }
    model.lights.extend(lights::light(document, placed.node, &placed.world, notes)?);
    let Some(mesh) = node.mesh else { return Ok(()) };
    notes.add("skins are ignored: the mesh stands where its node does", node.skin.is_some().into(), &place);
    let name = node.name.as_deref().or(document.root.meshes[mesh.value()].name.as_deref());
    let name: Arc<str> = name.unwrap_or_default().into();
    let extension = node.extensions.as_ref().and_then(|e| e.others.get("EXT_mesh_gpu_instancing"));
    let placements = match extension {
        Some(extension) => {
            let place = format!("{place}/extensions/EXT_mesh_gpu_instancing");
            instancing::placements(document, extension, &place)?
        }
        None => vec![DAffine3::IDENTITY],
    };
    let parts = parts.get(&mesh.value()).map_or(&[][..], Vec::as_slice);
    document.spend(placements.len() as u64 * parts.len() as u64, &place)?;
    for world in placements.iter().map(|placement| placed.world * *placement) {
        // Scaling to nothing is how some programs hide things.
        if !(world.is_finite() && world.inverse().is_finite() && world.matrix3.determinant() != 0.0) {
            notes.add("a mesh that is scaled to nothing is left out", 1, &place);
            continue;
        }
        model.instances.extend(parts.iter().map(|&mesh| Instance { mesh, world_from_mesh: world }));
        model.instance_names.extend(parts.iter().map(|_| Arc::clone(&name)));
    }
    Ok(())
}
