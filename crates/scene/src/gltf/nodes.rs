//! Where the nodes are: the forest of one scene, walked without recursion, in f64.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::document::{Document, RawPlacement, item};
use super::fault::{Checked, Fault};

/// A node of the scene and its place in model coordinates.
pub(super) struct Placed {
    pub(super) node: usize,
    pub(super) world: DAffine3,
}

/// All nodes of the default scene (else the first, else every root), parents before children, in the
/// order of the file.
pub(super) fn walk(document: &Document<'_>) -> Checked<Vec<Placed>> {
    let nodes = &document.root.nodes;
    let mut seen = vec![false; nodes.len()];
    let mut placed = Vec::new();
    let mut open: Vec<(usize, DAffine3, String)> =
        roots(document)?.into_iter().rev().map(|(node, user)| (node, DAffine3::IDENTITY, user)).collect();
    while let Some((index, parent, user)) = open.pop() {
        let node = item(nodes, index, "nodes", &user)?;
        if std::mem::replace(&mut seen[index], true) {
            let what = format!("node {index} is reached twice: it has two parents, or is its own ancestor");
            return Err(Fault::new(user, what));
        }
        let place = format!("/nodes/{index}");
        let raw = item(&document.placements, index, "nodes", &place)?;
        let world = parent * local(raw).map_err(|what| Fault::new(&place, what))?;
        if !world.is_finite() {
            return Err(Fault::new(place, "its place in the world is beyond all numbers"));
        }
        for (i, child) in node.children.as_deref().unwrap_or(&[]).iter().enumerate().rev() {
            open.push((child.value(), world, format!("{place}/children/{i}")));
        }
        placed.push(Placed { node: index, world });
    }
    Ok(placed)
}

/// Where to begin, and who says so.
fn roots(document: &Document<'_>) -> Checked<Vec<(usize, String)>> {
    let root = &document.root;
    let scene = root.scene.map(|scene| scene.value());
    if scene.is_some() || !root.scenes.is_empty() {
        let index = scene.unwrap_or(0);
        let scene = item(&root.scenes, index, "scenes", "/scene")?;
        let named =
            |(i, node): (usize, &gltf::json::Index<_>)| (node.value(), format!("/scenes/{index}/nodes/{i}"));
        return Ok(scene.nodes.iter().enumerate().map(named).collect());
    }
    let mut child = vec![false; root.nodes.len()];
    for node in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(child) = child.get_mut(node.value()) {
            *child = true;
        }
    }
    let free: Vec<_> = (0..child.len()).filter(|&i| !child[i]).map(|i| (i, format!("/nodes/{i}"))).collect();
    if free.is_empty() && !child.is_empty() {
        return Err(Fault::new("/nodes", "every node is the child of another: they form a cycle"));
    }
    Ok(free)
}

/// From the node's coordinates to its parent's.
fn local(raw: &RawPlacement) -> Result<DAffine3, String> {
    if let Some(matrix) = &raw.matrix {
        let m = DMat4::from_cols_array(matrix);
        if m.row(3).to_array() != [0.0, 0.0, 0.0, 1.0] {
            return Err("the last row of its matrix is not 0 0 0 1".into());
        }
        return Ok(DAffine3::from_mat4(m));
    }
    let rotation = rotation(raw.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]))?;
    let scale = DVec3::from_array(raw.scale.unwrap_or([1.0; 3]));
    let translation = DVec3::from_array(raw.translation.unwrap_or([0.0; 3]));
    Ok(DAffine3::from_scale_rotation_translation(scale, rotation, translation))
}

/// Files carry unit quaternions rounded to f32 or less; they are brought back to length 1.
pub(super) fn rotation(xyzw: [f64; 4]) -> Result<DQuat, String> {
    let q = DQuat::from_array(xyzw);
    let length = q.length();
    if length.is_finite() && length > 1e-3 {
        Ok(q / length)
    } else {
        Err(format!("rotation {xyzw:?} is no rotation: a unit quaternion x, y, z, w is needed"))
    }
}

/// The rigid part of a place: what counts for cameras and lights, which are not scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Model coordinates \[m\].
    pub position: DVec3,
    /// Right-handed, orthonormal; looks along its own −Z with +Y up.
    pub rotation: DMat3,
}

impl Placement {
    /// Keeps where −Z points, and +Y as far as it is perpendicular; a mirrored frame loses its mirroring
    /// in X. None if the frame is flat.
    pub(super) fn of(world: &DAffine3) -> Option<Self> {
        let back = world.matrix3.z_axis.try_normalize()?;
        let right = world.matrix3.y_axis.cross(back).try_normalize()?;
        let rotation = DMat3::from_cols(right, back.cross(right), back);
        Some(Self { position: world.translation, rotation })
    }
}
