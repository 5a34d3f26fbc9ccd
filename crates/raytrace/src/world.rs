//! All triangles of a scene, ready for rays: what stands once in one hierarchy, what stands often once and
//! placed many times under a second one.

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use light::{Geometry, Mesh};
use rayon::prelude::*;

use crate::{
    Quality,
    binary::Bounds,
    tree::{Faces, Name, Tree},
};

/// Largest |coordinate| \[m\] that takes part: edge functions are of the fourth power of it and must not overflow.
const FARTHEST: f64 = 1e9;

/// A mesh with no more triangles than this is never placed by reference: walking into a hierarchy of its
/// own costs more than the memory it would save.
const SMALL: usize = 16;

/// Nor one whose copies have no more triangles than this, all together.
const FEW: usize = 4096;

/// Triangles and instances, accelerated. Answers [`light::Occlude`] and [`light::Nearest`].
#[derive(Clone, Debug)]
pub struct World {
    pub(crate) geometry: Arc<Geometry>,
    /// In world coordinates.
    pub(crate) standing: Faces,
    /// In the coordinates of their meshes.
    pub(crate) models: Vec<Faces>,
    /// Over `placements`.
    pub(crate) tops: Tree,
    /// In the order of the leaves of `tops`.
    pub(crate) placements: Vec<Placement>,
    stats: Stats,
}

/// One placement of a model.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    /// From the world to the model.
    pub(crate) model_from_world: DAffine3,
    /// Index into [`World::models`].
    pub(crate) model: u32,
    /// Index into [`Geometry::instances`].
    pub(crate) instance: u32,
}

/// What a hierarchy is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Triangles in all placements together.
    pub triangles: usize,
    /// Triangles stored: placed ones once.
    pub stored: usize,
    /// Placements that share a hierarchy.
    pub placements: usize,
    /// Triangles left out: without area, not finite, or beyond 10⁹ m.
    pub dropped: usize,
    /// Inner nodes.
    pub nodes: usize,
    /// Memory on the heap \[B\].
    pub bytes: usize,
}

impl World {
    /// Makes a scene ready for rays.
    pub fn build(geometry: Arc<Geometry>, quality: Quality) -> Self {
        let shared = shared(&geometry);
        let mut dropped = 0;
        let standing = standing(&geometry, &shared, quality, &mut dropped);
        let meshes: Vec<usize> = (0..geometry.meshes.len()).filter(|&mesh| shared[mesh]).collect();
        let built: Vec<(Faces, usize)> =
            meshes.par_iter().map(|&mesh| model(&geometry.meshes[mesh], quality)).collect();
        dropped += built.iter().map(|(_, dropped)| dropped).sum::<usize>();
        let models: Vec<Faces> = built.into_iter().map(|(faces, _)| faces).collect();
        let (tops, placements) = place(&geometry, &meshes, &models, quality);
        let all = || std::iter::once(&standing).chain(&models);
        let stats = Stats {
            triangles: geometry.triangle_count(),
            stored: all().map(|faces| faces.count).sum(),
            placements: placements.len(),
            dropped,
            nodes: all().map(|faces| faces.tree.nodes.len()).sum::<usize>() + tops.nodes.len(),
            bytes: all().map(Faces::bytes).sum::<usize>()
                + size_of_val(&*tops.nodes)
                + size_of_val(&*placements),
        };
        Self { geometry, standing, models, tops, placements, stats }
    }

    /// What was built and how large it is.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// What it was built from.
    pub fn geometry(&self) -> &Arc<Geometry> {
        &self.geometry
    }
}

/// Which meshes get a hierarchy of their own.
fn shared(geometry: &Geometry) -> Vec<bool> {
    let mut uses = vec![0usize; geometry.meshes.len()];
    for instance in &geometry.instances {
        uses[instance.mesh as usize] += 1;
    }
    let worth = |(mesh, uses): (&Mesh, usize)| {
        let count = mesh.triangles.len();
        uses > 1 && count > SMALL && uses.saturating_mul(count) > FEW
    };
    geometry.meshes.iter().zip(uses).map(worth).collect()
}

