//! What may stand between parts of a scene: where surely nothing does, no way need be tried.

use glam::DVec3;
use light::Geometry;

/// Triangles in a leaf.
const FEW: usize = 4;

/// How far triangles may reach into a hull \[share of the largest coordinate\] and still count as its boundary: some roundings
/// of f32, in which ways are tried.
const TOUCHING: f64 = 4.0 * light::rounding::UNIT as f64;

/// All triangles that can stand in the way of light, in a tree of boxes.
#[derive(Debug, Default)]
pub struct Obstacles {
    boxes: Vec<Boxed>,
    triangles: Vec<[DVec3; 3]>,
    reach: f64,
}

/// A part of them.
#[derive(Clone, Copy, Debug)]
struct Boxed {
    low: DVec3,
    high: DVec3,
    /// Triangles from … to.
    range: [u32; 2],
    /// The box of the second half; the first half's comes next. 0 for a leaf.
    second: u32,
}

impl Obstacles {
    /// All triangles of `geometry`: everything that an occluder may find in the way must be among them.
    pub fn new(geometry: &Geometry) -> Self {
        let mut triangles = Vec::with_capacity(geometry.triangle_count());
        for (i, instance) in geometry.instances.iter().enumerate() {
            let count = geometry.meshes[instance.mesh as usize].triangles.len() as u32;
            triangles.extend((0..count).map(|triangle| geometry.triangle(i as u32, triangle).0));
        }
        triangles.retain(|corners| corners.iter().all(|corner| corner.is_finite()));
        let reach = triangles.iter().flatten().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        let mut all = Self { boxes: Vec::new(), triangles, reach };
        if !all.triangles.is_empty() {
            all.add(0..all.triangles.len());
        }
        all
    }

    /// Boxes the triangles of a range, and sorts them by halves; answers which box it is.
    fn add(&mut self, range: std::ops::Range<usize>) -> u32 {
        let part = &mut self.triangles[range.clone()];
        let (low, high) = bounds(part.as_flattened());
        let mine = self.boxes.len();
        let [from, to] = [range.start, range.end].map(|end| end as u32);
        if range.len() > FEW {
            let size = (high - low).to_array();
            let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
            let key = |corners: &[DVec3; 3]| corners.iter().map(|corner| corner[axis]).sum::<f64>();
            let half = part.len() / 2;
            part.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)));
        }
        self.boxes.push(Boxed { low, high, range: [from, to], second: 0 });
        if range.len() > FEW {
            let middle = range.start + range.len() / 2;
            self.add(range.start..middle);
            self.boxes[mine].second = self.add(middle..range.end);
        }
        mine as u32
    }

    /// Whether surely nothing is between any two points of the convex hull of `corners`; false where that would be hard to tell.
    ///
    /// A triangle is in nobody's way if its box is beside that of the corners, or if all of them are on one side of its plane; or if it
    /// stays away from a line within `tube` \[m\] of which the whole hull lies.
    pub fn is_clear(&self, corners: &[DVec3], tube: Option<([DVec3; 2], f64)>) -> bool {
        let (low, high) = bounds(corners);
        let touching = TOUCHING * self.reach.max(low.abs().max_element()).max(high.abs().max_element());
        let slack = DVec3::splat(touching);
        let (low, high) = (low + slack, high - slack);
        let mut open = vec![0u32];
        while let Some(number) = open.pop() {
            let Some(part) = self.boxes.get(number as usize) else { continue };
            let beside = part.low.cmpge(high).any() || part.high.cmple(low).any();
            if beside || tube.is_some_and(|(ends, radius)| misses(ends, radius, part)) {
                continue;
            }
            if part.second > 0 {
                open.extend([number + 1, part.second]);
                continue;
            }
            let inside = &self.triangles[part.range[0] as usize..part.range[1] as usize];
            if inside.iter().any(|triangle| stands_among(triangle, corners, [low, high], touching)) {
                return false;
            }
        }
        true
    }
}

/// Whether a line stays farther than `radius` away from a box.
fn misses([from, to]: [DVec3; 2], radius: f64, part: &Boxed) -> bool {
    let inverse = (to - from).recip();
    let [a, b] = [part.low - radius - from, part.high + radius - from].map(|corner| corner * inverse);
    // 0 · ∞, for a way along a side that touches it, is no number, which `min` and `max` pass over: whether that counts as a meeting
    // makes no difference, as nothing is nearer than the radius then.
    let enters = a.min(b).to_array().into_iter().fold(0.0, f64::max);
    let leaves = a.max(b).to_array().into_iter().fold(1.0, f64::min);
    enters > leaves
}

fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)))
}

