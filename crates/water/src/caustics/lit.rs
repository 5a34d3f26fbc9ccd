//! A source of light as waves bring it to things.

use std::sync::Arc;

use glam::DVec3;
use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum};

use super::grid::least_step;
use super::{Beam, BeamMap};
use crate::flat::{FlatWater, Lit, Part, Rules, Source, beams_on, on_surface};
use crate::waves::Waves;
use crate::{Loss, Way};

/// How finely beams are made and gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Cells to the shortest wave's length, > 0.
    pub cells: f64,
    /// Least side of the square that stands for a receiver \[m\].
    pub width: f64,
    /// Within what angle of its middle the source is seen \[rad\].
    pub disc: f64,
}

impl Setting {
    /// Cells to the shortest wave's length that the surface of `water` is cut into: those asked for, or fewer where its beams would have
    /// more than 4 Mi corners. None in calm water.
    pub fn cells_over(&self, water: &FlatWater, waves: &Waves) -> Option<f64> {
        let [low, high] = water.extent();
        Some(self.cells.min(waves.shortest()? / least_step(low, high)))
    }
}

/// The sun, or a lamp in air, with wavy water around: through and off the waves by beams; elsewhere as by flat water ([`Lit`]).
///
/// Over and under a water, between its highest crest and as far below its level, light takes its flat paths, and so does that of
/// lamps that hang lower than that. Each water is asked for itself: what others there are, and how high they lie, does not matter to it.
/// Nothing comes off a surface to places in another water. Shadows are asked for on both legs once for each leaf of
/// beams, at the surface point that its light comes from on average.
pub struct Beams {
    inner: Arc<dyn Illuminate>,
    /// With all waters as if at rest.
    flat: Lit,
    /// With those alone that are.
    calm: Lit,
    /// Those that are not.
    wavy: Vec<Wavy>,
    width: f64,
}

/// A water with waves, and its beams.
struct Wavy {
    /// Its number among all waters.
    index: usize,
    water: FlatWater,
    /// None where this part of the light is not asked for.
    through: Option<BeamMap>,
    mirrored: Option<BeamMap>,
    /// How far from the level beams begin \[m\]: no wave rises or falls farther.
    near: f64,
}

impl Wavy {
    /// Of a `part` of a source's light, in cells of `step` \[m\]; none where waves hide the source.
    fn new(
        (index, water, waves): (usize, &FlatWater, &Waves),
        source: Source,
        part: Part,
        fine: (f64, f64),
    ) -> Option<Self> {
        let map = |of, way| part.has(of).then(|| BeamMap::new(water, waves, source, way, fine));
        let (through, mirrored) = (map(Part::Through, Way::Refracted), map(Part::Reflected, Way::Mirrored));
        let near = through.as_ref().or(mirrored.as_ref()).map_or(0.0, BeamMap::reach);
        let over = |lamp: DVec3| lamp.y > water.surface.level + near;
        let shines = source.lamp().is_none_or(over);
        shines.then(|| Self { index, water: water.clone(), through, mirrored, near })
    }
}

impl Beams {
    /// A `part` of the light of `inner`, which is a `source`, with these waters around, each with its waves; the parts add up to
    /// [`Part::All`]. Waters at rest, and sources from all around, with an extent or below the crests, are left to [`Lit`].
    pub fn new(
        inner: Arc<dyn Illuminate>,
        source: Source,
        waters: Arc<[FlatWater]>,
        waves: &[Arc<Waves>],
        (rules, setting, part): (Rules, Setting, Part),
    ) -> Self {
        let outside =
            |lamp: DVec3| waters.iter().all(|water| water.depth(lamp).is_none_or(|depth| depth <= 0.0));
        let shines = |water: &FlatWater| match source {
            Source::Toward(toward) => toward.y > 0.0,
            Source::At(lamp) => lamp.y > water.surface.level && outside(lamp),
            Source::Around | Source::Area(_) => false,
        };
        let (mut wavy, mut calm) = (Vec::new(), Vec::new());
        for (i, (water, waves)) in waters.iter().zip(waves).enumerate() {
            let step = waves.shortest().filter(|_| shines(water)).map(|shortest| shortest / setting.cells);
            match step.and_then(|step| Wavy::new((i, water, waves), source, part, (step, setting.disc))) {
                Some(beams) => wavy.push(beams),
                None => calm.push(water.clone()),
            }
        }
        let by = |waters| Lit::new(Box::new(Arc::clone(&inner)), source, waters, rules).only(part);
        Self { flat: by(waters), calm: by(calm.into()), inner, wavy, width: setting.width }
    }

