//! Solids of the scene → bodies of the ray tracer.

use std::sync::Arc;

use light::{Medium, Shade};
use raytrace::solid::{Body, Node, Plane, Shape, Solids};
use scene::{Material, Scene, Solid, SolidNode, SolidShape};

use super::materials;
use crate::Error;

/// Bodies and the shaders that they wear.
pub(super) struct Dressed {
    pub(super) solids: Solids,
    pub(super) shaders: Vec<Box<dyn Shade>>,
}

/// The bodies of the scene, and the shaders that they need beyond those of the meshes; none without solids.
///
/// A transparent material on a solid is always that of a body, never of a thin pane: solids wear shaders
/// of their own, one for each [`Dress`], after those of the meshes.
pub(super) fn bodies(scene: &Scene) -> Result<Option<Dressed>, Error> {
    if scene.solids.is_empty() {
        return Ok(None);
    }
    let wardrobe = Wardrobe::of(scene);
    let bodies = scene.solids.iter().map(|solid| wardrobe.body(solid)).collect();
    // After the faces of the scene and the surfaces of its waters.
    let first = (scene.geometry.instances.len() + scene.waters.len()) as u32;
    let solids = Solids::new(bodies, first).map_err(|fault| Error::Content(format!("[[solid]] {fault}")))?;
    let shader = |dress: &Dress| {
        let material = &scene.materials[dress.material as usize];
        materials::shade_with(material, dress.medium(&scene.materials))
    };
    let shaders = wardrobe.dresses.iter().map(shader).collect();
    Ok(Some(Dressed { solids, shaders }))
}

/// What a face of a body looks like: its own material, and that which says what fills the body behind it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Dress {
    material: u32,
    filling: u32,
}

impl Dress {
    /// What light meets that passes the face: inside, what the filling says; at the face, what its own material
    /// lets through. None where either is opaque.
    fn medium(self, materials: &[Material]) -> Option<Medium> {
        medium(&materials[self.material as usize], &materials[self.filling as usize])
    }
}

/// What light meets that passes a face of the material `face` of a body that is filled with `filling`; none where either is opaque.
pub(super) fn medium(face: &Material, filling: &Material) -> Option<Medium> {
    let (face, inside) = (filled(face)?, filled(filling)?);
    Some(Medium { index: inside.index, absorption: inside.absorption, ..face })
}

/// All dresses of a scene's bodies, in order, and the number of the first one's shader.
struct Wardrobe<'s> {
    materials: &'s [Material],
    dresses: Vec<Dress>,
    first: u32,
}

impl<'s> Wardrobe<'s> {
    fn of(scene: &'s Scene) -> Self {
        let mut dresses = Vec::new();
        for solid in &scene.solids {
            collect(&solid.node, filling(&solid.node), &mut dresses);
        }
        dresses.sort_unstable();
        dresses.dedup();
        Self { materials: &scene.materials, dresses, first: scene.materials.len() as u32 }
    }

    fn body(&self, solid: &Solid) -> Body {
        let filling = filling(&solid.node);
        let medium = self.materials.get(filling as usize).and_then(filled).map(Arc::new);
        Body { node: self.node(&solid.node, filling), medium }
    }

    fn node(&self, node: &SolidNode, filling: u32) -> Node {
        let all = |members: &[SolidNode]| members.iter().map(|member| self.node(member, filling)).collect();
        match node {
            SolidNode::Shape { shape, world_from_solid, material } => Node::Solid {
                shape: convex(shape),
                world_from_solid: *world_from_solid,
                material: self.shader(Dress { material: *material, filling }),
            },
            SolidNode::Union(members) => Node::Union(all(members)),
            SolidNode::Intersection(members) => Node::Intersection(all(members)),
            SolidNode::Difference(whole, cutters) => {
                Node::Difference(Box::new(self.node(whole, filling)), all(cutters))
            }
        }
    }

    /// The number of a dress' shader; all dresses have been collected from the same bodies.
    fn shader(&self, dress: Dress) -> u32 {
        self.first + self.dresses.partition_point(|other| *other < dress) as u32
    }
}

/// Adds what the faces of a body wear that `filling` fills.
fn collect(node: &SolidNode, filling: u32, dresses: &mut Vec<Dress>) {
    match node {
        SolidNode::Shape { material, .. } => dresses.push(Dress { material: *material, filling }),
        SolidNode::Union(members) | SolidNode::Intersection(members) => {
            members.iter().for_each(|member| collect(member, filling, dresses));
        }
        SolidNode::Difference(whole, cutters) => {
            collect(whole, filling, dresses);
            cutters.iter().for_each(|cutter| collect(cutter, filling, dresses));
        }
    }
}

fn filled(material: &Material) -> Option<Medium> {
    material.medium().map(|medium| Medium { thin: false, ..medium })
}

/// The material that says what fills a body of several: that of its first shape. Members of unions and
/// intersections are filled alike ([`scene::load`] sees to it), and cutters fill nothing.
pub(super) fn filling(node: &SolidNode) -> u32 {
    match node {
        SolidNode::Shape { material, .. } => *material,
        SolidNode::Union(members) | SolidNode::Intersection(members) => members.first().map_or(0, filling),
        SolidNode::Difference(whole, _) => filling(whole),
    }
}

fn convex(shape: &SolidShape) -> Shape {
    match shape {
        SolidShape::Sphere => Shape::Sphere,
        SolidShape::Cylinder => Shape::Cylinder,
        SolidShape::Cone => Shape::Cone,
        SolidShape::Frustum { top } => Shape::Frustum { top: *top },
        SolidShape::Polyhedron { planes, .. } => {
            Shape::Polyhedron(planes.iter().map(|&(normal, offset)| Plane { normal, offset }).collect())
        }
    }
}
