//! Looking for light from a point, instead of waiting for chance to meet it.

use glam::DVec3;

use crate::bands::Bands;
use crate::dice::Dice;
use crate::lamp::Lamp;
use crate::tree::Line;
use crate::ways;
use crate::world::World;

/// Lamps that are all looked for at each point; of more, one at a time is.
const FEW: usize = 6;

/// A point from which one looks.
pub(crate) struct Looking<'a> {
    pub(crate) position: DVec3,
    /// Where a line of that direction leaves it.
    pub(crate) leave: &'a dyn Fn(DVec3) -> DVec3,
    /// What of irradiance facing a direction counts, and the density with which the walk goes there itself.
    pub(crate) scatters: &'a dyn Fn(DVec3) -> (Bands, f64),
    /// Whether faces that shine are looked for.
    pub(crate) glow: bool,
}

/// With which probability each of several lamps is looked for.
pub(crate) fn asked(lamps: usize) -> f64 {
    if lamps <= FEW { 1.0 } else { 1.0 / lamps as f64 }
}

impl World {
    /// Light of lamps, sky and faces that shine, as far as a walk from here on does not count it by chance.
    pub(crate) fn look_for_lamps(&self, place: &Looking, dice: &mut Dice) -> Bands {
        let count = self.lamps.len();
        let asked = asked(count);
        let from = if asked < 1.0 { dice.below(count) } else { 0 };
        let lamps = &self.lamps[from..if asked < 1.0 { from + 1 } else { count }];
        let mut sum = Bands::ZERO;
        for lamp in lamps {
            sum += self.look_straight(place, lamp, asked, dice) + self.look_past_water(place, lamp, dice);
        }
        sum * (1.0 / asked) + self.look_at_sky(place, dice) + self.look_at_faces(place, dice)
    }

    /// A lamp, straight.
    fn look_straight(&self, place: &Looking, lamp: &Lamp, asked: f64, dice: &mut Dice) -> Bands {
        let drawn = lamp.draw(place.position, dice);
        let Some(way) = drawn.and_then(|drawn| ways::straight(lamp, &drawn, place.position)) else {
            return Bands::ZERO;
        };
        let (factor, density) = (place.scatters)(way.toward);
        let light = way.irradiance * factor;
        if light.is_zero() {
            return light;
        }
        let met = lamp.met(&Line { origin: place.position, direction: way.toward });
        let weight = met.map_or(1.0, |(_, _, looked)| looked * asked / (looked * asked + density));
        light * self.arrives(&way, (place.leave)(way.toward)) * weight
    }

    /// A lamp, off each water surface and through it: walks that pass one count nothing of it.
    fn look_past_water(&self, place: &Looking, lamp: &Lamp, dice: &mut Dice) -> Bands {
        let mut sum = Bands::ZERO;
        for water in &self.waters {
            let Some(drawn) = lamp.draw_any(place.position, dice) else { continue };
            let mirrored = ways::mirrored(water, lamp, &drawn, place.position);
            for way in mirrored.into_iter().chain(ways::refracted(water, lamp, &drawn, place.position)) {
                let light = way.irradiance * (place.scatters)(way.toward).0;
                if !light.is_zero() {
                    sum += light * self.arrives(&way, (place.leave)(way.toward));
                }
            }
        }
        sum
    }

    fn look_at_sky(&self, place: &Looking, dice: &mut Dice) -> Bands {
        let Some(heaven) = &self.sky else { return Bands::ZERO };
        let (toward, looked) = heaven.draw(dice);
        let (factor, density) = (place.scatters)(toward);
        let light = (heaven.sky)(toward) * factor * (1.0 / (looked + density));
        if light.is_zero() {
            return light;
        }
        let line = Line { origin: (place.leave)(toward), direction: toward };
        light * self.transmittance(line, f64::INFINITY)
    }

    fn look_at_faces(&self, place: &Looking, dice: &mut Dice) -> Bands {
        let Some(glow) = self.glow.as_ref().filter(|_| place.glow) else { return Bands::ZERO };
        let surface = |number: u32| &self.surface(number).0;
        let Some(shining) = glow.draw(&self.shape, surface, place.position, dice) else { return Bands::ZERO };
        let (factor, density) = (place.scatters)(shining.toward);
        let light = shining.radiance * factor * (1.0 / (shining.density + density));
        if light.is_zero() {
            return light;
        }
        let line = Line { origin: (place.leave)(shining.toward), direction: shining.toward };
        light * self.transmittance(line, (shining.length - self.shape.before).max(0.0))
    }
}
