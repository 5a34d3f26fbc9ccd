//! The binary hierarchy that obvhs builds, in the order that collapsing wants.

use std::time::Duration;

use glam::Vec3;
use obvhs::{Boundable, aabb::Aabb, bvh2::builder::build_bvh2};

use crate::Quality;

/// An axis-aligned box, lower and upper corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: Vec3,
    pub(crate) high: Vec3,
}

impl Bounds {
    /// The box of nothing: the identity of [`Bounds::union`].
    pub(crate) const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    /// The box of some points.
    pub(crate) fn of(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |b, &p| Self { low: b.low.min(p), high: b.high.max(p) })
    }

    /// The box of both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Half the area of its surface, which is what its chance to be hit is proportional to.
    pub(crate) fn half_area(self) -> f32 {
        let d = self.high - self.low;
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    /// Largest absolute coordinate.
    pub(crate) fn reach(self) -> f32 {
        self.low.abs().max(self.high.abs()).max_element()
    }
}

impl Boundable for Bounds {
    fn aabb(&self) -> Aabb {
        Aabb::new(self.low.into(), self.high.into())
    }
}

/// A node: two children, or one primitive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) bounds: Bounds,
    pub(crate) kind: Kind,
}

/// What is below a node.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    /// Two nodes, both later in the list.
    Inner([u32; 2]),
    /// One primitive.
    Leaf(u32),
}

/// The hierarchy over some boxes, parents before children, root first; empty for no boxes.
pub(crate) fn build(boxes: &[Bounds], quality: Quality) -> Vec<Node> {
    if boxes.is_empty() {
        return Vec::new();
    }
    let mut unused = Duration::ZERO;
    let built = build_bvh2(boxes, quality.binary(), &mut unused);
    let mut nodes = Vec::with_capacity(2 * boxes.len());
    // (theirs, where ours goes). A list instead of recursion: depth is the input's to choose.
    let mut open = vec![(0usize, 0usize)];
    nodes.push(Node { bounds: Bounds::EMPTY, kind: Kind::Leaf(0) });
    while let Some((theirs, ours)) = open.pop() {
        let node = &built.nodes[theirs];
        let aabb = node.aabb();
        let kind = if node.is_leaf() {
            Kind::Leaf(built.primitive_indices[node.first_index as usize])
        } else {
            let first = nodes.len();
            nodes.extend([Node { bounds: Bounds::EMPTY, kind: Kind::Leaf(0) }; 2]);
            open.push((node.first_index as usize + 1, first + 1));
            open.push((node.first_index as usize, first));
            Kind::Inner([first as u32, first as u32 + 1])
        };
        nodes[ours] = Node { bounds: Bounds { low: aabb.min.into(), high: aabb.max.into() }, kind };
    }
    nodes
}

/// The same primitives, in the same order along the leaves, halved again and again: as shallow as can be.
///
/// For input on which the surface-area heuristic goes deeper than a traversal stack can hold (sizes that
/// double from face to face).
pub(crate) fn halved(nodes: &[Node]) -> Vec<Node> {
    let mut leaves = Vec::with_capacity(nodes.len() / 2 + 1);
    let mut open = vec![0usize];
    while let Some(node) = open.pop() {
        match nodes[node].kind {
            Kind::Leaf(_) => leaves.push(nodes[node]),
            Kind::Inner([a, b]) => open.extend([b as usize, a as usize]),
        }
    }
    let mut out = Vec::with_capacity(nodes.len());
    out.push(leaves[0]);
    let mut open = vec![(0usize, leaves.as_slice())];
    while let Some((at, leaves)) = open.pop() {
        if let [leaf] = leaves {
            out[at] = *leaf;
            continue;
        }
        let bounds = leaves.iter().fold(Bounds::EMPTY, |b, leaf| b.union(leaf.bounds));
        let first = out.len();
        out[at] = Node { bounds, kind: Kind::Inner([first as u32, first as u32 + 1]) };
        out.extend([leaves[0]; 2]);
        let (left, right) = leaves.split_at(leaves.len() / 2);
        open.extend([(first + 1, right), (first, left)]);
    }
    out
}
