//! What arrives at a place beside a water surface by way of the surface.

use glam::{DVec2, DVec3, Vec3};
use light::{Arrival, Occlude, Place, Spectrum};

use super::points::Point;
use super::shafts::on_surface;
use super::{FlatWater, Lit, Part};
use crate::{Leg, Loss, SunBelow, Way, mirrored_sun};

/// Whoever is told what arrives.
pub(super) type Receive<'a> = &'a mut dyn FnMut(Arrival);

/// A place beside a surface.
pub(super) struct At<'a> {
    pub(super) water: &'a FlatWater,
    pub(super) place: &'a Place,
    /// How far below the surface the place lies \[m\]; negative above.
    pub(super) depth: f64,
    pub(super) occlude: &'a dyn Occlude,
}

impl At<'_> {
    fn foot(&self) -> DVec2 {
        let p = self.place.position.as_dvec3();
        DVec2::new(p.x, p.z)
    }

    fn give(receive: Receive<'_>, toward: Vec3, irradiance: Spectrum) {
        if !irradiance.is_zero() {
            receive(Arrival::Beam { toward, irradiance, radius: None });
        }
    }

    /// What a path of `length` metres under water leaves of light that lights things.
    pub(super) fn left(&self, length: f64) -> Spectrum {
        self.water.water.loss(Loss::Diffuse).attenuate(length as f32)
    }

    /// By way of the surface point at x, z, whose light comes from above or from below: what arrives there of a point on a plane that
    /// faces it, past what hides the place from there; with the direction to it. None beside the outline.
    fn by_way_of(&self, point: &Point, at: DVec2, above: bool) -> Option<(Vec3, Spectrum)> {
        if !self.water.covers(at) {
            return None;
        }
        let surface = on_surface(DVec3::new(at.x, self.water.surface.level, at.y), self.place.seed);
        let way = self.place.toward(surface.position);
        let seen = self.occlude.transmittance(&way);
        if seen.is_zero() {
            return None;
        }
        let surface = if above { surface } else { surface.flipped() };
        Some((way.direction, point.facing(&surface, self.occlude) * seen))
    }

    /// From a lamp by way of the surface of this water, number `i`: off it from points on the place's own side of it, through it from those
    /// on the other. Points in another water, and those beside this one and below its level, send nothing by it.
    pub(super) fn lamp(&self, receive: Receive<'_>, lit: &Lit, i: usize) {
        let (surface, place) = (&self.water.surface, self.place.position.as_dvec3());
        let count = lit.count();
        for n in 0..count {
            let Some(point) = lit.point((n, count), self.place) else { return };
            let below = match lit.holder(point.at) {
                Some(holder) if holder == i => true,
                None if !surface.is_below(point.at) => false,
                _ => continue,
            };
            let (part, leg) = match below == (self.depth > 0.0) {
                true => (Part::Reflected, surface.mirrored(point.at, place)),
                false => (Part::Through, surface.refracted(point.at, place, lit.rules.paths)),
            };
            if !lit.part.has(part) {
                continue;
            }
            let Some((leg, at)) = leg.and_then(|leg| Some((leg, leg.at_surface?))) else { continue };
            if let Some((toward, there)) = self.by_way_of(&point, DVec2::new(at.x, at.z), !below) {
                let beyond = beyond(&leg, point.at.distance(at));
                Self::give(receive, toward, there * self.left(leg.water) * beyond);
            }
        }
    }

    /// The sun through the surface.
    pub(super) fn sun_below(&self, receive: Receive<'_>, lit: &Lit, toward: DVec3) {
        if !lit.part.has(Part::Through) {
            return;
        }
        let Some(sun) = SunBelow::new(&self.water.surface, toward, Spectrum::ONE) else { return };
        let run = DVec2::new(sun.toward.x, sun.toward.z) * (self.depth / sun.toward.y);
        let point = Point::luminaire(toward, &*lit.inner);
        if let Some((toward, there)) = self.by_way_of(&point, self.foot() + run, true) {
            Self::give(receive, toward, there * sun.facing(self.depth, self.water.water.loss(Loss::Diffuse)));
        }
    }

    /// The sun's mirror image in the surface.
    pub(super) fn sun_mirrored(&self, receive: Receive<'_>, lit: &Lit, toward: DVec3) {
        if !lit.part.has(Part::Reflected) {
            return;
        }
        let Some((image, share)) = mirrored_sun(&self.water.surface, toward, Spectrum::ONE) else { return };
        let run = DVec2::new(image.x, image.z) * (self.depth / image.y);
        let point = Point::luminaire(toward, &*lit.inner);
        if let Some((toward, there)) = self.by_way_of(&point, self.foot() + run, true) {
            Self::give(receive, toward, there * share);
        }
    }
}

/// Irradiance at the end of a way by the surface over that at the surface, `first` metres from the source.
fn beyond(leg: &Leg, first: f64) -> f32 {
    match leg.way {
        Way::Direct => 1.0,
        _ => (leg.share * leg.spread * first * first) as f32,
    }
}
