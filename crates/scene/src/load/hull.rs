//! Convex polyhedra from their corners.

use std::fmt;

use glam::DVec3;

use crate::SolidShape;

/// Most corners: sets of them are kept as the bits of one number.
pub(crate) const MOST_CORNERS: usize = 128;

/// Corners nearer to a face's plane than this share of the whole's extent lie in it. Corners written with ten
/// significant digits are off by 5e-11 of the extent or less; faces may be slivers ten times as thin as wide.
const FLAT: f64 = 1e-9;

/// Three corners whose angle has a smaller sine say too little about the plane through them.
const SLIVER: f64 = 1e-6;

/// Why points are not the corners of a convex polyhedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HullFault {
    /// How many points there are.
    Count(usize),
    /// All points lie in one plane.
    Flat,
    /// Index of a point that lies inside.
    Inside(usize),
    /// The faces found do not close: some are thinner than can be told.
    Thin,
}

impl fmt::Display for HullFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(count) => write!(f, "{count} points: from 4 to {MOST_CORNERS} are possible"),
            Self::Flat => f.write_str("all points lie in one plane: a body needs four that do not"),
            Self::Inside(_) => f.write_str(
                "this point lies inside the convex hull of the others: a polyhedron is convex; make hollows with union and difference",
            ),
            Self::Thin => f.write_str("some faces are too thin to tell: points must be farther apart"),
        }
    }
}

/// One face: unit normal outwards, and which corners lie in its plane.
struct Face {
    normal: DVec3,
    members: u128,
}

/// The polyhedron whose corners are `points`.
///
/// A plane through three points that has all others on one side is a face; every triple is looked at once
/// unless a face that is known has all three. 128 corners are 3·10⁵ triples.
pub(crate) fn hull(points: &[DVec3]) -> Result<SolidShape, HullFault> {
    if points.len() < 4 || points.len() > MOST_CORNERS {
        return Err(HullFault::Count(points.len()));
    }
    let low = points.iter().copied().fold(points[0], DVec3::min);
    let high = points.iter().copied().fold(points[0], DVec3::max);
    let near = FLAT * (high - low).length();
    let faces = faces(points, near);
    // No face at all: in one line, or one point.
    let flat = |face: &Face| face.members.count_ones() as usize == points.len();
    if faces.is_empty() || faces.iter().any(flat) {
        return Err(HullFault::Flat);
    }
    if faces.len() < 4 {
        return Err(HullFault::Thin);
    }
    let surface = faces.iter().fold(0, |all, face| all | face.members);
    if let Some(inside) = (0..points.len()).find(|i| surface >> i & 1 == 0) {
        return Err(HullFault::Inside(inside));
    }
    let corners = corners(points, &faces);
    if !closed(&faces, &corners) {
        return Err(HullFault::Thin);
    }
    let corners: Vec<DVec3> = corners.into_iter().map(|i| points[i]).collect();
    Ok(polyhedron(faces.into_iter().map(|face| face.normal), corners))
}

/// The polyhedron of face normals and corners; each plane touches the outermost corner.
pub(crate) fn polyhedron(normals: impl Iterator<Item = DVec3>, corners: Vec<DVec3>) -> SolidShape {
    let outermost = |n: DVec3| corners.iter().map(|c| n.dot(*c)).fold(f64::NEG_INFINITY, f64::max);
    let planes = normals.map(|n| (n, outermost(n))).collect();
    SolidShape::Polyhedron { planes, corners }
}

/// All planes through three points that have the rest on one side.
fn faces(points: &[DVec3], near: f64) -> Vec<Face> {
    let mut faces: Vec<Face> = Vec::new();
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            for k in j + 1..points.len() {
                let triple = 1u128 << i | 1 << j | 1 << k;
                if faces.iter().any(|face| face.members & triple == triple) {
                    continue;
                }
                let Some(normal) = normal(points[i], points[j], points[k]) else { continue };
                faces.extend([normal, -normal].into_iter().filter_map(|n| face(points, points[i], n, near)));
            }
        }
    }
    faces
}

/// Unit normal of the plane through three points; none where they lie in a line.
fn normal(a: DVec3, b: DVec3, c: DVec3) -> Option<DVec3> {
    let (u, v) = ((b - a).try_normalize()?, (c - a).try_normalize()?);
    let cross = u.cross(v);
    (cross.length() > SLIVER).then(|| cross.normalize())
}

