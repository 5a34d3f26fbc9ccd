//! A source of light as it arrives above and below water, and as water scatters it.

use std::sync::{Arc, OnceLock};

use glam::DVec3;
use light::{AreaLight, AreaShape, Arrival, Illuminate, Occlude, Place, Ray, Spectrum, Vacuum};

use super::FlatWater;
use super::along::Beside;
use super::arriving::{At, Receive};
use super::fill::filling;
use super::points::Point;
use super::rules::{Rules, Scattered};
use super::shafts::{Parallel, on_surface, within};
use super::source::{Part, Source};
use super::window::{Glow, Window, lit};
use crate::{Scattering, SunBelow, ViewRay, Way};

/// Places nearer to a surface than this \[m\] lie on it, and see neither its mirror images nor through it.
const ON: f64 = 1e-4;

/// Optical depth after which nothing is left of scattered light: e⁻²⁰ is 2e-9.
const DEEP: f64 = 20.0;
/// View rays without end are followed no farther than this \[m\].
const FARTHEST: f64 = 1e5;

/// Light of a source with flat water around: direct, mirrored by the surface from above (3.2, 3.10) or from below (3.14), and through
/// it (3.6, 3.11 and 3.12 repaired), dimmed under water by K = a + b_b.
///
/// The inner source is asked for what arrives at the *surface point*, with its own distribution and its shadows on that leg; from there the
/// bundle spreads as [`crate::Leg`] says, and the second leg is asked for by one ray. Beams keep no radius beyond the surface. The sky
/// under water is looked for in fixed directions ([`Rules::window`]).
///
/// Of what the water scatters into a view ray: the sun's light in closed form between shadows (3.31), as from the middle of its disc; the
/// sky's from a table, with the shadows of a few directions; a lamp's by quadrature to a stated error or by the thesis' steps, a lamp's
/// with an extent as if from its middle.
///
/// Where a lamp is decides what becomes of its light; a lamp with an extent that lies partly under water is asked point by point:
///
/// | the lamp lies | to places in the water | to places in air over its surface |
/// | --- | --- | --- |
/// | in that water | straight, and mirrored from below | through the surface |
/// | in air, above the level | through the surface | straight, and mirrored |
/// | in air, below the level: beside the water, deeper than its rim | straight through its side, dimmed as far as it runs in the water | straight |
/// | in another water | none | none of it by this surface |
///
/// *Left out.* Water seen through water (two surfaces on one path); what the water scatters of lamps beside it that lie below its level; beside
/// the outline light passes straight, unrefracted; the sky mirrored by the surface.
pub struct Lit {
    pub(super) inner: Box<dyn Illuminate>,
    pub(super) source: Source,
    waters: Arc<[FlatWater]>,
    /// Which of them its lamp is in, or its middle.
    lamp_in: Option<usize>,
    /// Whether its lamp has an extent that a surface cuts.
    cut: bool,
    pub(super) rules: Rules,
    pub(super) part: Part,
    held: Vec<Held>,
}

/// What is known of one of the waters.
struct Held {
    scattering: Scattering,
    sun: Option<(Parallel, SunBelow)>,
    window: OnceLock<Window>,
    glow: OnceLock<Glow>,
}

impl Lit {
    /// `inner`, which is a `source`, with these waters around.
    pub fn new(inner: Box<dyn Illuminate>, source: Source, waters: Arc<[FlatWater]>, rules: Rules) -> Self {
        let held = |water: &FlatWater| {
            let scattering = water.scattering();
            Held {
                scattering: if rules.scattered == Scattered::Often { scattering.often() } else { scattering },
                sun: match source {
                    Source::Toward(toward) => sun_below(water, toward, &*inner),
                    _ => None,
                },
                window: OnceLock::new(),
                glow: OnceLock::new(),
            }
        };
        let held = waters.iter().map(held).collect();
        let lamp_in = source.lamp().and_then(|lamp| holder(&waters, lamp));
        let cut = matches!(source, Source::Area(lamp) if waters.iter().any(|water| cuts(water, &lamp)));
        Self { inner, source, waters, lamp_in, cut, rules, part: Part::All, held }
    }

    /// Only one part of its light: the parts add up to [`Part::All`].
    pub fn only(self, part: Part) -> Self {
        Self { part, ..self }
    }

