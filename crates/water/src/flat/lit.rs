//! A source of light as it arrives above and below water.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};
use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum, fresnel};

use super::FlatWater;
use crate::{Leg, Loss, Paths, SunBelow, Way, mirrored_sun};

/// What kind of source it is, which says how its light finds its way through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Far away in the direction of this unit vector: the sun.
    Toward(DVec3),
    /// A luminaire at this point \[m\].
    At(DVec3),
    /// All around: sky and ground.
    Around,
}

/// Directions asked for in the place of a whole sky seen from under water.
const DIRECTIONS: u32 = 256;

/// Places nearer to a surface than this \[m\] lie on it, and see neither its mirror images nor through it.
const ON: f64 = 1e-4;

/// Light of a source with flat water around: direct, mirrored by the surface from above (3.2, 3.10) or from below (3.14), and through
/// it (3.6, 3.11 and 3.12 repaired), dimmed under water by K = a + b_b.
///
/// The inner source is asked for what arrives at the *surface point*, with its own distribution and its shadows on that leg; from there the
/// bundle spreads as [`Leg`] says, and the second leg is asked for by one ray. Beams keep no radius beyond the surface.
///
/// *Left out.* Water seen through water (two surfaces on one path); beside the outline light passes straight.
pub struct Lit {
    inner: Box<dyn Illuminate>,
    source: Source,
    waters: Arc<[FlatWater]>,
    paths: Paths,
}

impl Lit {
    /// `inner`, which is a `source`, with these waters around.
    pub fn new(inner: Box<dyn Illuminate>, source: Source, waters: Arc<[FlatWater]>, paths: Paths) -> Self {
        Self { inner, source, waters, paths }
    }

    /// The water that a point is in, and how deep.
    fn under(&self, point: DVec3) -> Option<(&FlatWater, f64)> {
        self.waters
            .iter()
            .find_map(|water| Some((water, water.depth(point)?)))
            .filter(|(_, depth)| *depth > ON)
    }

    /// What arrives at a place under water.
    fn below(&self, at: &At, receive: Receive<'_>) {
        match self.source {
            Source::Around => at.sky(receive, self),
            Source::Toward(toward) => at.sun_below(receive, self, toward),
            Source::At(lamp) if at.water.surface.is_below(lamp) => {
                let length = lamp.distance(at.place.position.as_dvec3());
                let left = at.left(length);
                self.inner.arrivals(at.place, at.occlude, &mut |arrival| match arrival {
                    Arrival::Beam { toward, irradiance, .. } => At::give(receive, toward, irradiance * left),
                    Arrival::Field { irradiance } => {
                        receive(Arrival::Field { irradiance: irradiance * left })
                    }
                });
                at.lamp(receive, self, lamp);
            }
            Source::At(lamp) => at.lamp(receive, self, lamp),
        }
    }
}

/// Whoever is told what arrives.
type Receive<'a> = &'a mut dyn FnMut(Arrival);