/// Whether a triangle's box meets the box, and corners lie on both sides of its plane.
fn stands_among(triangle: &[DVec3; 3], corners: &[DVec3], [low, high]: [DVec3; 2], touching: f64) -> bool {
    let (least, most) = bounds(triangle);
    if least.cmpge(high).any() || most.cmple(low).any() {
        return false;
    }
    let normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalize_or_zero();
    let heights = || corners.iter().map(|corner| (*corner - triangle[0]).dot(normal));
    heights().any(|height| height > touching) && heights().any(|height| height < -touching)
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, Vec3};
    use light::{Instance, Mesh};
    use proptest::prelude::*;

    use super::*;

    fn obstacles(triangles: &[[DVec3; 3]]) -> Obstacles {
        let positions: Vec<Vec3> = triangles.as_flattened().iter().map(|corner| corner.as_vec3()).collect();
        let numbers = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = Mesh { positions, triangles: numbers, ..Mesh::default() };
        let placed = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
        Obstacles::new(&Geometry { meshes: vec![mesh], instances: vec![placed] })
    }

    #[test]
    fn what_bounds_a_hull_is_not_in_its_way() {
        let floor = [DVec3::ZERO, DVec3::Z * 4.0, DVec3::X * 4.0];
        let slope = [DVec3::ZERO, DVec3::new(4.0, 4.0, 0.0), DVec3::new(4.0, 4.0, 4.0)];
        let hull = |up: f64| [DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::new(0.5, up, 0.2)];
        assert!(obstacles(&[floor]).is_clear(&hull(2.0), None));
        assert!(!obstacles(&[floor]).is_clear(&hull(2.0).map(|p| p - DVec3::Y), None));
        // All corners on one side of a slanting plane, whatever its box.
        assert!(
            obstacles(&[slope]).is_clear(&[DVec3::ZERO, DVec3::X * 2.0, DVec3::new(3.0, 1.0, 1.0)], None)
        );
        assert!(obstacles(&[]).is_clear(&hull(1.0), None) && obstacles(&[floor]).is_clear(&[], None));
    }

    fn point() -> impl Strategy<Value = DVec3> {
        [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_map(DVec3::from_array)
    }

    /// Whether the straight way between two points meets a triangle.
    fn meets(triangle: &[DVec3; 3], from: DVec3, to: DVec3) -> bool {
        let normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        let [a, b] = [from, to].map(|end| (end - triangle[0]).dot(normal));
        let at = from.lerp(to, a / (a - b));
        let inside =
            |k: usize| (triangle[(k + 1) % 3] - triangle[k]).cross(at - triangle[k]).dot(normal) > 0.0;
        a * b < 0.0 && (0..3).all(inside)
    }

    proptest! {
        /// Where it says clear, no way between two points of the hull meets any of the triangles.
        #[test]
        fn clear_is_clear(
            triangles in prop::collection::vec([point(), point(), point()], 1..40),
            corners in prop::collection::vec(point(), 6),
            size in 0.05..1.0f64,
            weights in prop::collection::vec([0.0..1.0f64, 0.0..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0], 8),
        ) {
            let corners: Vec<DVec3> = corners.iter().map(|corner| *corner * size).collect();
            let rounded: Vec<[DVec3; 3]> =
                triangles.iter().map(|corners| corners.map(|corner| corner.as_vec3().as_dvec3())).collect();
            // A tube about the line from the first corner to the last.
            let ends = [corners[0], corners[5]];
            let away = |p: DVec3| {
                let along = ends[1] - ends[0];
                let t = ((p - ends[0]).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
                p.distance(ends[0] + along * t)
            };
            let tube = (ends, corners.iter().map(|corner| away(*corner)).fold(0.0, f64::max));
            let all = obstacles(&triangles);
            prop_assert!(all.is_clear(&corners, Some(tube)) || !all.is_clear(&corners, None));
            if all.is_clear(&corners, Some(tube)) {
                let inner: Vec<DVec3> = weights
                    .iter()
                    .map(|weights| {
                        let sum: f64 = weights.iter().sum::<f64>().max(1e-9);
                        weights.iter().zip(&corners).map(|(w, corner)| *corner * (w / sum)).sum()
                    })
                    .chain(corners.iter().copied())
                    .collect();
                for pair in inner.windows(2) {
                    // Within the rounding that counts as touching nothing is promised: shrunk by ten times that.
                    let middle: DVec3 = corners.iter().sum::<DVec3>() / corners.len() as f64;
                    let [from, to] = [pair[0], pair[1]].map(|p| middle + (p - middle) * (1.0 - 1e-5));
                    prop_assert!(!rounded.iter().any(|triangle| meets(triangle, from, to)));
                }
            }
        }
    }
}
