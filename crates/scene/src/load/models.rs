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

/// Nodes of models that something else than the picture wants: surfaces of water.
#[derive(Default)]
pub(crate) struct Claims {
    /// Who claims what.
    pub(crate) of: Vec<Claim>,
    /// What was found.
    pub(crate) found: Vec<Found>,
    /// Names of all nodes, for messages; kept only if there are claims.
    pub(crate) names: BTreeSet<Arc<str>>,
}

/// A water (its number from 0) and the node that is its surface, in a certain model or in any.
pub(crate) struct Claim {
    pub(crate) water: usize,
    pub(crate) model: Option<String>,
    pub(crate) node: String,
}

/// A part of a claimed node.
pub(crate) struct Found {
    pub(crate) water: usize,
    pub(crate) mesh: Mesh,
    pub(crate) world_from_mesh: DAffine3,
}

impl Found {
    /// All its corners in the coordinates of the scene file \[m\].
    pub(crate) fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.mesh.positions.iter().map(|corner| self.world_from_mesh.transform_point3(corner.as_dvec3()))
    }
}

impl Claims {
    fn claim(&mut self, model: Option<&str>, node: &Arc<str>) -> Option<usize> {
        if !self.of.is_empty() {
            self.names.insert(Arc::clone(node));
        }
        let is = |claim: &&Claim| {
            claim.node == **node && claim.model.as_deref().is_none_or(|asked| Some(asked) == model)
        };
        self.of.iter().find(is).map(|claim| claim.water)
    }
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
        match claims.claim(name, node) {
            Some(water) => {
                let mesh = draft.geometry.meshes[instance.mesh as usize].clone();
                claims.found.push(Found { water, mesh, world_from_mesh });
            }
            None => draft.add_instance(instance.mesh, world_from_mesh),
        }
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
