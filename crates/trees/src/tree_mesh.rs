//! A tree as triangles, with what they are made of.

use std::sync::Arc;

use glam::Vec3;
use light::{Mesh, Texture};

/// Triangles of one material of a tree.
#[derive(Clone, Debug)]
pub struct Part {
    /// In metres, +Y up, the trunk's foot at the origin; its opacity and vertex colours count.
    pub mesh: Mesh,
    /// Linear base colour (reflectance), a factor on texture and vertex colours.
    pub colour: Vec3,
    /// Base colour by texture coordinates; none = white.
    pub texture: Option<Arc<Texture>>,
    /// True for leaves and needles, false for wood.
    pub leaf: bool,
}

/// A tree as triangles: grown ([`crate::grow`]), or anybody's.
#[derive(Clone, Debug, Default)]
pub struct TreeMesh {
    /// Its parts.
    pub parts: Vec<Part>,
}

impl TreeMesh {
    /// Triangles in all.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|part| part.mesh.triangles.len()).sum()
    }

    /// Lower and upper corner \[m\]; none without triangles.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let corners = self.parts.iter().flat_map(|part| {
            let corners = part.mesh.triangles.iter().flatten();
            corners.map(|i| part.mesh.positions[*i as usize])
        });
        corners.fold(None, |box_, p| {
            Some(box_.map_or([p, p], |[low, high]: [Vec3; 2]| [low.min(p), high.max(p)]))
        })
    }
}
