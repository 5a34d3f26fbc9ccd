//! Landscapes come in map coordinates of 10⁶ m; inside, the scene lies around (0, 0, 0).

use glam::{DAffine3, DVec3};
use light::{Geometry, Mesh};

use crate::Solid;
use crate::solid::Bounds;

/// Scenes whose middle is nearer to zero than this stay where they are \[m\]: f32 is good to 0.03 mm there.
const NEAR: f64 = 1000.0;

/// A solid counts as many triangles as a box has.
const SOLID_WEIGHT: u64 = 12;

/// Box of a mesh in its own coordinates; none without corners.
pub(crate) fn mesh_box(mesh: &Mesh) -> Option<(DVec3, DVec3)> {
    let mut corners = mesh.positions.iter().copied();
    let first = corners.next()?;
    let (low, high) = corners.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    Some((low.as_dvec3(), high.as_dvec3()))
}

/// Box around a box that is placed.
pub(crate) fn placed_box((low, high): (DVec3, DVec3), placement: &DAffine3) -> (DVec3, DVec3) {
    let middle = placement.transform_point3(0.5 * (low + high));
    let half = 0.5 * (high - low);
    let m = placement.matrix3;
    let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
    (middle - reach, middle + reach)
}

/// The box of every instance (none for an empty mesh), in the order of the instances.
pub(crate) fn instance_boxes(geometry: &Geometry) -> Vec<Option<(DVec3, DVec3)>> {
    let own: Vec<_> = geometry.meshes.iter().map(mesh_box).collect();
    let placed = |instance: &light::Instance| {
        own[instance.mesh as usize].map(|own| placed_box(own, &instance.world_from_mesh))
    };
    geometry.instances.iter().map(placed).collect()
}

/// The box of everything that is placed: instances, then solids.
pub(crate) fn all_boxes(geometry: &Geometry, solids: &[Solid]) -> Vec<Option<Bounds>> {
    let mut boxes = instance_boxes(geometry);
    boxes.extend(solids.iter().map(Solid::bounds));
    boxes
}

/// What to subtract from all coordinates: the middle of the geometry in whole metres, or 0 if that is near.
///
/// The middle is, for each axis, the median over the placed meshes' middles, each counted by its triangles:
/// a stray thing far away does not move it. A solid counts as a box. Without geometry the median of `others`.
pub(crate) fn origin(geometry: &Geometry, solids: &[Solid], others: &[DVec3]) -> DVec3 {
    let boxes = all_boxes(geometry, solids);
    let triangles =
        geometry.instances.iter().map(|i| geometry.meshes[i.mesh as usize].triangles.len().max(1));
    let weights = triangles.map(|count| count as u64).chain(solids.iter().map(|_| SOLID_WEIGHT));
    let weighted = boxes.iter().zip(weights).filter_map(|(placed, weight)| {
        let (low, high) = (*placed)?;
        Some((0.5 * (low + high), weight))
    });
    let mut points: Vec<(DVec3, u64)> = weighted.collect();
    if points.is_empty() {
        points = others.iter().map(|p| (*p, 1)).collect();
    }
    let middle = DVec3::from_array([0, 1, 2].map(|axis| {
        points.sort_by(|a, b| a.0[axis].total_cmp(&b.0[axis]));
        median(&points, axis)
    }));
    if middle.abs().max_element() <= NEAR { DVec3::ZERO } else { middle.round() }
}

/// Of points sorted along `axis`; 0 for none.
fn median(points: &[(DVec3, u64)], axis: usize) -> f64 {
    let total: u64 = points.iter().map(|p| p.1).sum();
    let mut before = 0;
    for (point, weight) in points {
        before += weight;
        if before * 2 >= total {
            return point[axis];
        }
    }
    0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(points: &[DVec3]) -> Geometry {
        let corners = vec![glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Z];
        let mesh = Mesh { positions: corners, triangles: vec![[0, 1, 2]], ..Mesh::default() };
        let instance =
            |p: &DVec3| light::Instance { mesh: 0, world_from_mesh: DAffine3::from_translation(*p) };
        Geometry { meshes: vec![mesh], instances: points.iter().map(instance).collect() }
    }

    #[test]
    fn near_scenes_stay_and_far_ones_move_by_whole_metres() {
        assert_eq!(origin(&at(&[DVec3::new(900.0, 5.0, -900.0)]), &[], &[]), DVec3::ZERO);
        let far = origin(&at(&[DVec3::new(3.5e5 + 0.2, 41.3, -3.9e6 + 0.2)]), &[], &[]);
        // The triangle's middle is half a metre from its corner: rounded to whole metres.
        assert_eq!(far, DVec3::new(350_001.0, 41.0, -3_900_000.0 + 1.0));
    }

    #[test]
    fn a_stray_thing_does_not_move_the_middle() {
        let mut points = vec![DVec3::ZERO; 5];
        points.push(DVec3::splat(1e7));
        assert_eq!(origin(&at(&points), &[], &[]), DVec3::ZERO);
    }

    #[test]
    fn without_geometry_the_rest_counts() {
        assert_eq!(origin(&Geometry::default(), &[], &[]), DVec3::ZERO);
        assert_eq!(origin(&Geometry::default(), &[], &[DVec3::splat(2e6)]), DVec3::splat(2e6));
    }

    #[test]
    fn a_placed_box_holds_its_corners() {
        let turn = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.0);
        let (low, high) = placed_box((DVec3::ZERO, DVec3::ONE), &turn);
        for i in 0..8 {
            let corner = DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
            let p = turn.transform_point3(corner);
            // Sums of three products of numbers ≤ 1.
            let slack = DVec3::splat(8.0 * f64::EPSILON);
            assert!(p.cmpge(low - slack).all() && p.cmple(high + slack).all());
        }
    }
}
