//! A hierarchy of eight boxes a node over leaves of up to eight primitives.

use glam::Vec3;

use crate::{
    Quality,
    binary::{self, Bounds},
    collapse::{Child, Plan, WIDTH},
};

/// Marks a child that is a leaf.
pub(crate) const LEAF: u32 = 1 << 31;

/// Deepest chain of wide nodes a tree may have: a traversal then needs at most
/// `(WIDTH − 1) · DEEPEST + 1` places on its stack.
pub(crate) const DEEPEST: usize = 64;

/// Eight boxes, by coordinate and side so that eight are compared at once.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(crate) struct Node {
    /// `[2 · axis + side][slot]`, side 0 = low. Empty slots have low = ∞, high = −∞.
    pub(crate) planes: [[f32; WIDTH]; 6],
    /// Index of a node, or [`LEAF`] | index of a leaf.
    pub(crate) children: [u32; WIDTH],
}

impl Node {
    const EMPTY: Self = Self {
        planes: {
            let (low, high) = ([f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]);
            [low, high, low, high, low, high]
        },
        children: [LEAF; WIDTH],
    };

    fn place(&mut self, slot: usize, bounds: Bounds, child: u32) {
        for axis in 0..3 {
            self.planes[2 * axis][slot] = bounds.low[axis];
            self.planes[2 * axis + 1][slot] = bounds.high[axis];
        }
        self.children[slot] = child;
    }
}

/// The inner part of a hierarchy; what a leaf is, is its owner's business.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// The nodes.
    pub(crate) nodes: Vec<Node>,
    /// Where to start, as in [`Node::children`]; none when there is nothing.
    pub(crate) root: Option<u32>,
    /// Largest absolute coordinate of all boxes.
    pub(crate) reach: f32,
}

impl Tree {
    /// The hierarchy over some boxes with at most `most` (≤ 8) of them in a leaf, and which boxes each leaf holds.
    pub(crate) fn build(boxes: &[Bounds], most: u32, quality: Quality) -> (Self, Vec<Vec<u32>>) {
        let binary = binary::build(boxes, quality);
        if binary.is_empty() {
            return (Self { nodes: Vec::new(), root: None, reach: 0.0 }, Vec::new());
        }
        Self::collapsed(&binary, most)
            .or_else(|| Self::collapsed(&binary::halved(&binary), most))
            // Halves of at most 2³² primitives are 32 deep at most.
            .unwrap_or_else(|| unreachable!("a halved hierarchy is shallow"))
    }

    /// None when deeper than [`DEEPEST`].
    fn collapsed(binary: &[binary::Node], most: u32) -> Option<(Self, Vec<Vec<u32>>)> {
        let plan = Plan::new(binary, most);
        let (mut nodes, mut leaves) = (Vec::new(), Vec::new());
        let mut open = Vec::new();
        let mut take = |child: Child, depth: usize, nodes: &mut Vec<Node>, open: &mut Vec<_>| match child {
            Child::Leaf(n) => {
                leaves.push(plan.primitives(n));
                (n, LEAF | (leaves.len() as u32 - 1))
            }
            Child::Inner(n) => {
                nodes.push(Node::EMPTY);
                open.push((n, nodes.len() - 1, depth));
                (n, nodes.len() as u32 - 1)
            }
        };
        let (_, root) = take(plan.root(), 1, &mut nodes, &mut open);
        while let Some((n, at, depth)) = open.pop() {
            if depth > DEEPEST {
                return None;
            }
            for (slot, child) in plan.children(n).into_iter().enumerate() {
                let (n, child) = take(child, depth + 1, &mut nodes, &mut open);
                nodes[at].place(slot, binary[n as usize].bounds, child);
            }
        }
        let reach = binary[0].bounds.reach();
        Some((Self { nodes, root: Some(root), reach }, leaves))
    }
}

/// Up to eight triangles, by corner and coordinate so that eight are tested at once.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(crate) struct Packet {
    /// `[corner][axis][lane]`; NaN in lanes without a triangle.
    pub(crate) corners: [[[f32; WIDTH]; 3]; 3],
}

/// Where a triangle of a packet comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Name {
    /// Index into `Geometry::instances`; 0 in hierarchies that are placed many times.
    pub(crate) instance: u32,
    /// Index within the mesh.
    pub(crate) triangle: u32,
    /// Whether the mesh has an opacity or a medium of its own: light may pass.
    pub(crate) alpha: bool,
}

/// Triangles under a hierarchy.
#[derive(Clone, Debug)]
pub(crate) struct Faces {
    pub(crate) tree: Tree,
    /// One per leaf.
    pub(crate) packets: Vec<Packet>,
    /// Eight per leaf.
    pub(crate) names: Vec<Name>,
    /// Triangles in all.
    pub(crate) count: usize,
    /// The box of all.
    pub(crate) bounds: Bounds,
}

impl Faces {
    /// From corners and names, one to one.
    pub(crate) fn build(corners: &[[Vec3; 3]], names: &[Name], quality: Quality) -> Self {
        let boxes: Vec<Bounds> = corners.iter().map(|c| Bounds::of(c)).collect();
        let (tree, leaves) = Tree::build(&boxes, WIDTH as u32, quality);
        let mut packets = Vec::with_capacity(leaves.len());
        let mut own_names = vec![Name::default(); leaves.len() * WIDTH];
        for (leaf, own_names) in leaves.iter().zip(own_names.chunks_exact_mut(WIDTH)) {
            let mut packet = Packet { corners: [[[f32::NAN; WIDTH]; 3]; 3] };
            for (lane, &face) in leaf.iter().enumerate() {
                own_names[lane] = names[face as usize];
                for (to, from) in packet.corners.iter_mut().zip(corners[face as usize]) {
                    (0..3).for_each(|axis| to[axis][lane] = from[axis]);
                }
            }
            packets.push(packet);
        }
        let bounds = boxes.iter().fold(Bounds::EMPTY, |all, &one| all.union(one));
        Self { tree, packets, names: own_names, count: corners.len(), bounds }
    }

    /// Bytes on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.tree.nodes) + size_of_val(&*self.packets) + size_of_val(&*self.names)
    }
}
