//! Drawing the scene onto the cuboid.

use glam::{DMat3, DVec3, Vec3};
use light::{Bodies, Geometry, Mesh};

use super::coverage::Coverage;
use super::layout::{Face, Layout};
use crate::obstacles::{Bounds, Obstacles, Oriented, Visit, above, is_edge_on};

/// What is looked at from a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Where \[m\], in the world: just in front of the place's surface.
    pub origin: DVec3,
    /// How far that may be wrong \[m\]: a face whose plane passes as near hides nothing.
    pub error: f64,
    /// Unit normal of the place's plane, in the world; nothing behind it matters.
    pub normal: Vec3,
    /// Height \[m\] over the origin of what is too low to hide anything; −∞ = nothing is.
    pub floor: f64,
}

/// Which of the scene's things are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Things {
    /// Faces that nothing passes.
    Solid,
    /// What only rays can tell of: faces with an opacity or a medium, hulls of bodies.
    Soft,
}

/// Which elements of the cuboid around a place does the scene cover?
///
/// An element, or each of k × k parts of it, is covered when a thing meets the half-line from the origin through
/// its *middle*, at any distance but above the floor; things seen from their edge do not count. Depth does not matter. There is one answer to that, whatever
/// the order of drawing: implementations may differ only where the half-line meets an edge within their rounding.
pub trait Rasterise: Send + Sync {
    /// Covers, in `bits` (one [`Coverage`] for each face of the layout, of k times its columns and rows), what `things`
    /// cover. Bits that are set already are not asked for.
    fn cover(&self, view: &Viewpoint, things: Things, bits: &mut [Coverage; 6]);
}

/// Drawing by the processor.
///
/// *Membership.* With the corners v_i relative to the origin and the edges' normals e_0 = v_1 × v_2 and so on, the
/// half-line along D meets the triangle where all D · e_i have the sign of v_0 · e_0. This is linear along a row of
/// elements, so that every edge leaves a half-line of them, which needs no clipping, even of triangles that pass beside or
/// behind the origin. Two triangles with an edge in common see the same e but for its sign: no gap opens between.
///
/// *Order.* A hierarchy of boxes is walked from near to far. A box is passed over when it is wholly behind the
/// plane, below the floor, or when each middle of an element that it may reach is covered already; a far box that
/// falls between the middles is one of these. None of this changes an answer.
#[derive(Clone, Debug)]
pub struct Drawing {
    faces: [Face; 6],
    frame_from_world: DMat3,
    solid: Obstacles,
    soft: Obstacles,
}

impl Drawing {
    /// The scene, to be drawn in a layout of k × k parts to an element.
    pub fn new(layout: &Layout, parts: u32, geometry: &Geometry, bodies: Option<&dyn Bodies>) -> Self {
        let parts = parts.max(1) as usize;
        Self {
            faces: layout.faces().map(|face| Face { count: face.count.map(|count| count * parts), ..face }),
            frame_from_world: layout.frame_from_world(),
            solid: Obstacles::new(geometry, |mesh| !is_soft(mesh), None),
            soft: Obstacles::new(geometry, is_soft, bodies),
        }
    }
}

/// Whether something of the light may pass the mesh's faces.
pub(crate) fn is_soft(mesh: &Mesh) -> bool {
    mesh.opacity.is_some() || mesh.medium.is_some()
}

impl Rasterise for Drawing {
    fn cover(&self, view: &Viewpoint, things: Things, bits: &mut [Coverage; 6]) {
        let obstacles = match things {
            Things::Solid => &self.solid,
            Things::Soft => &self.soft,
        };
        if obstacles.is_empty() {
            return;
        }
        let up = self.frame_from_world * DVec3::Y;
        let normal = self.frame_from_world * view.normal.as_dvec3();
        let Viewpoint { floor, error, .. } = *view;
        let mut pen = Pen { faces: &self.faces, up, normal, floor, error, bits };
        obstacles.walk(self.frame_from_world, view.origin, &mut pen);
    }
}

/// Draws around one place.
struct Pen<'a> {
    faces: &'a [Face; 6],
    up: DVec3,
    normal: DVec3,
    floor: f64,
    error: f64,
    bits: &'a mut [Coverage; 6],
}

impl Visit for Pen<'_> {
    fn wants(&mut self, bounds: &Bounds, solid: &Oriented) -> bool {
        if solid.most(self.normal) <= 0.0 || solid.most(self.up) <= self.floor {
            return false;
        }
        let open = |face: &Face, bits: &Coverage, around: &[DVec3]| {
            reach(face, bounds, around).is_some_and(|[x, y]| !bits.all_covered(x, y))
        };
        let mut faces = self.faces.iter().zip(&*self.bits);
        // The box along the axes first: its corners cost more to look at.
        faces.any(|(face, bits)| open(face, bits, &[]) && open(face, bits, &solid.corners()))
    }

    fn triangle(&mut self, corners: [DVec3; 3]) {
        if corners.iter().all(|&corner| self.normal.dot(corner) <= 0.0) || is_edge_on(&corners, self.error) {
            return;
        }
        if corners.iter().all(|&corner| self.up.dot(corner) >= self.floor) {
            return self.draw(corners);
        }
        let (polygon, count) = above(corners, self.up, self.floor);
        for last in 2..count {
            self.draw([polygon[0], polygon[last - 1], polygon[last]]);
        }
    }
}

