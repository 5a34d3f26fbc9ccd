//! A source of light as waves bring it to things.

use std::sync::Arc;

use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum};

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

/// The sun, or a lamp in air, with wavy water around: through and off the waves by beams; elsewhere as by flat water ([`Lit`]).
///
/// Within twice the sum of all waves' heights of the level of rest light takes the flat paths (in the seas of a strong wind that is some
/// metres), and so does that of lamps that hang lower than that sum. Shadows are asked for on both legs once for each
/// leaf of beams, at the surface point that its light comes from on average.
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
    water: FlatWater,
    /// None where this part of the light is not asked for.
    through: Option<BeamMap>,
    mirrored: Option<BeamMap>,
    /// How far from the level beams begin \[m\].
    near: f64,
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
        let shines = |water: &FlatWater, waves: &Waves| match source {
            Source::Toward(toward) => toward.y > 0.0,
            Source::At(lamp) => lamp.y > water.surface.level + waves.highest(),
            Source::Around | Source::Area(_) => false,
        };
        let (mut wavy, mut calm) = (Vec::new(), Vec::new());
        for (water, waves) in waters.iter().zip(waves) {
            let Some(shortest) = waves.shortest().filter(|_| shines(water, waves)) else {
                calm.push(water.clone());
                continue;
            };
            let fine = (shortest / setting.cells, setting.disc);
            let map = |of, way| part.has(of).then(|| BeamMap::new(water, waves, source, way, fine));
            let (through, mirrored) =
                (map(Part::Through, Way::Refracted), map(Part::Reflected, Way::Mirrored));
            wavy.push(Wavy { water: water.clone(), through, mirrored, near: 2.0 * waves.highest() });
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
        let above = |wavy: &Wavy| point.y - wavy.water.surface.level;
        if self.wavy.iter().any(|wavy| above(wavy).abs() <= wavy.near) {
            return self.flat.arrivals_on(face, place, occlude, receive);
        }
        let under = |wavy: &&Wavy| wavy.water.depth(point).is_some_and(|depth| depth > 0.0);
        if let Some(wavy) = self.wavy.iter().find(under) {
            let loss = wavy.water.water.loss(Loss::Diffuse);
            if let Some(through) = &wavy.through {
                self.give(through, &At { place, occlude, loss }, receive);
            }
            return;
        }
        self.calm.arrivals_on(face, place, occlude, receive);
        for mirrored in
            self.wavy.iter().filter(|wavy| above(wavy) > 0.0).filter_map(|wavy| wavy.mirrored.as_ref())
        {
            self.give(mirrored, &At { place, occlude, loss: Spectrum::ZERO }, receive);
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
