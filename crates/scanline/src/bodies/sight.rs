//! Which body shows at a point of a line, if any?

use glam::{DVec2, DVec3};
use light::{Bodies, Projection};

use super::hulls::Interval;
use crate::Scanline;
use crate::segment::Segment;

/// A body that shows at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shown {
    pub(crate) body: u32,
    pub(crate) nearness: f64,
}

/// Asks bodies, and counts how often.
pub(crate) struct Sight<'a> {
    pub(crate) scanline: &'a Scanline,
    pub(crate) bodies: &'a dyn Bodies,
    pub(crate) rays: u64,
    /// First pixel of those in `asked`, in the wide picture.
    pub(crate) first: u32,
    /// For which pixels a ray was needed.
    pub(crate) asked: Vec<bool>,
}

/// A line, with what is in it.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    /// Where to look.
    pub(crate) y: f64,
    /// Bodies that may be there.
    pub(crate) intervals: &'a [Interval],
    /// The opaque faces at `faces_y`.
    pub(crate) opaque: &'a [Segment],
    pub(crate) faces_y: f64,
}

impl Sight<'_> {
    /// Line through a point of the wide picture, distance of the near plane, and cosine to the line of sight.
    fn line(&self, x: f64, y: f64) -> ((DVec3, DVec3), f64, f64) {
        let view = &self.scanline.view;
        let line = view.line(DVec2::new(x, y));
        let cosine = -line.1.dot(view.world_from_view.z_axis);
        (line, view.near / cosine, cosine)
    }

    /// Where the line through a point meets a body, and how near that is.
    pub(crate) fn meet(&mut self, body: u32, x: f64, y: f64) -> Option<(f64, f64)> {
        self.rays += 1;
        let pixel = (x.max(0.0) as usize).saturating_sub(self.first as usize);
        if let Some(asked) = self.asked.get_mut(pixel) {
            *asked = true;
        }
        let (line, near, cosine) = self.line(x, y);
        let distance = self.bodies.meet(body, line, near)?;
        let depth = distance * cosine;
        let nearness = match self.scanline.view.projection {
            Projection::Perspective { .. } => 1.0 / depth,
            Projection::Orthographic { .. } => -depth,
        };
        Some((distance, nearness))
    }

    /// The nearest body at `x`, if it is before all opaque faces. A body in the same place as a face, as far as
    /// f64 can tell, shows; of two bodies the first.
    pub(crate) fn shown(&mut self, x: f64, scene: &Scene) -> Option<Shown> {
        let behind = scene.opaque.partition_point(|span| span.x1 <= x);
        let behind = scene.opaque.get(behind).filter(|span| span.x0 <= x);
        let mut least =
            behind.map_or(f64::NEG_INFINITY, |span| self.face(span, x, scene) - f64::from(span.error));
        let mut found = None;
        for interval in scene.intervals {
            if x < interval.x[0] || x > interval.x[1] || interval.nearness < least {
                continue;
            }
            if let Some((_, nearness)) = self.meet(interval.body, x, scene.y)
                && nearness >= least
                && found.is_none_or(|so_far: Shown| nearness > so_far.nearness)
            {
                found = Some(Shown { body: interval.body, nearness });
                least = nearness;
            }
        }
        found
    }

    /// Nearness of the plane of a face.
    fn face(&self, span: &Segment, x: f64, scene: &Scene) -> f64 {
        if scene.y == scene.faces_y {
            return span.nearness(x);
        }
        let (instance, triangle) = self.scanline.face(span.face);
        let corners = self.scanline.geometry.triangle(instance, triangle);
        let ((origin, direction), _, cosine) = self.line(x, scene.y);
        let normal = corners.cross();
        let depth = normal.dot(corners.0[0] - origin) / normal.dot(direction) * cosine;
        let nearness = match self.scanline.view.projection {
            Projection::Perspective { .. } => 1.0 / depth,
            Projection::Orthographic { .. } => -depth,
        };
        if nearness.is_finite() { nearness } else { span.nearness(x) }
    }
}
