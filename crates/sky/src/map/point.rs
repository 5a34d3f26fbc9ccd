//! Mesh points: whose they are, and where the sky is asked for them.

use glam::{DVec2, DVec3, Vec3};
use light::{Geometry, Place, Ray, Triangle};

use super::seams::Seams;

/// A point of a mesh: the same for all triangles that share it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    /// The triangle that answers for it.
    pub(crate) triangle: u32,
    /// Weights of that triangle's second and third corner; exact, by halving alone.
    pub(crate) at: DVec2,
    /// Whether other triangles share it.
    pub(crate) shared: bool,
}

impl Point {
    /// The point of `triangle` at weights `at`, whose halves are exact.
    pub(crate) fn of(seams: &Seams, triangle: u32, at: DVec2) -> Self {
        let first = 1.0 - at.x - at.y;
        let own = Self { triangle, at, shared: false };
        let (corners, edges) = (&seams.corners[triangle as usize], &seams.edges[triangle as usize]);
        if let Some(k) = [first, at.x, at.y].iter().position(|&weight| weight == 1.0) {
            let owner = corners[k];
            let at = [DVec2::ZERO, DVec2::X, DVec2::Y][usize::from(owner.part)];
            return Self { triangle: owner.triangle, at, shared: owner.shared };
        }
        // Edge k goes from corner k to the next: how far along it, and which weight is 0 on it.
        let along = [(at.y, at.x), (first, at.y), (at.x, first)];
        let Some(k) = along.iter().position(|&(none, _)| none == 0.0) else { return own };
        let owner = edges[k];
        // Edges of one pair of triangles run against each other.
        let t = if owner.triangle == triangle { along[k].1 } else { 1.0 - along[k].1 };
        let at = [DVec2::new(t, 0.0), DVec2::new(1.0 - t, t), DVec2::new(0.0, 1.0 - t)];
        Self { triangle: owner.triangle, at: at[usize::from(owner.part)], shared: owner.shared }
    }
}

/// Unit normal of a face on the side it is wound for, and where it is in space.
pub(crate) fn outward(geometry: &Geometry, instance: u32, world: &Triangle) -> DVec3 {
    let flips = geometry.instances[instance as usize].world_from_mesh.matrix3.determinant() < 0.0;
    let normal = world.cross().normalize_or_zero();
    if flips { -normal } else { normal }
}

/// Where the sky is asked for weights `at` of a face, on the side of `facing` (unit, ± its normal).
///
/// Its normal is the interpolated one. The point is drawn `inset` \[m\] away from the face's edges, so that a wall
/// that stands on an edge is beside it: towards the centre of the inscribed circle, which moves all edges inwards
/// alike; a fourth of the way at most (narrow faces), and no farther than four times `inset` (pointed ones).
pub(crate) fn place(geometry: &Geometry, face: [u32; 2], at: DVec2, facing: Vec3, inset: f32) -> Place {
    let [instance, triangle] = face;
    let world = geometry.triangle(instance, triangle);
    let ray = Ray::new(Vec3::ZERO, -facing);
    let at_weights = |at| geometry.hit_on(&world, face, at, &ray, 0.0);
    let hit = at_weights(at);
    let hit = if inset > 0.0 {
        // Less than the position's own error would leave the side of the wall to chance.
        at_weights(drawn_in(&world, at, f64::from(inset.max(hit.place.error))))
    } else {
        hit
    };
    let cos = hit.shading_normal.dot(hit.place.normal).max(LEAST_COSINE);
    let error = if hit.shading_normal == hit.place.normal {
        hit.place.error
    } else {
        // Rays leave along the normal: so far that they clear the true face, whose normal's coordinates sum
        // to at most √3.
        hit.place.error * 3.0f32.sqrt() / cos
    };
    Place { normal: hit.shading_normal, error, ..hit.place }
}

/// Interpolated normals count as no more inclined to the face than by 75°.
const LEAST_COSINE: f32 = 0.25;

fn drawn_in(world: &Triangle, at: DVec2, inset: f64) -> DVec2 {
    let [a, b, c] = world.0;
    let opposite = DVec3::new(b.distance(c), c.distance(a), a.distance(b));
    let around = opposite.element_sum();
    let inradius = world.cross().length() / around;
    let centre = DVec2::new(opposite.y, opposite.z) / around;
    let way = centre - at;
    let metres = ((b - a) * way.x + (c - a) * way.y).length();
    let share = (inset / inradius).min(0.25).min(if metres > 0.0 { 4.0 * inset / metres } else { 0.0 });
    at + way * share
}
