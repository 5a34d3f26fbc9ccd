//! Models: read once, placed as often as the file says.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use light::{Instance, Mesh};

use super::draft::Draft;
use super::materials::Names;
use super::{inline, materials, placement, punctual};
use crate::document::Spot;
use crate::file::{MaterialTable, ModelTable};
use crate::{Error, Material, gltf};

/// How far corners of a water's surface may lie off its level \[m\]: what one writes with millimetres.
pub(crate) const UNEVEN: f64 = 1e-3;

/// Most placed meshes of a scene: 10⁸ of them take 11 GB.
const MOST_INSTANCES: usize = 100_000_000;

/// Models that were read, by file and what was changed in their materials.
#[derive(Default)]
pub(crate) struct Library(Vec<(PathBuf, BTreeMap<String, MaterialTable>, Shelved)>);

/// A model whose meshes and materials are in the scene already.
struct Shelved {
    instances: Vec<Instance>,
    /// The name of each one's node.
    nodes: Vec<Arc<str>>,
    cameras: Vec<gltf::ModelCamera>,
    lights: Vec<gltf::PunctualLight>,
    path: PathBuf,
}

/// Faces of models that something else than the picture wants: surfaces of water.
#[derive(Default)]
pub(crate) struct Claims {
    /// Who claims what.
    pub(crate) of: Vec<Claim>,
    /// What was found.
    pub(crate) found: Vec<Found>,
    /// Names of all nodes and of all materials, for messages; kept only if there are claims.
    pub(crate) names: [BTreeSet<Arc<str>>; 2],
}

/// A water (its number from 0) and what is its surface, in a certain model or in any.
pub(crate) struct Claim {
    pub(crate) water: usize,
    /// What the water is called.
    pub(crate) name: String,
    pub(crate) model: Option<String>,
    pub(crate) wanted: Wanted,
}

/// Which faces.
#[derive(PartialEq)]
pub(crate) enum Wanted {
    /// All of the node of this name.
    Node(String),
    /// Of the faces in the material of this name, those that lie level at the top.
    Material(String),
}

/// A part of what is claimed.
pub(crate) struct Found {
    pub(crate) water: usize,
    pub(crate) mesh: Mesh,
    pub(crate) world_from_mesh: DAffine3,
}

impl Found {
    /// The corners of its triangles in the coordinates of the scene file \[m\], three by three.
    pub(crate) fn corners(&self) -> impl Iterator<Item = DVec3> {
        let corner =
            |i: &u32| self.world_from_mesh.transform_point3(self.mesh.positions[*i as usize].as_dvec3());
        self.mesh.triangles.iter().flatten().map(corner)
    }
}

impl Claims {
    /// The claim on faces of this node in this material.
    fn claim(&mut self, model: Option<&str>, node: &Arc<str>, material: &str) -> Option<&Claim> {
        if !self.of.is_empty() {
            self.names[0].insert(Arc::clone(node));
            self.names[1].insert(material.into());
        }
        self.of.iter().find(|claim| {
            let here = claim.model.as_deref().is_none_or(|asked| Some(asked) == model);
            here && match &claim.wanted {
                Wanted::Node(name) => *name == **node,
                Wanted::Material(name) => name == material,
            }
        })
    }
}

/// The faces of a placed mesh that lie level at its top, within `slack` \[m\], and the others.
fn split_top(mesh: &Mesh, world_from_mesh: &DAffine3, slack: f64) -> [Mesh; 2] {
    let height = |i: &u32| world_from_mesh.transform_point3(mesh.positions[*i as usize].as_dvec3()).y;
    let top = mesh.triangles.iter().flatten().map(height).fold(f64::NEG_INFINITY, f64::max);
    let (upper, lower) =
        mesh.triangles.iter().partition(|corners| corners.iter().all(|i| top - height(i) <= slack));
    [upper, lower].map(|triangles| Mesh { triangles, ..mesh.clone() })
}

/// Adds what one `[[model]]` table describes.
pub(crate) fn add(
    draft: &mut Draft,
    library: &mut Library,
    spot: &Spot<'_>,
    table: &ModelTable,
    names: &Names,
    claims: &mut Claims,
) -> Result<(), Error> {
    spot.exactly_one(&[
        ("file", table.file.is_some()),
        ("box", table.cuboid.is_some()),
        ("prism", table.prism.is_some()),
        ("plane", table.plane.is_some()),
        ("polygon", table.polygon.is_some()),
        ("terrain", table.terrain.is_some()),
    ])?;
    let placement = placement::affine(spot, table.position, table.rotation, table.scale)?;
    if let Some(name) = &table.file {
        if table.material.is_some() {
            let what = "is for inline geometry; change a file's materials in [model.materials.NAME]";
            return Err(spot.key("material").error(what));
        }
        let path = spot.file(name);
        let shelved = library.shelve(draft, spot, &path, &table.materials)?;
        return place(draft, shelved, &placement, (table.name.as_deref(), claims));
    }
    if !table.materials.is_empty() {
        let what = "is for model files; inline geometry has the key material, the name of a [[material]]";
        return Err(spot.key("materials").error(what));
    }
    let material = match &table.material {
        None => draft.grey(),
        Some(name) => material_named(spot, name, names)?,
    };
    if let Some(inline) = inline::geometry(spot, table, &mut draft.warnings)? {
        let world_from_mesh = inline.placed(&placement);
        draft.add_mesh(Mesh { material, ..inline.mesh }, world_from_mesh);
    }
    Ok(())
}

