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
    node::{DEEPEST, Fault, Node, Wrong},
};

/// A part of a body under construction.
struct Part {
    expression: Expression,
    /// A box around it.
    bounds: Bounds,
    /// Polyhedra around it, placed.
    hulls: Vec<Solid>,
}

/// Collects members while walking down a tree.
struct Walk {
    members: Vec<Member>,
    /// Around each of them.
    boxes: Vec<Bounds>,
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
                self.members.push(member);
                self.boxes.push(bounds.padded());
                Ok(Part { expression: Expression::Member(self.members.len() - 1), bounds, hulls })
            }
            Node::Union(nodes) => {
                let parts = self.parts(nodes, 0, positive)?;
                let expression = any(&parts);
                let mut all = Part { expression, bounds: Bounds::EMPTY, hulls: Vec::new() };
                for part in parts {
                    all.bounds = all.bounds.union(part.bounds);
                    all.hulls.extend(part.hulls);
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
                Ok(Part { expression, bounds, hulls: least.hulls })
            }
            Node::Difference(whole, cuts) => {
                let whole = self.parts(std::slice::from_ref(&**whole), 0, positive)?;
                let cuts = self.parts(cuts, 1, !positive)?.into_iter().map(|part| part.expression).collect();
                let whole = whole.into_iter().next().ok_or(Wrong::NoMembers)?;
                let expression = Expression::Without(Box::new(whole.expression), cuts);
                Ok(Part { expression, ..whole })
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

/// Which of a body's boxes have something in common within its own.
fn pairs(boxes: &[Bounds], body: Bounds) -> Vec<(u32, u32, Bounds)> {
    let mut pairs = Vec::new();
    for (i, one) in (0u32..).zip(boxes) {
        for (j, two) in (0u32..i).zip(boxes) {
            let common = one.common(*two).common(body);
            if !common.is_empty() {
                pairs.push((j, i, common));
            }
        }
    }
    pairs
}

/// Makes bodies ready.
pub(crate) fn solids(bodies: Vec<Body>, first_instance: u32) -> Result<Solids, Fault> {
    let mut ready = Vec::with_capacity(bodies.len());
    let mut hulls = Vec::new();
    for (index, body) in bodies.into_iter().enumerate() {
        let mut walk = Walk { members: Vec::new(), boxes: Vec::new(), path: Vec::new() };
        let mut part = match walk.part(&body.node, true) {
            Ok(part) => part,
            Err(wrong) => return Err(Fault { body: index, path: walk.path, wrong }),
        };
        if part.bounds.is_empty() {
            // A body without points needs no room.
            part.hulls.clear();
        }
        let bounds = if part.bounds.is_empty() { Bounds::EMPTY } else { part.bounds.padded() };
        let pairs = pairs(&walk.boxes, bounds);
        hulls.extend(part.hulls.into_iter().map(|solid| Hull {
            body: index as u32,
            corners: solid.corners,
            faces: solid.faces,
        }));
        let compound = Compound { members: walk.members, expression: part.expression };
        ready.push(Ready { compound, medium: body.medium, bounds, boxes: walk.boxes, pairs });
    }
    let bounds: Vec<Bounds> = ready.iter().map(|body| body.bounds).collect();
    let boxes = Boxes::new(&bounds);
    Ok(Solids { bodies: ready, hulls, boxes, acceleration: Acceleration::default(), first_instance })
}
