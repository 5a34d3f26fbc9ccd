//! Boxes around trees and around boxes, so that a ray looks at few of many.

use glam::Vec3;

use crate::species::Species;
use crate::stand::Placed;

/// Trees in a leaf, at most: fewer cost memory, more cost time.
const LEAF: usize = 4;

/// Nodes that wait during a walk, at most: halving 2³² trees goes 30 deep.
const STACK: usize = 64;

/// An axis-aligned box and what is in it: 32 bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) low: Vec3,
    /// First tree of a leaf, or first of two neighbouring nodes.
    first: u32,
    pub(crate) high: Vec3,
    /// Trees of a leaf; 0 = an inner node.
    count: u32,
}

/// What is in a box.
pub(crate) enum Inside {
    /// These trees.
    Trees(std::ops::Range<u32>),
    /// These two nodes.
    Nodes([u32; 2]),
}

impl Node {
    pub(crate) fn inside(&self) -> Inside {
        match self.count {
            0 => Inside::Nodes([self.first, self.first + 1]),
            count => Inside::Trees(self.first..self.first + count),
        }
    }
}

/// A half-line prepared for boxes.
#[derive(Clone, Copy)]
pub(crate) struct Probe {
    origin: Vec3,
    inverse: Vec3,
    length: f32,
}

impl Probe {
    pub(crate) fn new(ray: &light::Ray) -> Self {
        // A finite stand-in for 1/0: 0 · ∞ would be no number.
        let inverse = |d: f32| if d.abs() < 1e-30 { 1e30f32.copysign(d) } else { 1.0 / d };
        let d = ray.direction;
        Self {
            origin: ray.origin,
            inverse: Vec3::new(inverse(d.x), inverse(d.y), inverse(d.z)),
            length: ray.length,
        }
    }

    /// Where it enters a box \[m\], ≥ 0; none where it misses.
    pub(crate) fn enter(&self, low: Vec3, high: Vec3) -> Option<f32> {
        let (a, b) = ((low - self.origin) * self.inverse, (high - self.origin) * self.inverse);
        let into = a.min(b).max_element().max(0.0);
        // 1 + 2 γ₃ (Ize 2013), as everywhere boxes are met in f32.
        let out = a.max(b).min_element() * (1.0 + 2.0 * light::rounding::gamma(3));
        (into <= out.min(self.length)).then_some(into)
    }
}

/// The box of a placed tree: planes turn, so it is as deep as wide.
pub(crate) fn bounds(placed: &Placed, species: &Species) -> [Vec3; 2] {
    let tree = species.description();
    let radius = tree.half_width * placed.height / tree.height;
    let (low, high) = (Vec3::new(-radius, 0.0, -radius), Vec3::new(radius, placed.height, radius));
    // Roundings of positions far from the origin.
    let slack = Vec3::splat(placed.position.abs().max_element() * 4.0 * f32::EPSILON);
    [placed.position + low - slack, placed.position + high + slack]
}

/// The nodes over `trees`, root first; trees are reordered to go with them. Empty for none.
pub(crate) fn build(trees: &mut [Placed], kinds: &[Species]) -> Vec<Node> {
    let mut nodes = Vec::new();
    if trees.is_empty() {
        return nodes;
    }
    let empty = Node { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY, first: 0, count: 0 };
    nodes.push(empty);
    let mut open = vec![(0usize, 0..trees.len())];
    while let Some((node, range)) = open.pop() {
        let here = &mut trees[range.clone()];
        let mut at = empty;
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for tree in here.iter() {
            let [under, over] = bounds(tree, &kinds[tree.species as usize]);
            (at.low, at.high) = (at.low.min(under), at.high.max(over));
            (low, high) = (low.min(tree.position), high.max(tree.position));
        }
        if here.len() <= LEAF {
            (at.first, at.count) = (range.start as u32, here.len() as u32);
        } else {
            let axis = (high - low).max_position();
            let middle = here.len() / 2;
            here.select_nth_unstable_by(middle, |a, b| a.position[axis].total_cmp(&b.position[axis]));
            at.first = nodes.len() as u32;
            nodes.extend([empty; 2]);
            let split = range.start + middle;
            open.push((at.first as usize + 1, split..range.end));
            open.push((at.first as usize, range.start..split));
        }
        nodes[node] = at;
    }
    nodes.shrink_to_fit();
    nodes
}

/// Visits every tree whose box a ray meets, in any order, until `visit` says so by false.
pub(crate) fn walk(nodes: &[Node], probe: &Probe, mut visit: impl FnMut(u32) -> bool) {
    select(nodes, |low, high| probe.enter(low, high).is_some(), &mut visit);
}

/// Visits every tree in boxes that `wanted` wants, in any order, until `visit` says so by false.
pub(crate) fn select(
    nodes: &[Node],
    wanted: impl Fn(Vec3, Vec3) -> bool,
    mut visit: impl FnMut(u32) -> bool,
) {
    if nodes.is_empty() {
        return;
    }
    let (mut stack, mut height) = ([0u32; STACK], 1);
    while height > 0 {
        height -= 1;
        let node = &nodes[stack[height] as usize];
        if !wanted(node.low, node.high) {
            continue;
        }
        match node.inside() {
            Inside::Nodes(two) => {
                stack[height..height + 2].copy_from_slice(&two);
                height += 2;
            }
            Inside::Trees(mut trees) => {
                if !trees.all(&mut visit) {
                    return;
                }
            }
        }
    }
}
