//! What scattering once leaves out, as a factor.
//!
//! In deep water whose losses are K = a + b_b, light scattered once makes only a part of the radiance that comes back: 0.97 of it at
//! ω0 = 0.2, 0.6 (particles) or 0.5 (molecules) at ω0 = 0.9. The rest has lost its direction, so that it is added evenly:
//!
//!   L/L₁ = 1 + N(ω0, B) B/(2π p(Θ)),   N = Σ q^i (n_i0 + n_i1 √B + n_i2 B),  q = 1 − √(1 − ω0),  B = b_b/b
//!
//! N was fitted to 700 radiances of the example `multiple_scattering` (60 000 photons each): B from 0.018 to 0.5, ω0 from 0.2 to
//! 0.98, the sun at 0 to 80° in air, view rays at 0 to 45° under water. They are met within 6 % (root mean square; 25 % at worst:
//! particles, low sun, view towards it), where L₁ alone misses by 37 % and up to three quarters. Angles of sun and view in N would improve that by
//! less than half a percent.
//!
//! Light is scattered again only where there is room for it: over a bottom z deep N counts (1 − e^(−0.7 c z)) times ([`room`]). Over a
//! black bottom (`--bottom` of the same example, ω0 = 0.9, sun at 60°, straight down, c z from 0.25 to 8) that meets the photons within
//! 11 %, where L₁ alone is 0.5 to 0.93 of them and the factor of deep water up to 1.63 of them.
//!
//! **Where it is wrong.** Just under the surface is where it holds. Deeper down the loss itself is off: K = a + b_b is too much
//! for molecules (at ω0 = 0.9 and ten optical depths radiance is 0.15 of the truth), too little for particles (1.7 of it).

use std::f64::consts::TAU;

use light::Spectrum;

use crate::Water;

/// n_ij: a row for each power of q from 1.
const FITTED: [[f64; 3]; 3] = [[0.33, 2.36, -2.17], [-0.49, -15.8, 18.04], [2.07, 16.1, -15.26]];

/// Backscattered shares that the fit saw; others count as the nearest.
const BACKSCATTERED: [f64; 2] = [0.018, 0.5];

/// Radiance of light scattered any number of times over that of light scattered once with the loss K = a + b_b, just under the
/// surface of deep water: ≥ 1.
///
/// `albedo` is ω0, `backscattered` B = b_b/b, `phase` p(Θ) \[1/sr\] at the angle between sun and view.
///
/// ```
/// use keikan_water::{Phase, multiple};
/// let p = Phase::petzold();
/// let nadir = p.value(-0.7631); // sun at 60° in air
/// // Photons: 0.596 of the light is scattered once.
/// assert!((multiple::factor(0.9, p.backscattered(), nadir) * 0.596 - 1.0).abs() < 0.06);
/// ```
pub fn factor(albedo: f64, backscattered: f64, phase: f64) -> f64 {
    if phase > 0.0 { 1.0 + even(albedo, backscattered) / phase } else { 1.0 }
}

/// N B/2π \[1/sr\]: what is added to p(Θ), the same for all Θ.
fn even(albedo: f64, backscattered: f64) -> f64 {
    let q = 1.0 - (1.0 - albedo.clamp(0.0, 1.0)).sqrt();
    let share = backscattered.clamp(BACKSCATTERED[0], BACKSCATTERED[1]);
    let [first, second, third] = FITTED.map(|[n0, n1, n2]| n0 + n1 * share.sqrt() + n2 * share);
    let n = q * (first + q * (second + q * third));
    n.max(0.0) * backscattered.max(0.0) / TAU
}

/// How often light is scattered per optical depth of water, as far as more than once is concerned: between what molecules need (1.3 at
/// c z = 0.25 to 0.8 at 4) and particles (0.4 to 0.8).
const AGAIN: f64 = 0.7;

/// The share of N that light scattered more than once has over a bottom `depth` \[m\] below the surface, of water of `extinction` c \[1/m\].
///
/// ```
/// use keikan_water::{Phase, multiple};
/// let (p, c_z) = (Phase::petzold(), 1.0);
/// let nadir = p.value(-0.7631); // sun at 60° in air
/// let factor = 1.0 + (multiple::factor(0.9, p.backscattered(), nadir) - 1.0) * multiple::room(1.0, c_z);
/// // Photons over a black bottom: 0.80 of the light is scattered once.
/// assert!((factor * 0.798 - 1.0).abs() < 0.11);
/// ```
pub fn room(extinction: f64, depth: f64) -> f64 {
    let scattered = AGAIN * extinction * depth;
    // Endless depth of what loses nothing gives no number.
    if scattered > 0.0 { -(-scattered).exp_m1() } else { 0.0 }
}

/// What is added to β(Θ) per band \[1/(m sr)\].
pub(super) fn evenly(water: &Water) -> Spectrum {
    let (albedo, all, back) = (water.albedo(), water.scattering(), water.backscattering());
    Spectrum(std::array::from_fn(|b| {
        let [albedo, all, back] = [albedo[b], all[b], back[b]].map(f64::from);
        if all > 0.0 { (all * even(albedo, back / all)) as f32 } else { 0.0 }
    }))
}