    /// The water that a point is in, and how deep.
    fn under(&self, point: DVec3) -> Option<(usize, f64)> {
        let depths = self.waters.iter().enumerate();
        let depths =
            depths.filter_map(|(i, water)| Some((i, water.depth(point).filter(|depth| *depth > ON)?)));
        // Of waters above each other, the one whose surface is nearest.
        depths.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether a point lies in one of the waters.
    pub(crate) fn is_under(&self, point: DVec3) -> bool {
        self.under(point).is_some()
    }

    /// What arrives at a place in air by way of the surface of water number `i`.
    pub(crate) fn off(&self, i: usize, place: &Place, occlude: &dyn Occlude, receive: Receive<'_>) {
        let water = &self.waters[i];
        let depth = water.surface.level - f64::from(place.position.y);
        if depth >= -ON {
            return;
        }
        let at = At { water, place, depth, occlude };
        match self.source {
            Source::Toward(toward) => at.sun_mirrored(receive, self, toward),
            Source::At(_) | Source::Area(_) => at.lamp(receive, self, i),
            Source::Around => {}
        }
    }

    /// Which water a point of its lamp is in.
    pub(super) fn holder(&self, point: DVec3) -> Option<usize> {
        if self.cut { holder(&self.waters, point) } else { self.lamp_in }
    }

    /// What comes straight from those points of a cut lamp that are in the same water as the place, number `i`, or both in air.
    fn straight(&self, i: Option<usize>, place: &Place, occlude: &dyn Occlude, receive: Receive<'_>) {
        let (to, count) = (place.position.as_dvec3(), self.count());
        for n in 0..count {
            let Some(point) = self.point((n, count), place) else { return };
            if self.holder(point.at) != i {
                continue;
            }
            let left = i.map_or(Spectrum::ONE, |i| self.waters[i].left(point.at, to));
            let irradiance = point.facing(place, occlude) * left;
            if let Some(toward) = (point.at - to).as_vec3().try_normalize().filter(|_| !irradiance.is_zero())
            {
                receive(Arrival::Beam { toward, irradiance, radius: None });
            }
        }
    }

    /// How many points its lamp shines from.
    pub(super) fn count(&self) -> u32 {
        if let Source::Area(lamp) = self.source { lamp.samples.max(1) } else { 1 }
    }

    /// Point `i` of `count` of its lamp, for light towards a place.
    pub(super) fn point(&self, (i, count): (u32, u32), to: &Place) -> Option<Point<'_>> {
        match &self.source {
            Source::At(at) => Some(Point::luminaire(*at, &*self.inner)),
            Source::Area(lamp) => Some(Point::part(lamp, (i, count), to)),
            Source::Toward(_) | Source::Around => None,
        }
    }

    /// What arrives at a place under water number `i`.
    fn below(&self, i: usize, at: &At, receive: Receive<'_>) {
        match self.source {
            Source::Around if self.part.has(Part::Through) => {
                let sky = |toward| self.inner.radiance(&above(at.water, toward));
                let window = &self.held[i].window;
                let window =
                    window.get_or_init(|| Window::new(at.water, (self.rules.window, self.rules.still), sky));
                let irradiance = window.irradiance(at.water, (at.place, at.depth), at.occlude);
                if !irradiance.is_zero() {
                    receive(Arrival::Field { irradiance });
                }
            }
            Source::Around => {}
            Source::Toward(toward) => at.sun_below(receive, self, toward),
            Source::At(_) | Source::Area(_) => {
                if self.part.has(Part::Direct) {
                    self.direct_below(i, at, receive);
                }
                at.lamp(receive, self, i);
            }
        }
    }

    /// What comes straight from its lamp to a place under water number `i`.
    fn direct_below(&self, i: usize, at: &At, receive: Receive<'_>) {
        if self.cut {
            return self.straight(Some(i), at.place, at.occlude, receive);
        }
        let Some(lamp) = self.source.lamp() else { return };
        let beside = self.lamp_in.is_none() && at.water.surface.is_below(lamp);
        if self.lamp_in != Some(i) && !beside {
            return;
        }
        let left = at.water.left(lamp, at.place.position.as_dvec3());
        self.inner.arrivals(at.place, at.occlude, &mut |arrival| {
            receive(match arrival {
                Arrival::Beam { toward, irradiance, radius } => {
                    Arrival::Beam { toward, irradiance: irradiance * left, radius }
                }
                Arrival::Field { irradiance } => Arrival::Field { irradiance: irradiance * left },
            });
        });
    }

    /// The sun's light that a view ray gains.
    fn sun_along(&self, i: usize, ray: &ViewRay, occlude: &dyn Occlude) -> Spectrum {
        let (water, held) = (&self.waters[i], &self.held[i]);
        let Some((light, sun)) = &held.sun else { return Spectrum::ZERO };
        let shafts = light.shafts(water, ray, occlude);
        let whole = if shafts.is_empty() {
            Spectrum::ZERO
        } else {
            held.scattering.sun(sun, ray, &[[0.0, ray.length]])
        };
        lit(&held.scattering, sun, ray, (&shafts, whole))
    }

