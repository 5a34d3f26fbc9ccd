//! Many trees of few species.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f32::consts::TAU;

use glam::Vec3;
use light::{Path, Ray};

use crate::hierarchy::{self, Inside, Node, Probe};
use crate::leaf::{Crossing, Met, Shading};
use crate::planes::{Aim, Cross, Planes, Setting};
use crate::species::Species;

/// One tree: 24 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Index into the stand's species.
    pub species: u32,
    /// Its foot in the world \[m\].
    pub position: Vec3,
    /// How high it is \[m\], > 0; its width follows.
    pub height: f32,
    /// How it is turned about its axis \[rad\]; its side view is mirrored for negative ones and beyond half a turn.
    pub rotation: f32,
}

/// Many trees of few species, over which rays find their way in logarithmic time.
///
/// Asked as an occluder ([`light::Occlude`]) it is its shadow planes, asked what a ray sees through it ([`light::Traverse`]) its
/// display planes.
#[derive(Debug)]
pub struct Stand {
    pub(crate) species: Vec<Species>,
    pub(crate) trees: Vec<Placed>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) setting: Setting,
    pub(crate) shading: Shading,
}

/// Why placements are no stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StandError {
    /// This tree's species does not exist.
    NoSpecies(usize),
    /// This tree's height is not above 0, or its place or rotation is no number.
    NotANumber(usize),
    /// More trees than numbers for them.
    TooMany,
}

impl std::fmt::Display for StandError {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoSpecies(tree) => write!(out, "tree {tree}: no such species"),
            Self::NotANumber(tree) => {
                write!(out, "tree {tree}: position and rotation must be numbers, height one above 0")
            }
            Self::TooMany => out.write_str("more than 2³⁰ trees"),
        }
    }
}

impl std::error::Error for StandError {}

impl Stand {
    /// A stand of `trees`, whose order it may change; rotations are brought within half a turn.
    pub fn new(species: Vec<Species>, mut trees: Vec<Placed>) -> Result<Self, StandError> {
        if trees.len() > 1 << 30 {
            return Err(StandError::TooMany);
        }
        for (i, tree) in trees.iter().enumerate() {
            if tree.species as usize >= species.len() {
                return Err(StandError::NoSpecies(i));
            }
            let finite = tree.position.is_finite() && tree.rotation.is_finite() && tree.height.is_finite();
            if !finite || tree.height <= 0.0 {
                return Err(StandError::NotANumber(i));
            }
        }
        trees.iter_mut().for_each(|tree| tree.rotation = within_half_a_turn(tree.rotation));
        let nodes = hierarchy::build(&mut trees, &species);
        let (setting, shading) = (Setting::default(), Shading::default());
        Ok(Self { species, trees, nodes, setting, shading })
    }

    /// The same with planes set and shaded in another way.
    #[must_use]
    pub fn with(self, setting: Setting, shading: Shading) -> Self {
        Self { setting, shading, ..self }
    }

    /// Its species.
    pub fn species(&self) -> &[Species] {
        &self.species
    }

    /// Its trees, in the order in which crossings number them.
    pub fn trees(&self) -> &[Placed] {
        &self.trees
    }

