//! A flat interface between two media: Fresnel and Snell.

use glam::DVec3;

/// Share of unpolarised light that a flat interface reflects (thesis eq. 3.3).
///
/// `eta` = n2/n1 > 0, `cos_in` in \[0, 1\] on the side the light comes from; 1 beyond the critical angle.
/// In place of tan and sin of sums and differences, which are 0/0 head on:
///
///   g² = η² − 1 + cos²,   r_s = (cos − g)/(cos + g),   r_p = (η² cos − g)/(η² cos + g),   α = ½ (r_s² + r_p²)
///
/// ```
/// use keikan_light::fresnel;
/// assert!((fresnel(1.5, 1.0) - 0.04).abs() < 1e-15); // ((η−1)/(η+1))² head on, to rounding
/// assert_eq!(fresnel(1.33, 0.0), 1.0); // grazing
/// assert_eq!(fresnel(1.0 / 1.33, 0.5), 1.0); // total reflection beyond 48.75°
/// ```
pub fn fresnel(eta: f64, cos_in: f64) -> f64 {
    let [s, p] = fresnel_polarised(eta, cos_in);
    0.5 * (s + p)
}

/// The same for light polarised across (r_s²) and along (r_p²) the plane of incidence.
pub fn fresnel_polarised(eta: f64, cos_in: f64) -> [f64; 2] {
    let cos = cos_in.clamp(0.0, 1.0);
    // (η − 1)(η + 1) keeps its digits where η is near 1.
    let g2 = (eta - 1.0) * (eta + 1.0) + cos * cos;
    if g2 <= 0.0 {
        // At η = 1 and exactly grazing there is no interface at all.
        return [if eta == 1.0 { 0.0 } else { 1.0 }; 2];
    }
    let g = g2.sqrt();
    let s = (cos - g) / (cos + g);
    let p = (eta * eta * cos - g) / (eta * eta * cos + g);
    [s * s, p * p]
}

/// Direction of refracted light (Snell); none beyond the critical angle.
///
/// `direction` goes towards the interface, `normal` is on the side it comes from, both unit vectors;
/// `eta` = n2/n1. The answer is a unit vector that leaves the interface on the other side.
pub fn refract(direction: DVec3, normal: DVec3, eta: f64) -> Option<DVec3> {
    let cos_in = (-direction.dot(normal)).clamp(0.0, 1.0);
    let g2 = (eta - 1.0) * (eta + 1.0) + cos_in * cos_in;
    if g2 < 0.0 {
        return None;
    }
    let tangential = (direction + normal * cos_in) / eta;
    Some((tangential - normal * (g2.sqrt() / eta)).normalize())
}

/// Mirror direction of `direction` (towards the surface) at unit `normal`.
pub fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - normal * (2.0 * direction.dot(normal))
}
