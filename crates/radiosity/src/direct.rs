//! Primary light on patches.

use glam::DVec3;
use light::{Arrival, Illuminate, Occlude, Spectrum};
use rayon::prelude::*;

use crate::Patches;
use crate::patch::{Patch, place, reach};
use crate::triangle::{self, Corners};

/// By patch, irradiance by primary light \[W m⁻² nm⁻¹\]: the mean of three points, each of them a place with a seed of its own.
///
/// Where they differ, and it matters among all patches, the patch is halved, up to `halvings` times, as a lamp near a wall, a shadow's edge or
/// gathered light needs it. A light that three points have all missed stays missed.
pub fn direct(
    patches: &Patches,
    lights: &[&dyn Illuminate],
    occlude: &dyn Occlude,
    halvings: u32,
) -> Vec<Spectrum> {
    let all = |of: &(dyn Fn(usize) -> Spectrum + Sync)| -> Vec<Spectrum> {
        (0..patches.len()).into_par_iter().map(of).collect()
    };
    let mean = |index: usize, halvings: u32, least: f64| {
        let patch = patches.patch(index);
        let lit = Lit { lights, occlude, patch, normal: patch.normal(), reach: reach(&patch.corners), least };
        lit.mean(&patch.corners, light::sampling::scramble(index as u32), halvings)
    };
    let first = all(&|index| mean(index, 0, 0.0));
    if halvings == 0 {
        return first;
    }
    let flux = |(index, mean): (usize, &Spectrum)| f64::from(mean.mean()) * patches.node(index).area;
    let total: f64 = first.iter().enumerate().map(flux).sum();
    let least = SLIGHT * total / patches.len().max(1) as f64;
    all(&|index| mean(index, halvings, least))
}

/// Differences of flux within a piece that do not matter, over the mean flux of a patch.
const SLIGHT: f64 = 0.01;

/// Differences within a piece that are left as they are, over its mean. On each side of it errors cancel; three points take
/// those of the second order.
const EVEN: f32 = 0.5;

/// A patch and what lights it.
struct Lit<'a> {
    lights: &'a [&'a dyn Illuminate],
    occlude: &'a dyn Occlude,
    patch: Patch,
    normal: DVec3,
    reach: f64,
    /// Differences of flux within a piece that do not matter.
    least: f64,
}

impl Lit<'_> {
    /// Over a piece of the patch, with so many halvings left.
    fn mean(&self, piece: &Corners, seed: u32, left: u32) -> Spectrum {
        let points = triangle::three_points(piece);
        let at = [0, 1, 2].map(|k| self.irradiance(points[k as usize], seed.wrapping_mul(3).wrapping_add(k)));
        let mean = (at[0] + at[1] + at[2]) * (1.0 / 3.0);
        let values = at.map(Spectrum::mean);
        let [least, most] = [
            values.iter().copied().fold(f32::INFINITY, f32::min),
            values.iter().copied().fold(0.0, f32::max),
        ];
        let area = 0.5 * triangle::cross(piece).length();
        let slight = f64::from(most - least) * area <= self.least;
        if left == 0 || slight || most - least <= EVEN * mean.mean() {
            return mean;
        }
        let halves = triangle::halves(piece, triangle::apex(piece));
        let [first, second] = [0, 1].map(|k| {
            let seed = light::sampling::scramble(seed.wrapping_mul(2).wrapping_add(k));
            self.mean(&halves[k as usize], seed, left - 1)
        });
        (first + second) * 0.5
    }

    fn irradiance(&self, at: DVec3, seed: u32) -> Spectrum {
        let place = place(at, self.normal, self.reach, light::sampling::scramble(seed));
        let mut sum = Spectrum::ZERO;
        for light in self.lights {
            let receive = &mut |arrival: Arrival| sum += arrival.on_plane(place.normal);
            light.arrivals_on(self.patch.face, &place, self.occlude, receive);
        }
        sum
    }
}
