//! A tree as the triangles it is, ray by ray in f64: what planes are measured against.
//!
//! Slow and plain on purpose; shares no code with planes, envelopes and baked pictures.

use glam::{DVec3, Vec2, Vec3};
use light::{Occlude, Ray, Spectrum};

use crate::tree_mesh::{Part, TreeMesh};

/// Triangles in a leaf of the hierarchy, at most.
const LEAF: usize = 8;

/// A mesh that answers rays.
#[derive(Debug)]
pub struct Reference<'a> {
    tree: &'a TreeMesh,
    faces: Vec<Face>,
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Face {
    corner: DVec3,
    edges: [DVec3; 2],
    part: u32,
    index: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// First face of a leaf, or first of two nodes.
    first: u32,
    /// Faces of a leaf; 0 = two nodes.
    count: u32,
}

/// Told of every face that a line cuts: which, how far away, with which barycentric weights; may shorten what is left of the line.
type Meet<'a> = dyn FnMut(Face, f64, [f32; 3], &mut f64) + 'a;

/// What a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// Along the ray \[m\].
    pub distance: f64,
    /// Unit normal of the face, on the viewer's side.
    pub normal: DVec3,
    /// Linear colour.
    pub colour: Vec3,
    /// True for leaves.
    pub leaf: bool,
}

impl<'a> Reference<'a> {
    /// Triangles of the mesh that have an area.
    pub fn new(tree: &'a TreeMesh) -> Self {
        let mut faces = Vec::new();
        for (part, of) in tree.parts.iter().enumerate() {
            for (index, corners) in of.mesh.triangles.iter().enumerate() {
                let [a, b, c] = corners.map(|i| of.mesh.positions[i as usize].as_dvec3());
                let edges = [b - a, c - a];
                if edges[0].cross(edges[1]) != DVec3::ZERO {
                    faces.push(Face { corner: a, edges, part: part as u32, index: index as u32 });
                }
            }
        }
        let nodes = build(&mut faces);
        Self { tree, faces, nodes }
    }

    /// What the line from `origin` along the unit vector `direction` meets first, farther than `after` \[m\]; faces with alpha
    /// are there where it is at least 1/2.
    pub fn first(&self, origin: DVec3, direction: DVec3, after: f64) -> Option<Met> {
        let mut reach = f64::INFINITY;
        let mut first = None;
        self.walk(origin, direction, &mut reach, &mut |face, t, at, reach| {
            if t > after && self.opacity(&face, at) >= 0.5 {
                *reach = t;
                first = Some((face, t, at));
            }
        });
        first.map(|(face, distance, at)| {
            let part = &self.tree.parts[face.part as usize];
            let normal = face.edges[0].cross(face.edges[1]).normalize();
            let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
            Met { distance, normal, colour: colour(part, face.index, at), leaf: part.leaf }
        })
    }

    /// Share of light that passes all faces between `after` and `reach` \[m\].
    pub fn through(&self, origin: DVec3, direction: DVec3, after: f64, reach: f64) -> f64 {
        let (mut left, mut reach) = (1.0, reach);
        self.walk(origin, direction, &mut reach, &mut |face, t, at, reach| {
            if t > after {
                left *= 1.0 - f64::from(self.opacity(&face, at));
                if left == 0.0 {
                    *reach = 0.0;
                }
            }
        });
        left
    }

    fn opacity(&self, face: &Face, at: [f32; 3]) -> f32 {
        let part = &self.tree.parts[face.part as usize];
        part.mesh.opacity.as_ref().map_or(1.0, |opacity| opacity.at(uv(part, face.index, at), 0.0))
    }