/// Adds a whole model file as it is.
pub(crate) fn add_file(draft: &mut Draft, path: &Path) -> Result<(), Error> {
    let shelved = shelve(draft, gltf::read(path)?, path);
    place(draft, &shelved, &DAffine3::IDENTITY, (None, &mut Claims::default()))
}

/// Index of the material that the key `material` of this table names.
pub(crate) fn material_named(spot: &Spot<'_>, name: &str, names: &Names) -> Result<u32, Error> {
    names.get(name).copied().ok_or_else(|| {
        let known = list(names.keys().map(String::as_str));
        spot.key("material").error(format!("{name:?} is unknown; [[material]] tables define {known}"))
    })
}

/// Names for a message, at most 40 of them.
pub(crate) fn list<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    names.dedup();
    if names.is_empty() {
        return "none".to_owned();
    }
    let more = names.len().saturating_sub(40);
    names.truncate(40);
    let shown = names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    if more > 0 { format!("{shown} and {more} more") } else { shown }
}

impl Library {
    fn shelve(
        &mut self,
        draft: &mut Draft,
        spot: &Spot<'_>,
        path: &Path,
        changes: &BTreeMap<String, MaterialTable>,
    ) -> Result<&Shelved, Error> {
        let known = self.0.iter().position(|(p, c, _)| p == path && c == changes);
        let index = match known {
            Some(index) => index,
            None => {
                let mut model = gltf::read(path).map_err(|error| super::missing(&spot.key("file"), error))?;
                change(&mut model.materials, &spot.key("materials"), changes)?;
                self.0.push((path.to_path_buf(), changes.clone(), shelve(draft, model, path)));
                self.0.len() - 1
            }
        };
        Ok(&self.0[index].2)
    }
}

/// Applies `[model.materials.NAME]` tables.
fn change(
    found: &mut [Material],
    spot: &Spot<'_>,
    changes: &BTreeMap<String, MaterialTable>,
) -> Result<(), Error> {
    for (name, table) in changes {
        let spot = spot.key(name);
        if table.name.is_some() {
            return Err(spot
                .key("name")
                .error("is not possible here: the table's own name says which material"));
        }
        if !found.iter().any(|material| material.name == *name) {
            return Err(spot.error(format!(
                "the model has no such material; it has {}",
                list(found.iter().map(|m| m.name.as_str()))
            )));
        }
        for material in found.iter_mut().filter(|material| material.name == *name) {
            materials::change(&spot, table, material)?;
        }
    }
    Ok(())
}

/// Moves meshes and materials into the scene.
fn shelve(draft: &mut Draft, model: gltf::Model, path: &Path) -> Shelved {
    let (first_mesh, first_material) = (draft.geometry.meshes.len() as u32, draft.materials.len() as u32);
    draft.materials.extend(model.materials);
    let meshes = model.meshes.into_iter();
    draft
        .geometry
        .meshes
        .extend(meshes.map(|mesh| Mesh { material: mesh.material + first_material, ..mesh }));
    draft.warnings.extend(model.warnings);
    let instances =
        model.instances.into_iter().map(|i| Instance { mesh: i.mesh + first_mesh, ..i }).collect();
    let (nodes, path) = (model.instance_names, path.to_path_buf());
    Shelved { instances, nodes, cameras: model.cameras, lights: model.lights, path }
}

/// Places everything of a model.
fn place(
    draft: &mut Draft,
    shelved: &Shelved,
    placement: &DAffine3,
    (name, claims): (Option<&str>, &mut Claims),
) -> Result<(), Error> {
    if draft.geometry.instances.len() + shelved.instances.len() > MOST_INSTANCES {
        let what = format!("with this model the scene has more than {MOST_INSTANCES} placed meshes");
        return Err(Error::File { path: shelved.path.clone(), place: String::new(), what });
    }
    for (instance, node) in shelved.instances.iter().zip(&shelved.nodes) {
        let world_from_mesh = *placement * instance.world_from_mesh;
        let mesh = &draft.geometry.meshes[instance.mesh as usize];
        let material = draft.materials.get(mesh.material as usize).map_or("", |material| &material.name);
        let Some(claim) = claims.claim(name, node, material) else {
            draft.add_instance(instance.mesh, world_from_mesh);
            continue;
        };
        let water = claim.water;
        let [taken, left] = match claim.wanted {
            Wanted::Node(_) => [mesh.clone(), Mesh::default()],
            Wanted::Material(_) => split_top(mesh, &world_from_mesh, UNEVEN),
        };
        if !left.triangles.is_empty() {
            draft.add_mesh(left, world_from_mesh);
        }
        claims.found.push(Found { water, mesh: taken, world_from_mesh });
    }
    for camera in &shelved.cameras {
        draft.cameras.extend(punctual::camera(camera, placement, draft.cameras.len() + 1));
    }
    let origin = shelved.path.display().to_string();
    for light in &shelved.lights {
        let placed = punctual::light(light, placement, &draft.site, &origin, &mut draft.warnings)?;
        match placed {
            None => {}
            Some(punctual::Placed::Sun(sun)) => draft.add_sun(sun, &origin, &light.name),
            Some(punctual::Placed::Lamp(mut lamp)) => {
                if lamp.name.is_empty() {
                    lamp.name = format!("light-{}", draft.lights.len() + 1);
                }
                draft.lights.push(lamp);
            }
        }
    }
    Ok(())
}
