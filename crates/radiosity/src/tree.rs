//! The tree over all patches: halves of faces below, groups of faces above.

use std::f64::consts::PI;

use glam::DVec3;

use crate::triangle::{self, Corners};

/// A part of the scene's surface seen from one side: a piece of a face, or a group of faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// Of a piece; zeros of a group.
    pub(crate) corners: Corners,
    /// \[m\]
    pub(crate) centre: DVec3,
    /// All of it lies within this of the centre \[m\].
    pub(crate) radius: f64,
    /// Middle of its normals, a unit vector.
    pub(crate) normal: DVec3,
    /// No normal is farther from that \[rad\].
    pub(crate) spread: f64,
    /// \[m²\]
    pub(crate) area: f64,
    /// Its halves, after it in the list; none for a patch.
    pub(crate) children: Option<[u32; 2]>,
    /// For a piece: which corner it is halved from.
    pub(crate) apex: u8,
    pub(crate) is_piece: bool,
    /// Part of space that all of it is lit in, or [`MIXED`].
    pub(crate) part: u32,
}

/// Of nodes that lie in several parts of space. They are never seen as one.
pub(crate) const MIXED: u32 = u32::MAX;

impl Node {
    pub(crate) fn piece(corners: Corners) -> Self {
        let cross = triangle::cross(&corners);
        Self {
            corners,
            centre: triangle::centre(&corners),
            radius: triangle::radius(&corners),
            normal: cross.normalize_or_zero(),
            spread: 0.0,
            area: 0.5 * cross.length(),
            children: None,
            apex: triangle::apex(&corners) as u8,
            is_piece: true,
            part: 0,
        }
    }

    /// A point that looks along the unit vector `normal`.
    pub(crate) fn point(at: DVec3, normal: DVec3) -> Self {
        Self { normal, ..Self::piece([at; 3]) }
    }

    /// Writes corners of a convex hull around it to `into`, and answers how many: 3, or 8 for a group.
    pub(crate) fn corners_of_hull(&self, into: &mut [DVec3]) -> usize {
        if self.is_piece {
            into[..3].copy_from_slice(&self.corners);
            return 3;
        }
        for (k, corner) in into[..8].iter_mut().enumerate() {
            let toward =
                DVec3::from_array([1, 2, 4].map(|bit| if k & bit > 0 { self.radius } else { -self.radius }));
            *corner = self.centre + toward;
        }
        8
    }

    fn group(children: [u32; 2], parts: [&Self; 2]) -> Self {
        let area = parts[0].area + parts[1].area;
        let centre = (parts[0].centre * parts[0].area + parts[1].centre * parts[1].area) / area;
        let normal =
            (parts[0].normal * parts[0].area + parts[1].normal * parts[1].area).normalize_or(DVec3::Y);
        let radius = parts.map(|part| part.centre.distance(centre) + part.radius);
        let spread = parts.map(|part| normal.angle_between(part.normal) + part.spread);
        Self {
            corners: [DVec3::ZERO; 3],
            centre,
            radius: radius[0].max(radius[1]),
            normal,
            spread: spread[0].max(spread[1]).min(PI),
            area,
            children: Some(children),
            apex: 0,
            is_piece: false,
            part: common(parts.map(|part| part.part)),
        }
    }

    /// Its mirror image in the plane through `point` with unit normal `normal`; the front stays the front.
    pub(crate) fn image(&self, point: DVec3, normal: DVec3) -> Self {
        let turn = |v: DVec3| v - normal * (2.0 * v.dot(normal));
        let mirror = |p: DVec3| p - normal * (2.0 * (p - point).dot(normal));
        let [a, b, c] = self.corners;
        // Corners run the other way round in a mirror.
        Self {
            corners: [a, c, b].map(mirror),
            centre: mirror(self.centre),
            normal: turn(self.normal),
            ..*self
        }
    }
}

