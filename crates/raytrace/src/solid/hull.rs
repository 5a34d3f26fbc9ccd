//! Convex polyhedra around solids, aligned with the solid's own axis (thesis 2.3.1).

use glam::{DAffine3, DVec3};

use super::node::{Plane, Wrong};

/// A closed convex polyhedron.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solid {
    pub(crate) corners: Vec<DVec3>,
    /// Counter-clockwise seen from outside.
    pub(crate) faces: Vec<[u32; 3]>,
}

/// Hulls of curved solids are larger than they must be by this share, so that rounding lets nothing out.
const MARGIN: f64 = 1e-9;

impl Solid {
    /// Centre and radius of a ball around it.
    pub(crate) fn ball(&self) -> (DVec3, f64) {
        let centre = self.corners.iter().sum::<DVec3>() / self.corners.len().max(1) as f64;
        let radius2 = self.corners.iter().map(|c| (*c - centre).length_squared()).fold(0.0, f64::max);
        (centre, radius2.sqrt())
    }

    /// The placed polyhedron, wound outwards also when the placement mirrors.
    pub(crate) fn placed(&self, world_from_solid: &DAffine3) -> Self {
        let corners = self.corners.iter().map(|&c| world_from_solid.transform_point3(c)).collect();
        let mirrored = world_from_solid.matrix3.determinant() < 0.0;
        let turned = |&[a, b, c]: &[u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        Self { corners, faces: self.faces.iter().map(turned).collect() }
    }

    /// Volume \[m³\]: a sixth of Σ a · (b × c) over the faces, about a corner.
    pub(crate) fn volume(&self) -> f64 {
        let Some(&about) = self.corners.first() else { return 0.0 };
        let corner = |i: u32| self.corners[i as usize] - about;
        self.faces.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c)))).sum::<f64>() / 6.0
    }

    /// Triangles of a face whose corners are given in order.
    fn fan(&mut self, corners: &[u32]) {
        for pair in corners.windows(2).skip(1) {
            self.faces.push([corners[0], pair[0], pair[1]]);
        }
    }
}

/// Around the unit ball: of the Platonic solids the icosahedron wastes least. Its mean outline (a quarter of
/// its surface, Cauchy) is 3.791 against the ball's π, 21 % more; a cube's is 6.
pub(crate) fn around_ball() -> Solid {
    // With corners (0, ±1, ±φ) and their rotations, the faces are at distance φ²/√3.
    icosahedron((1.0 + MARGIN) * 3f64.sqrt() / (GOLDEN * GOLDEN))
}

const GOLDEN: f64 = 1.618_033_988_749_895;

/// Corners `scale` (0, ±1, ±φ) and their rotations; edges of 2 `scale`.
fn icosahedron(scale: f64) -> Solid {
    let mut solid = Solid::default();
    for axis in 0..3 {
        for (one, phi) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
            let mut corner = [0.0; 3];
            corner[(axis + 1) % 3] = one * scale;
            corner[(axis + 2) % 3] = phi * GOLDEN * scale;
            solid.corners.push(DVec3::from(corner));
        }
    }
    // Faces are the triples of mutual neighbours.
    let near = |a: DVec3, b: DVec3| a.distance_squared(b) < 5.0 * scale * scale;
    let count = solid.corners.len() as u32;
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                let [p, q, r] = [a, b, c].map(|i| solid.corners[i as usize]);
                if near(p, q) && near(q, r) && near(r, p) {
                    let outward = (q - p).cross(r - p).dot(p) > 0.0;
                    solid.faces.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    solid
}

/// Around a cylinder, cone or truncated cone: squares about its two circles.
pub(crate) fn around_frustum(top: f64) -> Solid {
    // A square about a circle has its corners √2 out. The tip is where the sides, moved outwards, meet.
    let wide = 2f64.sqrt() * (1.0 + MARGIN);
    let tip = if top == 0.0 { 2.0 * MARGIN } else { MARGIN };
    tapered(4, [wide, wide * top], [-MARGIN, 1.0 + tip])
}