/// The face through `at` with the normal `n`; none if a point lies beyond it.
fn face(points: &[DVec3], at: DVec3, n: DVec3, near: f64) -> Option<Face> {
    let mut members = 0u128;
    for (i, point) in points.iter().enumerate() {
        let height = n.dot(*point - at);
        if height > near {
            return None;
        }
        if height >= -near {
            members |= 1 << i;
        }
    }
    // The two widest legs tell the plane best.
    let of_face: Vec<DVec3> =
        (0..points.len()).filter(|i| members >> i & 1 == 1).map(|i| points[i]).collect();
    let legs = of_face.iter().flat_map(|b| of_face.iter().map(move |c| (*b - at).cross(*c - at)));
    let best = legs.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?.try_normalize()?;
    Some(Face { normal: if best.dot(n) < 0.0 { -best } else { best }, members })
}

/// The points where three faces or more meet, each once: those within faces or edges, and repetitions, go.
fn corners(points: &[DVec3], faces: &[Face]) -> Vec<usize> {
    let meeting = |i: usize| {
        let own = faces.iter().enumerate().filter(|(_, face)| face.members >> i & 1 == 1);
        own.map(|(f, _)| f).collect::<Vec<_>>()
    };
    let mut known: Vec<Vec<usize>> = Vec::new();
    let mut corners = Vec::new();
    for i in 0..points.len() {
        let own = meeting(i);
        if own.len() >= 3 && !known.contains(&own) {
            known.push(own);
            corners.push(i);
        }
    }
    corners
}

/// Euler: corners − edges + faces = 2; an edge is where two faces share two corners.
fn closed(faces: &[Face], corners: &[usize]) -> bool {
    let kept = corners.iter().fold(0u128, |all, i| all | 1 << i);
    let mut edges = 0;
    for (i, a) in faces.iter().enumerate() {
        edges += faces[i + 1..].iter().filter(|b| (a.members & b.members & kept).count_ones() == 2).count();
    }
    corners.len() + faces.len() == edges + 2
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn cube() -> Vec<DVec3> {
        let bit = |i: i32, b: i32| f64::from(i >> b & 1);
        (0..8).map(|i| DVec3::new(bit(i, 0), bit(i, 1), bit(i, 2))).collect()
    }

    fn parts(shape: &SolidShape) -> (&[(DVec3, f64)], &[DVec3]) {
        match shape {
            SolidShape::Polyhedron { planes, corners } => (planes, corners),
            _ => panic!("not a polyhedron"),
        }
    }

    #[test]
    fn a_cube_has_six_faces_and_eight_corners() {
        let mut points = cube();
        // A repetition, the middle of an edge and that of a face are passed over.
        points.extend([DVec3::ONE, DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.5, 0.5, 1.0)]);
        let shape = hull(&points).unwrap();
        let (planes, corners) = parts(&shape);
        assert_eq!(corners, cube());
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            assert!(planes.contains(&(axis, 1.0)) && planes.contains(&(-axis, 0.0)));
        }
        assert_eq!(planes.len(), 6);
    }

    #[test]
    fn what_is_no_convex_body_is_refused() {
        assert_eq!(hull(&cube()[..3]), Err(HullFault::Count(3)));
        assert_eq!(hull(&[DVec3::ONE; 5]), Err(HullFault::Flat));
        let line: Vec<DVec3> = (0..5).map(|i| DVec3::X * f64::from(i)).collect();
        assert_eq!(hull(&line), Err(HullFault::Flat));
        let square: Vec<DVec3> = cube().into_iter().filter(|p| p.y == 0.0).collect();
        assert_eq!(hull(&square), Err(HullFault::Flat));
        let mut dented = cube();
        dented.insert(2, DVec3::splat(0.5));
        assert_eq!(hull(&dented), Err(HullFault::Inside(2)));
    }

    proptest! {
        /// Points on a sphere are all corners, and no corner lies beyond a plane.
        #[test]
        fn corners_on_a_sphere_are_all_kept(seed in prop::collection::vec((-1.0..1.0f64, -3.0..3.0f64), 4..24)) {
            let points: Vec<DVec3> = seed
                .iter()
                .map(|(y, a)| DVec3::new((1.0 - y * y).sqrt() * a.cos(), *y, (1.0 - y * y).sqrt() * a.sin()))
                .collect();
            let close = points.iter().enumerate().any(|(i, p)| points[..i].iter().any(|q| p.distance(*q) < 0.01));
            prop_assume!(!close);
            let Ok(shape) = hull(&points) else { return Ok(()) };
            let (planes, corners) = parts(&shape);
            prop_assert_eq!(corners.len(), points.len());
            prop_assert!(planes.iter().all(|(n, offset)| corners.iter().all(|c| n.dot(*c) <= *offset)));
        }
    }
}