    /// By one water's beams, those that its waves let through or those that they mirror.
    fn give(&self, beams: &BeamMap, at: &At<'_>, receive: &mut dyn FnMut(Arrival)) {
        let position = at.place.position.as_dvec3();
        beams.beams(position, beams.half_width(position, 0.5 * self.width), &mut |beam| {
            // What comes from behind lights nothing, and needs no shadows; who is lit from all sides asks twice.
            if beam.toward.as_vec3().dot(at.place.normal) > 0.0
                && let Some(arrival) = self.arrival(&beam, at)
            {
                receive(arrival);
            }
        });
    }

    /// What one beam brings, past what is in its way.
    fn arrival(&self, beam: &Beam, at: &At<'_>) -> Option<Arrival> {
        let surface = on_surface(beam.from, at.place.seed);
        let seen = at.occlude.transmittance(&at.place.toward(surface.position));
        if seen.is_zero() {
            return None;
        }
        let there = beams_on(&*self.inner, &surface, at.occlude);
        let length = beam.from.distance(at.place.position.as_dvec3());
        let facing = beam.level / beam.toward.y.abs();
        let irradiance = there * seen * at.loss.attenuate(length as f32) * facing as f32;
        let toward = beam.toward.as_vec3();
        (!irradiance.is_zero()).then_some(Arrival::Beam { toward, irradiance, radius: None })
    }
}

/// A place that light comes to by a surface.
struct At<'a> {
    place: &'a Place,
    occlude: &'a dyn Occlude,
    /// What is lost on the way from the surface \[1/m\].
    loss: Spectrum,
}

impl Illuminate for Beams {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        self.arrivals_on([u32::MAX; 2], place, occlude, receive);
    }

    fn arrivals_on(
        &self,
        face: [u32; 2],
        place: &Place,
        occlude: &dyn Occlude,
        receive: &mut dyn FnMut(Arrival),
    ) {
        let point = place.position.as_dvec3();
        if self.flat.is_under(point) {
            let here = |wavy: &&Wavy| wavy.water.depth(point).is_some_and(|depth| depth > wavy.near);
            let Some(wavy) = self.wavy.iter().find(here) else {
                return self.flat.arrivals_on(face, place, occlude, receive);
            };
            let loss = wavy.water.water.loss(Loss::Diffuse);
            if let Some(through) = &wavy.through {
                self.give(through, &At { place, occlude, loss }, receive);
            }
            return;
        }
        self.calm.arrivals_on(face, place, occlude, receive);
        for wavy in &self.wavy {
            let low = wavy.water.depth(point).is_some_and(|depth| -depth <= wavy.near);
            match &wavy.mirrored {
                Some(_) if low => self.flat.off(wavy.index, place, occlude, receive),
                Some(mirrored) if point.y > wavy.water.surface.level => {
                    self.give(mirrored, &At { place, occlude, loss: Spectrum::ZERO }, receive);
                }
                _ => {}
            }
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.flat.radiance(ray)
    }

    /// As if the water were flat: what waves gather, scattering evens out.
    fn scattered(&self, ray: &Ray, occlude: &dyn Occlude) -> Spectrum {
        self.flat.scattered(ray, occlude)
    }
}
