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

    /// The stretch of the segment that a convex polyhedron within `bounds` may keep in the dark.
    pub(crate) fn shadow(&self, planes: &[Plane], bounds: &Bounds) -> Option<(f64, f64)> {
        let reach = bounds.low.abs().max(bounds.high.abs()).max_element();
        let size = self.a.abs().max(self.b.abs()).max_element().max(reach);
        // Everything here rounds far below this; a shadow larger by it costs nothing.
        let pad = 1e-12 * size;
        let (corner, u, v, mut polygon) = match self.source {
            PointSource::At(p) => (p, self.a - p, self.b - p, vec![DVec2::ZERO, DVec2::X, DVec2::Y]),
            PointSource::Toward(way) => {
                // Farther than the polyhedron from any point of the segment.
                let far = 4.0 * size;
                let way = way * far;
                (self.a, way, self.b - self.a, vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y])
            }
        };
        let lamp = if let PointSource::At(p) = self.source { p.abs().max_element() } else { 0.0 };
        let pad = pad.max(1e-12 * lamp);
        for plane in planes {
            let (height, along) = (
                plane.normal.dot(corner) - plane.offset - pad,
                DVec2::new(plane.normal.dot(u), plane.normal.dot(v)),
            );
            clip(&mut polygon, height, along);
            if polygon.is_empty() {
                return None;
            }
        }
        let place = |at: &DVec2| match self.source {
            PointSource::Toward(_) => Some(at.y),
            PointSource::At(_) => {
                let sum = at.element_sum();
                (sum > 1e-12).then_some(at.y / sum)
            }
        };
        let mut stretch = (f64::INFINITY, f64::NEG_INFINITY);
        for corner in &polygon {
            // The lamp itself is in the polyhedron.
            let Some(s) = place(corner) else { return Some((0.0, 1.0)) };
            stretch = (stretch.0.min(s), stretch.1.max(s));
        }
        let (from, to) = ((stretch.0 - 1e-12).max(0.0), (stretch.1 + 1e-12).min(1.0));
        (from < to).then_some((from, to))
    }
}

/// Keeps the part of a convex polygon with height + along · x ≤ 0 (Sutherland and Hodgman 1974).
fn clip(polygon: &mut Vec<DVec2>, height: f64, along: DVec2) {
    let value = |x: &DVec2| height + along.dot(*x);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
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
    *polygon = kept;
}
