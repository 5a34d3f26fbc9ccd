//! Light of a luminaire scattered along a view ray by the thesis' steps.

use glam::DVec3;
use light::bands::BANDS;

use super::{Light, Scattering, ViewRay};
use crate::path::Way;

/// Steps each way from where they begin are no more than this: on longer ways they are longer. The thesis has no bound.
pub const MOST_STEPS: usize = 100_000;

/// How the thesis steps along a view ray (3.33 to 3.35).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// Longest step \[m\].
    pub longest: f64,
    /// Shortest step \[m\].
    pub shortest: f64,
    /// Scattered luminance per metre at which the longest step is taken, I_ref \[cd m⁻³\]; a step is as much shorter as there is more.
    pub reference: f64,
    /// Scattered luminance per metre below which stepping ends, I_ε \[cd m⁻³\].
    pub negligible: f64,
}

/// What stepping along a view ray found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stepped {
    /// Scattered radiance at P per band \[W m⁻² sr⁻¹ nm⁻¹\], in f64 as thousands of steps are added.
    pub radiance: [f64; BANDS],
    /// How many points it looked at.
    pub evaluations: usize,
}

impl Scattering {
    /// Radiance at P of a luminaire's light scattered along `ray` (finite), by the thesis' steps: trapezoids between
    ///
    ///   S_(i+1) = S_i + min(longest, max(longest · I_ref/I_S, shortest)) u
    ///
    /// from the point nearest to the luminaire's `axis` both ways (from the surface down for one in air), until light gets less with every
    /// step and is negligible, or [`MOST_STEPS`] are taken. There is no bound on the error; [`Scattering::lamp`] has one.
    pub fn lamp_by_steps(
        &self,
        at: DVec3,
        axis: DVec3,
        light: &Light,
        ray: &ViewRay,
        steps: &Steps,
    ) -> Stepped {
        let below = self.surface.is_below(at);
        let ways: &[Way] = if below { &[Way::Direct, Way::Mirrored] } else { &[Way::Refracted] };
        ways.iter().fold(Stepped::default(), |sum, &way| {
            let part = self.steps_by_way(way, (at, axis), light, ray, steps);
            Stepped {
                radiance: std::array::from_fn(|b| sum.radiance[b] + part.radiance[b]),
                evaluations: sum.evaluations + part.evaluations,
            }
        })
    }

    /// The same of the light that comes by one way only, of a luminaire `at` a point with an axis (0: none, and the walk starts nearest
    /// to the luminaire itself).
    pub fn steps_by_way(
        &self,
        way: Way,
        (at, axis): (DVec3, DVec3),
        light: &Light,
        ray: &ViewRay,
        steps: &Steps,
    ) -> Stepped {
        let start = if way == Way::Refracted { 0.0 } else { nearest_to_axis(at, axis, ray) };
        let mut sum = Stepped::default();
        for (sign, room) in [(1.0, ray.length - start), (-1.0, start)] {
            self.walk(way, at, light, ray, steps, [start, sign, room], &mut sum);
        }
        sum
    }

    #[expect(clippy::too_many_arguments, reason = "a private loop body of one caller")]
    fn walk(
        &self,
        way: Way,
        at: DVec3,
        light: &Light,
        ray: &ViewRay,
        steps: &Steps,
        [start, sign, room]: [f64; 3],
        sum: &mut Stepped,
    ) {
        if room <= 0.0 {
            return;
        }
        let look = |walked: f64| self.per_metre(way, at, light, ray, start + sign * walked);
        // One less, for the last is cut off at the end of the way.
        let least = room / (MOST_STEPS - 1) as f64;
        let (mut walked, mut here, mut step) = (0.0, look(0.0), steps.longest);
        sum.evaluations += 1;
        while walked < room {
            let bright = f64::from(here.luminance());
            // In shadow the last step is kept.
            if bright > 0.0 {
                step = (steps.longest * steps.reference / bright).max(steps.shortest).min(steps.longest);
            }
            let next = (walked + step.max(least)).min(room);
            // A step too short for f64, or none at all, would never end.
            if next <= walked || next.is_nan() {
                break;
            }
            let there = look(next);
            sum.evaluations += 1;
            for (sum, pair) in sum.radiance.iter_mut().zip((here + there).0) {
                *sum += f64::from(pair) * 0.5 * (next - walked);
            }
            let leaving = (ray.at(start + sign * next) - at).dot(ray.direction) * sign >= 0.0;
            // A shadow may end again.
            let faint = !there.is_zero() && f64::from(there.luminance()) <= steps.negligible;
            if faint && (leaving || way == Way::Refracted) {
                break;
            }
            (walked, here) = (next, there);
        }
    }
}

/// Distance along the ray of its point nearest to the line through `at` along `axis`.
fn nearest_to_axis(at: DVec3, axis: DVec3, ray: &ViewRay) -> f64 {
    let axis = axis.normalize_or_zero();
    let across = ray.direction - axis * ray.direction.dot(axis);
    let way = at - ray.from;
    let way = way - axis * way.dot(axis);
    let length2 = across.length_squared();
    let nearest =
        if length2 > 1e-18 { way.dot(across) / length2 } else { (at - ray.from).dot(ray.direction) };
    nearest.clamp(0.0, ray.length)
}
