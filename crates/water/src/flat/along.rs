//! The light of lamps that water scatters into a view ray.

use glam::{DVec2, DVec3};
use light::{Occlude, PointSource, Spectrum, Vacuum};

use super::FlatWater;
use super::points::Point;
use super::rules::Along;
use super::shafts::{PROBES, Shaft, between, on_surface, probed, within};
use crate::scatter::Steps;
use crate::{Leg, Paths, Scattering, ViewRay, Way};

/// A lamp beside a view ray under water.
pub(super) struct Beside<'a> {
    pub(super) water: &'a FlatWater,
    pub(super) scattering: &'a Scattering,
    pub(super) lamp: &'a Point<'a>,
    pub(super) ray: &'a ViewRay,
    pub(super) occlude: &'a dyn Occlude,
}

impl Beside<'_> {
    /// Radiance at the ray's origin of what comes to the ray by one way \[W m⁻² sr⁻¹ nm⁻¹\].
    pub(super) fn radiance(&self, way: Way, along: Along) -> Spectrum {
        let shafts = self.shafts(way);
        match along {
            Along::Quadrature(tolerance) => {
                let piece = |shaft: &Shaft| {
                    let ray =
                        ViewRay { from: self.ray.at(shaft.from), length: shaft.to - shaft.from, ..*self.ray };
                    let light = |leg: &Leg, point: DVec3| self.intensity(leg, point);
                    let found = self.scattering.lamp_by_way(way, self.lamp.at, &light, &ray, &[], tolerance);
                    let left = self.scattering.coefficient().attenuate(shaft.from as f32);
                    Spectrum(found.value.map(|band| band as f32)) * shaft.share * left
                };
                shafts.iter().map(piece).sum()
            }
            Along::Steps(longest) => self.by_steps(way, longest, &shafts),
        }
    }

    /// By the thesis' steps. Its I_ref is the mean of what eight points scatter, its I_ε a thousandth of that.
    fn by_steps(&self, way: Way, longest: f64, shafts: &[Shaft]) -> Spectrum {
        let light = |leg: &Leg, point: DVec3| {
            let r = (point - self.ray.from).dot(self.ray.direction);
            let here = shafts.iter().find(|shaft| shaft.from <= r && r <= shaft.to);
            here.map_or(Spectrum::ZERO, |shaft| self.intensity(leg, point) * shaft.share)
        };
        let bright = |i: u32| {
            let r = self.ray.length * (f64::from(i) + 0.5) / 8.0;
            f64::from(self.scattering.per_metre(way, self.lamp.at, &light, self.ray, r).luminance())
        };
        let reference = (0..8).map(bright).sum::<f64>() / 8.0;
        let steps = Steps { longest, shortest: 0.05 * longest, reference, negligible: 1e-3 * reference };
        let walked = self.scattering.steps_by_way(way, (self.lamp.at, DVec3::ZERO), &light, self.ray, &steps);
        Spectrum(walked.radiance.map(|band| band as f32))
    }

    /// Intensity along a leg, with nothing in the way: what arrives at its first end, times that distance squared.
    fn intensity(&self, leg: &Leg, point: DVec3) -> Spectrum {
        let place = match leg.at_surface {
            Some(at) if self.water.surface.is_below(self.lamp.at) => on_surface(at, 0).flipped(),
            Some(at) => on_surface(at, 0),
            None => within(point, leg.toward),
        };
        let distance = self.lamp.at.distance(leg.at_surface.unwrap_or(point));
        self.lamp.facing(&place, &Vacuum) * (distance * distance) as f32
    }

    /// The stretches of the ray to which nothing hides that way.
    fn shafts(&self, way: Way) -> Vec<Shaft> {
        let (ray, whole) = (self.ray, [0.0, self.ray.length]);
        let (mut out, mut hidden) = (Vec::new(), Vec::new());
        let seen = |r: f64| self.seen(way, ray.at(r));
        let source = PointSource::At(self.lamp.at);
        if way == Way::Direct && self.occlude.shadows(&source, ray.from, ray.at(ray.length), &mut hidden) {
            between(&hidden, [0.0, 1.0], ray.length, &seen, &mut out);
        } else {
            probed(whole, PROBES, &seen, &mut out);
        }
        out
    }

    /// The share that arrives at a point by a way.
    fn seen(&self, way: Way, point: DVec3) -> Spectrum {
        let surface = &self.water.surface;
        let leg = match way {
            Way::Direct => {
                let toward = (self.lamp.at - point).normalize_or(DVec3::Y);
                return self.occlude.transmittance(&within(point, toward).toward(self.lamp.at.as_vec3()));
            }
            Way::Mirrored => surface.mirrored(self.lamp.at, point),
            Way::Refracted => surface.refracted(self.lamp.at, point, Paths::Exact),
        };
        let Some((leg, at)) = leg.and_then(|leg| Some((leg, leg.at_surface?))) else { return Spectrum::ZERO };
        if leg.share <= 0.0 || !self.water.covers(DVec2::new(at.x, at.z)) {
            return Spectrum::ZERO;
        }
        let place = on_surface(at, 0);
        let first = self.occlude.transmittance(&place.toward(self.lamp.at.as_vec3()));
        if first.is_zero() {
            return first;
        }
        first * self.occlude.transmittance(&within(point, leg.toward).toward(place.position))
    }
}