/// A place beside a surface.
struct At<'a> {
    water: &'a FlatWater,
    place: &'a Place,
    /// How far below the surface the place lies \[m\]; negative above.
    depth: f64,
    occlude: &'a dyn Occlude,
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

    /// The point of the surface at x, z as a place that is lit from above or from below; none beside the outline.
    fn surface(&self, at: DVec2, above: bool) -> Option<Place> {
        let position = DVec3::new(at.x, self.water.surface.level, at.y).as_vec3();
        let error = 4.0 * f32::EPSILON * position.abs().max_element() + f32::MIN_POSITIVE;
        let normal = if above { Vec3::Y } else { Vec3::NEG_Y };
        self.water.covers(at).then_some(Place { position, error, normal, seed: self.place.seed })
    }

    /// What a path of `length` metres under water leaves of light that lights things.
    fn left(&self, length: f64) -> Spectrum {
        self.water.water.loss(Loss::Diffuse).attenuate(length as f32)
    }

    /// By way of the surface point at x, z, whose light comes from above or from below: what arrives there on a plane that faces it, past what
    /// hides the place from there; with the direction to it.
    fn by_way_of(&self, lit: &Lit, at: DVec2, above: bool) -> Option<(Vec3, Spectrum)> {
        let surface = self.surface(at, above)?;
        let way = self.place.toward(surface.position);
        let seen = self.occlude.transmittance(&way);
        if seen.is_zero() {
            return None;
        }
        let mut sum = Spectrum::ZERO;
        lit.inner.arrivals(&surface, self.occlude, &mut |arrival| {
            if let Arrival::Beam { irradiance, .. } = arrival {
                sum += irradiance;
            }
        });
        Some((way.direction, sum * seen))
    }

    /// From a lamp, off the surface if it is on the place's own side of it, through it if not.
    fn lamp(&self, receive: Receive<'_>, lit: &Lit, lamp: DVec3) {
        let (surface, place) = (&self.water.surface, self.place.position.as_dvec3());
        let same_side = surface.is_below(lamp) == (self.depth > 0.0);
        let leg = match same_side {
            true => surface.mirrored(lamp, place),
            false => surface.refracted(lamp, place, lit.paths),
        };
        let Some(leg) = leg else { return };
        let Some(point) = leg.at_surface else { return };
        if let Some((toward, there)) =
            self.by_way_of(lit, DVec2::new(point.x, point.z), !surface.is_below(lamp))
        {
            Self::give(receive, toward, there * self.left(leg.water) * beyond(&leg, lamp.distance(point)));
        }
    }

    /// The sun through the surface.
    fn sun_below(&self, receive: Receive<'_>, lit: &Lit, toward: DVec3) {
        let Some(sun) = SunBelow::new(&self.water.surface, toward, Spectrum::ONE) else { return };
        let run = DVec2::new(sun.toward.x, sun.toward.z) * (self.depth / sun.toward.y);
        if let Some((toward, there)) = self.by_way_of(lit, self.foot() + run, true) {
            Self::give(receive, toward, there * sun.facing(self.depth, self.water.water.loss(Loss::Diffuse)));
        }
    }

    /// The sun's mirror image in the surface.
    fn sun_mirrored(&self, receive: Receive<'_>, lit: &Lit, toward: DVec3) {
        let Some((image, share)) = mirrored_sun(&self.water.surface, toward, Spectrum::ONE) else { return };
        let run = DVec2::new(image.x, image.z) * (self.depth / image.y);
        if let Some((toward, there)) = self.by_way_of(lit, self.foot() + run, true) {
            Self::give(receive, toward, there * share);
        }
    }

    /// The sky through Snell's window, by directions spread evenly over it: Σ n² T L cos′ ΔΩ′.
    fn sky(&self, receive: Receive<'_>, lit: &Lit) {
        let (n, normal) = (self.water.surface.index, self.place.normal);
        let window = 1.0 - (1.0 - 1.0 / (n * n)).sqrt();
        let each = std::f64::consts::TAU * window / f64::from(DIRECTIONS);
        let mut sum = Spectrum::ZERO;
        for i in 0..DIRECTIONS {
            let [along, turn] = light::sampling::lattice(i, DIRECTIONS, [0, 0]);
            let up = 1.0 - (f64::from(along) + 0.5 / f64::from(DIRECTIONS)).min(1.0) * window;
            let (s, c) = (f64::from(turn) * std::f64::consts::TAU).sin_cos();
            let level = (1.0 - up * up).max(0.0).sqrt();
            let inner = DVec3::new(level * c, up, level * s);
            let cosine = inner.as_vec3().dot(normal);
            if cosine <= 0.0 {
                continue;
            }
            let at = self.foot() + DVec2::new(inner.x, inner.z) * (self.depth / up);
            let Some(surface) = self.surface(at, true) else { continue };
            let sin = (level * n).min(1.0);
            let cos = (1.0 - sin * sin).sqrt();
            let outer = DVec3::new(sin * c, cos, sin * s).as_vec3();
            let seen = self.occlude.transmittance(&self.place.toward(surface.position))
                * self.occlude.transmittance(&surface.leave(outer, f32::INFINITY));
            let radiance = lit.inner.radiance(&Ray::new(surface.position, outer));
            let weight = n * n * (1.0 - fresnel(n, cos)) * each * f64::from(cosine);
            sum += radiance * seen * self.left(self.depth / up) * weight as f32;
        }
        if !sum.is_zero() {
            receive(Arrival::Field { irradiance: sum });
        }
    }
}

impl Illuminate for Lit {
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
        if let Some((water, depth)) = self.under(place.position.as_dvec3()) {
            return self.below(&At { water, place, depth, occlude }, receive);
        }
        let from_below = |water: &&FlatWater| matches!(self.source, Source::At(lamp) if water.depth(lamp).is_some_and(|depth| depth > 0.0));
        let lamp_in = self.waters.iter().find(from_below);
        if lamp_in.is_none() {
            self.inner.arrivals_on(face, place, occlude, receive);
        }
        for water in self.waters.iter() {
            let depth = water.surface.level - f64::from(place.position.y);
            if depth >= -ON {
                continue;
            }
            let at = At { water, place, depth, occlude };
            match (self.source, lamp_in) {
                (Source::Toward(toward), _) => at.sun_mirrored(receive, self, toward),
                (Source::At(lamp), None) if !water.surface.is_below(lamp) => at.lamp(receive, self, lamp),
                (Source::At(lamp), Some(inside)) if std::ptr::eq(inside, water) => {
                    at.lamp(receive, self, lamp)
                }
                _ => {}
            }
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.inner.radiance(ray)
    }
}

/// Irradiance at the end of a way by the surface over that at the surface, `first` metres from the source.
fn beyond(leg: &Leg, first: f64) -> f32 {
    match leg.way {
        Way::Direct => 1.0,
        _ => (leg.share * leg.spread * first * first) as f32,
    }
}
