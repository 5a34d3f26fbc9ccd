//! A source of light as it arrives above and below water.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};
use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum, fresnel};

use super::FlatWater;
use crate::path::{Bundle, refraction_point};

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

/// Light of a source with flat water around: direct, mirrored by the surface from above (3.2, 3.10) or from below (3.14), and through it
/// (3.6, 3.11′, 3.12′), attenuated under water.
///
/// The inner source is asked for what arrives at the *surface point*, with its own distribution and shadows; a bundle spreads
/// from there as [`Bundle`] says, and the second leg is asked for by one ray. Beams keep no radius beyond the surface.
///
/// *Left out.* Water seen through water (two surfaces on one path); beside the outline light passes straight.
pub struct Lit {
    inner: Box<dyn Illuminate>,
    source: Source,
    waters: Arc<[FlatWater]>,
}

impl Lit {
    /// `inner`, which is a `source`, with these waters around.
    pub fn new(inner: Box<dyn Illuminate>, source: Source, waters: Arc<[FlatWater]>) -> Self {
        Self { inner, source, waters }
    }

    /// The water that a point is in, and how deep.
    fn under(&self, point: DVec3) -> Option<(&FlatWater, f64)> {
        self.waters
            .iter()
            .find_map(|water| Some((water, water.depth(point)?)))
            .filter(|(_, depth)| *depth > ON)
    }

    /// What arrives at a place under water.
    fn below(&self, leg: &Leg, receive: Receive<'_>) {
        match self.source {
            Source::Around => leg.sky(receive, self),
            Source::Toward(toward) => {
                let sin = (1.0 - toward.y * toward.y).max(0.0).sqrt() / leg.water.index;
                let level = DVec2::new(toward.x, toward.z).normalize_or_zero();
                let run = leg.depth * sin / (1.0 - sin * sin).sqrt();
                if toward.y > 0.0 {
                    leg.through(
                        receive,
                        self,
                        leg.foot() + level * run,
                        Bundle::parallel(toward.y, leg.water.index),
                    );
                }
            }
            Source::At(lamp) if lamp.y > leg.water.level => {
                let height = lamp.y - leg.water.level;
                let foot = DVec2::new(lamp.x, lamp.z);
                let apart = foot.distance(leg.foot());
                let x = refraction_point(height, leg.depth, apart, leg.water.index);
                let at = foot + (leg.foot() - foot).normalize_or_zero() * x;
                leg.through(receive, self, at, Bundle::new(height, x, leg.depth, apart - x, leg.water.index));
            }
            Source::At(lamp) => {
                leg.straight(receive, self, lamp);
                leg.mirrored(receive, self, lamp);
            }
        }
    }
}

/// Whoever is told what arrives.
type Receive<'a> = &'a mut dyn FnMut(Arrival);

/// Light on its way to a place beside a surface.
struct Leg<'a> {
    water: &'a FlatWater,
    place: &'a Place,
    /// How far below the surface the place lies \[m\]; negative above.
    depth: f64,
    occlude: &'a dyn Occlude,
}