/// Regular polygons about the y axis, their corners at these radii and heights, joined.
fn tapered(sides: u32, radii: [f64; 2], heights: [f64; 2]) -> Solid {
    let ring = |level: usize| {
        (0..sides).map(move |i| {
            // From +x to −z: counter-clockwise seen from above.
            let (sin, cos) = (std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(sides)).sin_cos();
            DVec3::new(radii[level] * cos, heights[level], -radii[level] * sin)
        })
    };
    let mut solid = Solid { corners: ring(0).collect(), faces: Vec::new() };
    solid.fan(&(0..sides).rev().collect::<Vec<u32>>());
    if radii[1] == 0.0 {
        solid.corners.push(DVec3::Y * heights[1]);
        solid.faces.extend((0..sides).map(|i| [i, (i + 1) % sides, sides]));
    } else {
        solid.corners.extend(ring(1));
        solid.fan(&(sides..2 * sides).collect::<Vec<u32>>());
        for i in 0..sides {
            let next = (i + 1) % sides;
            solid.fan(&[i, next, next + sides, i + sides]);
        }
    }
    solid
}

/// The polyhedron that half-spaces with unit normals leave. Takes time as the fourth power of their number.
pub(crate) fn polyhedron(planes: &[Plane]) -> Result<Solid, Wrong> {
    if !bounded(planes) {
        return Err(Wrong::Unbounded);
    }
    let size = planes.iter().map(|plane| plane.offset.abs()).fold(0.0, f64::max);
    // Corners of nearly parallel planes are as far off as they are far; nearer than this they are one.
    let same = 1e-10 * size.max(f64::MIN_POSITIVE);
    let mut solid = Solid::default();
    for (i, a) in planes.iter().enumerate() {
        for (j, b) in planes.iter().enumerate().skip(i + 1) {
            let edge = a.normal.cross(b.normal);
            for c in &planes[j + 1..] {
                let volume = edge.dot(c.normal);
                let corner = (b.normal.cross(c.normal) * a.offset
                    + c.normal.cross(a.normal) * b.offset
                    + edge * c.offset)
                    / volume;
                let kept = |plane: &Plane| plane.normal.dot(corner) <= plane.offset + same;
                if volume.abs() > 1e-12 && planes.iter().all(kept) {
                    let new = |other: &DVec3| other.distance(corner) > 2.0 * same;
                    if solid.corners.iter().all(new) {
                        solid.corners.push(corner);
                    }
                }
            }
        }
    }
    for (i, plane) in planes.iter().enumerate() {
        // A half-space given twice has one face.
        if !planes[..i].iter().any(|p| p.normal.distance(plane.normal) < 1e-10) {
            face(&mut solid, plane, 4.0 * same);
        }
    }
    // Thinner than rounding is nothing.
    let (_, radius) = solid.ball();
    if solid.corners.len() < 4 || solid.volume() <= 1e-12 * radius.powi(3) {
        return Err(Wrong::Empty);
    }
    Ok(solid)
}

/// The corners on a plane, in order around its normal.
fn face(solid: &mut Solid, plane: &Plane, same: f64) {
    let on = |corner: &DVec3| (plane.normal.dot(*corner) - plane.offset).abs() <= same;
    let mut ring: Vec<(f64, u32)> =
        (0..).zip(&solid.corners).filter(|(_, c)| on(c)).map(|(i, _)| (0.0, i)).collect();
    if ring.len() < 3 {
        return;
    }
    let centre = ring.iter().map(|&(_, i)| solid.corners[i as usize]).sum::<DVec3>() / ring.len() as f64;
    let (u, v) = plane.normal.any_orthonormal_pair();
    for (angle, i) in &mut ring {
        let from = solid.corners[*i as usize] - centre;
        *angle = from.dot(v).atan2(from.dot(u));
    }
    ring.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ring: Vec<u32> = ring.into_iter().map(|(_, i)| i).collect();
    solid.fan(&ring);
}

/// Whether half-spaces close: whether no direction leaves all of them. If one does, one does that is along the
/// edge of two planes, or the planes have no two directions at all.
fn bounded(planes: &[Plane]) -> bool {
    let mut edges = 0;
    for (i, a) in planes.iter().enumerate() {
        for b in &planes[i + 1..] {
            let Some(edge) = a.normal.cross(b.normal).try_normalize() else { continue };
            edges += 1;
            let free = |way: DVec3| planes.iter().all(|plane| plane.normal.dot(way) <= 1e-12);
            if free(edge) || free(-edge) {
                return false;
            }
        }
    }
    edges > 0
}
