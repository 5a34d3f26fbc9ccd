//! Faces that light passes: of bodies, where it bends, and of panes, where it goes on straight.

use glam::DVec3;
use light::{Medium, fresnel, fresnel_polarised, reflect, refract};

use crate::bands::Bands;
use crate::dice::Dice;
use crate::shape::Point;
use crate::surface::Surface;

/// What becomes of a line at a smooth face.
pub(crate) enum Turn {
    /// It is mirrored.
    Mirrored(DVec3),
    /// It passes bent, with the factor on radiances.
    Bent(DVec3, Bands),
    /// It passes straight.
    Straight(Bands),
    /// What the face scatters itself.
    Matt,
    /// It ends.
    Lost,
}

/// Share of light that passes a pane: two faces and all reflections between them, ½ Σ (1 − r)/(1 + r), times its colour.
pub(crate) fn pane(surface: &Surface, body: &Medium, point: &Point, direction: DVec3) -> Bands {
    let passes = passing(f64::from(body.index), direction.dot(point.smooth).abs());
    surface.colour(point) * (passes * f64::from(body.transmission))
}

fn passing(index: f64, cos: f64) -> f64 {
    fresnel_polarised(index, cos).iter().map(|r| 0.5 * (1.0 - r) / (1.0 + r)).sum()
}

/// What becomes of a line of this direction at the face of a body: each with its probability, so that the factor is the colour's alone,
/// and where it bends (n₁/n₂)² of the sides from which and to which one looks, because radiance is carried.
pub(crate) fn turn(
    surface: &Surface,
    body: &Medium,
    point: &Point,
    direction: DVec3,
    dice: &mut Dice,
) -> Turn {
    let cos = (-direction.dot(point.smooth)).clamp(0.0, 1.0);
    let index = f64::from(body.index);
    let eta = if point.front { index } else { 1.0 / index };
    let mirrored = if body.thin { 1.0 - passing(index, cos) } else { fresnel(eta, cos) };
    if dice.roll() < mirrored {
        let direction = reflect(direction, point.smooth);
        return if direction.dot(point.normal) > 0.0 { Turn::Mirrored(direction) } else { Turn::Lost };
    }
    if dice.roll() >= f64::from(body.transmission) {
        return if point.front || body.thin { Turn::Matt } else { Turn::Lost };
    }
    let colour = surface.colour(point);
    if body.thin {
        return Turn::Straight(colour);
    }
    match refract(direction, point.smooth, eta) {
        Some(bent) if bent.dot(point.normal) < 0.0 => Turn::Bent(bent, colour * (1.0 / (eta * eta))),
        _ => Turn::Lost,
    }
}
