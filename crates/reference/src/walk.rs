//! One random walk of light, backwards: what it finds is the radiance along a line on average (Kajiya 1986).

use glam::DVec3;
use light::{fresnel, reflect, refract};

use crate::bands::Bands;
use crate::dice::Dice;
use crate::glass::{self, Turn};
use crate::lamp::Lamp;
use crate::look::{Looking, asked};
use crate::shape::{Face, Point};
use crate::surface::{Local, Surface};
use crate::tree::Line;
use crate::water::Water;
use crate::world::World;

/// Turns that a walk takes for sure; afterwards it goes on with a probability of what is left of it.
const SURE: u32 = 4;
/// Largest probability to go on.
const LIKELY: f64 = 0.95;
/// How what a walk meets of a lamp counts, so that nothing counts twice that was looked for on the way already.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Since {
    /// From the eye: it sees the sun, and no lamp itself.
    Eye,
    /// From a point where lamps were looked for, whose direction had this density: both ways to find the same light share it by the
    /// balance heuristic (Veach 1997).
    Scattered(DVec3, f64),
    /// From such a point through, or off, one water surface: lamps were looked for on that way too.
    Covered,
    /// By a mirror, a body or several water surfaces: nobody has looked there.
    Free,
}

/// A walk on its way.
pub(crate) struct Walk<'a> {
    pub(crate) world: &'a World,
    pub(crate) dice: &'a mut Dice,
    /// How many faces may send light to each other on its way; none = as many as do.
    pub(crate) limit: Option<u32>,
    pub(crate) line: Line,
    pub(crate) since: Since,
    found: Bands,
    /// What of radiance found from here on is added.
    share: Bands,
    /// That have scattered it so far.
    faces: u32,
    turns: u32,
    /// Absorption of the glass that it is in \[1/m\].
    glass: Bands,
}

impl<'a> Walk<'a> {
    pub(crate) fn new(
        world: &'a World,
        line: Line,
        since: Since,
        limit: Option<u32>,
        dice: &'a mut Dice,
    ) -> Self {
        let (found, share, glass) = (Bands::ZERO, Bands::ONE, Bands::ZERO);
        Self { world, dice, limit, line, since, found, share, faces: 0, turns: 0, glass }
    }

    /// Radiance that comes back along the line \[W m⁻² sr⁻¹ nm⁻¹\], right on average.
    pub(crate) fn radiance(mut self) -> Bands {
        while self.step() && self.goes_on() {}
        self.found
    }

    /// Goes to what is met next; false where the walk ends.
    fn step(&mut self) -> bool {
        let meeting = self.world.shape.nearest(&self.line, f64::INFINITY);
        let far = meeting.map_or(f64::INFINITY, |met| met.distance());
        let water = self.world.water_along(&self.line, far);
        let flight = water.and_then(|water| self.flight(water)).filter(|flight| *flight < far);
        self.lamps_along(flight.unwrap_or(far), water);
        if let (Some(water), Some(flight)) = (water, flight) {
            return self.scatter(water, flight);
        }
        self.share *= self.glass.attenuate(far);
        self.share *= water.map_or(Bands::ONE, |water| passed(water, far));
        let Some(meeting) = meeting else {
            if let Some(sky) = &self.world.sky {
                let toward = self.line.direction;
                let weight = self.shared(|_| sky.density(toward));
                self.found += self.share * (sky.sky)(toward) * weight;
            }
            return false;
        };
        let point = self.world.shape.point(&self.line, &meeting);
        match point.face {
            Face::Side => self.pass(&point),
            Face::Surface(number) => self.surface(number, &point),
            Face::Thing { .. } | Face::Solid => {
                let opacity = self.world.shape.opacity(&meeting);
                match opacity < 1.0 && self.dice.roll() >= opacity {
                    true => self.pass(&point),
                    false => self.thing(&point),
                }
            }
        }
    }

