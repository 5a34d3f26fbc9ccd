//! A model of a tree → parts of wood and of leaves, its foot at the origin.

use glam::{DAffine3, DVec2, DVec3, Vec2, Vec3, swizzles::Vec3Swizzles};
use light::Mesh;
use scene::Material;
use scene::gltf::Model;
use trees::{Part, TreeMesh};

/// Triangles of all placements together: each is kept, with its corners, in some 100 bytes.
const MOST_TRIANGLES: usize = 20_000_000;

/// What begins no higher than this share of the tree's height above its lowest point is its foot.
const FOOT: f64 = 0.02;

/// Radius about the axis within which the trunk ends, as a share of the tree's height.
const TRUNK: f64 = 0.04;

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
/// The foot is that of the wood (of all, where there is none).
///
/// # Errors
/// Nothing with a height, or too much.
pub(super) fn tree(model: &Model, height: Option<f32>) -> Result<(TreeMesh, Vec<Worn>), String> {
    let counted = |i: &light::Instance| &model.meshes[i.mesh as usize];
    let count: usize = model.instances.iter().map(|instance| counted(instance).triangles.len()).sum();
    if count > MOST_TRIANGLES {
        return Err(format!("has {count} triangles, more than {MOST_TRIANGLES}"));
    }
    let worn = worn(model);
    let leafy = |mesh: &Mesh| worn.get(mesh.material as usize).is_some_and(|worn| worn.leaves);
    let high = corners(model, |_| true).map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
    let any_wood = worn.iter().any(|worn| worn.triangles > 0 && !worn.leaves);
    let foot = foot(model, high, |mesh| !any_wood || !leafy(mesh)).ok_or("has no triangles with a height")?;
    let scale = height.map_or(1.0, |height| f64::from(height) / (high - foot.y));
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

/// Triangles of those meshes that are asked for, in the model's coordinates \[m\].
fn triangles<'a>(model: &'a Model, of: impl Fn(&Mesh) -> bool + 'a) -> impl Iterator<Item = [DVec3; 3]> + 'a {
    let meshes = model.instances.iter().map(|placed| (placed, &model.meshes[placed.mesh as usize]));
    meshes.filter(move |(_, mesh)| of(mesh)).flat_map(|(placed, mesh)| {
        let corner = |i: u32| placed.world_from_mesh.transform_point3(mesh.positions[i as usize].as_dvec3());
        mesh.triangles.iter().map(move |corners| corners.map(corner))
    })
}

fn corners<'a>(model: &'a Model, of: impl Fn(&Mesh) -> bool + 'a) -> impl Iterator<Item = DVec3> + 'a {
    triangles(model, of).flatten()
}

/// Where the trunk meets the ground: the middle (median by area, which branches that hang low do not move) of what is lowest,
/// at the height where it ends below.
fn foot(model: &Model, high: f64, wood: impl Fn(&Mesh) -> bool) -> Option<DVec3> {
    let lowest = corners(model, &wood).map(|corner| corner.y).reduce(f64::min)?;
    let height = high - lowest;
    if !(height.is_finite() && height > 0.0) {
        return None;
    }
    let mut around: Vec<(DVec3, f64)> = Vec::new();
    for [a, b, c] in triangles(model, &wood) {
        if a.min(b).min(c).y <= lowest + FOOT * height {
            around.push(((a + b + c) / 3.0, (b - a).cross(c - a).length()));
        }
    }
    let middle = |of: &[(DVec3, f64)]| {
        DVec2::from([0, 2].map(|axis| median(of.iter().map(|(at, area)| (at[axis], *area)).collect())))
    };
    let mut axis = middle(&around);
    // Closer and closer to the trunk, until only it is left.
    for reach in [4.0, 2.0, 1.0, 1.0] {
        let near = |(at, _): &&(DVec3, f64)| at.xz().distance(axis) < reach * TRUNK * height;
        let near: Vec<_> = around.iter().filter(near).copied().collect();
        if !near.is_empty() {
            axis = middle(&near);
        }
    }
    let trunk = corners(model, &wood).filter(|corner| corner.xz().distance(axis) < TRUNK * height);
    let below = trunk.map(|corner| corner.y).reduce(f64::min).unwrap_or(lowest);
    Some(DVec3::new(axis.x, below, axis.y))
}

/// The value below which half of the weight lies; 0 of nothing.
fn median(mut values: Vec<(f64, f64)>) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = 0.5 * values.iter().map(|(_, weight)| weight).sum::<f64>();
    let found = values.iter().find(|(_, weight)| {
        left -= weight;
        left <= 0.0
    });
    found.map_or(0.0, |(value, _)| *value)
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
