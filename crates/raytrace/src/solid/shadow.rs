//! The shadow of bodies on a segment, exactly.
//!
//! Seen from the source, the segment a b spans a plane *fan* of ways p(s) … source, p = a + s (b − a). A way is
//! blocked if it meets a wall of the compound, as a ray would. That can only change at places that
//! [`super::section`] knows; between neighbouring ones a single way tells for all. A place where it does change
//! is where a stretch ends, once ways just before and just behind it have confirmed it; otherwise halving finds it.
//!
//! So what is dark is what rays say, and what cuts the members only decides where to look. A stretch's end is right
//! to [`EXACT`] of the segment, or to the rounding of its points; where the shadow begins on the body itself, which
//! stands on the segment or pierces it, to [`TOUCH`]. A piece of shadow or of light may be missed where it is
//! shorter than 1e-6 of the body *and* the two borders are those of members that just touch or just cross there.

use std::cell::OnceCell;

use glam::DVec3;
use light::{PointSource, Stretch};

use super::{
    Ready,
    boxes::Bounds,
    csg::Compound,
    member::{Member, U},
    roots::quadratic,
    section::{Section, Sheet, difference, square},
};

/// Share of the segment to which its places are told apart.
const EXACT: f64 = 1.0 / (1u64 << 40) as f64;

/// A wall no farther than this from either end of a way, as a share of the coordinates, is the surface that
/// the segment lies on, seen from its lit side, or the one that the lamp is set in. A place in f32 is 60 times
/// less exact.
const TOUCH: f64 = 1e-9;

/// Lines o + s o' + t (d + s d'): (o, o') and (d, d').
pub(crate) type Pencil = ([DVec3; 2], [DVec3; 2]);

/// The fan of a source over a segment.
pub(crate) struct Fan {
    source: PointSource,
    pub(crate) a: DVec3,
    pub(crate) b: DVec3,
    /// See [`Self::normal`].
    plane: OnceCell<Option<DVec3>>,
    /// The largest coordinate.
    size: f64,
}

impl Fan {
    pub(crate) fn new(source: &PointSource, a: DVec3, b: DVec3) -> Self {
        let lamp = match *source {
            PointSource::At(lamp) => lamp,
            PointSource::Toward(_) => DVec3::ZERO,
        };
        let size = a.abs().max(b.abs()).max(lamp.abs()).max_element();
        Self { source: *source, a, b, plane: OnceCell::new(), size }
    }

    /// Unit normal of its plane; none for a mere line. Most fans meet no body and are never asked.
    pub(crate) fn normal(&self) -> Option<DVec3> {
        *self.plane.get_or_init(|| {
            let (along, way) = (self.b - self.a, self.lamp().map_or(self.sun(), |lamp| lamp - self.a));
            let normal = way.cross(along);
            // Nearer to a line than this its plane would be made of rounding.
            let flat = normal.length() > 1e-12 * way.length() * along.length();
            flat.then(|| normal.normalize())
        })
    }

    pub(crate) fn lamp(&self) -> Option<DVec3> {
        match self.source {
            PointSource::At(lamp) => Some(lamp),
            PointSource::Toward(_) => None,
        }
    }

    /// Direction towards the sun; 0 for a lamp.
    pub(crate) fn sun(&self) -> DVec3 {
        match self.source {
            PointSource::At(_) => DVec3::ZERO,
            PointSource::Toward(way) => way,
        }
    }

    /// A box around all of it.
    pub(crate) fn bounds(&self) -> Bounds {
        let ends = Bounds::around(&[self.a, self.b]);
        match self.source {
            PointSource::At(p) => ends.union(Bounds { low: p, high: p }).padded(),
            PointSource::Toward(way) => {
                let low = DVec3::select(way.cmplt(DVec3::ZERO), DVec3::NEG_INFINITY, ends.padded().low);
                let high = DVec3::select(way.cmpgt(DVec3::ZERO), DVec3::INFINITY, ends.padded().high);
                Bounds { low, high }
            }
        }
    }

    /// The lines of all ways.
    fn pencil(&self) -> Pencil {
        match self.source {
            PointSource::At(lamp) => ([lamp, DVec3::ZERO], [self.a - lamp, self.b - self.a]),
            PointSource::Toward(way) => ([self.a, self.b - self.a], [way, DVec3::ZERO]),
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
            PointSource::Toward(way) => (t > -1e-6 * self.size).then(|| place + way * t),
        }
    }

    /// Whether its plane misses a box.
    fn misses(&self, bounds: &Bounds) -> bool {
        let Some(normal) = self.normal() else { return false };
        let centre = (bounds.low + bounds.high) * 0.5;
        let reach = normal.abs().dot(bounds.high - centre);
        // Products of coordinates, each rounded, and the normal likewise.
        let rounding = 1e-12 * (self.size + centre.abs().max_element());
        normal.dot(centre - self.a).abs() > reach + rounding
    }

