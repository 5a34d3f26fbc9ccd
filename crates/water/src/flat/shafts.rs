//! Which stretches of a view ray under water light reaches.

use glam::{DVec2, DVec3, Vec3};
use light::{Occlude, Place, PointSource, Spectrum, Stretch};

use super::FlatWater;
use crate::ViewRay;

/// A stretch of a ray, as distances \[m\], and the share of light that nothing hides from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shaft {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) share: Spectrum,
}

impl Shaft {
    /// Whether it is all of a ray, and nothing is hidden from it.
    pub(super) fn is_whole(&self, ray: &ViewRay) -> bool {
        self.from <= 0.0 && self.to >= ray.length && self.share == Spectrum::ONE
    }
}

/// Places at which a ray is looked at where no occluder can tell intervals. What hides less than 1/32 of it may be missed: 2.5 % of the
/// ray's light at worst in `shadows_of_a_garden_…`, where 16 places miss 7 %.
pub(super) const PROBES: u32 = 32;
/// Halvings of the way between two of them that differ: ends of shadows are found to 1/32 · 2⁻¹⁰ of the ray, 3e-5.
const HALVINGS: u32 = 10;
/// Least looks at a stretch that things partly let light through to: a longer one has as many as its part of the [`PROBES`] of the whole ray.
const VEILED: u32 = 4;
/// Shares that differ by less are one: products of transmittances round.
const ALIKE: f32 = 1e-3;

/// Parallel light that comes through a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parallel {
    /// Unit vectors towards where it comes from, under water and in air.
    pub(super) below: DVec3,
    pub(super) above: DVec3,
}

impl Parallel {
    /// Which stretches of `ray` (of finite length) it reaches: between shadows of what is under water, and of what is in air on the feet of
    /// its ways, which lie on a line on the surface; and where there is a surface to come through. Exact where the occluder
    /// tells intervals, else by [`probed`].
    pub(super) fn shafts(&self, water: &FlatWater, ray: &ViewRay, occlude: &dyn Occlude) -> Vec<Shaft> {
        let level = water.surface.level;
        let [a, b] = [ray.from, ray.at(ray.length)];
        let foot = |p: DVec3| {
            let foot = p + self.below * ((level - p.y).max(0.0) / self.below.y);
            foot.with_y(level)
        };
        let [foot_a, foot_b] = [foot(a), foot(b)];
        let flat = |p: DVec3| DVec2::new(p.x, p.z);
        let covered = water.stretches(flat(foot_a), flat(foot_b));
        let seen = |r: f64| self.seen(foot(ray.at(r)), ray.at(r), occlude);
        let mut hidden = Vec::new();
        let told = occlude.shadows(&PointSource::Below { toward: self.below, level }, a, b, &mut hidden)
            && occlude.shadows(&PointSource::Toward(self.above), foot_a, foot_b, &mut hidden);
        let mut out = Vec::new();
        for [from, to] in covered {
            if told {
                between(&hidden, [from, to], ray.length, &seen, &mut out);
            } else {
                probed([from * ray.length, to * ray.length], PROBES, &seen, &mut out);
            }
        }
        out
    }

    /// The share that arrives at a point by way of a point of the surface.
    fn seen(&self, surface: DVec3, point: DVec3, occlude: &dyn Occlude) -> Spectrum {
        let place = on_surface(surface, 0);
        let first = occlude.transmittance(&place.leave(self.above.as_vec3(), f32::INFINITY));
        if first.is_zero() {
            return first;
        }
        first * occlude.transmittance(&within(point, self.below).toward(place.position))
    }
}

/// A point of the surface, as a place.
pub(crate) fn on_surface(point: DVec3, seed: u32) -> Place {
    let position = point.as_vec3();
    let error = 4.0 * f32::EPSILON * position.abs().max_element() + f32::MIN_POSITIVE;
    Place { position, error, normal: Vec3::Y, seed }
}