/// The part of space of two nodes together.
pub(crate) fn common([a, b]: [u32; 2]) -> u32 {
    if a == b { a } else { MIXED }
}

/// All nodes, every one before its children; the first is the root, if there is any.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
}

impl Tree {
    /// Groups the trees of faces, whose child numbers count from each tree's own start. Answers also where each begins.
    pub(crate) fn new(faces: Vec<Vec<Node>>) -> (Self, Vec<u32>) {
        let groups = faces.len().saturating_sub(1);
        let mut starts = Vec::with_capacity(faces.len());
        let mut nodes = vec![Node::piece([DVec3::ZERO; 3]); groups];
        for face in faces {
            let start = nodes.len() as u32;
            starts.push(start);
            nodes.extend(face.into_iter().map(|node| Node {
                children: node.children.map(|children| children.map(|child| child + start)),
                ..node
            }));
        }
        let mut order = starts.clone();
        // Parts of space first: what is mixed is not seen as one.
        order.sort_by_key(|&start| nodes[start as usize].part);
        let mut next = 0;
        if !order.is_empty() {
            group(&mut nodes, &mut order, &mut next);
        }
        (Self { nodes }, starts)
    }

    /// The point that belongs to one of the unit square, areas kept, and the normal there.
    pub(crate) fn point(&self, node: &Node, at: [f64; 2]) -> (DVec3, DVec3) {
        let (mut node, [mut u, v]) = (node, at);
        while !node.is_piece
            && let Some(children) = node.children
        {
            let [first, second] = children.map(|child| &self.nodes[child as usize]);
            let share = first.area / node.area;
            (node, u) = if u < share { (first, u / share) } else { (second, (u - share) / (1.0 - share)) };
        }
        (triangle::point(&node.corners, [u.clamp(0.0, 1.0), v]), node.normal)
    }

    /// Area projected along the unit vector `toward`, of what faces there \[m²\].
    pub(crate) fn projected(&self, node: &Node, toward: DVec3) -> f64 {
        match node.children {
            Some(children) if !node.is_piece => {
                children.iter().map(|&child| self.projected(&self.nodes[child as usize], toward)).sum()
            }
            _ => node.area * node.normal.dot(toward).max(0.0),
        }
    }
}

/// Groups the nodes in `order`, and answers which is theirs.
fn group(nodes: &mut [Node], order: &mut [u32], next: &mut u32) -> u32 {
    if let [alone] = order {
        return *alone;
    }
    let mine = *next;
    *next += 1;
    let part = |start: &u32| nodes[*start as usize].part;
    let first = part(&order[0]);
    let mut half = order.partition_point(|start| part(start) == first);
    if half == order.len() {
        sort_by_widest(nodes, order);
        half /= 2;
    }
    let (first, second) = order.split_at_mut(half);
    let children = [group(nodes, first, next), group(nodes, second, next)];
    nodes[mine as usize] = Node::group(children, children.map(|child| &nodes[child as usize]));
    mine
}

/// Brings nodes in order along what tells them apart most.
fn sort_by_widest(nodes: &[Node], order: &mut [u32]) {
    // Six numbers tell parts apart: where they are, and where they look, which counts as much as half the extent.
    let bounds = |value: &dyn Fn(&Node) -> DVec3, order: &[u32]| {
        let values = order.iter().map(|&i| value(&nodes[i as usize]));
        let (low, high) =
            values.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let place = bounds(&|node| node.centre, order);
    let look = bounds(&|node| node.normal, order) * (0.5 * place.max_element());
    let widths = [place.to_array(), look.to_array()];
    let widest =
        (1..6).fold(0, |best, k| if widths[k / 3][k % 3] > widths[best / 3][best % 3] { k } else { best });
    let key = |i: u32| {
        let node = &nodes[i as usize];
        [node.centre.to_array(), node.normal.to_array()][widest / 3][widest % 3]
    };
    // Ties by number, so that the order never depends on the sort.
    order.sort_unstable_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
}