    /// Whether a ball comes near any of the lines o + s o' + t (d + s d'), 0 ≤ s ≤ 1: whether
    /// r² d² − |(o − c) × d|² ≥ 0 for any of them.
    fn reaches(([o, along], [d, turn]): Pencil, (centre, radius): (DVec3, f64)) -> bool {
        let o = o - centre;
        let near = square(d, turn).map(|c| c * radius * radius * (1.0 + 1e-6));
        let depth = difference(near, square(o.cross(d), along.cross(d) + o.cross(turn)));
        let middle = depth[0] + 0.5 * depth[1] + 0.25 * depth[2];
        middle >= 0.0 || quadratic(depth).iter().any(|s| (0.0..=1.0).contains(s))
    }

    /// Whether a box has a point in common with the fan's plane, near its ways.
    fn passes(&self, bounds: &Bounds) -> bool {
        let ball = ((bounds.low + bounds.high) * 0.5, (bounds.high - bounds.low).length() * 0.5);
        !self.misses(bounds) && Self::reaches(self.pencil(), ball)
    }

    /// Whether a wall stands on the way from a place to the source.
    fn blocked(&self, compound: &Compound, s: f64) -> bool {
        let from = self.a + (self.b - self.a) * s;
        let (way, end) = match self.source {
            PointSource::At(lamp) => (lamp - from, 1.0),
            PointSource::Toward(way) => (way, f64::INFINITY),
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

/// Working memory.
#[derive(Default)]
pub(crate) struct Work {
    places: Vec<f64>,
    sections: Vec<Option<Section>>,
}

impl Fan {
    /// Appends the body's shadow.
    pub(crate) fn stretches(&self, body: &Ready, work: &mut Work, out: &mut Vec<Stretch>) {
        if body.bounds.is_empty() || self.misses(&body.bounds) || !self.places(body, work) {
            return;
        }
        let places = &mut work.places;
        places.sort_unstable_by(f64::total_cmp);
        // Nearer than this points of the segment are the same in f64.
        let exact = EXACT.max(8.0 * U * self.size / (self.b - self.a).length());
        let touch = 4.0 * TOUCH * self.size / (self.b - self.a).length();
        let blocked = |s: f64| self.blocked(&body.compound, s);
        let (mut last, mut middle, mut from) = (0.0, 0.0, None);
        for i in 0..=places.len() {
            let next = places.get(i).copied().unwrap_or(1.0);
            if next - last < exact && i < places.len() {
                continue;
            }
            let here = 0.5 * (last + next);
            let dark = blocked(here);
            if dark != from.is_some() {
                let place = match last {
                    0.0 => 0.0,
                    _ => border(blocked, !dark, [middle, here], last, [exact, touch]),
                };
                match from.take() {
                    Some(from) => out.push(Stretch { from, to: place, dark: body.medium.is_none() }),
                    None => from = Some(place),
                }
            }
            (last, middle) = (next, here);
        }
        if let Some(from) = from {
            out.push(Stretch { from, to: 1.0, dark: body.medium.is_none() });
        }
    }

    /// Collects where the body's shadow may begin or end, between 0 and 1; false when it is nowhere near.
    fn places(&self, body: &Ready, work: &mut Work) -> bool {
        let Work { places, sections } = work;
        (places.clear(), sections.clear());
                let compound = &body.compound;
        let mut see = |s: f64, at: DVec3, members: [u32; 2]| {
            if s > 0.0 && s < 1.0 && compound.shows(at, members) {
                places.push(s);
            }
        };
        let sheet = Sheet::new(self, &body.bounds);
        let mut any = false;
        for (member, i) in body.compound.members.iter().zip(0..) {
            let near = Self::reaches(self.local_pencil(member), member.ball);
            any |= near;
            let sheet = sheet.as_ref().filter(|_| near);
            let see = |s, at| see(s, at, [i; 2]);
            sections.push(sheet.map(|sheet| Section::new(member, self, sheet, see)));
        }
        if !any {
            return false;
        }
        if let Some(sheet) = &sheet {
            for &(i, j, common) in &body.pairs {
                if let (Some(one), Some(two)) = (&sections[i as usize], &sections[j as usize])
                    && self.passes(&common)
                {
                    one.corners(two, sheet, |s, at| see(s, at, [i, j]));
                }
            }
        }
        body.compound.walls((self.a, self.b - self.a), |wall| {
            if wall.end.t > 0.0 && wall.end.t < 1.0 {
                places.push(wall.end.t);
            }
            wall.end.t >= 1.0
        });
        true
    }
}

/// Where, near `at` and within a bracket, ways cease to be `before`, blocked or not.
///
/// `at` itself if ways around it, as near as the first or at least the second of `sure`, say so.
fn border(
    blocked: impl Fn(f64) -> bool,
    before: bool,
    [mut low, mut high]: [f64; 2],
    at: f64,
    sure: [f64; 2],
) -> f64 {
    for by in sure {
        for s in [at - by, at + by] {
            if low < s && s < high {
                if blocked(s) == before { low = s } else { high = s }
            }
        }
        // Half as much again for the rounding of at ± by.
        if at - low <= 1.5 * by && high - at <= 1.5 * by {
            return at;
        }
    }
    while high - low > sure[0] {
        let s = 0.5 * (low + high);
        if s <= low || s >= high {
            break;
        }
        if blocked(s) == before { low = s } else { high = s }
    }
    0.5 * (low + high)
}