    /// The same of a lamp's.
    fn lamp_along(&self, i: usize, ray: &ViewRay, occlude: &dyn Occlude) -> Spectrum {
        let (water, scattering) = (&self.waters[i], &self.held[i].scattering);
        let Some(lamp) = self.point((0, 1), &within(ray.from, DVec3::Y)) else { return Spectrum::ZERO };
        let ways: &[(Way, Part)] = match self.lamp_in {
            Some(inside) if inside == i => &[(Way::Direct, Part::Direct), (Way::Mirrored, Part::Reflected)],
            None if !water.surface.is_below(lamp.at) => &[(Way::Refracted, Part::Through)],
            _ => &[],
        };
        let beside = Beside { water, scattering, lamp: &lamp, ray, occlude };
        let ways = ways.iter().filter(|(_, part)| self.part.has(*part));
        ways.map(|(way, _)| beside.radiance(*way, self.rules.along)).sum()
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
        if let Some((i, depth)) = self.under(place.position.as_dvec3()) {
            return self.below(i, &At { water: &self.waters[i], place, depth, occlude }, receive);
        }
        if self.part.has(Part::Direct) {
            match (self.cut, self.lamp_in) {
                (true, _) => self.straight(None, place, occlude, receive),
                (false, None) => self.inner.arrivals_on(face, place, occlude, receive),
                (false, Some(_)) => {}
            }
        }
        for i in 0..self.waters.len() {
            self.off(i, place, occlude, receive);
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        if self.part.has(Part::Direct) { self.inner.radiance(ray) } else { Spectrum::ZERO }
    }

    fn scattered(&self, ray: &Ray, occlude: &dyn Occlude) -> Spectrum {
        let Some(i) = filling(&self.waters, ray) else { return Spectrum::ZERO };
        let (water, held) = (&self.waters[i], &self.held[i]);
        if self.rules.scattered == Scattered::Off || water.water.scattering().is_zero() {
            return Spectrum::ZERO;
        }
        let least = held.scattering.coefficient().0.iter().fold(f32::INFINITY, |least, k| least.min(*k));
        let view = ViewRay {
            from: ray.origin.as_dvec3(),
            direction: ray.direction.as_dvec3().normalize(),
            length: f64::from(ray.length).min(DEEP / f64::from(least)).min(FARTHEST),
        };
        match self.source {
            Source::Toward(_) if self.part.has(Part::Through) => self.sun_along(i, &view, occlude),
            Source::Around if self.part.has(Part::Through) => {
                let sky = |toward| self.inner.radiance(&above(water, toward));
                let glow = || Glow::new(held.scattering.clone(), self.rules.shafts, sky);
                held.glow.get_or_init(glow).radiance(water, &view, occlude)
            }
            Source::Toward(_) | Source::Around => Spectrum::ZERO,
            Source::At(_) | Source::Area(_) => self.lamp_along(i, &view, occlude),
        }
    }
}

/// Which of the waters a point is in.
fn holder(waters: &[FlatWater], point: DVec3) -> Option<usize> {
    let depths = waters.iter().map(|water| water.depth(point).filter(|depth| *depth > 0.0));
    let depths = depths.enumerate().filter_map(|(i, depth)| Some((i, depth?)));
    depths.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
}

/// Whether a lamp lies partly above and partly below a water's surface, by its middle.
fn cuts(water: &FlatWater, lamp: &AreaLight) -> bool {
    let reach = match lamp.shape {
        AreaShape::Rectangle { half_u, half_v } => half_u.y.abs() + half_v.y.abs(),
        AreaShape::Sphere { radius } => radius,
    };
    water.depth(lamp.centre.as_dvec3()).is_some_and(|depth| depth.abs() < f64::from(reach))
}

/// A ray to the sky from a water.
fn above(water: &FlatWater, toward: glam::Vec3) -> Ray {
    Ray::new(water.middle().as_vec3(), toward)
}

/// The sun under a water; its irradiance is the same everywhere.
fn sun_below(water: &FlatWater, toward: DVec3, inner: &dyn Illuminate) -> Option<(Parallel, SunBelow)> {
    let facing = Point::luminaire(toward, inner).facing(&on_surface(water.middle(), 0), &Vacuum);
    let sun = SunBelow::new(&water.surface, toward, facing)?;
    Some((Parallel { below: sun.toward, above: toward.normalize_or_zero() }, sun))
}
