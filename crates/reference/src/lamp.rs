//! What shines: points, areas, the sun's disc; and how one looks for them from a point.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use light::Distribution;

use crate::bands::Bands;
use crate::dice::Dice;
use crate::tree::Line;

/// A source of light that hides nothing.
pub enum Lamp {
    /// A point.
    Point {
        /// Where \[m\].
        position: DVec3,
        /// From the lamp's frame to the world, a rotation.
        world_from_lamp: DMat3,
        /// Intensity over direction \[cd\].
        distribution: Distribution,
        /// Intensity per candela \[W sr⁻¹ nm⁻¹ cd⁻¹\].
        spectrum: Bands,
    },
    /// A parallelogram centre ± u ± v of one radiance, that shines to the side of u × v.
    Rectangle {
        /// Its middle \[m\].
        centre: DVec3,
        /// To the middle of a side \[m\].
        half_u: DVec3,
        /// To the middle of a neighbouring side \[m\].
        half_v: DVec3,
        /// \[W m⁻² sr⁻¹ nm⁻¹\].
        radiance: Bands,
    },
    /// A sphere of one radiance, that shines outwards.
    Sphere {
        /// Its middle \[m\].
        centre: DVec3,
        /// Radius \[m\].
        radius: f64,
        /// \[W m⁻² sr⁻¹ nm⁻¹\].
        radiance: Bands,
    },
    /// A disc of one radiance, infinitely far away; what of it is below the horizon is dark.
    Sun {
        /// Unit vector towards its middle.
        toward: DVec3,
        /// Angular radius \[rad\]; 0 = a point.
        radius: f64,
        /// Irradiance of the whole disc on a plane that faces it \[W m⁻² nm⁻¹\].
        irradiance: Bands,
    },
}

/// What of a lamp is looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Aim {
    /// In this direction, infinitely far away.
    Toward(DVec3),
    /// At this point.
    At(DVec3),
}

/// How much of it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Amount {
    /// Irradiance on a plane that faces it.
    Facing(Bands),
    /// Radiance × area, on the side of this normal, which counts with its cosine.
    Area(Bands, DVec3),
    /// Radiance × area of a point of a sphere about this centre: likewise, and no point is its own back.
    Point,
}

/// A part of a lamp, drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn {
    pub(crate) aim: Aim,
    pub(crate) amount: Amount,
}

impl Lamp {
    /// A part of it as seen from `from`; none that shines there.
    pub(crate) fn draw(&self, from: DVec3, dice: &mut Dice) -> Option<Drawn> {
        match *self {
            Self::Point { position, .. } => Some(Drawn { aim: Aim::At(position), amount: Amount::Point }),
            Self::Rectangle { centre, half_u, half_v, radiance } => {
                let [u, v] = dice.pair().map(|x| 2.0 * x - 1.0);
                let across = half_u.cross(half_v);
                let at = centre + half_u * u + half_v * v;
                let amount = Amount::Area(radiance * (4.0 * across.length()), across.normalize_or_zero());
                Some(Drawn { aim: Aim::At(at), amount })
            }
            Self::Sphere { centre, radius, radiance } => {
                // From afar only the cap that faces the point is looked at: where the normal's cosine to the way back is above r/d.
                let away = from - centre;
                let distance = away.length();
                let height = if distance > radius { 1.0 - radius / distance } else { return None };
                let normal = dice.cone(away / distance, height);
                let area = TAU * radius * radius * height;
                Some(Drawn {
                    aim: Aim::At(centre + normal * radius),
                    amount: Amount::Area(radiance * area, normal),
                })
            }
            Self::Sun { toward, radius, irradiance } => {
                let (height, share) = disc(radius);
                let direction = if height > 0.0 { dice.cone(toward, height) } else { toward };
                let amount = Amount::Facing(irradiance * share);
                (direction.y > 0.0).then_some(Drawn { aim: Aim::Toward(direction), amount })
            }
        }
    }

    /// The same where the way bends: any part of it, since the caps that face a point are others there.
    pub(crate) fn draw_any(&self, from: DVec3, dice: &mut Dice) -> Option<Drawn> {
        let Self::Sphere { centre, radius, radiance } = *self else { return self.draw(from, dice) };
        let normal = dice.cone(DVec3::Y, 2.0);
        let amount = Amount::Area(radiance * (4.0 * PI * radius * radius), normal);
        Some(Drawn { aim: Aim::At(centre + normal * radius), amount })
    }

    /// Intensity of what was drawn along a unit vector away from it \[W sr⁻¹ nm⁻¹\].
    pub(crate) fn intensity(&self, amount: Amount, away: DVec3) -> Bands {
        match (amount, self) {
            (Amount::Facing(irradiance), _) => irradiance,
            (Amount::Area(power, normal), _) => power * normal.dot(away).max(0.0),
            (Amount::Point, Self::Point { world_from_lamp, distribution, spectrum, .. }) => {
                let local = world_from_lamp.transpose() * away;
                *spectrum * f64::from(distribution.intensity(local.as_vec3()))
            }
            (Amount::Point, _) => Bands::ZERO,
        }
    }

    /// What a line meets of it: where, its radiance, and the density with which [`Self::draw`] finds that direction from the line's
    /// origin \[1/sr\]. Points are not met.
    pub(crate) fn met(&self, line: &Line) -> Option<(f64, Bands, f64)> {
        match *self {
            Self::Point { .. } => None,
            Self::Rectangle { centre, half_u, half_v, radiance } => {
                let across = half_u.cross(half_v);
                let facing = -line.direction.dot(across);
                let t = (line.origin - centre).dot(across) / facing;
                let at = line.at(t) - centre;
                // Coordinates along u and v, which need not be at right angles.
                let u = at.cross(half_v).dot(across) / across.length_squared();
                let v = half_u.cross(at).dot(across) / across.length_squared();
                let density = t * t / (4.0 * facing);
                (facing > 0.0 && t > 0.0 && u.abs() <= 1.0 && v.abs() <= 1.0)
                    .then_some((t, radiance, density))
            }
            Self::Sphere { centre, radius, radiance } => {
                let to = centre - line.origin;
                let distance = to.length();
                let along = to.dot(line.direction);
                let beside = radius * radius - (to - line.direction * along).length_squared();
                if distance <= radius || along <= 0.0 || beside < 0.0 {
                    return None;
                }
                let t = along - beside.sqrt();
                let normal = (line.at(t) - centre) / radius;
                let area = TAU * radius * radius * (1.0 - radius / distance);
                let cos = -normal.dot(line.direction);
                (cos > 0.0).then_some((t, radiance, t * t / (cos * area)))
            }
            Self::Sun { toward, radius, irradiance } => {
                let (height, share) = disc(radius);
                // Half the chord: sin of half the angle between both.
                let half = 0.5 * line.direction.distance(toward);
                let within = height > 0.0 && 2.0 * half * half <= height && line.direction.y > 0.0;
                let angle = TAU * height;
                within.then(|| (f64::INFINITY, irradiance * (share / angle), 1.0 / angle))
            }
        }
    }
}

/// 1 − cos of a disc's radius, and its irradiance, drawn evenly by solid angle, by that of the whole on a plane that faces it:
/// 2π (1 − cos r)/(π sin² r) = 2/(1 + cos r).
fn disc(radius: f64) -> (f64, f64) {
    let height = 2.0 * (0.5 * radius).sin().powi(2);
    (height, 2.0 / (2.0 - height))
}