/// Whether a placement can be undone, so that rays can be brought into the mesh's coordinates.
fn invertible(world_from_mesh: &DAffine3) -> bool {
    world_from_mesh.is_finite() && {
        let inverse = world_from_mesh.inverse();
        inverse.is_finite() && world_from_mesh.matrix3.determinant() != 0.0
    }
}

/// A triangle that can be met at all.
fn usable(corners: &[DVec3; 3]) -> bool {
    let near = |corner: &DVec3| corner.is_finite() && corner.abs().max_element() <= FARTHEST;
    corners.iter().all(near) && (corners[1] - corners[0]).cross(corners[2] - corners[0]) != DVec3::ZERO
}

/// Everything that stands once, in world coordinates.
fn standing(geometry: &Geometry, shared: &[bool], quality: Quality, dropped: &mut usize) -> Faces {
    let (mut corners, mut names) = (Vec::new(), Vec::new());
    for (i, instance) in geometry.instances.iter().enumerate() {
        if shared[instance.mesh as usize] && invertible(&instance.world_from_mesh) {
            continue;
        }
        let mesh = &geometry.meshes[instance.mesh as usize];
        let alpha = mesh.opacity.is_some() || mesh.medium.is_some();
        for t in 0..mesh.triangles.len() as u32 {
            let world = geometry.triangle(i as u32, t).0;
            if usable(&world) {
                corners.push(world.map(DVec3::as_vec3));
                names.push(Name { instance: i as u32, triangle: t, alpha });
            } else {
                *dropped += 1;
            }
        }
    }
    Faces::build(&corners, &names, quality)
}

/// A mesh in its own coordinates, and how many of its triangles were dropped.
fn model(mesh: &Mesh, quality: Quality) -> (Faces, usize) {
    let alpha = mesh.opacity.is_some() || mesh.medium.is_some();
    let (mut corners, mut names) = (Vec::new(), Vec::new());
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        let own: [Vec3; 3] = triangle.map(|i| mesh.positions[i as usize]);
        if usable(&own.map(|corner| corner.as_dvec3())) {
            corners.push(own);
            names.push(Name { instance: 0, triangle: t as u32, alpha });
        }
    }
    let dropped = mesh.triangles.len() - corners.len();
    (Faces::build(&corners, &names, quality), dropped)
}

/// The hierarchy over placements.
fn place(
    geometry: &Geometry,
    meshes: &[usize],
    models: &[Faces],
    quality: Quality,
) -> (Tree, Vec<Placement>) {
    let mut model_of = vec![None; geometry.meshes.len()];
    for (model, &mesh) in meshes.iter().enumerate() {
        model_of[mesh] = (models[model].count > 0).then_some(model);
    }
    let mut placements = Vec::new();
    let mut boxes = Vec::new();
    for (i, instance) in geometry.instances.iter().enumerate() {
        let Some(model) = model_of[instance.mesh as usize] else { continue };
        if !invertible(&instance.world_from_mesh) {
            continue;
        }
        let bounds = placed(models[model].bounds, &instance.world_from_mesh);
        // Said so that NaN is left out too.
        let near = bounds.reach() <= FARTHEST as f32;
        if !near {
            continue;
        }
        boxes.push(bounds);
        let model_from_world = instance.world_from_mesh.inverse();
        placements.push(Placement { model_from_world, model: model as u32, instance: i as u32 });
    }
    let (tree, leaves) = Tree::build(&boxes, 1, quality);
    let ordered = leaves.iter().flatten().map(|&i| placements[i as usize]).collect();
    (tree, ordered)
}

/// A box around a placed box, rounded outwards.
fn placed(bounds: Bounds, world_from_mesh: &DAffine3) -> Bounds {
    let mut out = Bounds::EMPTY;
    for corner in 0..8 {
        let pick = |axis: usize| {
            let side = if corner >> axis & 1 == 0 { bounds.low } else { bounds.high };
            f64::from(side[axis])
        };
        let world = world_from_mesh.transform_point3(DVec3::new(pick(0), pick(1), pick(2))).as_vec3();
        let down = Vec3::from(world.to_array().map(f32::next_down));
        let up = Vec3::from(world.to_array().map(f32::next_up));
        out = out.union(Bounds { low: down, high: up });
    }
    out
}
