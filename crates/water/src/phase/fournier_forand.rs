//! Fournier and Forand's phase function.

use std::f64::consts::PI;

use super::PEAK;

/// p at s = sin²(θ/2) for spheres of relative index n whose diameters d are distributed as d^−μ (Fournier and Jonasz 1999):
///
///   δ = 4 s / (3 (n − 1)²),   ν = (3 − μ)/2,
///   p = { ν (1 − δ) − (1 − δ^ν) + \[δ (1 − δ^ν) − ν (1 − δ)\]/s } / (4π (1 − δ)² δ^ν)
///       + (1 − δ₁₈₀^ν) (3 cos² θ − 1) / (16π (δ₁₈₀ − 1) δ₁₈₀^ν)
pub(super) fn at(index: f64, slope: f64, s: f64) -> f64 {
    let s = s.max((0.5 * PEAK).sin().powi(2));
    let nu = 0.5 * (3.0 - slope);
    let delta_of = |s: f64| 4.0 * s / (3.0 * (index - 1.0) * (index - 1.0));
    let (delta, back) = (delta_of(s), delta_of(1.0));
    let (power, back_power) = (delta.powf(nu), back.powf(nu));
    let from_one = 1.0 - delta;
    let lobe = if from_one.abs() < 1e-4 {
        // Both brackets begin with (1 − δ)²: two terms of their series, next to which 1e-8 is left out.
        let (second, third) = (0.5 * nu * (nu - 1.0), nu * (nu - 1.0) * (nu - 2.0) / 6.0);
        second - third * from_one + ((second + third) * from_one - (nu + second)) / s
    } else {
        let first = nu * from_one - (1.0 - power);
        (first + (delta * (1.0 - power) - nu * from_one) / s) / (from_one * from_one)
    };
    let cos = 1.0 - 2.0 * s;
    let tail = (1.0 - back_power) / (16.0 * PI * (back - 1.0) * back_power) * (3.0 * cos * cos - 1.0);
    (lobe / (4.0 * PI * power) + tail).max(0.0)
}

/// Backscattered share in closed form (Mobley, Sundman and Boss 2002): the check on the quadrature.
#[cfg(test)]
pub(super) fn backscattered(index: f64, slope: f64) -> f64 {
    let nu = 0.5 * (3.0 - slope);
    let delta = 4.0 / (3.0 * (index - 1.0) * (index - 1.0)) * 0.5;
    let power = delta.powf(nu);
    1.0 - (1.0 - delta * power - 0.5 * (1.0 - power)) / ((1.0 - delta) * power)
}
