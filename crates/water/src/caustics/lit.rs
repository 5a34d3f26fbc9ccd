//! A source of light as waves bring it to things.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum};

use super::{Beam, BeamMap};
use crate::flat::{FlatWater, Lit, Source};
use crate::waves::Waves;
use crate::{Loss, Paths, Way};

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

/// The sun, or a lamp in air, with wavy water around: below it by beams, elsewhere as by flat water ([`Lit`]).
///
/// *Below* is deeper than the deepest trough can be, and by waves' height more: in between light takes the flat path. Shadows are
/// asked for on both legs once for each leaf of beams, at the surface point that its light comes from on average.
pub struct Beams {
    inner: Arc<dyn Illuminate>,
    flat: Lit,
    waters: Arc<[FlatWater]>,
    maps: Vec<Option<Map>>,
    width: f64,
}

/// Of one water.
struct Map {
    beams: BeamMap,
    /// From where on beams are asked \[m\].
    depth: f64,
}

impl Beams {
    /// `inner`, which is a `source`, with these waters around, each with its waves. Waters at rest, and sources from all around or below a
    /// water's level, are left to [`Lit`].
    pub fn new(
        inner: Arc<dyn Illuminate>,
        source: Source,
        waters: Arc<[FlatWater]>,
        waves: &[Waves],
        (paths, setting): (Paths, Setting),
    ) -> Self {
        let map = |(water, waves): (&FlatWater, &Waves)| {
            let above = match source {
                Source::Toward(toward) => toward.y > 0.0,
                Source::At(lamp) => lamp.y > water.surface.level + waves.highest(),
                Source::Around => false,
            };
            let shortest = waves.shortest().filter(|_| above)?;
            let step = shortest / setting.cells;
            let beams = BeamMap::new(water, waves, source, Way::Refracted, (step, setting.disc));
            Some(Map { beams, depth: 2.0 * waves.highest() })
        };
        let maps = waters.iter().zip(waves).map(map).collect();
        let flat = Lit::new(Box::new(Arc::clone(&inner)), source, Arc::clone(&waters), paths);
        Self { inner, flat, waters, maps, width: setting.width }
    }

    /// The water with beams that a point is in, and its map.
    fn under(&self, point: DVec3) -> Option<(&FlatWater, &Map)> {
        let maps = self.waters.iter().zip(&self.maps);
        let mut with = maps.filter_map(|(water, map)| Some((water, map.as_ref()?)));
        with.find(|(water, map)| water.depth(point).is_some_and(|depth| depth > map.depth))
    }

    /// What one beam brings, past what is in its way.
    fn arrival(
        &self,
        beam: &Beam,
        water: &FlatWater,
        place: &Place,
        occlude: &dyn Occlude,
    ) -> Option<Arrival> {
        let position = beam.from.as_vec3();
        let error = 4.0 * f32::EPSILON * position.abs().max_element() + f32::MIN_POSITIVE;
        let surface = Place { position, error, normal: Vec3::Y, seed: place.seed };
        let seen = occlude.transmittance(&place.toward(position));
        if seen.is_zero() {
            return None;
        }
        let mut there = Spectrum::ZERO;
        self.inner.arrivals(&surface, occlude, &mut |arrival| {
            if let Arrival::Beam { irradiance, .. } = arrival {
                there += irradiance;
            }
        });
        let length = beam.from.distance(place.position.as_dvec3());
        let left = water.water.loss(Loss::Diffuse).attenuate(length as f32);
        let irradiance = there * seen * left * (beam.level / beam.toward.y) as f32;
        (!irradiance.is_zero()).then(|| Arrival::Beam {
            toward: beam.toward.as_vec3(),
            irradiance,
            radius: None,
        })
    }
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
        let at = place.position.as_dvec3();
        let Some((water, map)) = self.under(at) else {
            return self.flat.arrivals_on(face, place, occlude, receive);
        };
        map.beams.beams(at, map.beams.half_width(at, 0.5 * self.width), &mut |beam| {
            // What comes from behind lights nothing, and needs no shadows; water's own points are lit from all sides, and ask twice.
            if beam.toward.as_vec3().dot(place.normal) > 0.0
                && let Some(arrival) = self.arrival(&beam, water, place, occlude)
            {
                receive(arrival);
            }
        });
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.inner.radiance(ray)
    }
}
