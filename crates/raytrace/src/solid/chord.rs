//! The piece of a line that lies within a convex solid.
//!
//! A ball and a truncated cone are where a quadric F ≤ 0, clipped by half-spaces:
//!
//!   ball      F = x² + y² + z² − 1
//!   frustum   F = x² + z² − (1 − s y)²,   0 ≤ y ≤ 1,   s = 1 − top
//!
//! Along o + t d it is F = A t² + 2 B t + C. The line's origin has been moved next to the shape, so all three are
//! of the shape's own size and lose no digits; the roots are q/A and C/q with q = −(B + sign B √(B² − AC)),
//! which adds what has one sign. An error e of the points shows as ΔF ≤ |grad F| · e and moves a root
//! by ΔF / (2 √(B² − AC)).

use glam::DVec3;

use super::{
    member::{Line, U},
    node::Plane,
};

/// One end of a chord.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    /// Where on the line.
    pub(crate) t: f64,
    /// Bound on the error of `t`.
    pub(crate) error: f64,
    /// Which face: 0 the curved one, 1 the base, 2 the top; of a polyhedron the half-space.
    pub(crate) face: u32,
}

/// Where a line enters and where it leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chord {
    pub(crate) enter: End,
    pub(crate) leave: End,
}

/// The surface of a shape in its own coordinates.
#[derive(Clone, Debug)]
pub(crate) enum Surface {
    Ball,
    Frustum { taper: f64 },
    Planes(Box<[Plane]>),
}

pub(crate) const BASE: Plane = Plane { normal: DVec3::NEG_Y, offset: 0.0 };
pub(crate) const TOP: Plane = Plane { normal: DVec3::Y, offset: 1.0 };

impl Chord {
    const WHOLE: Self = Self {
        enter: End { t: f64::NEG_INFINITY, error: 0.0, face: 0 },
        leave: End { t: f64::INFINITY, error: 0.0, face: 0 },
    };

    /// Keeps what lies in a half-space whose normal is a unit vector; false when nothing is left.
    fn clip(&mut self, line: &Line, plane: &Plane, face: u32, nudge: DVec3) -> bool {
        let (height, speed) =
            (plane.offset - plane.normal.dot(line.origin), plane.normal.dot(line.direction));
        let error = plane.normal.abs().dot(line.error)
            + 4.0 * U * (plane.offset.abs() + plane.normal.abs().dot(line.origin.abs()));
        if speed.abs() * line.reach <= error {
            // The line runs along the plane.
            return if height.abs() <= error { plane.normal.dot(nudge) < 0.0 } else { height > 0.0 };
        }
        let end = End { t: height / speed, error: error / speed.abs(), face };
        if speed > 0.0 {
            if end.t < self.leave.t {
                self.leave = end;
            }
        } else if end.t > self.enter.t {
            self.enter = end;
        }
        self.enter.t < self.leave.t
    }

    /// Keeps what lies in A t² + 2 B t + C ≤ 0 on the nappe where `rising` tells which way it widens; `error` is
    /// that of C.
    fn bend(&mut self, quadric: &Quadric, rising: bool) -> bool {
        let Quadric { a, b, c, error } = *quadric;
        let discriminant = b * b - a * c;
        if a > 0.0 && discriminant <= a * error {
            return false; // passes, or touches within the error
        }
        let root = discriminant.max(0.0).sqrt();
        let q = -(b + root.copysign(b));
        // Through the apex of a cone all is 0.
        let second = if q == 0.0 { 0.0 } else { c / q };
        let first = if a == 0.0 { second } else { q / a };
        let end = |t: f64| {
            let shift = (error / (2.0 * root)).min((error / a.abs()).sqrt());
            End { t, error: shift + 4.0 * U * t.abs(), face: 0 }
        };
        let (low, high) = (first.min(second), first.max(second));
        if a > 0.0 {
            (self.enter, self.leave) = (end(low), end(high));
        } else if a == 0.0 {
            if b > 0.0 { self.leave = end(second) } else { self.enter = end(second) }
        } else if rising {
            self.enter = end(high);
        } else {
            self.leave = end(low);
        }
        true
    }
}