    /// Russian roulette.
    fn goes_on(&mut self) -> bool {
        self.turns += 1;
        if self.turns <= SURE {
            return true;
        }
        let stays = self.share.largest().min(LIKELY);
        let goes = self.dice.roll() < stays;
        if goes {
            self.share *= 1.0 / stays;
        }
        goes
    }

    /// Straight on.
    fn pass(&mut self, point: &Point) -> bool {
        self.line = self.world.shape.leave(point, self.line.direction);
        true
    }

    /// Where a lamp's light was not looked for, what of it lies before `far` is added.
    fn lamps_along(&mut self, far: f64, water: Option<&Water>) {
        let lamps = &self.world.lamps;
        let asked = asked(lamps.len());
        for lamp in lamps {
            let (origin, weigh) = match (self.since, lamp) {
                (Since::Covered, _) => continue,
                (Since::Eye, lamp) if !matches!(lamp, Lamp::Sun { .. }) => continue,
                (Since::Scattered(origin, density), _) => (origin, Some(density)),
                _ => (self.line.origin, None),
            };
            let Some((t, radiance, looked)) = lamp.met(&Line { origin, ..self.line }) else { continue };
            let t = t - origin.distance(self.line.origin);
            if t <= 0.0 || (t > far || (t.is_infinite() && far.is_finite())) {
                continue;
            }
            let weight = weigh.map_or(1.0, |density| density / (density + looked * asked));
            let left = self.glass.attenuate(t) * water.map_or(Bands::ONE, |water| passed(water, t));
            self.found += self.share * left * radiance * weight;
        }
    }

    /// How far light flies in a water before it is scattered, for a band drawn at random; none in water that does not scatter.
    fn flight(&mut self, water: &Water) -> Option<f64> {
        let scattering = water.scattering();
        if scattering.is_zero() {
            return None;
        }
        let extinction = water.extinction().0;
        let own = extinction[self.dice.below(extinction.len())];
        let flight = -(1.0 - self.dice.roll()).ln() / own;
        // A band that loses nothing flies for ever.
        Some(flight).filter(|flight| flight.is_finite())
    }

    /// Scattered in the water after `flight`.
    fn scatter(&mut self, water: &Water, flight: f64) -> bool {
        let extinction = water.extinction();
        let left = extinction.attenuate(flight);
        let density = (extinction * left).mean();
        let scattering = water.scattering();
        let arrived = self.line.at(flight);
        if density <= 0.0 {
            return false;
        }
        self.share *= left * (1.0 / density);
        let along = self.line.direction;
        let shares: Vec<f64> =
            water.scatterers.iter().map(|(own, _)| own.mean() / scattering.mean()).collect();
        // Phase functions are about the direction that light goes on in, which a walk comes from.
        let scatters = |toward: DVec3| {
            let cos = along.dot(toward);
            let parts = water.scatterers.iter().zip(&shares);
            parts.fold((Bands::ZERO, 0.0), |(sum, density), ((own, phase), share)| {
                (sum + *own * phase.value(cos), density + share * phase.density(cos))
            })
        };
        self.look_for_lamps(arrived, &|_| arrived, &scatters, 0);
        let mut choice = self.dice.roll();
        let mut chosen = shares.len() - 1;
        for (i, share) in shares.iter().enumerate() {
            if choice < *share {
                chosen = i;
                break;
            }
            choice -= share;
        }
        let toward = water.scatterers[chosen].1.draw(along, self.dice);
        let (value, density) = scatters(toward);
        self.share *= value * (1.0 / density);
        self.line = Line { origin: arrived, direction: toward };
        self.since = Since::Scattered(arrived, density);
        true
    }

    /// At the surface of a water.
    fn surface(&mut self, number: usize, point: &Point) -> bool {
        let index = self.world.waters[number].index;
        let direction = self.line.direction;
        let eta = if direction.y < 0.0 { index } else { 1.0 / index };
        let mirrored = fresnel(eta, direction.y.abs());
        let normal = if direction.y < 0.0 { DVec3::Y } else { DVec3::NEG_Y };
        let onwards = if self.dice.roll() < mirrored {
            reflect(direction, normal)
        } else {
            let Some(bent) = refract(direction, normal, eta) else { return false };
            // Radiance over n² stays what it is.
            self.share *= 1.0 / (eta * eta);
            bent
        };
        self.since = match self.since {
            Since::Scattered(..) => Since::Covered,
            _ => Since::Free,
        };
        self.line = self.world.shape.leave(point, onwards);
        true
    }

