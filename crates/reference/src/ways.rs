//! By which ways light of a part of a lamp gets to a point: straight, off a water surface, or through one.

use glam::{DVec2, DVec3};
use light::fresnel;

use crate::bands::Bands;
use crate::lamp::{Aim, Drawn, Lamp};
use crate::tree::Line;
use crate::water::Water;
use crate::world::World;

/// Light that arrives, nothing being in the way yet but the surface itself.
pub(crate) struct Way {
    /// Unit vector towards where it comes from.
    pub(crate) toward: DVec3,
    /// Irradiance on a plane that faces it \[W m⁻² nm⁻¹\].
    pub(crate) irradiance: Bands,
    /// Where it meets the surface on its way; none = nowhere.
    at_surface: Option<DVec3>,
    /// How far it is to that, or to the lamp \[m\].
    length: f64,
    /// From the surface on towards the lamp, and how far.
    onwards: (DVec3, f64),
}

/// Straight.
pub(crate) fn straight(lamp: &Lamp, drawn: &Drawn, to: DVec3) -> Option<Way> {
    let (toward, length, spread) = arriving(drawn.aim, to)?;
    let irradiance = lamp.intensity(drawn.amount, -toward) * spread;
    Some(Way { toward, irradiance, at_surface: None, length, onwards: (toward, 0.0) })
}

/// Direction, distance, and irradiance by intensity, 1/r².
fn arriving(aim: Aim, to: DVec3) -> Option<(DVec3, f64, f64)> {
    match aim {
        Aim::Toward(toward) => Some((toward, f64::INFINITY, 1.0)),
        Aim::At(point) => {
            let length = to.distance(point);
            (length > 0.0).then(|| ((point - to) / length, length, 1.0 / (length * length)))
        }
    }
}

/// Off the surface of a water, both ends being on one side of it.
pub(crate) fn mirrored(water: &Water, lamp: &Lamp, drawn: &Drawn, to: DVec3) -> Option<Way> {
    let above = to.y > water.level;
    let image = match drawn.aim {
        Aim::Toward(toward) if above && toward.y > 0.0 => Aim::Toward(toward.with_y(-toward.y)),
        Aim::At(point) if (point.y > water.level) == above && point.y != water.level => {
            Aim::At(point.with_y(2.0 * water.level - point.y))
        }
        _ => return None,
    };
    let (toward, length, spread) = arriving(image, to)?;
    let first = (water.level - to.y) / toward.y;
    let at = (to + toward * first).with_y(water.level);
    if !(first > 0.0 && first < length && water.covers(DVec2::new(at.x, at.z))) {
        return None;
    }
    let eta = if above { water.index } else { 1.0 / water.index };
    let onwards = toward.with_y(-toward.y);
    let irradiance = lamp.intensity(drawn.amount, -onwards) * (spread * fresnel(eta, toward.y.abs()));
    Some(Way { toward, irradiance, at_surface: Some(at), length: first, onwards: (onwards, length - first) })
}

/// Through the surface of a water, which the ends are on either side of.
pub(crate) fn refracted(water: &Water, lamp: &Lamp, drawn: &Drawn, to: DVec3) -> Option<Way> {
    let above = to.y > water.level;
    // Index of the lamp's side by that of the receiver's.
    let eta = if above { water.index } else { 1.0 / water.index };
    let depth = (to.y - water.level).abs();
    let up = if above { -1.0 } else { 1.0 };
    match drawn.aim {
        Aim::Toward(onwards) => {
            if above || onwards.y <= 0.0 {
                return None;
            }
            let toward =
                (onwards.with_y(0.0) * eta).with_y((1.0 - eta * eta * (1.0 - onwards.y * onwards.y)).sqrt());
            let at = (to + toward * (depth / toward.y)).with_y(water.level);
            let passes = 1.0 - fresnel(water.index, onwards.y);
            // What falls on the level surface falls on level planes below it.
            let irradiance = lamp.intensity(drawn.amount, -onwards) * (passes * onwards.y / toward.y);
            let onwards = (onwards, f64::INFINITY);
            covered(
                water,
                Way { toward, irradiance, at_surface: Some(at), length: depth / toward.y, onwards },
            )
        }
        Aim::At(point) => {
            let height = up * (point.y - water.level);
            if !(height > 0.0 && depth > 0.0) {
                return None;
            }
            let across = DVec2::new(point.x - to.x, point.z - to.z);
            let apart = across.length();
            let sin = bend(height, depth, eta, apart);
            let (c1, c2) = ((1.0 - sin * sin).sqrt(), (1.0 - eta * eta * sin * sin).sqrt());
            if !(c1 > 0.0 && c2 > 0.0) {
                return None;
            }
            let side = across.try_normalize().unwrap_or(DVec2::X);
            let toward = DVec3::new(side.x * eta * sin, up * c2, side.y * eta * sin);
            let onwards = DVec3::new(side.x * sin, up * c1, side.y * sin);
            let at = (to + toward * (depth / c2)).with_y(water.level);
            // A ring of rays dΩ = sin θ₁ dθ₁ dφ falls on ρ dρ dφ of the level plane and a share c₂ of that across the rays:
            // E/I = 1/(c₂ (ρ/sin θ₁) dρ/dθ₁), dθ₂/dθ₁ = η c₁/c₂.
            let ring = height / c1 + depth * eta / c2;
            let widening = height / (c1 * c1) + depth * eta * c1 / (c2 * c2 * c2);
            let passes = 1.0 - fresnel(1.0 / eta, c1);
            let irradiance = lamp.intensity(drawn.amount, -onwards) * (passes / (c2 * ring * widening));
            let onwards = (onwards, height / c1);
            covered(water, Way { toward, irradiance, at_surface: Some(at), length: depth / c2, onwards })
        }
    }
}

fn covered(water: &Water, way: Way) -> Option<Way> {
    way.at_surface.is_some_and(|at| water.covers(DVec2::new(at.x, at.z))).then_some(way)
}

/// sin θ₁ at the lamp of the ray that gets from `height` over the surface to `depth` beyond it and `apart` across:
/// ρ(θ₁) = height tan θ₁ + depth tan θ₂ rises, so halving finds it; to the last digit.
fn bend(height: f64, depth: f64, eta: f64, apart: f64) -> f64 {
    if apart <= 0.0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0f64, (1.0 / eta).min(1.0));
    let reach = |sin: f64| {
        let sin2 = eta * sin;
        height * sin / (1.0 - sin * sin).max(0.0).sqrt() + depth * sin2 / (1.0 - sin2 * sin2).max(0.0).sqrt()
    };
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if reach(middle) < apart { low = middle } else { high = middle }
    }
}

impl World {
    /// What of a way's light arrives at its end, which leaves its face from `origin`.
    pub(crate) fn arrives(&self, way: &Way, origin: DVec3) -> Bands {
        let line = Line { origin, direction: way.toward };
        let Some(at) = way.at_surface else {
            let length = way.length - if way.length.is_finite() { self.shape.before } else { 0.0 };
            return self.transmittance(line, length.max(0.0));
        };
        let below =
            self.transmittance(line, (way.length - 2.0 * self.shape.off / way.toward.y.abs()).max(0.0));
        if below.is_zero() {
            return below;
        }
        let (direction, length) = way.onwards;
        let line = Line { origin: at + DVec3::Y * direction.y.signum() * self.shape.off, direction };
        below * self.transmittance(line, (length - self.shape.before).max(0.0))
    }
}
