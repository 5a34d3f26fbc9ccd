//! The triangle between a segment and a source, and what of it a face cuts.

use glam::DVec3;
use light::{PointSource, Triangle, rounding::UNIT};

/// The fan's own coordinates. With d = b − a and e = S − a (for a sun: its direction), a point X of its plane is
///
/// > X = a + along · d + height · e = P(s) + height · (S − P(s)),   P(s) = a + s d
///
/// so that s = along / room with room = 1 − height (for a sun, whose ways are parallel, room = 1). X stands
/// between P(s) and the source where height > 0 and room > 0, above a–b where 0 < along < room.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fan {
    /// The segment's start and its whole length.
    pub(crate) a: DVec3,
    pub(crate) d: DVec3,
    /// Where the source is; none for a sun.
    pub(crate) lamp: Option<DVec3>,
    /// Height from below which things are in the way, if light does not come from farther up.
    pub(crate) ceiling: Option<f64>,
    /// Normal of the plane, of any length.
    pub(crate) normal: DVec3,
    /// Gradients of `along` and `height`: the basis dual to d and e within the plane.
    pub(crate) along: DVec3,
    pub(crate) height: DVec3,
}

/// A point in the fan's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    /// Distance from the plane, in any unit.
    side: f64,
    along: f64,
    height: f64,
    room: f64,
    /// How far below the ceiling, in any unit.
    below: f64,
}

impl Point {
    /// Where the edge from `self`, which is below the plane, to `other`, which is not, crosses it: the same
    /// bits for all faces that share the edge.
    fn toward(self, other: Self) -> Self {
        let whole = other.side - self.side;
        let mix = |below: f64, above: f64| (below * other.side - above * self.side) / whole;
        Self {
            side: 0.0,
            along: mix(self.along, other.along),
            height: mix(self.height, other.height),
            room: mix(self.room, other.room),
            below: mix(self.below, other.below),
        }
    }

    /// Which point of a–b hides behind it, as a share of the way.
    fn share(self) -> f64 {
        (self.along / self.room).clamp(0.0, 1.0)
    }

    fn lerp(self, other: Self, t: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * t;
        Self {
            side: 0.0,
            along: mix(self.along, other.along),
            height: mix(self.height, other.height),
            room: mix(self.room, other.room),
            below: mix(self.below, other.below),
        }
    }
}

/// One end of a piece: how far along it, and the share there if a side of the fan cuts it off.
#[derive(Clone, Copy)]
struct End {
    t: f64,
    share: Option<f64>,
}

impl Fan {
    /// None where the source is seen from the segment along itself to f32 accuracy (then light grazes whatever
    /// the segment lies on), or lies on it, or the segment has no length.
    pub(crate) fn new(source: &PointSource, a: DVec3, b: DVec3) -> Option<Self> {
        let d = b - a;
        let (e, lamp) = match *source {
            PointSource::At(at) => (at - a, Some(at)),
            PointSource::Toward(toward) | PointSource::Below { toward, .. } => (toward, None),
        };
        let ceiling = match *source {
            PointSource::Below { level, .. } => Some(level),
            _ => None,
        };
        let normal = d.cross(e);
        let square = normal.length_squared();
        let least = f64::from(UNIT) * d.length() * e.length();
        let area = square > least * least;
        let (along, height) = (e.cross(normal) / square, normal.cross(d) / square);
        let sound = area && along.is_finite() && height.is_finite();
        sound.then_some(Self { a, d, lamp, ceiling, normal, along, height })
    }

    fn point(&self, at: DVec3) -> Point {
        let from = at - self.a;
        Point {
            side: self.normal.dot(from),
            along: self.along.dot(from),
            height: self.height.dot(from),
            // From the source itself, so that it keeps its digits near by.
            room: self.lamp.map_or(1.0, |lamp| self.height.dot(lamp - at)),
            below: self.ceiling.map_or(1.0, |level| level - at.y),
        }
    }

    /// The interval of a–b, within \[0, 1\], that `face` hides from the source.
    pub(crate) fn hidden(&self, face: &Triangle) -> Option<(f64, f64)> {
        let corners = face.0.map(|corner| self.point(corner));
        let below = corners.map(|corner| corner.side < 0.0);
        // The corner that is alone on its side.
        let lone = match below {
            [x, y, z] if x == y && y == z => return None,
            [x, y, z] if y == z && x != y => 0,
            [x, y, z] if x == z && y != x => 1,
            _ => 2,
        };
        let cut = |other: usize| match below[lone] {
            true => corners[lone].toward(corners[other]),
            false => corners[other].toward(corners[lone]),
        };
        let (from, to) = within(cut((lone + 1) % 3), cut((lone + 2) % 3))?;
        (from < to && !self.touches(face, from, to)).then_some((from, to))
    }

    /// Whether the segment from share `from` to share `to` lies in the plane of `face`, or the source does, as
    /// far as positions are known: within 4 u of the largest coordinate, per coordinate. That is what
    /// [`light::Place::error`] is for hits, and how far [`light::Place::leave`] moves them.
    fn touches(&self, face: &Triangle, from: f64, to: f64) -> bool {
        let normal = face.cross();
        let reach = face.0.iter().fold(0.0f64, |reach, corner| reach.max(corner.abs().max_element()));
        let unit = 4.0 * f64::from(UNIT) * normal.abs().element_sum();
        let near =
            |point: DVec3| normal.dot(point - face.0[0]).abs() <= unit * reach.max(point.abs().max_element());
        (near(self.a + self.d * from) && near(self.a + self.d * to)) || self.lamp.is_some_and(near)
    }
}

/// The shares that the part of `p`–`q` within the fan hides, the lesser first; none when nothing of it is within.
fn within(p: Point, q: Point) -> Option<(f64, f64)> {
    let mut low = End { t: 0.0, share: None };
    let mut high = End { t: 1.0, share: None };
    let sides = [
        (p.along, q.along, Some(0.0)),
        (p.room - p.along, q.room - q.along, Some(1.0)),
        (p.height, q.height, None),
        (p.below, q.below, None),
    ];
    for (at_p, at_q, share) in sides {
        if at_p <= 0.0 && at_q <= 0.0 {
            return None;
        }
        let t = at_p / (at_p - at_q);
        if at_p < 0.0 && t > low.t {
            low = End { t, share };
        }
        if at_q < 0.0 && t < high.t {
            high = End { t, share };
        }
    }
    let inside = low.t < high.t;
    let share = |end: End, own: Point| match (end.share, end.t == 0.0 || end.t == 1.0) {
        (Some(share), _) => share,
        // Not through `lerp`, so that neighbours get the same bits.
        (None, true) => own.share(),
        (None, false) => p.lerp(q, end.t).share(),
    };
    let (s, t) = (share(low, p), share(high, q));
    inside.then_some((s.min(t), s.max(t)))
}
