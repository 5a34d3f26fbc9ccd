//! The sky through Snell's window.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec3};
use light::sampling::{lattice, shift};
use light::{Occlude, Place, Spectrum, fresnel};

use super::FlatWater;
use super::shafts::{Parallel, Shaft, on_surface};
use crate::{Loss, ScatteredSky, Scattering, SkyBelow, SunBelow, ViewRay};

/// Sets of directions at least and at most; and directions in all of them, as far as the least number of sets allows (80 bytes each).
const SETS: [u32; 2] = [4, 32];
const LOOKS: u32 = 1 << 16;

/// What sets of directions are for, among those that share a seed.
const PURPOSE: u32 = 0x5E11;

/// One direction out of many that stand for the sky.
#[derive(Clone, Copy, Debug)]
struct Look {
    /// Towards it.
    light: Parallel,
    /// Irradiance just under the surface on a plane that faces it, n² T L ΔΩ′ \[W m⁻² nm⁻¹\].
    facing: Spectrum,
}

/// The sky through Snell's window, as surfaces under water receive it.
///
/// How much there is with nothing in the way a table knows ([`SkyBelow`]). The share of it that arrives is looked for in
/// directions spread evenly over the window, each weighed with what would arrive from it: where all is seen, or nothing, there is no
/// error. Where they do not stand still, the place's seed says which of some sets of directions those are: what it is asked again and again
/// then says how good they are.
pub(super) struct Window {
    table: SkyBelow,
    /// Sets of directions.
    looks: Vec<Vec<Look>>,
    coefficient: Spectrum,
}

impl Window {
    /// Of a sky of `radiance` by unit vector, looked for in `count` directions, `still` or not.
    pub(super) fn new(
        water: &FlatWater,
        (count, still): (u32, bool),
        radiance: impl Fn(Vec3) -> Spectrum,
    ) -> Self {
        let coefficient = water.water.loss(Loss::Diffuse);
        let table = SkyBelow::new(&water.surface, coefficient, &radiance);
        let sets = if still { 1 } else { (LOOKS / count.max(1)).clamp(SETS[0], SETS[1]) };
        let set = |i: u32| looks(water.surface.index, count, shift(i, PURPOSE), &radiance);
        Self { table, looks: (0..sets).map(set).collect(), coefficient }
    }

    /// Irradiance on the plane of `place`, `depth` metres deep \[W m⁻² nm⁻¹\].
    pub(super) fn irradiance(
        &self,
        water: &FlatWater,
        (place, depth): (&Place, f64),
        occlude: &dyn Occlude,
    ) -> Spectrum {
        let (mut all, mut seen) = (Spectrum::ZERO, Spectrum::ZERO);
        let foot = DVec2::new(f64::from(place.position.x), f64::from(place.position.z));
        let [set, _] = shift(place.seed, PURPOSE);
        for look in &self.looks[set as usize % self.looks.len()] {
            let below = look.light.below;
            let cosine = below.as_vec3().dot(place.normal);
            if cosine <= 0.0 {
                continue;
            }
            let own = look.facing * self.coefficient.attenuate((depth / below.y) as f32) * cosine;
            all += own;
            let at = foot + DVec2::new(below.x, below.z) * (depth / below.y);
            if !water.covers(at) {
                continue;
            }
            let surface = on_surface(DVec3::new(at.x, water.surface.level, at.y), place.seed);
            let near = occlude.transmittance(&place.toward(surface.position));
            if !near.is_zero() {
                let far = occlude.transmittance(&surface.leave(look.light.above.as_vec3(), f32::INFINITY));
                seen += own * near * far;
            }
        }
        self.table.irradiance(depth, place.normal) * share(seen, all)
    }
}

/// The sky's light that the water scatters towards the eye: how much with nothing in the way from a table ([`ScatteredSky`]), of which
/// the share arrives that comes by a few directions, each between its own shadows along the ray.
pub(super) struct Glow {
    table: ScatteredSky,
    looks: Vec<(Parallel, SunBelow)>,
}

impl Glow {
    /// Of a sky of `radiance` by unit vector, in `count` directions.
    pub(super) fn new(scattering: Scattering, count: u32, radiance: impl Fn(Vec3) -> Spectrum) -> Self {
        let sun = |look: Look| {
            let horizontal = look.facing * look.light.below.y as f32;
            (look.light, SunBelow { toward: look.light.below, horizontal })
        };
        let looks =
            looks(scattering.surface().index, count, [1 << 31, 0], &radiance).into_iter().map(sun).collect();
        Self { table: ScatteredSky::new(scattering, radiance), looks }
    }

    /// Radiance at the ray's origin \[W m⁻² sr⁻¹ nm⁻¹\].
    pub(super) fn radiance(&self, water: &FlatWater, ray: &ViewRay, occlude: &dyn Occlude) -> Spectrum {
        let scattering = self.table.scattering();
        let shafts: Vec<_> = self.looks.iter().map(|(light, _)| light.shafts(water, ray, occlude)).collect();
        let open = self.table.radiance(ray);
        if shafts.iter().all(|shafts| matches!(shafts[..], [shaft] if shaft.is_whole(ray))) {
            return open;
        }
        let (mut all, mut seen) = (Spectrum::ZERO, Spectrum::ZERO);
        for ((_, sun), shafts) in self.looks.iter().zip(&shafts) {
            let whole = scattering.sun(sun, ray, &[[0.0, ray.length]]);
            all += whole;
            seen += lit(scattering, sun, ray, (shafts, whole));
        }
        open * share(seen, all)
    }
}

/// Radiance of parallel light scattered along the stretches of `ray` that it reaches, `whole` if that is all of it.
pub(super) fn lit(
    scattering: &Scattering,
    sun: &SunBelow,
    ray: &ViewRay,
    (shafts, whole): (&[Shaft], Spectrum),
) -> Spectrum {
    match shafts {
        [shaft] if shaft.is_whole(ray) => whole,
        _ => shafts.iter().map(|s| scattering.sun(sun, ray, &[[s.from, s.to]]) * s.share).sum(),
    }
}

/// `count` directions spread evenly over the window, moved by `shift`, around the vertical and each within its own ring: what comes from each.
fn looks(n: f64, count: u32, shift: [u32; 2], radiance: impl Fn(Vec3) -> Spectrum) -> Vec<Look> {
    let window = 1.0 - (1.0 - 1.0 / (n * n)).sqrt();
    let each = TAU * window / f64::from(count);
    let look = |i: u32| {
        let [along, turn] = lattice(i, count, [shift[0] / count, shift[1]]);
        let up = 1.0 - f64::from(along) * window;
        let (s, c) = (f64::from(turn) * TAU).sin_cos();
        let level = (1.0 - up * up).max(0.0).sqrt();
        let sin = (level * n).min(1.0);
        let cos = (1.0 - sin * sin).sqrt();
        let light = Parallel {
            below: DVec3::new(level * c, up, level * s),
            above: DVec3::new(sin * c, cos, sin * s),
        };
        let share = n * n * (1.0 - fresnel(n, cos)) * each;
        Look { light, facing: radiance(light.above.as_vec3()) * share as f32 }
    };
    (0..count).map(look).collect()
}

/// Band by band; 1 where there is nothing to share.
fn share(seen: Spectrum, all: Spectrum) -> Spectrum {
    Spectrum(std::array::from_fn(|b| if all[b] > 0.0 { (seen[b] / all[b]).min(1.0) } else { 1.0 }))
}
