//! The plane of a fan, with coordinates.

use glam::{DVec2, DVec3};

use super::{boxes::Bounds, fan::Fan};

/// Share of a body's size within which points are taken for the same when places are sought.
pub(crate) const NEAR: f64 = 1e-6;

/// The plane of a fan with coordinates in which a body is within ±1.
pub(crate) struct Sheet {
    pub(crate) origin: DVec3,
    /// Its axes, as long as the body is large.
    pub(crate) x: DVec3,
    pub(crate) y: DVec3,
    /// The segment's start and way.
    start: DVec2,
    way: DVec2,
    /// The lamp, or the direction towards the sun.
    lamp: Option<DVec2>,
    sun: DVec2,
}

impl Sheet {
    /// None for a fan that is a mere line.
    pub(crate) fn new(fan: &Fan, bounds: &Bounds) -> Option<Self> {
        let (normal, _) = fan.plane()?;
        let centre = (bounds.low + bounds.high) * 0.5;
        let origin = centre - normal * normal.dot(centre - fan.a);
        let size = 0.5 * (bounds.high - bounds.low).length();
        let x = (fan.b - fan.a).normalize();
        let y = normal.cross(x);
        let flat = |v: DVec3| DVec2::new(v.dot(x), v.dot(y)) / size;
        let (lamp, sun) = match fan.lamp() {
            Some(lamp) => (Some(flat(lamp - origin)), DVec2::ZERO),
            None => (None, flat(fan.sun())),
        };
        let (start, way) = (flat(fan.a - origin), flat(fan.b - fan.a));
        Some(Self { origin, x: x * size, y: y * size, start, way, lamp, sun })
    }

    /// The point in the world.
    pub(crate) fn point(&self, at: DVec2) -> DVec3 {
        self.origin + self.x * at.x + self.y * at.y
    }

    /// The square around what the plane cuts out of a box.
    pub(crate) fn square(&self, bounds: &Bounds) -> Square {
        let size = self.x.length();
        let from = ((bounds.low + bounds.high) * 0.5 - self.origin) / size;
        // The foot of the box's centre is no farther from any of its points in the plane than the centre itself.
        let half = 0.5 * (bounds.high - bounds.low).length() / size + NEAR;
        Square { centre: DVec2::new(from.dot(self.x), from.dot(self.y)) / size, half }
    }

    /// At which share of the segment a point between it and the source lies behind.
    ///
    /// From a lamp p: x − p = λ (a − p + s (b − a)); towards a sun w: x − a = s (b − a) + α w.
    pub(crate) fn share(&self, point: DVec2) -> Option<f64> {
        let Some(lamp) = self.lamp else {
            let (from, across) = (point - self.start, self.way.perp_dot(self.sun));
            let beyond = from.perp_dot(self.way) / -across;
            return (beyond * self.sun.length() > -NEAR).then(|| from.perp_dot(self.sun) / across);
        };
        let (from, first) = (point - lamp, self.start - lamp);
        let across = from.perp_dot(self.way);
        let part = across / first.perp_dot(self.way);
        (part > 0.0 && part < 1.0 + NEAR).then(|| -from.perp_dot(first) / across)
    }
}

/// A part of a [`Sheet`] with coordinates of its own, in which it is within ±1: what is small in a body is as exact
/// there as what is large.
pub(crate) struct Square {
    centre: DVec2,
    half: f64,
}

impl Square {
    /// A point in the coordinates of the sheet.
    pub(crate) fn on_sheet(&self, at: DVec2) -> DVec2 {
        self.centre + at * self.half
    }

    /// Its centre and axes in the world.
    pub(crate) fn frame(&self, sheet: &Sheet) -> [DVec3; 3] {
        [sheet.point(self.centre), sheet.x * self.half, sheet.y * self.half]
    }
}