    fn walk(&self, origin: DVec3, direction: DVec3, reach: &mut f64, meet: &mut Meet) {
        let mut open = Vec::with_capacity(64);
        open.extend((!self.nodes.is_empty()).then_some(0u32));
        let inverse = direction.map(|d| if d == 0.0 { 1e300 } else { 1.0 / d });
        while let Some(node) = open.pop() {
            let node = &self.nodes[node as usize];
            let (a, b) = ((node.low - origin) * inverse, (node.high - origin) * inverse);
            let (into, out) = (a.min(b).max_element(), a.max(b).min_element());
            if into > out || out < 0.0 || into > *reach {
                continue;
            }
            if node.count == 0 {
                // The nearer one is looked into first, so that what it shows cuts the other off.
                let [a, b] = [node.first, node.first + 1];
                let middle = |i: u32| self.nodes[i as usize].low + self.nodes[i as usize].high;
                let swap = (middle(b) - middle(a)).dot(direction) < 0.0;
                open.extend(if swap { [a, b] } else { [b, a] });
                continue;
            }
            for face in &self.faces[node.first as usize..][..node.count as usize] {
                if let Some((t, at)) = cut(face, origin, direction)
                    && t < *reach
                {
                    meet(*face, t, at, reach);
                }
            }
        }
    }
}

impl Occlude for Reference<'_> {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let (origin, direction) = (segment.origin.as_dvec3(), segment.direction.as_dvec3());
        Spectrum::splat(self.through(origin, direction, 0.0, f64::from(segment.length)) as f32)
    }
}

/// Distance and barycentric weights where a line cuts a triangle (Möller & Trumbore 1997).
fn cut(face: &Face, origin: DVec3, direction: DVec3) -> Option<(f64, [f32; 3])> {
    let [e1, e2] = face.edges;
    let p = direction.cross(e2);
    let determinant = e1.dot(p);
    let s = origin - face.corner;
    let q = s.cross(e1);
    let (v, w, t) = (s.dot(p) / determinant, direction.dot(q) / determinant, e2.dot(q) / determinant);
    let inside = v >= 0.0 && w >= 0.0 && v + w <= 1.0 && t > 0.0;
    inside.then_some((t, [1.0 - v - w, v, w].map(|weight| weight as f32)))
}

fn uv(part: &Part, index: u32, at: [f32; 3]) -> Vec2 {
    let corners = part.mesh.triangles[index as usize];
    let one = |i: usize| part.mesh.uvs.get(corners[i] as usize).copied().unwrap_or_default() * at[i];
    one(0) + one(1) + one(2)
}

fn colour(part: &Part, index: u32, at: [f32; 3]) -> Vec3 {
    let corners = part.mesh.triangles[index as usize];
    let one = |i: usize| part.mesh.colours.get(corners[i] as usize).copied().unwrap_or(Vec3::ONE) * at[i];
    let texture = part.texture.as_ref().map_or(Vec3::ONE, |t| t.sample(uv(part, index, at), 0.0).0);
    part.colour * (one(0) + one(1) + one(2)) * texture
}

/// Halves along the longest axis of centres.
fn build(faces: &mut [Face]) -> Vec<Node> {
    let mut nodes = Vec::new();
    if faces.is_empty() {
        return nodes;
    }
    let corners = |f: &Face| [f.corner, f.corner + f.edges[0], f.corner + f.edges[1]];
    let centre = |f: &Face| f.corner + (f.edges[0] + f.edges[1]) / 3.0;
    let empty = Node { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, first: 0, count: 0 };
    nodes.push(empty);
    let mut open = vec![(0usize, 0..faces.len())];
    while let Some((at, range)) = open.pop() {
        let here = &mut faces[range.clone()];
        let mut node = empty;
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for face in here.iter() {
            for corner in corners(face) {
                // A millionth of a metre for the roundings of edges.
                (node.low, node.high) = (node.low.min(corner - 1e-6), node.high.max(corner + 1e-6));
            }
            (low, high) = (low.min(centre(face)), high.max(centre(face)));
        }
        if here.len() <= LEAF {
            (node.first, node.count) = (range.start as u32, here.len() as u32);
        } else {
            let axis = (high - low).max_position();
            let middle = here.len() / 2;
            here.select_nth_unstable_by(middle, |a, b| centre(a)[axis].total_cmp(&centre(b)[axis]));
            node.first = nodes.len() as u32;
            nodes.extend([empty; 2]);
            let split = range.start + middle;
            open.extend([
                (node.first as usize, range.start..split),
                (node.first as usize + 1, split..range.end),
            ]);
        }
        nodes[at] = node;
    }
    nodes
}