impl Pen<'_> {
    fn draw(&mut self, corners: [DVec3; 3]) {
        let [a, b, c] = corners;
        let edges = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(edges[0]);
        if volume == 0.0 || !volume.is_finite() {
            return;
        }
        let inward = edges.map(|edge| edge * volume.signum());
        let bounds = Bounds { low: a.min(b).min(c), high: a.max(b).max(c) };
        for (face, bits) in self.faces.iter().zip(&mut *self.bits) {
            if let Some([x, y]) = reach(face, &bounds, &corners)
                && !bits.all_covered(x, y)
            {
                fill(face, bits, &inward, x, y);
            }
        }
    }
}

/// First and last column, and row.
type Rectangle = [[usize; 2]; 2];

/// Covers the middles in a rectangle of elements that are on the inner side of all edges.
fn fill(face: &Face, bits: &mut Coverage, inward: &[DVec3; 3], x: [usize; 2], y: [usize; 2]) {
    let [i, j] = face.axes();
    let step = [0, 1].map(|k| 2.0 * face.half[k] / face.count[k] as f64);
    let first = [0, 1].map(|k| 0.5 * step[k] - face.half[k]);
    // On the row at height v of column c: D · e = slope · c + start + rise · v ≥ 0.
    let lines = inward.map(|edge| {
        let start = edge[face.axis] * (face.sign * face.distance) + edge[i] * first[0];
        Line::new(edge[i] * step[0], start, edge[j])
    });
    for row in y[0]..=y[1] {
        let height = first[1] + step[1] * row as f64;
        let (mut low, mut high) = (x[0] as f64, x[1] as f64);
        for line in &lines {
            match *line {
                Line::From { start, rise } => low = low.max(start + rise * height),
                Line::To { start, rise } => high = high.min(start + rise * height),
                Line::Along { start, rise } if start + rise * height >= 0.0 => {}
                // Also where something is not a number.
                Line::Along { .. } => high = -1.0,
            }
        }
        if low <= high {
            // Neither is negative: truncation is the floor.
            let (first, last) = (ceiling(low), high as usize);
            if first <= last {
                bits.cover(row, first, last);
            }
        }
    }
}

/// The least whole number that is not below x ≥ 0. (`f64::ceil` is a call where the processor's newer instructions are
/// not asked for; this ran once for each row of each face drawn.)
fn ceiling(x: f64) -> usize {
    let whole = x as usize;
    whole + usize::from((whole as f64) < x)
}

/// What an edge leaves of a row: the columns from, or up to, start + rise · height; or all or none.
enum Line {
    From { start: f64, rise: f64 },
    To { start: f64, rise: f64 },
    Along { start: f64, rise: f64 },
}

impl Line {
    fn new(slope: f64, start: f64, rise: f64) -> Self {
        let (from, by) = (-start / slope, -rise / slope);
        match slope {
            _ if !from.is_finite() || !by.is_finite() => Self::Along { start, rise },
            slope if slope > 0.0 => Self::From { start: from, rise: by },
            _ => Self::To { start: from, rise: by },
        }
    }
}

/// Rounding of a bound in elements: far more than it is, far less than an element.
const SLACK: f64 = 1e-6;

/// The elements of `face` whose middles may be covered by what has these bounds and is the convex hull of `around`; none
/// when there are none. Without points the bounds alone decide, as they do where a point is behind the centre.
fn reach(face: &Face, bounds: &Bounds, around: &[DVec3]) -> Option<Rectangle> {
    let (low, high) = (bounds.low[face.axis] * face.sign, bounds.high[face.axis] * face.sign);
    let (near, far) = (low.min(high), low.max(high));
    // What only touches the plane of the centre reaches nothing of the face at all.
    if far <= 0.0 {
        return None;
    }
    let axes = face.axes();
    let [x, y] = slopes(face, around).unwrap_or_else(|| {
        [0, 1].map(|k| {
            let (low, high) = (bounds.low[axes[k]], bounds.high[axes[k]]);
            let most = |x: f64| match x {
                x if x <= 0.0 => x / far,
                x if near > 0.0 => x / near,
                _ => f64::INFINITY,
            };
            [-most(-low), most(high)]
        })
    });
    Some([columns(face, 0, x)?, columns(face, 1, y)?])
}

/// Least and greatest tangents, along both sides of a face, of the angles between its axis and `points`; none without
/// points or with one that is not in front of the centre.
fn slopes(face: &Face, points: &[DVec3]) -> Option<[[f64; 2]; 2]> {
    let [i, j] = face.axes();
    let nothing = [f64::INFINITY, f64::NEG_INFINITY];
    let (mut x, mut y) = (nothing, nothing);
    for point in points {
        let depth = point[face.axis] * face.sign;
        if depth.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        let inverse = 1.0 / depth;
        let (u, v) = (point[i] * inverse, point[j] * inverse);
        x = [x[0].min(u), x[1].max(u)];
        y = [y[0].min(v), y[1].max(v)];
    }
    (!points.is_empty()).then_some([x, y])
}

/// Columns (or rows) of a face with their middles between two slopes, tangents of the angle from its axis.
fn columns(face: &Face, side: usize, [low, high]: [f64; 2]) -> Option<[usize; 2]> {
    let count = face.count[side] as f64;
    let scale = 0.5 * count / face.half[side];
    let at = |slope: f64| (slope * face.distance + face.half[side]) * scale - 0.5;
    let first = (at(low) - SLACK).max(0.0);
    let last = (at(high) + SLACK).min(count - 1.0);
    // Also none where something is not a number.
    (first <= last).then(|| [ceiling(first), last as usize]).filter(|[first, last]| first <= last)
}