    /// At a face of a thing.
    fn thing(&mut self, point: &Point) -> bool {
        let (surface, boundary) = self.world.surface(point.surface);
        if self.may_send(0) {
            self.glow(surface, point);
        }
        if let Some(body) = &surface.body {
            match glass::turn(surface, body, point, self.line.direction, self.dice) {
                Turn::Mirrored(direction) => return self.turned(point, direction),
                Turn::Bent(direction, factor) => {
                    self.share *= factor;
                    self.glass = match point.front {
                        true => Bands::from(body.absorption),
                        false => Bands::ZERO,
                    };
                    return self.turned(point, direction);
                }
                Turn::Straight(factor) => {
                    self.share *= factor;
                    return self.pass(point);
                }
                Turn::Lost => return false,
                Turn::Matt => {}
            }
        }
        if !self.may_send(0) {
            return false;
        }
        let local = Local::new(surface, boundary, point);
        let out = -self.line.direction;
        let shape = &self.world.shape;
        let leave = |toward: DVec3| shape.leave(point, toward).origin;
        self.look_for_lamps(point.position, &leave, &|toward| local.evaluate(out, toward), 1);
        let Some(look) = local.look(out, self.dice) else { return false };
        self.share *= look.weight;
        self.faces += 1;
        self.line = self.world.shape.leave(point, look.toward);
        self.since = match look.density {
            Some(density) => Since::Scattered(self.line.origin, density),
            None => Since::Free,
        };
        true
    }

    fn turned(&mut self, point: &Point, direction: DVec3) -> bool {
        self.line = self.world.shape.leave(point, direction);
        self.since = Since::Free;
        true
    }

    /// What a face emits, as far as nobody has looked for it yet.
    fn glow(&mut self, surface: &Surface, point: &Point) {
        let emitted = surface.emitted(point);
        if emitted.is_zero() || (surface.shown_only && !matches!(self.since, Since::Eye)) {
            return;
        }
        let toward = self.line.direction;
        let weight = match &self.world.glow {
            // Nobody looks for bodies that shine.
            Some(glow) if point.face != Face::Solid => {
                self.shared(|origin| glow.density(surface, point, toward, origin.distance(point.position)))
            }
            _ => 1.0,
        };
        self.found += self.share * emitted * weight;
    }

    /// The share of what is met that the walk may count, where it has been looked for with a density from the last point.
    fn shared(&self, looked: impl Fn(DVec3) -> f64) -> f64 {
        match self.since {
            Since::Scattered(origin, density) => density / (density + looked(origin)),
            _ => 1.0,
        }
    }

    /// Whether a face may send light that so many more faces scatter before what the walk has found already.
    fn may_send(&self, more: u32) -> bool {
        self.limit.is_none_or(|limit| self.faces + more < limit)
    }

    fn look_for_lamps(
        &mut self,
        position: DVec3,
        leave: &dyn Fn(DVec3) -> DVec3,
        scatters: &dyn Fn(DVec3) -> (Bands, f64),
        faces: u32,
    ) {
        let place = Looking { position, leave, scatters, glow: self.may_send(faces) };
        let found = self.world.look_for_lamps(&place, self.dice);
        self.found += self.share * found;
    }
}

/// What flies over a stretch of water, by the probability that it does.
fn passed(water: &Water, length: f64) -> Bands {
    let left = water.extinction().attenuate(length);
    match water.scattering().is_zero() {
        true => left,
        false => {
            let flies = left.mean();
            if flies > 0.0 { left * (1.0 / flies) } else { Bands::ZERO }
        }
    }
}
