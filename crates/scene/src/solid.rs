//! Curved solids, convex polyhedra and set operations of them, as data.

use glam::{DAffine3, DVec3};

/// Most levels of set operations inside one another, a lone shape being 1.
pub const MAX_SOLID_DEPTH: usize = 64;

/// A body that is seen: a shape, or a set operation of shapes.
///
/// Unlike a mesh of the same material it is always a body, never a thin pane: its inside is filled.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Its name in the file, or `solid-3`.
    pub name: String,
    /// What it consists of.
    pub node: SolidNode,
}

/// A shape, or what a set operation makes of others. Lists have two members at least, difference one.
#[derive(Clone, Debug, PartialEq)]
pub enum SolidNode {
    /// A shape of one material, placed.
    Shape {
        /// Which, in coordinates of its own.
        shape: SolidShape,
        /// From those to the world \[m\]; invertible, finite; may mirror.
        world_from_solid: DAffine3,
        /// Index into [`crate::Scene::materials`]; also on faces that this shape cuts into others.
        material: u32,
    },
    /// What is in any of them.
    Union(Vec<SolidNode>),
    /// What is in all of them.
    Intersection(Vec<SolidNode>),
    /// What is in the first and in none of the others.
    Difference(Box<SolidNode>, Vec<SolidNode>),
}

/// A convex shape in coordinates of its own; y is its axis.
#[derive(Clone, Debug, PartialEq)]
pub enum SolidShape {
    /// x² + y² + z² ≤ 1.
    Sphere,
    /// x² + z² ≤ 1, 0 ≤ y ≤ 1.
    Cylinder,
    /// x² + z² ≤ (1 − y)², 0 ≤ y ≤ 1: the apex is at y = 1.
    Cone,
    /// A truncated cone: x² + z² ≤ (1 + (top − 1) y)², 0 ≤ y ≤ 1.
    Frustum {
        /// Radius at y = 1 by that at y = 0; > 0, finite.
        top: f64,
    },
    /// A convex polyhedron \[m\].
    Polyhedron {
        /// One per face: unit normal outwards, and its distance from the origin along it; inside n·p ≤ offset.
        planes: Vec<(DVec3, f64)>,
        /// The corners, four at least; for each plane, its offset is the largest n·p of all corners.
        corners: Vec<DVec3>,
    },
}

/// A box: its lower and upper corner \[m\].
pub(crate) type Bounds = (DVec3, DVec3);

impl Solid {
    /// A box around it, lower and upper corner \[m\]; exact for a shape, for set operations it may be too
    /// large. None for an intersection that is empty even as boxes.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.node.bounds()
    }
}

impl SolidNode {
    /// As [`Solid::bounds`].
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        match self {
            Self::Shape { shape, world_from_solid, .. } => Some(shape.bounds(world_from_solid)),
            Self::Union(members) => members.iter().filter_map(Self::bounds).reduce(join),
            Self::Intersection(members) => {
                let mut members = members.iter().map(Self::bounds);
                let first = members.next()??;
                members.try_fold(first, |common, own| {
                    let own = own?;
                    let (low, high) = (common.0.max(own.0), common.1.min(own.1));
                    low.cmple(high).all().then_some((low, high))
                })
            }
            Self::Difference(whole, _) => whole.bounds(),
        }
    }

    /// Calls `visit` for the placement of each of its shapes.
    pub(crate) fn placements_mut(&mut self, visit: &mut dyn FnMut(&mut DAffine3)) {
        match self {
            Self::Shape { world_from_solid, .. } => visit(world_from_solid),
            Self::Union(members) | Self::Intersection(members) => {
                members.iter_mut().for_each(|member| member.placements_mut(visit));
            }
            Self::Difference(whole, others) => {
                whole.placements_mut(visit);
                others.iter_mut().for_each(|other| other.placements_mut(visit));
            }
        }
    }
}