impl Leg<'_> {
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
        let position = DVec3::new(at.x, self.water.level, at.y).as_vec3();
        let error = 4.0 * f32::EPSILON * position.abs().max_element() + f32::MIN_POSITIVE;
        let normal = if above { Vec3::Y } else { Vec3::NEG_Y };
        self.water.covers(at).then_some(Place { position, error, normal, seed: self.place.seed })
    }

    /// What a path of `length` metres under water leaves.
    fn left(&self, length: f64) -> Spectrum {
        self.water.extinction().map(|c| (-c * length as f32).exp())
    }

    /// The sum of what arrives at a point of the surface, on planes that face it.
    fn at_surface(&self, lit: &Lit, place: &Place) -> Spectrum {
        let mut sum = Spectrum::ZERO;
        lit.inner.arrivals(place, self.occlude, &mut |arrival| {
            if let Arrival::Beam { irradiance, .. } = arrival {
                sum += irradiance;
            }
        });
        sum
    }

    /// Through the surface at `at`, to the other side of the source.
    fn through(&self, receive: Receive<'_>, lit: &Lit, at: DVec2, bundle: Bundle) {
        let Some(surface) = self.surface(at, self.depth > 0.0) else { return };
        let way = self.place.toward(surface.position);
        let factor = bundle.factor() as f32;
        let seen = self.occlude.transmittance(&way);
        if factor > 0.0 && !seen.is_zero() {
            let length = f64::from(self.place.position.distance(surface.position));
            let under = if self.depth > 0.0 { length } else { bundle.first() };
            Self::give(
                receive,
                way.direction,
                self.at_surface(lit, &surface) * seen * self.left(under) * factor,
            );
        }
    }

    /// Straight from a lamp under water.
    fn straight(&self, receive: Receive<'_>, lit: &Lit, lamp: DVec3) {
        let left = self.left(lamp.distance(self.place.position.as_dvec3()));
        lit.inner.arrivals(self.place, self.occlude, &mut |arrival| match arrival {
            Arrival::Beam { toward, irradiance, .. } => Self::give(receive, toward, irradiance * left),
            Arrival::Field { irradiance } => receive(Arrival::Field { irradiance: irradiance * left }),
        });
    }

    /// Off the surface, from a lamp on the place's own side of it.
    fn mirrored(&self, receive: Receive<'_>, lit: &Lit, lamp: DVec3) {
        let (height, depth) = ((lamp.y - self.water.level).abs(), self.depth.abs());
        if height + depth <= 0.0 {
            return;
        }
        let foot = DVec2::new(lamp.x, lamp.z);
        let at = foot.lerp(self.foot(), height / (height + depth));
        let Some(surface) = self.surface(at, self.depth < 0.0) else { return };
        let way = self.place.toward(surface.position);
        let seen = self.occlude.transmittance(&way);
        if seen.is_zero() {
            return;
        }
        let first = lamp.distance(surface.position.as_dvec3());
        let second = f64::from(self.place.position.distance(surface.position));
        let cos = if first > 0.0 { height / first } else { 1.0 };
        let eta = if self.depth > 0.0 { 1.0 / self.water.index } else { self.water.index };
        let spread = if first > 0.0 { (first / (first + second)).powi(2) } else { 0.0 };
        let left = if self.depth > 0.0 { self.left(first + second) } else { Spectrum::ONE };
        let factor = (fresnel(eta, cos) * spread) as f32;
        Self::give(receive, way.direction, self.at_surface(lit, &surface) * seen * left * factor);
    }

    /// The sun's mirror image in the surface.
    fn mirrored_sun(&self, receive: Receive<'_>, lit: &Lit, toward: DVec3) {
        if toward.y <= 0.0 {
            return;
        }
        let run = DVec2::new(toward.x, toward.z) * (-self.depth / toward.y);
        let Some(surface) = self.surface(self.foot() + run, true) else { return };
        let way = self.place.toward(surface.position);
        let seen = self.occlude.transmittance(&way);
        if !seen.is_zero() {
            let factor = fresnel(self.water.index, toward.y) as f32;
            Self::give(receive, way.direction, self.at_surface(lit, &surface) * seen * factor);
        }
    }

    /// The sky through Snell's window, by directions spread evenly over it: Σ n² T L cos′ ΔΩ′.
    fn sky(&self, receive: Receive<'_>, lit: &Lit) {
        let (n, normal) = (self.water.index, self.place.normal);
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
            return self.below(&Leg { water, place, depth, occlude }, receive);
        }
        let from_below = |water: &&FlatWater| matches!(self.source, Source::At(lamp) if water.depth(lamp).is_some_and(|depth| depth > 0.0));
        let lamp_in = self.waters.iter().find(from_below);
        if lamp_in.is_none() {
            self.inner.arrivals_on(face, place, occlude, receive);
        }
        for water in self.waters.iter() {
            let depth = water.level - f64::from(place.position.y);
            if depth >= -ON {
                continue;
            }
            let leg = Leg { water, place, depth, occlude };
            match (self.source, lamp_in) {
                (Source::Toward(toward), _) => leg.mirrored_sun(receive, self, toward),
                (Source::At(lamp), None) if lamp.y > water.level => leg.mirrored(receive, self, lamp),
                (Source::At(lamp), Some(inside)) if std::ptr::eq(inside, water) => {
                    let (under, over) = (water.level - lamp.y, -depth);
                    let foot = DVec2::new(lamp.x, lamp.z);
                    let apart = foot.distance(leg.foot());
                    // The way is the same both ways: from the place's side it is one from air into water.
                    let x = apart - refraction_point(over, under, apart, water.index);
                    let at = foot + (leg.foot() - foot).normalize_or_zero() * x;
                    leg.through(receive, self, at, Bundle::new(under, x, over, apart - x, 1.0 / water.index));
                }
                _ => {}
            }
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.inner.radiance(ray)
    }
}
