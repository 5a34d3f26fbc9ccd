//! What can stand between a place and the sky, in a hierarchy that is walked from near to far.

mod clip;
mod tree;

use glam::{DAffine3, DMat3, DVec3};
use light::{Bodies, Geometry, Mesh};

pub(crate) use clip::above;
use tree::Tree;
pub(crate) use tree::{Bounds, Oriented};

/// Triangles in a leaf at most.
const LEAF: usize = 2;

/// Whoever walks the obstacles. All coordinates are relative to the place, in a frame of the visitor's.
pub(crate) trait Visit {
    /// Whether anything within a box can matter; `bounds` are those of `solid`, which may be much smaller.
    fn wants(&mut self, bounds: &Bounds, solid: &Oriented) -> bool;
    /// One triangle.
    fn triangle(&mut self, corners: [DVec3; 3]);
}

/// Triangles in the world.
///
/// Two levels: a mesh that is placed many times is kept once, in the world as its first placement stands.
#[derive(Clone, Debug, Default)]
pub(crate) struct Obstacles {
    parts: Vec<Part>,
    placements: Vec<Placement>,
    tree: Tree,
}

/// The triangles of one mesh, as its first placement stands.
#[derive(Clone, Debug)]
struct Part {
    corners: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    tree: Tree,
}

#[derive(Clone, Copy, Debug)]
struct Placement {
    part: u32,
    /// From where the first placement stands to where this one does.
    there_from_first: DAffine3,
}

/// Whether the plane of a triangle passes the place, the origin, within `error` \[m\] and rounding: it is then seen from its
/// edge, or it touches the place and would hide one half of everything, which one only rounding knows.
pub(crate) fn is_edge_on(corners: &[DVec3; 3], error: f64) -> bool {
    let [a, b, c] = *corners;
    let across = (b - a).cross(c - a);
    let reach = a.abs().max(b.abs()).max(c.abs()).max_element();
    let near = error + 8.0 * f64::EPSILON * reach;
    let distance = a.dot(across);
    !distance.is_finite() || distance * distance <= near * near * across.length_squared()
}

impl Part {
    fn new(corners: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let at = |triangle: &[u32; 3]| triangle.map(|i| corners[i as usize]);
        let boxes: Vec<Bounds> = triangles.iter().map(|t| Bounds::around(at(t))).collect();
        let tree = Tree::new(&boxes, LEAF);
        Self { corners, triangles: triangles.to_vec(), tree }
    }
}

impl Obstacles {
    /// The meshes of `geometry` that are `wanted`, and the hulls of `bodies`.
    pub(crate) fn new(
        geometry: &Geometry,
        wanted: impl Fn(&Mesh) -> bool,
        bodies: Option<&dyn Bodies>,
    ) -> Self {
        let mut obstacles = Self::default();
        let mut firsts: Vec<Option<(u32, DAffine3)>> = vec![None; geometry.meshes.len()];
        for instance in &geometry.instances {
            let mesh = &geometry.meshes[instance.mesh as usize];
            if !wanted(mesh) {
                continue;
            }
            let placed = instance.world_from_mesh;
            let placement = match firsts[instance.mesh as usize] {
                Some((part, mesh_from_first)) => {
                    Placement { part, there_from_first: placed * mesh_from_first }
                }
                None => {
                    let corners = mesh.positions.iter().map(|p| placed.transform_point3(p.as_dvec3()));
                    let own = obstacles.add(Part::new(corners.collect(), &mesh.triangles));
                    // A placement that flattens the mesh cannot be undone: others do not build on it.
                    let back = placed.inverse();
                    firsts[instance.mesh as usize] = back.is_finite().then_some((own.part, back));
                    own
                }
            };
            obstacles.placements.push(placement);
        }
        for hull in bodies.map_or(&[][..], |bodies| bodies.hulls()) {
            let placement = obstacles.add(Part::new(hull.corners.clone(), &hull.faces));
            obstacles.placements.push(placement);
        }
        let boxes: Vec<Bounds> = obstacles.placements.iter().map(|p| obstacles.bounds(p)).collect();
        obstacles.tree = Tree::new(&boxes, 1);
        obstacles
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.tree.nodes.is_empty()
    }

    fn add(&mut self, part: Part) -> Placement {
        self.parts.push(part);
        Placement { part: self.parts.len() as u32 - 1, there_from_first: DAffine3::IDENTITY }
    }

    fn bounds(&self, placement: &Placement) -> Bounds {
        let to = placement.there_from_first;
        let corners = &self.parts[placement.part as usize].corners;
        let finite = corners.iter().filter(|corner| corner.is_finite());
        Bounds::around(finite.map(|&corner| to.transform_point3(corner)))
    }

    /// Shows `visitor`, whose frame is turned from the world's, what is around `origin`, what is nearer mostly before what is
    /// farther.
    pub(crate) fn walk(&self, frame_from_world: DMat3, origin: DVec3, visitor: &mut impl Visit) {
        let away = DAffine3::from_mat3(frame_from_world) * DAffine3::from_translation(-origin);
        descend(&self.tree, &away, visitor, &mut |item, visitor| {
            let placement = &self.placements[item as usize];
            let part = &self.parts[placement.part as usize];
            let to = away * placement.there_from_first;
            descend(&part.tree, &to, visitor, &mut |item, visitor| {
                let corners = part.triangles[item as usize].map(|i| part.corners[i as usize]);
                visitor.triangle(corners.map(|corner| to.transform_point3(corner)));
            });
        });
    }
}

/// Walks one tree whose boxes `to` brings to where the place is the origin.
fn descend<V: Visit>(tree: &Tree, to: &DAffine3, visitor: &mut V, receive: &mut impl FnMut(u32, &mut V)) {
    let brought = |node: u32| {
        let solid = Oriented::brought(&tree.nodes[node as usize].bounds, to);
        (node, solid, solid.bounds())
    };
    if tree.nodes.is_empty() {
        return;
    }
    // Medians halve: no tree of 2³² boxes is deeper than 33.
    let mut waiting = [brought(0); 40];
    let mut count = 1;
    while count > 0 {
        count -= 1;
        let (index, solid, bounds) = waiting[count];
        if !visitor.wants(&bounds, &solid) {
            continue;
        }
        let node = &tree.nodes[index as usize];
        if node.count > 0 {
            let items = &tree.items[node.first as usize..(node.first + node.count) as usize];
            items.iter().for_each(|&item| receive(item, visitor));
            continue;
        }
        let [mut near, mut far] = [index + 1, node.first].map(brought);
        if far.2.distance_squared() < near.2.distance_squared() {
            std::mem::swap(&mut near, &mut far);
        }
        (waiting[count], waiting[count + 1]) = (far, near);
        count += 2;
    }
}

#[cfg(test)]
pub(crate) mod scenes;
#[cfg(test)]
mod tests;
