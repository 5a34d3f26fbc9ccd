//! From the scene's trees to bodies ready for lines.

use glam::DVec3;
use light::Hull;

use super::{
    Acceleration, Body, Ready, Solids,
    boxes::{Bounds, Boxes},
    chord::Surface,
    csg::{Compound, Expression},
    hull::Solid,
    member::Member,
    node::{DEEPEST, Fault, Node, Plane, Wrong},
};

/// A part of a body under construction.
struct Part {
    expression: Expression,
    /// A box around it.
    bounds: Bounds,
    /// Polyhedra around it, placed.
    hulls: Vec<Solid>,
    /// Polyhedra that lie wholly in it, placed.
    cores: Vec<Solid>,
}

/// Collects members while walking down a tree.
struct Walk {
    members: Vec<Member>,
    path: Vec<usize>,
}

impl Walk {
    fn part(&mut self, node: &Node, positive: bool) -> Result<Part, Wrong> {
        if self.path.len() > DEEPEST {
            return Err(Wrong::TooDeep);
        }
        match node {
            Node::Solid { shape, world_from_solid, material } => {
                let member = Member::new(shape, *world_from_solid, *material, positive)?;
                let hulls = vec![member.hull.placed(world_from_solid)];
                let bounds = bounds(&member, &hulls[0]);
                let cores = vec![member.core.placed(world_from_solid)];
                self.members.push(member);
                Ok(Part { expression: Expression::Member(self.members.len() - 1), bounds, hulls, cores })
            }
            Node::Union(nodes) => {
                let parts = self.parts(nodes, 0, positive)?;
                let expression = any(&parts);
                let mut all =
                    Part { expression, bounds: Bounds::EMPTY, hulls: Vec::new(), cores: Vec::new() };
                for part in parts {
                    all.bounds = all.bounds.union(part.bounds);
                    all.hulls.extend(part.hulls);
                    all.cores.extend(part.cores);
                }
                Ok(all)
            }
            Node::Intersection(nodes) => {
                let parts = self.parts(nodes, 0, positive)?;
                let expression = Expression::All(parts.iter().map(|part| part.expression.clone()).collect());
                let bounds = parts.iter().map(|part| part.bounds).reduce(Bounds::common);
                // Any member's hulls contain what all have in common: the least wasteful are taken.
                let volume = |part: &Part| part.hulls.iter().map(Solid::volume).sum::<f64>();
                let least = parts.into_iter().min_by(|a, b| volume(a).total_cmp(&volume(b)));
                let (least, bounds) = least.zip(bounds).ok_or(Wrong::NoMembers)?;
                Ok(Part { expression, bounds, hulls: least.hulls, cores: Vec::new() })
            }
            Node::Difference(whole, cuts) => {
                let whole = self.parts(std::slice::from_ref(&**whole), 0, positive)?;
                let cuts = self.parts(cuts, 1, !positive)?.into_iter().map(|part| part.expression).collect();
                let whole = whole.into_iter().next().ok_or(Wrong::NoMembers)?;
                let expression = Expression::Without(Box::new(whole.expression), cuts);
                Ok(Part { expression, cores: Vec::new(), ..whole })
            }
        }
    }

    /// All nodes in turn; `first` is what the path calls the first of them.
    fn parts(&mut self, nodes: &[Node], first: usize, positive: bool) -> Result<Vec<Part>, Wrong> {
        let mut parts = Vec::with_capacity(nodes.len());
        for (node, index) in nodes.iter().zip(first..) {
            self.path.push(index);
            parts.push(self.part(node, positive)?);
            self.path.pop();
        }
        Ok(parts)
    }
}

/// A union of one is that one: single solids are met without sorting.
fn any(parts: &[Part]) -> Expression {
    match parts {
        [one] => one.expression.clone(),
        _ => Expression::Any(parts.iter().map(|part| part.expression.clone()).collect()),
    }
}

/// The box of a placed member.
fn bounds(member: &Member, hull: &Solid) -> Bounds {
    let m = member.world_from_solid.matrix3;
    let centre = member.world_from_solid.translation;
    // A disc or ball spanned by vectors u, v, … reaches √(u² + v² + …) far, axis by axis.
    let reach = |u: DVec3, v: DVec3, w: DVec3| (u * u + v * v + w * w).to_array().map(f64::sqrt).into();
    let about = |c: DVec3, r: DVec3| Bounds { low: c - r, high: c + r };
    match member.surface {
        Surface::Ball => about(centre, reach(m.x_axis, m.y_axis, m.z_axis)),
        Surface::Frustum { taper } => {
            let disc: DVec3 = reach(m.x_axis, DVec3::ZERO, m.z_axis);
            about(centre, disc).union(about(centre + m.y_axis, disc * (1.0 - taper)))
        }
        Surface::Planes(_) => Bounds::around(&hull.corners),
    }
}

/// The planes of a placed hull's faces.
fn planes(hull: &Solid) -> Box<[Plane]> {
    let mut planes: Vec<Plane> = Vec::new();
    for face in &hull.faces {
        let [a, b, c] = face.map(|i| hull.corners[i as usize]);
        let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
        // Both halves of a square have one plane; the outer one, if rounding parts them.
        let offset = normal.dot(a).max(normal.dot(b)).max(normal.dot(c));
        match planes.iter_mut().find(|plane| plane.normal.distance_squared(normal) < 1e-24) {
            Some(plane) => plane.offset = plane.offset.max(offset),
            None => planes.push(Plane { normal, offset }),
        }
    }
    planes.into()
}

/// Makes bodies ready.
pub(crate) fn solids(bodies: Vec<Body>, first_instance: u32) -> Result<Solids, Fault> {
    let mut ready = Vec::with_capacity(bodies.len());
    let mut hulls = Vec::new();
    for (index, body) in bodies.into_iter().enumerate() {
        let mut walk = Walk { members: Vec::new(), path: Vec::new() };
        let mut part = match walk.part(&body.node, true) {
            Ok(part) => part,
            Err(wrong) => return Err(Fault { body: index, path: walk.path, wrong }),
        };
        if part.bounds.is_empty() {
            // A body without points needs no room.
            part.hulls.clear();
        }
        let bounds = if part.bounds.is_empty() { Bounds::EMPTY } else { part.bounds.padded() };
        let shells = part.hulls.iter().map(planes).collect();
        // What light passes through has no core that keeps it off.
        let opaque = body.medium.is_none();
        let cores = part.cores.iter().filter(|_| opaque).map(planes).collect();
        hulls.extend(part.hulls.into_iter().map(|solid| Hull {
            body: index as u32,
            corners: solid.corners,
            faces: solid.faces,
        }));
        let compound = Compound { members: walk.members, expression: part.expression };
        ready.push(Ready { compound, medium: body.medium, bounds, shells, cores });
    }
    let bounds: Vec<Bounds> = ready.iter().map(|body| body.bounds).collect();
    let boxes = Boxes::new(&bounds);
    Ok(Solids { bodies: ready, hulls, boxes, acceleration: Acceleration::default(), first_instance })
}