/// A point in the water, as a place that faces `normal`.
pub(super) fn within(point: DVec3, normal: DVec3) -> Place {
    Place { position: point.as_vec3(), error: 0.0, normal: normal.as_vec3(), seed: 0 }
}

/// What `hidden` leaves of the stretch between two shares of a ray: `seen` is asked where things let light through.
pub(super) fn between(
    hidden: &[Stretch],
    [from, to]: [f64; 2],
    length: f64,
    seen: &dyn Fn(f64) -> Spectrum,
    out: &mut Vec<Shaft>,
) {
    let mut ends: Vec<f64> =
        hidden.iter().flat_map(|s| [s.from, s.to]).filter(|s| *s > from && *s < to).collect();
    ends.extend([from, to]);
    ends.sort_by(f64::total_cmp);
    for pair in ends.windows(2).filter(|pair| pair[0] < pair[1]) {
        let middle = 0.5 * (pair[0] + pair[1]);
        let over = |dark: bool| hidden.iter().any(|s| s.dark == dark && s.from < middle && middle < s.to);
        let [from, to] = [pair[0] * length, pair[1] * length];
        if over(true) {
            continue;
        }
        match over(false) {
            true => probed([from, to], looks(pair[1] - pair[0]), seen, out),
            false => join(Shaft { from, to, share: Spectrum::ONE }, out),
        }
    }
}

/// Looks at a stretch that is a `share` of its ray.
fn looks(share: f64) -> u32 {
    (f64::from(PROBES) * share).ceil().clamp(f64::from(VEILED), f64::from(PROBES)) as u32
}

/// The stretch between two distances by looking at `count` places of it; where two neighbours differ, the end of the shadow
/// between them is found by halving.
pub(super) fn probed([from, to]: [f64; 2], count: u32, seen: &dyn Fn(f64) -> Spectrum, out: &mut Vec<Shaft>) {
    let at = |i: u32| from + (to - from) * (f64::from(i) + 0.5) / f64::from(count);
    let (mut start, mut here) = (from, seen(at(0)));
    for i in 1..count {
        let there = seen(at(i));
        if alike(here, there) {
            continue;
        }
        let (mut low, mut high) = (at(i - 1), at(i));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            // What is neither is between both: its end is as good as the other's.
            if alike(seen(middle), here) { low = middle } else { high = middle }
        }
        join(Shaft { from: start, to: high, share: here }, out);
        (start, here) = (high, there);
    }
    join(Shaft { from: start, to, share: here }, out);
}

fn alike(a: Spectrum, b: Spectrum) -> bool {
    a.0.iter().zip(b.0).all(|(a, b)| (a - b).abs() < ALIKE)
}

/// Appends a stretch, to the one before it if they are one.
fn join(shaft: Shaft, out: &mut Vec<Shaft>) {
    if shaft.share.is_zero() || shaft.from >= shaft.to {
        return;
    }
    match out.last_mut() {
        Some(last) if last.to == shaft.from && last.share == shaft.share => last.to = shaft.to,
        _ => out.push(shaft),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_veiled_stretch_is_found_as_well_as_a_short_one() {
        // Leaves that are dark over half of every metre of a ray of 8 m, and a veil over all of it or over one metre.
        let leaf = |r: f64| if r.fract() < 0.5 { Spectrum::ZERO } else { Spectrum::splat(0.8) };
        let light = |from: f64, to: f64| {
            let veil = [Stretch { from: from / 8.0, to: to / 8.0, dark: false }];
            let mut out = Vec::new();
            between(&veil, [from / 8.0, to / 8.0], 8.0, &leaf, &mut out);
            out.iter().map(|shaft| (shaft.to - shaft.from) * f64::from(shaft.share[0])).sum::<f64>()
                / (to - from)
        };
        // Ends between two looks, 1/4 m apart, are found by ten halvings.
        let [short, long] = [light(3.0, 4.0), light(0.0, 8.0)];
        assert!((short - 0.4).abs() < 1e-3 && (long - 0.4).abs() < 2e-3, "{short} {long}");
    }
}
