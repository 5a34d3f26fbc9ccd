//! Which triangles of a mesh go on into each other, and who answers for what they share.

use std::collections::HashMap;

use glam::{DVec3, Vec3};
use light::Mesh;

use super::buried::Shared;

/// Faces without normals of their own go on into each other where they lie in one plane: cosine of 1.4·10⁻³ rad,
/// some hundred times what f32 corners leave of the flatness of a well-shaped quadrilateral.
const ONE_PLANE: f64 = 1.0 - 1e-6;

/// The triangle that answers for a corner or for an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Owner {
    /// Index within the mesh.
    pub(crate) triangle: u32,
    /// Corner of that triangle; or edge, which goes from the corner of this number to the next.
    pub(crate) part: u8,
    /// Whether several triangles share it.
    pub(crate) shared: bool,
}

/// For every triangle of a mesh, who answers for its corners and edges.
///
/// Two triangles go on into each other across an edge that both have, in opposite directions and no third has,
/// where their normals agree: those of the mesh at both ends (and the faces do not turn by 90° or more), or without
/// any, those of the faces. Positions are
/// compared by their bits. Of such an edge the rounder triangle is the owner (larger inscribed circle), of a corner
/// that with the widest angle there: samples are taken a little inside the owner, where there is most room.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seams {
    pub(crate) corners: Vec<[Owner; 3]>,
    pub(crate) edges: Vec<[Owner; 3]>,
}

impl Seams {
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let shapes: Vec<Shape> = mesh.triangles.iter().map(|t| Shape::new(mesh, *t)).collect();
        let partners = partners(mesh, &shapes);
        let edges =
            (0..shapes.len()).map(|t| [0, 1, 2].map(|k| edge_owner(&shapes, &partners, t, k))).collect();
        Self { corners: corner_owners(&shapes, &partners), edges }
    }

    /// What of a triangle others have too.
    pub(crate) fn shared(&self, triangle: u32) -> Shared {
        let parts = |of: &[[Owner; 3]]| of[triangle as usize].map(|owner| owner.shared);
        Shared { edges: parts(&self.edges), corners: parts(&self.corners) }
    }
}

/// What decides between owners.
struct Shape {
    /// Unit normal; zero for a triangle without area.
    normal: DVec3,
    /// Radius of the inscribed circle \[m\].
    inradius: f64,
    angles: [f64; 3],
}

impl Shape {
    fn new(mesh: &Mesh, triangle: [u32; 3]) -> Self {
        let corners = triangle.map(|i| mesh.positions[i as usize].as_dvec3());
        let sides = [0, 1, 2].map(|k| corners[(k + 1) % 3] - corners[k]);
        let cross = sides[0].cross(sides[1]);
        let around: f64 = sides.iter().map(|side| side.length()).sum();
        Self {
            normal: cross.normalize_or_zero(),
            inradius: if around > 0.0 { cross.length() / around } else { 0.0 },
            angles: [0, 1, 2].map(|k| cross.length().atan2(sides[k].dot(-sides[(k + 2) % 3]))),
        }
    }
}

