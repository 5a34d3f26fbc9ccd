//! Members cut by the plane of a fan: the places that may matter to their shadow.
//!
//! Where along the segment the way to the source begins or ceases to be blocked by a compound, that way
//!
//! - touches the curved face of a member: the discriminant B² − AC of its quadric along the way is 0. By the
//!   quadric's 2 × 2 minors mᵢⱼ = oᵢ dⱼ − oⱼ dᵢ it is −Σ Jᵢ Jⱼ mᵢⱼ² (J its signs), in which nothing cancels and which is
//!   quadratic in the place, since m is linear in it;
//! - or passes a corner of the cut: a rim of a frustum, a corner of a polyhedron, or where the faces of two
//!   members cross. Within the plane faces are straight edges and conics; two conics have in common the roots
//!   of a polynomial of the fourth degree, their resultant, in coordinates of what the two members have in common;
//! - or starts where the segment itself enters or leaves the body.
//!
//! A place too many costs a test, one found inexactly a few tests.

use glam::{DVec2, DVec3};

use super::{
    boxes::Bounds,
    chord::{BASE, Surface, TOP},
    conic::Conic,
    fan::Fan,
    member::Member,
    node::Plane,
    roots::{difference, quadratic, square},
    sheet::{NEAR, Sheet},
};

/// What the plane cuts out of a member's surface.
pub(crate) struct Section {
    conic: Option<Conic>,
    edges: Vec<[DVec2; 2]>,
}

impl Section {
    /// Reports at which shares of the segment ways to the source touch the member or pass a corner of it, and at
    /// which points.
    pub(crate) fn new(member: &Member, fan: &Fan, sheet: &Sheet, mut visit: impl FnMut(f64, DVec3)) -> Self {
        let frame = member.local_frame([sheet.origin, sheet.x, sheet.y]);
        let conic = conic(&member.surface, frame);
        let edges = match (&member.surface, &conic) {
            (Surface::Planes(planes), _) => polygon(planes, frame),
            (Surface::Frustum { .. }, Some(conic)) => {
                [BASE, TOP].iter().filter_map(|cap| rim(conic, cap, frame)).collect()
            }
            _ => Vec::new(),
        };
        if conic.is_some() {
            touching(member, fan).into_iter().flatten().for_each(|(s, point)| visit(s, point));
        }
        for &corner in edges.iter().flatten() {
            if let Some(s) = sheet.share(corner) {
                visit(s, sheet.point(corner));
            }
        }
        Self { conic, edges }
    }

    /// Reports where ways to the source pass a point that an edge of one has in common with the other's surface.
    pub(crate) fn corners(&self, other: &Self, sheet: &Sheet, mut visit: impl FnMut(f64, DVec3)) {
        let mut see = |point: DVec2| {
            if let Some(s) = sheet.share(point) {
                visit(s, sheet.point(point));
            }
        };
        let within = |t: f64| (-NEAR..=1.0 + NEAR).contains(&t);
        for (conic, edges) in [(&self.conic, &other.edges), (&other.conic, &self.edges)] {
            let Some(conic) = conic else { continue };
            for &[from, to] in edges {
                let places = quadratic(conic.along(from, to - from));
                places.into_iter().filter(|&t| within(t)).for_each(|t| see(from + (to - from) * t));
            }
        }
        for &[p, q] in &self.edges {
            for &[r, s] in &other.edges {
                let (u, v, w) = (q - p, s - r, r - p);
                let across = u.perp_dot(v);
                let (t, other) = (w.perp_dot(v) / across, w.perp_dot(u) / across);
                if within(t) && within(other) {
                    see(p + u * t);
                }
            }
        }
    }
}

/// Reports where ways to the source pass a point that the curved faces of two members have in common, within a box.
pub(crate) fn crossings(
    [one, two]: [&Member; 2],
    common: &Bounds,
    sheet: &Sheet,
    mut visit: impl FnMut(f64, DVec3),
) {
    let square = sheet.square(common);
    let frame = square.frame(sheet);
    let cut = |member: &Member| conic(&member.surface, member.local_frame(frame));
    let (Some(one), Some(two)) = (cut(one), cut(two)) else { return };
    one.meet(&two, |at| {
        let point = square.on_sheet(at);
        if let Some(s) = sheet.share(point) {
            visit(s, sheet.point(point));
        }
    });
}

/// A vector in the coordinates in which a quadric is a sum of signed squares: x, y, z of a ball; x, z and the radius
/// 1 − s y of a frustum. `one` is 1 for points, 0 for directions.
fn squares(surface: &Surface, v: DVec3, one: f64) -> DVec3 {
    match *surface {
        Surface::Frustum { taper } => DVec3::new(v.x, v.z, one - taper * v.y),
        _ => v,
    }
}

