//! The shadow of a convex polyhedron on a segment.
//!
//! Seen from the source, the segment a b spans a plane fan. Its points are p + α (a − p) + β (b − p) for a
//! lamp at p (α, β ≥ 0, α + β ≤ 1), a + β (b − a) + α w for a sun towards w (α ≥ 0, 0 ≤ β ≤ 1). The
//! polyhedron's half-spaces are linear in (α, β), so what the fan has in common with it is a convex polygon,
//! and its shadow on the segment is one interval, found from the polygon's corners: s = β / (α + β), or β.

use glam::{DVec2, DVec3};
use light::PointSource;

use super::{boxes::Bounds, node::Plane};

/// The fan of a source over a segment.
pub(crate) struct Fan {
    source: PointSource,
    a: DVec3,
    b: DVec3,
}

impl Fan {
    pub(crate) fn new(source: &PointSource, a: DVec3, b: DVec3) -> Self {
        Self { source: *source, a, b }
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

    /// What a convex polyhedron within `bounds`, larger than it is by a share `margin` of the coordinates
    /// (negative: smaller), keeps the light off.
    pub(crate) fn shadow(&self, planes: &[Plane], bounds: &Bounds, margin: f64) -> Shadow {
        let reach = |p: DVec3| p.abs().max_element();
        let size = reach(bounds.low).max(reach(bounds.high)).max(reach(self.a)).max(reach(self.b));
        let (corner, u, v, lamp) = match self.source {
            PointSource::At(p) => (p, self.a - p, self.b - p, reach(p)),
            // Farther than the polyhedron from any point of the segment.
            PointSource::Toward(way) => (self.a, way * 4.0 * size, self.b - self.a, 0.0),
        };
        let sun = matches!(self.source, PointSource::Toward(_));
        let (mut polygon, mut kept) = (Vec::with_capacity(16), Vec::with_capacity(16));
        polygon.extend([DVec2::ZERO, DVec2::X, DVec2::Y]);
        if sun {
            polygon.insert(2, DVec2::ONE);
        }
        let pad = margin * size.max(lamp);
        for plane in planes {
            let height = plane.normal.dot(corner) - plane.offset - pad;
            let along = DVec2::new(plane.normal.dot(u), plane.normal.dot(v));
            if !clip(&mut polygon, &mut kept, height, along) {
                return Shadow::Nothing;
            }
        }
        // Distance from the segment, and place along it; none at the lamp.
        let length = u.length().max(v.length());
        let off = |at: &DVec2| if sun { at.x * 4.0 * size } else { (1.0 - at.element_sum()) * length };
        let place = |at: &DVec2| match at.element_sum() {
            _ if sun => Some(at.y),
            sum => (sum > 1e-12).then(|| at.y / sum),
        };
        if polygon.iter().all(|at| off(at) <= TOUCH * size) {
            return Shadow::Nothing;
        }
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for at in &polygon {
            let Some(s) = place(at) else { return Shadow::Lamp };
            (from, to) = (from.min(s), to.max(s));
        }
        let (from, to) = ((from - margin).max(0.0), (to + margin).min(1.0));
        if from < to { Shadow::Stretch(from, to) } else { Shadow::Nothing }
    }
}

/// How much larger what may be in the way is taken, as a share of the coordinates: all here rounds far below.
pub(crate) const MARGIN: f64 = 1e-12;

/// What reaches no farther than this from the segment, as a share of the coordinates, is the surface that the
/// segment lies on, seen from its lit side. A place in f32 is 60 times less exact.
const TOUCH: f64 = 1e-9;

/// What a polyhedron does to a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shadow {
    /// No point of it is behind the polyhedron.
    Nothing,
    /// From here to here, as shares of the way.
    Stretch(f64, f64),
    /// The lamp is within the polyhedron.
    Lamp,
}

/// Keeps the part of a convex polygon with height + along · x ≤ 0 (Sutherland and Hodgman 1974); false when none
/// is left. `kept` is room to work in.
fn clip(polygon: &mut Vec<DVec2>, kept: &mut Vec<DVec2>, height: f64, along: DVec2) -> bool {
    let value = |x: &DVec2| height + along.dot(*x);
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
