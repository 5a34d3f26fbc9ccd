//! Solids of the scene → bodies of the ray tracer.

use std::sync::Arc;

use light::{Medium, Shade};
use raytrace::solid::{Body, Node, Plane, Shape, Solids};
use scene::{Scene, Solid, SolidNode, SolidShape};

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
/// of their own, one for each material, after those of the meshes.
pub(super) fn bodies(scene: &Scene) -> Result<Option<Dressed>, Error> {
    if scene.solids.is_empty() {
        return Ok(None);
    }
    let offset = scene.materials.len() as u32;
    let bodies = scene.solids.iter().map(|solid| body(scene, solid, offset)).collect();
    let first = scene.geometry.instances.len() as u32;
    let solids = Solids::new(bodies, first).map_err(|fault| Error::Content(format!("[[solid]] {fault}")))?;
    let shaders =
        scene.materials.iter().map(|material| materials::shade_with(material, filled(material))).collect();
    Ok(Some(Dressed { solids, shaders }))
}

fn body(scene: &Scene, solid: &Solid, offset: u32) -> Body {
    let medium = scene.materials.get(outermost(&solid.node) as usize).and_then(filled).map(Arc::new);
    Body { node: node(&solid.node, offset), medium }
}

fn filled(material: &scene::Material) -> Option<Medium> {
    material.medium().map(|medium| Medium { thin: false, ..medium })
}

/// The material that says what fills a body of several: that of its first shape.
fn outermost(node: &SolidNode) -> u32 {
    match node {
        SolidNode::Shape { material, .. } => *material,
        SolidNode::Union(members) | SolidNode::Intersection(members) => members.first().map_or(0, outermost),
        SolidNode::Difference(whole, _) => outermost(whole),
    }
}

fn node(node_: &SolidNode, offset: u32) -> Node {
    let all = |members: &[SolidNode]| members.iter().map(|member| node(member, offset)).collect();
    match node_ {
        SolidNode::Shape { shape, world_from_solid, material } => Node::Solid {
            shape: convex(shape),
            world_from_solid: *world_from_solid,
            material: material + offset,
        },
        SolidNode::Union(members) => Node::Union(all(members)),
        SolidNode::Intersection(members) => Node::Intersection(all(members)),
        SolidNode::Difference(whole, cutters) => {
            Node::Difference(Box::new(node(whole, offset)), all(cutters))
        }
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
