//! Where a camera goes.

use glam::DVec3;
use light::Projection;

use crate::Camera;
use crate::load::look_along;

/// A way through keys.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    /// At least one; times rise.
    keys: Vec<Key>,
    /// What is up in the picture, a unit vector.
    up: DVec3,
    /// On a curve, else straight from key to key.
    smooth: bool,
}

/// Where a camera is at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Key {
    /// \[s\].
    pub(crate) time: f64,
    /// World \[m\].
    pub(crate) position: DVec3,
    /// The point in the middle of the picture \[m\], another one than `position`.
    pub(crate) target: DVec3,
    /// tan of half the vertical field, or half the height of a parallel projection \[m\]; > 0.
    pub(crate) half: f64,
}

/// Two keys, the share of the way between them, and their neighbours (themselves at the ends).
struct Span<'k> {
    keys: [&'k Key; 4],
    share: f64,
}

impl CameraPath {
    /// `keys` in the order of their times, at least one.
    pub(crate) fn new(keys: Vec<Key>, up: DVec3, smooth: bool) -> Self {
        Self { keys, up, smooth }
    }

    /// When it begins and ends \[s\]; before and after, the camera stands still.
    pub fn seconds(&self) -> [f64; 2] {
        let at = |key: Option<&Key>| key.map_or(0.0, |key| key.time);
        [at(self.keys.first()), at(self.keys.last())]
    }

    pub(crate) fn shift(&mut self, by: DVec3) {
        for key in &mut self.keys {
            key.position += by;
            key.target += by;
        }
    }

    /// The keys about a time; none without keys.
    fn span(&self, seconds: f64) -> Option<Span<'_>> {
        let last = self.keys.len().checked_sub(1)?;
        // The first key whose time is later.
        let next = self.keys.partition_point(|key| key.time <= seconds).clamp(1, last.max(1)).min(last);
        let before = next.saturating_sub(1);
        let at = |i: usize| &self.keys[i.min(last)];
        let keys = [at(before.saturating_sub(1)), at(before), at(next), at(next + 1)];
        let length = keys[2].time - keys[1].time;
        let share = if length > 0.0 { ((seconds - keys[1].time) / length).clamp(0.0, 1.0) } else { 0.0 };
        Some(Span { keys, share: if share.is_nan() { 0.0 } else { share } })
    }
}

impl Span<'_> {
    /// A quantity of the keys between them.
    ///
    /// On a curve: the cubic Hermite polynomial of each stretch,
    ///
    /// ```text
    ///   p(s) = p₁ + s²(3 − 2s) (p₂ − p₁) + T [s(1 − s)² m₁ − s²(1 − s) m₂],   T = t₂ − t₁
    /// ```
    ///
    /// with the velocities m of [`velocity`]: it goes through the keys at their times, and its velocity
    /// has no jump.
    fn of(&self, smooth: bool, value: impl Fn(&Key) -> DVec3) -> DVec3 {
        let [p0, p1, p2, p3] = self.keys.map(&value);
        let s = self.share;
        if !smooth {
            return p1.lerp(p2, s);
        }
        let [t0, t1, t2, t3] = self.keys.map(|key| key.time);
        let m1 = velocity([t0, t1, t2], [p0, p1, p2]);
        let m2 = velocity([t1, t2, t3], [p1, p2, p3]);
        let r = 1.0 - s;
        p1 + (p2 - p1) * (s * s * (3.0 - 2.0 * s)) + (m1 * (s * r * r) - m2 * (s * s * r)) * (t2 - t1)
    }
}

/// Velocity at the middle one of three keys \[per s\]: that of the parabola through them (Catmull and Rom's curve with
/// the times as knots), without what of it goes back against the way that it came or that it goes, and at most three times
/// that of the slower side. So nothing swings beyond keys that lie on a line, and who waits between two keys stands
/// still (Fritsch and Carlson 1980: a stretch is monotone if both its ends are at most three times as steep as it is,
/// and level where it turns). Nothing at the ends: it starts and stops softly.
fn velocity([t0, t1, t2]: [f64; 3], [p0, p1, p2]: [DVec3; 3]) -> DVec3 {
    let (before, after) = (t1 - t0, t2 - t1);
    if !(before > 0.0 && after > 0.0) {
        return DVec3::ZERO;
    }
    let (came, goes) = ((p1 - p0) / before, (p2 - p1) / after);
    let parabola = (came * after + goes * before) / (before + after);
    let forward = |v: DVec3, way: DVec3| {
        let back = v.dot(way);
        if back < 0.0 { v - way * (back / way.length_squared()) } else { v }
    };
    let ahead = forward(forward(parabola, came), goes);
    // Where the way turns back sharply, what does not go against one side may still go against the other.
    if ahead.dot(came) < 0.0 {
        return DVec3::ZERO;
    }
    ahead.clamp_length_max(3.0 * came.length().min(goes.length()))
}

impl Camera {
    /// This camera at `seconds` on its path; itself if it has none. Before the first key and after the last it stands
    /// there.
    ///
    /// ```
    /// let scene = keikan_scene::parse("[[camera]]\ntarget = [0, 0, 0]\nease = 'linear'\n\
    ///     path = [{ time = 0, position = [0, 0, 9] }, { time = 2, position = [4, 0, 9] }]",
    ///     "".as_ref(), "a.toml".as_ref())?;
    /// assert_eq!(scene.cameras[0].at(1.0).position, glam::DVec3::new(2.0, 0.0, 9.0));
    /// # Ok::<(), keikan_scene::Error>(())
    /// ```
    pub fn at(&self, seconds: f64) -> Self {
        let Some((path, span)) = self.path.as_ref().and_then(|path| Some((path, path.span(seconds)?))) else {
            return self.clone();
        };
        let position = span.of(path.smooth, |key| key.position);
        let target = span.of(path.smooth, |key| key.target);
        // Where the way leads through its own target, the direction of the key before it is kept.
        let axis = [target - position, span.keys[1].target - span.keys[1].position]
            .into_iter()
            .find_map(DVec3::try_normalize);
        let half = span.of(path.smooth, |key| DVec3::splat(key.half)).x;
        Self {
            position,
            world_from_camera: axis.map_or(self.world_from_camera, |axis| look_along(axis, path.up)),
            projection: match self.projection {
                Projection::Perspective { .. } => Projection::Perspective { tan_half_height: half },
                Projection::Orthographic { .. } => Projection::Orthographic { half_height: half },
            },
            ..self.clone()
        }
    }

    /// Moves it and its path by so much \[m\].
    pub(crate) fn shift(&mut self, by: DVec3) {
        self.position += by;
        if let Some(path) = &mut self.path {
            path.shift(by);
        }
    }
}

#[cfg(test)]
mod tests;
