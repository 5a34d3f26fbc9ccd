//! Points that lamps shine from.

use glam::{DVec3, Vec3};
use light::sampling::{disc, lattice, shift};
use light::{AreaLight, AreaShape, Arrival, Illuminate, Occlude, Place, Spectrum};

/// What sets of points are for, among those that share a seed.
const PURPOSE: u32 = 0x1A3F;

/// A point that shines: a luminaire, or one of those that stand for a lamp with an extent.
pub(super) struct Point<'a> {
    /// Where \[m\].
    pub(super) at: DVec3,
    shines: Shines<'a>,
}

enum Shines<'a> {
    /// As this source says itself.
    AsItSays(&'a dyn Illuminate),
    /// As a part of a luminous area: L A \[W sr⁻¹ nm⁻¹\] of it, A \[m²\], and where a flat one faces.
    Part { intensity: Spectrum, area: f32, facing: Option<Vec3> },
}

/// What arrives in beams at a place, on planes that face them \[W m⁻² nm⁻¹\].
pub(crate) fn beams_on(source: &dyn Illuminate, place: &Place, occlude: &dyn Occlude) -> Spectrum {
    let mut sum = Spectrum::ZERO;
    source.arrivals(place, occlude, &mut |arrival| {
        if let Arrival::Beam { irradiance, .. } = arrival {
            sum += irradiance;
        }
    });
    sum
}

impl<'a> Point<'a> {
    /// A luminaire.
    pub(super) fn luminaire(at: DVec3, says: &'a dyn Illuminate) -> Self {
        Self { at, shines: Shines::AsItSays(says) }
    }

    /// Part `i` of `count` of a luminous area, for light towards the place `to`, whose seed moves all of them: points of a rectangle, or of the
    /// disc that `to` sees of a sphere. One alone is the middle.
    pub(super) fn part(lamp: &AreaLight, (i, count): (u32, u32), to: &Place) -> Self {
        let [x, y] = match count {
            1 => [0.5; 2],
            _ => lattice(i, count, shift(to.seed, PURPOSE)),
        };
        let share = 1.0 / count as f32;
        let (offset, area, facing) = match lamp.shape {
            AreaShape::Rectangle { half_u, half_v } => {
                let offset = half_u * (2.0 * x - 1.0) + half_v * (2.0 * y - 1.0);
                (offset, lamp.area() * share, Some(half_u.cross(half_v).normalize_or_zero()))
            }
            AreaShape::Sphere { radius } => {
                let toward = (to.position - lamp.centre).try_normalize().unwrap_or(Vec3::Y);
                let (a, b) = toward.any_orthonormal_pair();
                let [p, q] = if count == 1 { [0.0; 2] } else { disc([x, y]) };
                // The disc that is seen of it is a fourth of its surface.
                ((a * p + b * q) * radius, 0.25 * lamp.area() * share, None)
            }
        };
        let at = (lamp.centre + offset).as_dvec3();
        Self { at, shines: Shines::Part { intensity: lamp.radiance * area, area, facing } }
    }

    /// Irradiance on a plane at `place` that faces it \[W m⁻² nm⁻¹\], on the side of the place's normal, past what is in the way.
    ///
    /// Of a part of an area L A cos/(d² + A/π): what a disc gives on its axis, and bounded by π L.
    pub(super) fn facing(&self, place: &Place, occlude: &dyn Occlude) -> Spectrum {
        match &self.shines {
            Shines::AsItSays(source) => beams_on(*source, place, occlude),
            Shines::Part { intensity, area, facing } => {
                let way = self.at.as_vec3() - place.position;
                let distance2 = way.length_squared();
                let Some(toward) = way.try_normalize() else { return Spectrum::ZERO };
                let cos = facing.map_or(1.0, |facing| -facing.dot(toward));
                if cos <= 0.0 || toward.dot(place.normal) <= 0.0 {
                    return Spectrum::ZERO;
                }
                let seen = occlude.transmittance(&place.toward(self.at.as_vec3()));
                *intensity * seen * (cos / (distance2 + area * std::f32::consts::FRAC_1_PI))
            }
        }
    }
}