/// A t² + 2 B t + C along a line.
struct Quadric {
    a: f64,
    b: f64,
    c: f64,
    /// Bound on the error of its value within the shape.
    error: f64,
}

impl Surface {
    /// The piece of the line inside; none when there is none, or none longer than its own error.
    pub(crate) fn chord(&self, line: &Line, nudge: DVec3) -> Option<Chord> {
        let mut chord = Chord::WHOLE;
        let there = match self {
            Self::Ball => self.round(line, nudge, &mut chord),
            Self::Frustum { .. } => {
                self.round(line, nudge, &mut chord)
                    && chord.clip(line, &BASE, 1, nudge)
                    && chord.clip(line, &TOP, 2, nudge)
            }
            Self::Planes(planes) => {
                planes.iter().zip(0..).all(|(plane, face)| chord.clip(line, plane, face, nudge))
            }
        };
        let long = chord.leave.t - chord.enter.t > chord.enter.error + chord.leave.error;
        (there && long && chord.enter.t.is_finite() && chord.leave.t.is_finite()).then_some(chord)
    }

    /// Clips by the curved face.
    fn round(&self, line: &Line, nudge: DVec3, chord: &mut Chord) -> bool {
        let (o, d) = (line.origin, line.direction);
        let (quadric, rising) = match *self {
            Self::Frustum { taper } => {
                // (1 − s y)² is written by the radius at the origin, not by y², which would lose digits.
                let (radius, change) = (1.0 - taper * o.y, -taper * d.y);
                let across = DVec3::new(1.0, 0.0, 1.0);
                let quadric = Quadric {
                    a: (d * across).length_squared() - change * change,
                    b: (o * across).dot(d) - radius * change,
                    c: (o * across).length_squared() - radius * radius,
                    error: 0.0,
                };
                (quadric, change > 0.0)
            }
            _ => (Quadric { a: d.dot(d), b: o.dot(d), c: o.dot(o) - 1.0, error: 0.0 }, false),
        };
        let wide = match *self {
            Self::Frustum { taper } => 1.0f64.max(1.0 - taper) + line.error.length(),
            _ => 1.0,
        };
        let slope = match *self {
            Self::Frustum { taper } => DVec3::new(1.0, taper.abs(), 1.0),
            _ => DVec3::ONE,
        };
        let error = 2.0 * wide * slope.dot(line.error) + 16.0 * U * wide * wide;
        let quadric = Quadric { error, ..quadric };
        let change = quadric.a.abs() * line.reach * line.reach + 2.0 * quadric.b.abs() * line.reach;
        if change <= error {
            // The line runs along the surface, or in parallel to it.
            return match quadric.c.abs() <= 2.0 * error {
                true => self.gradient(0, o).dot(nudge) < 0.0,
                false => quadric.c < 0.0,
            };
        }
        chord.bend(&quadric, rising)
    }

    /// Whether a face is plane.
    pub(crate) fn is_flat(&self, face: u32) -> bool {
        match self {
            Self::Ball => false,
            Self::Frustum { .. } => face != 0,
            Self::Planes(_) => true,
        }
    }

    /// How far outside a point is: a distance for planes, off by a factor of the shape's for others; negative inside.
    pub(crate) fn beyond(&self, p: DVec3) -> f64 {
        match self {
            Self::Ball => p.length() - 1.0,
            Self::Frustum { taper } => {
                let side = p.x.hypot(p.z) - (1.0 - taper * p.y);
                side.max(-p.y).max(p.y - 1.0)
            }
            Self::Planes(planes) => planes
                .iter()
                .map(|plane| plane.normal.dot(p) - plane.offset)
                .fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// Some vector along the outward normal of a face at a point of it.
    pub(crate) fn gradient(&self, face: u32, p: DVec3) -> DVec3 {
        match (self, face) {
            (Self::Ball, _) => p,
            (Self::Frustum { taper }, 0) => DVec3::new(p.x, taper * (1.0 - taper * p.y), p.z),
            (Self::Frustum { .. }, 1) => BASE.normal,
            (Self::Frustum { .. }, _) => TOP.normal,
            (Self::Planes(planes), face) => planes[face as usize].normal,
        }
    }
}
