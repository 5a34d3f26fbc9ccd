//! Slopes of Trowbridge and Reitz (GGX) with Smith's height-correlated shadowing (Walter et al. 2007, Heitz 2014 and 2018).

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// The least width α of rough facets: the material's own definition; what is smoother turns into a mirror.
pub(crate) const LEAST_WIDTH: f64 = 0.0047;

/// D \[1/sr\] at the cosine of a facet's normal.
pub(crate) fn density(cos: f64, width: f64) -> f64 {
    let spread = 1.0 - cos * cos * (1.0 - width * width);
    if cos > 0.0 { width * width / (PI * spread * spread) } else { 0.0 }
}

fn slope(cos: f64, width: f64) -> f64 {
    (width * width + (1.0 - width * width) * cos * cos).sqrt()
}

/// G/(4 cos_i cos_o).
pub(crate) fn masking(cos: f64, cos_out: f64, width: f64) -> f64 {
    0.5 / (cos * slope(cos_out, width) + cos_out * slope(cos, width))
}

/// Density \[1/sr\] of facets as seen from a direction: D G₁ (o·h)/cos_o, G₁ = 2 cos_o/(cos_o + slope).
pub(crate) fn seen(cos_half: f64, cos_facet: f64, cos_out: f64, width: f64) -> f64 {
    density(cos_half, width) * 2.0 * cos_facet / (cos_out + slope(cos_out, width))
}

/// The normal of a facet as seen along `out` (Heitz 2018).
pub(crate) fn draw(out: DVec3, normal: DVec3, width: f64, [u, v]: [f64; 2]) -> DVec3 {
    let (x, y) = normal.any_orthonormal_pair();
    let local = DVec3::new(out.dot(x) * width, out.dot(y) * width, out.dot(normal).max(1e-9)).normalize();
    let across = local.truncate().length();
    let first = if across > 0.0 { DVec3::new(-local.y, local.x, 0.0) / across } else { DVec3::X };
    let second = local.cross(first);
    let (sin, cos) = (TAU * v).sin_cos();
    let (a, s) = (u.sqrt() * cos, 0.5 * (1.0 + local.z));
    let b = (1.0 - s) * (1.0 - a * a).max(0.0).sqrt() + s * u.sqrt() * sin;
    let half = first * a + second * b + local * (1.0 - a * a - b * b).max(0.0).sqrt();
    let half = DVec3::new(half.x * width, half.y * width, half.z.max(0.0)).normalize_or(DVec3::Z);
    (x * half.x + y * half.y + normal * half.z).normalize()
}
