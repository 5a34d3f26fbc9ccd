//! The plane fan that a source spans over a segment: the ways from its points p(s) = a + s (b − a) to the source.

use std::cell::OnceCell;

use glam::DVec3;
use light::PointSource;

use super::{
    boxes::Bounds,
    csg::Compound,
    member::{Member, U},
    roots::{difference, quadratic, square},
};

/// A wall no farther than this from either end of a way, as a share of the coordinates, is the surface that
/// the segment lies on, seen from its lit side, or the one that the lamp is set in. A place in f32 is 60 times
/// less exact.
pub(crate) const TOUCH: f64 = 1e-9;

/// Lines o + s o' + t (d + s d'): (o, o') and (d, d').
pub(crate) type Pencil = ([DVec3; 2], [DVec3; 2]);

/// The fan of a source over a segment.
pub(crate) struct Fan {
    source: PointSource,
    pub(crate) a: DVec3,
    pub(crate) b: DVec3,
    /// See [`Self::plane`].
    plane: OnceCell<Option<(DVec3, f64)>>,
    /// The largest coordinate.
    pub(crate) size: f64,
}

impl Fan {
    pub(crate) fn new(source: &PointSource, a: DVec3, b: DVec3) -> Self {
        let lamp = match *source {
            PointSource::At(lamp) => lamp,
            PointSource::Toward(_) | PointSource::Below { .. } => DVec3::ZERO,
        };
        let size = a.abs().max(b.abs()).max(lamp.abs()).max_element();
        Self { source: *source, a, b, plane: OnceCell::new(), size }
    }

    /// Unit normal of its plane and a bound on the error of that; none for a mere line. Most fans meet no body and
    /// are never asked.
    pub(crate) fn plane(&self) -> Option<(DVec3, f64)> {
        *self.plane.get_or_init(|| {
            let (along, way) = (self.b - self.a, self.lamp().map_or(self.sun(), |lamp| lamp - self.a));
            let normal = way.cross(along);
            // Each product of the cross product rounds, and so did the ends' differences.
            let error = 8.0 * U * way.length() * along.length() / normal.length();
            (error < 1e-3).then(|| (normal.normalize(), error))
        })
    }

    pub(crate) fn lamp(&self) -> Option<DVec3> {
        match self.source {
            PointSource::At(lamp) => Some(lamp),
            PointSource::Toward(_) | PointSource::Below { .. } => None,
        }
    }

    /// Direction towards the sun; 0 for a lamp.
    pub(crate) fn sun(&self) -> DVec3 {
        match self.source {
            PointSource::At(_) => DVec3::ZERO,
            PointSource::Toward(way) | PointSource::Below { toward: way, .. } => way,
        }
    }

    /// A box around all of it.
    pub(crate) fn bounds(&self) -> Bounds {
        let ends = Bounds::around(&[self.a, self.b]);
        match self.source {
            PointSource::At(p) => ends.union(Bounds { low: p, high: p }).padded(),
            PointSource::Toward(way) | PointSource::Below { toward: way, .. } => {
                let low = DVec3::select(way.cmplt(DVec3::ZERO), DVec3::NEG_INFINITY, ends.padded().low);
                let mut high = DVec3::select(way.cmpgt(DVec3::ZERO), DVec3::INFINITY, ends.padded().high);
                if let PointSource::Below { level, .. } = self.source {
                    high.y = high.y.min(level);
                }
                Bounds { low, high }
            }
        }
    }

    /// The lines of all ways.
    fn pencil(&self) -> Pencil {
        match self.source {
            PointSource::At(lamp) => ([lamp, DVec3::ZERO], [self.a - lamp, self.b - self.a]),
            PointSource::Toward(way) | PointSource::Below { toward: way, .. } => {
                ([self.a, self.b - self.a], [way, DVec3::ZERO])
            }
        }
    }

    /// The same in a member's coordinates.
    pub(crate) fn local_pencil(&self, member: &Member) -> Pencil {
        let ([o, along], ways) = self.pencil();
        let local = |v: DVec3| member.local_vector(v);
        ([member.local(o), local(along)], ways.map(local))
    }

    /// The point of line s of [`Self::pencil`] at t, if it lies between segment and source.
    pub(crate) fn pass(&self, s: f64, t: f64) -> Option<DVec3> {
        let place = self.a + (self.b - self.a) * s;
        match self.source {
            // With some room for what is found inexactly.
            PointSource::At(lamp) => (t > -1e-6 && t < 1.0 + 1e-6).then(|| lamp + (place - lamp) * t),
            PointSource::Toward(way) | PointSource::Below { toward: way, .. } => {
                (t > -1e-6 * self.size).then(|| place + way * t)
            }
        }
    }

    /// Whether its plane misses a box.
    pub(crate) fn misses(&self, bounds: &Bounds) -> bool {
        let Some((normal, error)) = self.plane() else { return false };
        let centre = (bounds.low + bounds.high) * 0.5;
        let reach = normal.abs().dot(bounds.high - centre);
        let away = centre - self.a;
        // Coordinates round to 2⁻⁵³ of them.
        let rounding = error * away.length() + 1e-14 * (self.size + centre.abs().max_element());
        normal.dot(away).abs() > reach + rounding
    }

    /// Whether a ball comes near any of the lines o + s o' + t (d + s d'), 0 ≤ s ≤ 1: whether
    /// r² d² − |(o − c) × d|² ≥ 0 for any of them.
    pub(crate) fn reaches(([o, along], [d, turn]): Pencil, (centre, radius): (DVec3, f64)) -> bool {
        let o = o - centre;
        let near = square(d, turn).map(|c| c * radius * radius * (1.0 + 1e-6));
        let depth = difference(near, square(o.cross(d), along.cross(d) + o.cross(turn)));
        let middle = depth[0] + 0.5 * depth[1] + 0.25 * depth[2];
        middle >= 0.0 || quadratic(depth).iter().any(|s| (0.0..=1.0).contains(s))
    }

    /// Whether a box has a point in common with the fan's plane, near its ways.
    pub(crate) fn passes(&self, bounds: &Bounds) -> bool {
        let ball = ((bounds.low + bounds.high) * 0.5, (bounds.high - bounds.low).length() * 0.5);
        !self.misses(bounds) && Self::reaches(self.pencil(), ball)
    }

    /// Whether a wall stands on the way from a place to the source.
    pub(crate) fn blocked(&self, compound: &Compound, s: f64) -> bool {
        let from = self.a + (self.b - self.a) * s;
        let (way, end) = match self.source {
            PointSource::At(lamp) => (lamp - from, 1.0),
            PointSource::Toward(way) | PointSource::Below { toward: way, .. } => (way, f64::INFINITY),
        };
        let touch = TOUCH * self.size / way.length();
        let mut blocked = false;
        compound.walls((from, way), |wall| {
            let near = touch + wall.end.error;
            blocked = wall.end.t > near && wall.end.t < end - near;
            blocked || wall.end.t >= end
        });
        blocked
    }
}
