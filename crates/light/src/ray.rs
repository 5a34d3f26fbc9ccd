//! A ray, or a segment when its length is finite.

use glam::Vec3;

/// A half-line, or a segment when `length` is finite.
///
/// Both ends are *excluded*: whoever makes a ray that leaves a surface has moved `origin` off that
/// surface by the hit's own error ([`crate::Place::leave`]) and shortened `length` likewise, so that no
/// receiver of rays needs an epsilon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts \[m\].
    pub origin: Vec3,
    /// Where it goes: a unit vector.
    pub direction: Vec3,
    /// How far it goes \[m\]; infinite for sun, sky and the eye.
    pub length: f32,
}

impl Ray {
    /// An endless ray. `direction` must be a unit vector.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, length: f32::INFINITY }
    }

    /// The segment from `from` to `to`; of length 0 and direction +Y when both coincide.
    pub fn between(from: Vec3, to: Vec3) -> Self {
        let way = to - from;
        let length = way.length();
        Self { origin: from, direction: way.try_normalize().unwrap_or(Vec3::Y), length }
    }

    /// The point at distance `t` \[m\].
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}
