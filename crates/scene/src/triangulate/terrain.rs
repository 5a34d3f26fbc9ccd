//! Ground from scattered points: Delaunay in plan.

use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

use glam::{DVec2, DVec3, Vec3};
use light::Mesh;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::Fault;

/// Ground in coordinates of its own.
#[derive(Clone, Debug)]
pub struct Terrain {
    /// The surface, +Y up, around (0, 0, 0); no normals (flat faces), material 0.
    pub mesh: Mesh,
    /// To be added to it to give the coordinates of the points \[m\].
    pub origin: DVec3,
    /// Points that were not finite.
    pub not_finite: usize,
    /// Points in the same place in plan as an earlier one, which counts.
    pub duplicates: usize,
}

/// A point in plan, with its index.
struct Node {
    plan: DVec2,
    index: u32,
}

impl HasPosition for Node {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.plan.x, self.plan.y)
    }
}

/// The surface over `points` (x, *height*, z: +Y is up), triangulated in plan.
///
/// Map coordinates of 10⁶ m keep millimetres: all is done in f64 about `origin`, the middle of the points
/// rounded to metres, and only the differences become f32.
pub fn terrain(points: &[DVec3]) -> Result<Terrain, Fault> {
    let usable = |p: &&DVec3| p.is_finite() && p.abs().max_element() <= 1e30;
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut finite = 0;
    for &p in points.iter().filter(usable) {
        (low, high) = (low.min(p), high.max(p));
        finite += 1;
    }
    if finite < 3 {
        return Err(Fault::NoArea);
    }
    let origin = (0.5 * low + 0.5 * high).round();
    let mut seen: HashSet<[u64; 2]> = HashSet::with_capacity(finite);
    let (mut nodes, mut positions) = (Vec::with_capacity(finite), Vec::with_capacity(finite));
    for &p in points.iter().filter(usable) {
        let local = p - origin;
        // The library refuses numbers between 0 and 2⁻¹⁴²; and −0 is 0.
        let settle = |x: f64| if x.abs() < 1e-40 { 0.0 } else { x };
        // North is −Z: (x, −z) is seen from above, so that counter-clockwise there faces up.
        let plan = DVec2::new(settle(local.x), settle(-local.z));
        if seen.insert([plan.x.to_bits(), plan.y.to_bits()]) {
            nodes.push(Node { plan, index: positions.len() as u32 });
            positions.push(local.as_vec3());
        }
    }
    let built = catch_unwind(AssertUnwindSafe(|| DelaunayTriangulation::<Node>::bulk_load(nodes)));
    let triangulation = built
        .map_err(|_| Fault::Library("an inner check failed".into()))?
        .map_err(|error| Fault::Library(error.to_string()))?;
    let triangles: Vec<[u32; 3]> = triangulation
        .inner_faces()
        .map(|face| face.vertices().map(|vertex| vertex.data().index))
        .filter(|&triangle| has_area(triangle, &positions))
        .collect();
    if triangles.is_empty() {
        return Err(Fault::NoArea);
    }
    let duplicates = finite - positions.len();
    let mesh = Mesh { positions, triangles, ..Mesh::default() };
    Ok(Terrain { mesh, origin, not_finite: points.len() - finite, duplicates })
}

/// False where rounding to f32 has made a sliver vanish.
fn has_area(triangle: [u32; 3], positions: &[Vec3]) -> bool {
    let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
    (b - a).cross(c - a) != DVec3::ZERO
}