fn conic(surface: &Surface, [origin, x, y]: [DVec3; 3]) -> Option<Conic> {
    let (signs, constant) = match surface {
        Surface::Ball => (DVec3::ONE, -1.0),
        Surface::Frustum { .. } => (DVec3::new(1.0, 1.0, -1.0), 0.0),
        Surface::Planes(_) => return None,
    };
    let (o, x, y) = (squares(surface, origin, 1.0), squares(surface, x, 0.0), squares(surface, y, 0.0));
    let form = |u: DVec3, v: DVec3| (signs * u).dot(v);
    Some(Conic::new([form(x, x), form(x, y), form(y, y), form(o, x), form(o, y), form(o, o) + constant]))
}

/// Where the way to the source touches a member's curved face, and in which points.
fn touching(member: &Member, fan: &Fan) -> [Option<(f64, DVec3)>; 2] {
    let ([o, along], [d, turn]) = fan.local_pencil(member);
    let surface = &member.surface;
    let (o, along) = (squares(surface, o, 1.0), squares(surface, along, 0.0));
    let (d, turn) = (squares(surface, d, 0.0), squares(surface, turn, 0.0));
    // o × d, linear in the place since either o or d stays.
    let minors = [o.cross(d), along.cross(d) + o.cross(turn)];
    let (signs, discriminant) = match surface {
        Surface::Ball => (DVec3::ONE, difference(square(d, turn), square(minors[0], minors[1]))),
        _ => {
            let [m, change] = minors;
            let part = |i: usize| [m[i] * m[i], 2.0 * m[i] * change[i], change[i] * change[i]];
            let [a, b, c] = [part(0), part(1), part(2)];
            (DVec3::new(1.0, 1.0, -1.0), std::array::from_fn(|i| a[i] + b[i] - c[i]))
        }
    };
    quadratic(discriminant).map(|s| {
        if !(0.0..=1.0).contains(&s) {
            return None;
        }
        // The double root of A t² + 2 B t + C.
        let (from, way) = (o + along * s, d + turn * s);
        let t = -(signs * from).dot(way) / (signs * way).dot(way);
        let point = fan.pass(s, t)?;
        let height = member.local(point).y;
        let face = matches!(surface, Surface::Ball) || (-NEAR..=1.0 + NEAR).contains(&height);
        face.then_some((s, point))
    })
}

/// Height of the plane's points above a half-space: constant, and change along the axes.
fn height(plane: &Plane, [origin, x, y]: [DVec3; 3]) -> (f64, DVec2) {
    let n = plane.normal;
    (n.dot(origin) - plane.offset, DVec2::new(n.dot(x), n.dot(y)))
}

/// The chord of a frustum's cap.
fn rim(conic: &Conic, cap: &Plane, frame: [DVec3; 3]) -> Option<[DVec2; 2]> {
    let (height, slope) = height(cap, frame);
    let foot = slope * (-height / slope.length_squared());
    let along = slope.perp().normalize();
    let ends = quadratic(conic.along(foot, along)).map(|t| foot + along * t);
    ends.iter().all(|end| end.is_finite()).then_some(ends)
}

/// The edges of a polyhedron's cut, as far as they are within ±1.
fn polygon(planes: &[Plane], frame: [DVec3; 3]) -> Vec<[DVec2; 2]> {
    let mut polygon = vec![DVec2::NEG_ONE, DVec2::new(1.0, -1.0), DVec2::ONE, DVec2::new(-1.0, 1.0)];
    let mut kept = Vec::with_capacity(16);
    for plane in planes {
        let (height, slope) = height(plane, frame);
        let size = NEAR * NEAR * frame[1].length();
        // A face in the plane itself cuts nothing off.
        let along = slope.length() <= size && height.abs() <= size;
        if !along && !clip(&mut polygon, &mut kept, height, slope) {
            return Vec::new();
        }
    }
    (0..polygon.len()).map(|i| [polygon[i], polygon[(i + 1) % polygon.len()]]).collect()
}

/// Keeps the part of a convex polygon with height + slope · x ≤ 0 (Sutherland and Hodgman 1974); false when none
/// is left. `kept` is room to work in.
fn clip(polygon: &mut Vec<DVec2>, kept: &mut Vec<DVec2>, height: f64, slope: DVec2) -> bool {
    let value = |x: &DVec2| height + slope.dot(*x);
    if polygon.iter().all(|x| value(x) <= 0.0) {
        return true; // most planes of a polyhedron cut nothing off
    }
    kept.clear();
    for (i, x) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (value(x), value(next));
        if here <= 0.0 {
            kept.push(*x);
        }
        if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
            kept.push(*x + (*next - *x) * (here / (here - there)));
        }
    }
    std::mem::swap(polygon, kept);
    !polygon.is_empty()
}
