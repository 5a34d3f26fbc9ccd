//! Bounds on rounding errors, in the manner of Higham's γₙ (as pbrt uses it).

/// Unit round-off of f32: half the distance from 1 to its successor.
pub const UNIT: f32 = f32::EPSILON * 0.5;

/// γₙ = n u / (1 − n u): bound on the relative error of `n` successive f32 operations.
pub fn gamma(n: u32) -> f32 {
    let nu = n as f32 * UNIT;
    nu / (1.0 - nu)
}
