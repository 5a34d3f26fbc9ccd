//! A luminous sphere: its part above a horizon in closed form, and points on it.

use glam::{DVec3, Vec3};

use crate::sampling::{disc, lattice};

/// ∫ ω dω over the part of the sphere above the plane through the origin with `normal` \[sr\]; zero inside it.
///
/// With c the direction of its centre, σ its angular radius, θ the angle between c and the normal n: π sin²σ c
/// while all of it is above the horizon. Else Stokes turns it into ½ ∮ ω × dω along the border, an arc of the
/// cap (half angle α, cos α = −cot σ cot θ) and one of the horizon (half angle φ, tan φ = sin θ sin α tan σ):
///
///   sin²σ α c − sin σ cos σ sin α a + φ n,   a = (n − c cos θ) / sin θ.
pub(super) fn vector(to_centre: DVec3, radius: f64, normal: DVec3) -> DVec3 {
    let distance = to_centre.length();
    if radius.is_nan() || radius <= 0.0 || distance <= radius {
        return DVec3::ZERO;
    }
    let centre = to_centre / distance;
    let sin = radius / distance;
    let cos = ((1.0 - sin) * (1.0 + sin)).sqrt();
    let (cos_theta, sin_theta) = (centre.dot(normal), centre.cross(normal).length());
    if cos_theta >= sin {
        return centre * (std::f64::consts::PI * sin * sin);
    }
    if cos_theta <= -sin || sin_theta <= 0.0 {
        return DVec3::ZERO;
    }
    let cos_alpha = (-cos * cos_theta / (sin * sin_theta)).clamp(-1.0, 1.0);
    let sin_alpha = ((1.0 - cos_alpha) * (1.0 + cos_alpha)).sqrt();
    let phi = (sin_theta * sin_alpha * sin).atan2(cos);
    let up = (normal - centre * cos_theta) / sin_theta;
    centre * (sin * sin * cos_alpha.acos()) - up * (sin * cos * sin_alpha) + normal * phi
}

/// A point of the sphere's near side and what it contributes up to a common factor.
///
/// Points are even over the disc that the sphere shows (density cos ψ, ψ from the centre's direction), so each counts
/// for cos θ / cos ψ.
pub(super) fn sample(
    to_centre: Vec3,
    radius: f32,
    normal: Vec3,
    (i, count, shift): (u32, u32, [u32; 2]),
) -> (Vec3, f32) {
    let distance = to_centre.length();
    let Some(centre) = to_centre.try_normalize() else { return (to_centre, 0.0) };
    let [x, y] = if count == 1 { [0.0; 2] } else { disc(lattice(i, count, shift)) };
    let sin = (radius / distance).min(1.0);
    let (across, along) = centre.any_orthonormal_pair();
    let (x, y) = (x * sin, y * sin);
    // At the rim of a sphere that is touched the cosine ends; the floor keeps its reciprocal a number.
    let cos = (1.0 - x * x - y * y).max(1e-12).sqrt();
    let toward = (across * x + along * y + centre * cos).normalize();
    (front(to_centre, radius, toward), toward.dot(normal).max(0.0) / cos)
}

/// The point at which the line along the unit vector `toward` first meets the sphere, in f64: the near root is a difference.
pub(super) fn front(to_centre: Vec3, radius: f32, toward: Vec3) -> Vec3 {
    let (centre, toward) = (to_centre.as_dvec3(), toward.as_dvec3());
    let middle = centre.dot(toward);
    let off = centre - toward * middle;
    let radius = f64::from(radius);
    let half_chord = (radius * radius - off.length_squared()).max(0.0).sqrt();
    (toward * (middle - half_chord).max(0.0)).as_vec3()
}