impl SolidShape {
    /// The box around the shape as it is placed.
    fn bounds(&self, placement: &DAffine3) -> Bounds {
        // A disc of radius r about the axis reaches r √(m_x² + m_z²) along each axis of the world, where m_x
        // and m_z are where x and z go: the largest value of (m_x cos φ + m_z sin φ).
        let m = placement.matrix3;
        let around = (m.x_axis * m.x_axis + m.z_axis * m.z_axis).map(f64::sqrt);
        let disc = |y: f64, radius: f64| {
            let middle = placement.transform_point3(DVec3::Y * y);
            (middle - around * radius, middle + around * radius)
        };
        match self {
            Self::Sphere => {
                let reach = (around * around + m.y_axis * m.y_axis).map(f64::sqrt);
                (placement.translation - reach, placement.translation + reach)
            }
            Self::Cylinder => join(disc(0.0, 1.0), disc(1.0, 1.0)),
            Self::Cone => join(disc(0.0, 1.0), disc(1.0, 0.0)),
            Self::Frustum { top } => join(disc(0.0, 1.0), disc(1.0, *top)),
            Self::Polyhedron { corners, .. } => {
                let placed = corners.iter().map(|corner| placement.transform_point3(*corner));
                let box_of = placed.map(|corner| (corner, corner)).reduce(join);
                box_of.unwrap_or((placement.translation, placement.translation))
            }
        }
    }
}

/// The box around two boxes.
pub(crate) fn join(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(shape: SolidShape, x: f64) -> SolidNode {
        let world_from_solid = DAffine3::from_translation(DVec3::X * x);
        SolidNode::Shape { shape, world_from_solid, material: 0 }
    }

    #[test]
    fn boxes_of_shapes_are_exact() {
        let bounds = |shape| placed(shape, 10.0).bounds();
        let around = |low: [f64; 3], high: [f64; 3]| Some((DVec3::from(low), DVec3::from(high)));
        assert_eq!(bounds(SolidShape::Sphere), around([9.0, -1.0, -1.0], [11.0, 1.0, 1.0]));
        for shape in [SolidShape::Cylinder, SolidShape::Cone, SolidShape::Frustum { top: 0.5 }] {
            assert_eq!(bounds(shape), around([9.0, 0.0, -1.0], [11.0, 1.0, 1.0]));
        }
        let wide = SolidShape::Frustum { top: 2.0 };
        assert_eq!(bounds(wide), around([8.0, 0.0, -2.0], [12.0, 1.0, 2.0]));
    }

    /// A cylinder whose axis lies along (1, 1, 0)/√2: its box reaches √½ beyond both ends' middles.
    #[test]
    fn a_tilted_cylinder_has_the_box_of_its_two_discs() {
        let turn = DAffine3::from_rotation_z(-std::f64::consts::FRAC_PI_4);
        let shape = SolidShape::Cylinder.bounds(&turn);
        let half = 0.5f64.sqrt();
        let expected = (DVec3::new(-half, -half, -1.0), DVec3::new(2.0 * half, 2.0 * half, 1.0));
        // A few roundings of numbers below 2.
        assert!((shape.0 - expected.0).length() < 1e-15 && (shape.1 - expected.1).length() < 1e-15);
    }

    #[test]
    fn boxes_of_set_operations_follow_the_operation() {
        let (a, b) = (placed(SolidShape::Sphere, 0.0), placed(SolidShape::Sphere, 1.0));
        let x = |node: SolidNode| node.bounds().map(|(low, high)| (low.x, high.x));
        assert_eq!(x(SolidNode::Union(vec![a.clone(), b.clone()])), Some((-1.0, 2.0)));
        assert_eq!(x(SolidNode::Intersection(vec![a.clone(), b.clone()])), Some((0.0, 1.0)));
        assert_eq!(x(SolidNode::Difference(Box::new(a.clone()), vec![b])), Some((-1.0, 1.0)));
        let far = placed(SolidShape::Sphere, 9.0);
        assert_eq!(x(SolidNode::Intersection(vec![a, far])), None);
    }
}