/// For every edge of every triangle, the triangle and edge on its other side that goes on from it.
fn partners(mesh: &Mesh, shapes: &[Shape]) -> Vec<[Option<(u32, u8)>; 3]> {
    // A position that occurs at several indices is one corner; so are 0 and −0.
    let mut names = HashMap::new();
    let names: Vec<u32> = mesh
        .positions
        .iter()
        .map(|p| {
            let next = names.len() as u32;
            *names.entry((*p + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(next)
        })
        .collect();
    let ends = |t: usize, k: usize| [k, (k + 1) % 3].map(|k| mesh.triangles[t][k]);
    let mut directed: HashMap<[u32; 2], (u32, u8, u32)> = HashMap::new();
    for t in 0..shapes.len() {
        for k in 0..3 {
            let entry =
                directed.entry(ends(t, k).map(|i| names[i as usize])).or_insert((t as u32, k as u8, 0));
            entry.2 += 1;
        }
    }
    let alone = |ends: [u32; 2]| directed.get(&ends).filter(|entry| entry.2 == 1).map(|&(t, k, _)| (t, k));
    (0..shapes.len())
        .map(|t| {
            [0, 1, 2].map(|k| {
                let [from, to] = ends(t, k).map(|i| names[i as usize]);
                alone([from, to])?;
                let (other, edge) = alone([to, from])?;
                let there = ends(other as usize, edge as usize);
                go_on(mesh, [&shapes[t], &shapes[other as usize]], ends(t, k), there).then_some((other, edge))
            })
        })
        .collect()
}

/// Whether normals agree across an edge, whose ends are given as either triangle has them.
fn go_on(mesh: &Mesh, shapes: [&Shape; 2], here: [u32; 2], there: [u32; 2]) -> bool {
    let [a, b] = shapes.map(|shape| shape.normal);
    if a == DVec3::ZERO || b == DVec3::ZERO {
        return false;
    }
    if mesh.normals.is_empty() {
        return a.dot(b) >= ONE_PLANE;
    }
    let normal = |i: u32| mesh.normals[i as usize];
    // Two that lie on each other, one for either side, do not go on.
    a.dot(b) > 0.0 && normal(here[0]) == normal(there[1]) && normal(here[1]) == normal(there[0])
}

fn edge_owner(shapes: &[Shape], partners: &[[Option<(u32, u8)>; 3]], t: usize, k: usize) -> Owner {
    let own = Owner { triangle: t as u32, part: k as u8, shared: false };
    let Some((other, edge)) = partners[t][k] else { return own };
    let rounder = shapes[other as usize].inradius.total_cmp(&shapes[t].inradius);
    // Among equals the first.
    if rounder.then((t as u32).cmp(&other)).is_gt() {
        Owner { triangle: other, part: edge, shared: true }
    } else {
        Owner { shared: true, ..own }
    }
}

/// The corners that meet at one position and go on into each other are one: joined across every shared edge.
fn corner_owners(shapes: &[Shape], partners: &[[Option<(u32, u8)>; 3]]) -> Vec<[Owner; 3]> {
    let mut parents: Vec<u32> = (0..3 * shapes.len() as u32).collect();
    for (t, edges) in partners.iter().enumerate() {
        for (k, partner) in edges.iter().enumerate() {
            let &Some((other, edge)) = partner else { continue };
            let corner = |t: u32, k: usize| 3 * t + (k % 3) as u32;
            let (t, edge) = (t as u32, edge as usize);
            join(&mut parents, corner(t, k), corner(other, edge + 1));
            join(&mut parents, corner(t, k + 1), corner(other, edge));
        }
    }
    let angle = |corner: u32| shapes[corner as usize / 3].angles[corner as usize % 3];
    let mut widest: HashMap<u32, (u32, bool)> = HashMap::new();
    for corner in 0..parents.len() as u32 {
        let root = root(&mut parents, corner);
        widest
            .entry(root)
            .and_modify(|(best, shared)| {
                *shared = true;
                if angle(corner) > angle(*best) {
                    *best = corner;
                }
            })
            .or_insert((corner, false));
    }
    let owner = |corner: u32, parents: &mut [u32]| {
        let (best, shared) = widest[&root(parents, corner)];
        Owner { triangle: best / 3, part: (best % 3) as u8, shared }
    };
    (0..shapes.len() as u32).map(|t| [0, 1, 2].map(|k| owner(3 * t + k, &mut parents))).collect()
}

fn root(parents: &mut [u32], mut at: u32) -> u32 {
    while parents[at as usize] != at {
        // Every step shortens the way for the next.
        parents[at as usize] = parents[parents[at as usize] as usize];
        at = parents[at as usize];
    }
    at
}

fn join(parents: &mut [u32], a: u32, b: u32) {
    let [a, b] = [root(parents, a), root(parents, b)];
    parents[a.max(b) as usize] = a.min(b);
}
