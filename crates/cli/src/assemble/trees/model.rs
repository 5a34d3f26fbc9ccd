//! A model of a tree → parts of wood and of leaves, its foot at the origin.

use glam::{DAffine3, DVec3, Vec2, Vec3};
use light::Mesh;
use scene::Material;
use scene::gltf::Model;
use trees::{Part, TreeMesh};

/// Triangles of all placements together: each is kept, with its corners, in some 100 bytes.
const MOST_TRIANGLES: usize = 20_000_000;

/// What lies no higher than this share of the tree's height above its lowest point is its foot.
const FOOT: f64 = 0.02;

/// Names, or parts of them, of materials that are leaves.
const LEAVES: [&str; 8] = ["leaf", "leaves", "needle", "foliage", "blatt", "blätter", "laub", "nadel"];

/// Names of those that are not, even where they are cut out or green.
const WOOD: [&str; 7] = ["bark", "trunk", "stem", "wood", "stamm", "rinde", "holz"];

/// A part of a tree by the material that it wears.
#[derive(Clone, Debug, serde::Serialize)]
pub(crate) struct Worn {
    /// Name of the material.
    pub(crate) material: String,
    /// Triangles that wear it.
    pub(crate) triangles: usize,
    /// Whether they count as leaves.
    pub(crate) leaves: bool,
    /// Why, in words.
    pub(crate) why: &'static str,
}

/// Parts by placement, as high as they are, or `height` metres; and what each material counts as.
///
/// The foot is the middle of the lowest part of the wood (of all, where there is none).
///
/// # Errors
/// Nothing with a height, or too much.
pub(super) fn tree(model: &Model, height: Option<f32>) -> Result<(TreeMesh, Vec<Worn>), String> {
    let counted = |i: &light::Instance| &model.meshes[i.mesh as usize];
    let triangles: usize = model.instances.iter().map(|instance| counted(instance).triangles.len()).sum();
    if triangles > MOST_TRIANGLES {
        return Err(format!("has {triangles} triangles, more than {MOST_TRIANGLES}"));
    }
    let worn = worn(model);
    let leafy = |mesh: &Mesh| worn.get(mesh.material as usize).is_some_and(|worn| worn.leaves);
    let [low, high] = bounds(corners(model, |_| true)).ok_or("has no triangles")?;
    let (wood, whole) = (bounds(corners(model, |mesh| !leafy(mesh))), [low, high]);
    let lowest = wood.unwrap_or(whole)[0].y;
    if high.y - lowest <= 0.0 {
        return Err("has no height".to_owned());
    }
    let near = lowest + FOOT * (high.y - lowest);
    let foot = corners(model, |mesh| wood.is_none() || !leafy(mesh)).filter(|corner| corner.y <= near);
    let [a, b] = bounds(foot).unwrap_or(whole);
    let foot = (0.5 * (a + b)).with_y(lowest);
    let scale = height.map_or(1.0, |height| f64::from(height) / (high.y - lowest));
    let upright = DAffine3::from_scale(DVec3::splat(scale)) * DAffine3::from_translation(-foot);
    let parts = model.instances.iter().map(|instance| {
        let mesh = counted(instance);
        let material = &model.materials[mesh.material as usize];
        part(mesh, &(upright * instance.world_from_mesh), material, leafy(mesh))
    });
    Ok((TreeMesh { parts: parts.collect() }, worn.into_iter().filter(|worn| worn.triangles > 0).collect()))
}

fn part(mesh: &Mesh, tree_from_mesh: &DAffine3, material: &Material, leaf: bool) -> Part {
    let at = |p: &Vec3| tree_from_mesh.transform_point3(p.as_dvec3()).as_vec3();
    Part {
        mesh: Mesh {
            positions: mesh.positions.iter().map(at).collect(),
            normals: Vec::new(),
            ..mesh.clone()
        },
        colour: material.base_colour,
        texture: material.base_texture.as_ref().map(|(texture, _)| texture.clone()),
        leaf,
    }
}

/// Corners of the triangles of those meshes that are asked for, in the model's coordinates \[m\].
fn corners<'a>(model: &'a Model, of: impl Fn(&Mesh) -> bool + 'a) -> impl Iterator<Item = DVec3> + 'a {
    let meshes = model.instances.iter().map(|placed| (placed, &model.meshes[placed.mesh as usize]));
    meshes.filter(move |(_, mesh)| of(mesh)).flat_map(|(placed, mesh)| {
        let corners = mesh.triangles.iter().flatten();
        corners.map(|i| placed.world_from_mesh.transform_point3(mesh.positions[*i as usize].as_dvec3()))
    })
}

/// Lower and upper corner; none of nothing.
fn bounds(points: impl Iterator<Item = DVec3>) -> Option<[DVec3; 2]> {
    points.map(|p| [p, p]).reduce(|[low, high], [p, _]| [low.min(p), high.max(p)])
}

/// What each material counts as.
fn worn(model: &Model) -> Vec<Worn> {
    let of = |(i, material): (usize, &Material)| {
        let placed = model.instances.iter().map(|placed| &model.meshes[placed.mesh as usize]);
        let meshes: Vec<&Mesh> = placed.filter(|mesh| mesh.material as usize == i).collect();
        let (leaves, why) = judged(material, meshes.iter().any(|mesh| mesh.opacity.is_some()));
        let triangles = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        let name = if material.name.is_empty() { format!("{}", i + 1) } else { material.name.clone() };
        Worn { material: name, triangles, leaves, why }
    };
    model.materials.iter().enumerate().map(of).collect()
}

/// Whether a material is that of leaves, and why.
fn judged(material: &Material, cut_out: bool) -> (bool, &'static str) {
    let name = material.name.to_lowercase();
    let named = |words: &[&str]| words.iter().any(|word| name.contains(word));
    // A footprint as wide as the texture: its mean.
    let mean = material
        .base_texture
        .as_ref()
        .map_or(Vec3::ONE, |(texture, _)| texture.sample(Vec2::splat(0.5), 1.0).0);
    let colour = mean * material.base_colour;
    match () {
        () if named(&LEAVES) => (true, "by its name"),
        () if named(&WOOD) => (false, "by its name"),
        () if cut_out => (true, "it has an alpha"),
        () if material.diffuse_transmission > 0.0 => (true, "light shines through"),
        () if colour.y > colour.x.max(colour.z) => (true, "it is green"),
        () => (false, "it is solid and not green"),
    }
}