    /// Lower and upper corner of all trees \[m\]; none without trees.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        self.nodes.first().map(|root| [root.low, root.high])
    }

    /// Bytes in memory of placements with their hierarchy, and of the species' pictures.
    pub fn bytes(&self) -> [usize; 2] {
        let trees = self.trees.capacity() * size_of::<Placed>() + self.nodes.capacity() * size_of::<Node>();
        [trees, self.species.iter().map(Species::bytes).sum()]
    }

    /// A ray in a tree's own metres, and how many of the world's they are.
    pub(crate) fn local(&self, tree: u32, ray: &Ray) -> (&Species, &Placed, (Vec3, Vec3), f32) {
        let placed = &self.trees[tree as usize];
        let species = &self.species[placed.species as usize];
        let scale = placed.height / species.description().height;
        (species, placed, ((ray.origin - placed.position) / scale, ray.direction), scale)
    }

    /// What a ray crosses, nearest first, up to its length, with planes set for an eye at its origin (or for its direction,
    /// where `path` does not spread); until `receive` answers false.
    pub fn crossings(&self, ray: &Ray, path: &Path, mut receive: impl FnMut(&Crossing) -> bool) {
        let probe = Probe::new(ray);
        let mut queue = BinaryHeap::new();
        let open = |queue: &mut BinaryHeap<Next>, node: u32| {
            let Node { low, high, .. } = self.nodes[node as usize];
            queue.extend(probe.enter(low, high).map(|at| Next { at, what: What::Node(node) }));
        };
        if !self.nodes.is_empty() {
            open(&mut queue, 0);
        }
        while let Some(Next { what, .. }) = queue.pop() {
            match what {
                What::Node(node) => match self.nodes[node as usize].inside() {
                    Inside::Nodes(two) => two.into_iter().for_each(|node| open(&mut queue, node)),
                    Inside::Trees(trees) => {
                        for tree in trees {
                            self.cross(tree, ray, path, &mut queue);
                        }
                    }
                },
                What::Cross(tree, cross, facing) => {
                    if let Some(crossing) = self.look(tree, &cross, facing, (ray, path))
                        && !receive(&crossing)
                    {
                        return;
                    }
                }
            }
        }
    }

    /// Crossings with one tree, in any order: what tests compare with.
    #[cfg(test)]
    pub(crate) fn alone(&self, tree: u32, ray: &Ray, path: &Path) -> Vec<Crossing> {
        let mut queue = BinaryHeap::new();
        self.cross(tree, ray, path, &mut queue);
        let crossing = |next: Next| match next.what {
            What::Cross(tree, cross, facing) => self.look(tree, &cross, facing, (ray, path)),
            What::Node(_) => None,
        };
        queue.into_iter().filter_map(crossing).collect()
    }

    /// Where a ray crosses the planes of one tree.
    fn cross(&self, tree: u32, ray: &Ray, path: &Path, queue: &mut BinaryHeap<Next>) {
        let (species, placed, line, scale) = self.local(tree, ray);
        let aim = if path.spread > 0.0 { Aim::Eye(line.0) } else { Aim::Toward(-line.1) };
        let planes = Planes::new(species, placed, aim, self.setting);
        planes.cross(species, line, ray.length / scale, |cross| {
            queue.push(Next { at: cross.t * scale, what: What::Cross(tree, cross, planes.facing) });
        });
    }

    /// What is on a plane where a ray crosses it; none where its picture is clear.
    fn look(&self, tree: u32, cross: &Cross, facing: Vec3, (ray, path): (&Ray, &Path)) -> Option<Crossing> {
        let (species, placed, line, scale) = self.local(tree, ray);
        let width = path.width_at(cross.t * scale) / scale;
        let (colour, alpha) = cross.sheet(species).sample(cross.uv, cross.texels(species, width));
        let opacity = alpha * cross.opacity;
        let met = Met { tree, placed, species, facing, line, scale, width };
        (opacity > 0.0).then(|| met.crossing(cross, colour, opacity))
    }
}

/// The same angle within \[−π, π\]: its sign says which half of a turn it is in.
fn within_half_a_turn(angle: f32) -> f32 {
    angle - TAU * (angle / TAU).round()
}

/// What comes next along a ray.
struct Next {
    at: f32,
    what: What,
}

enum What {
    Node(u32),
    /// Of a tree's plane, with where its vertical plane faces.
    Cross(u32, Cross, Vec3),
}

impl Next {
    /// Nodes before crossings at one distance, so that nothing nearer is still hidden in them; then by number.
    fn key(&self) -> (u8, u32, u32) {
        match &self.what {
            What::Node(node) => (0, *node, 0),
            What::Cross(tree, cross, _) => (1, *tree, cross.slice.map_or(0, |i| i + 1)),
        }
    }
}

impl Ord for Next {
    /// The greatest is the nearest: what a heap gives first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.at.total_cmp(&self.at).then_with(|| other.key().cmp(&self.key()))
    }
}

impl PartialOrd for Next {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Next {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Next {}
