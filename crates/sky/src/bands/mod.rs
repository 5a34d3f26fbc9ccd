//! The sky's light by bands (Nishita and Nakamae 1986), which the receiving cuboid replaces.

mod shadow;
mod table;

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Vec3};
use light::bands::BANDS as SPECTRAL;
use light::{Arrival, Bodies, Geometry, Illuminate, Occlude, Place, Ray, Spectrum};

use shadow::{Interval, Shadows};
use table::Table;

use crate::Description;
use crate::cuboid::is_soft;
use crate::ground::Surround;
use crate::lru::Lru;
use crate::obstacles::Obstacles;
use crate::open_sky::OpenSky;
use crate::sampling::transmit;

/// Bands of the dome; what they cost and leave is at [`BandSky`].
pub const BANDS: u32 = 40;

/// Tables that are kept: one for each normal used last.
const TABLES: usize = 64;

/// The light of sky and ground by half circles across the dome in front of the place, each the middle of a band.
///
/// With the normal n and two axes a, b in the place's plane, a band is what lies between two half planes through a; its middle
/// half circle is D(α) = a cos α + (b cos θ + n sin θ) sin α, 0 < α < π. Bands are equally wide where they are projected onto the plane:
/// cos θ_j = −1 + (2j + 1)/N. With dω cos ξ = sin² α sin θ dα dθ every band counts alike,
///
///   E = (2/N) Σ_j ∫ H_j(α) L_j(α) sin² α dα
///
/// and H is 1 but on the stretches of the half circle that faces hide: the plane of the half circle cuts a triangle in a straight segment,
/// whose ends give a stretch from α_1 to α_2. Exact along the half circle, blind across. Running integrals along it, a table for
/// each normal (of exactly these three numbers), turn what is left open into differences. `a` is horizontal.
///
/// Ground, solid and soft things, grazing faces: as [`crate::CuboidSky`] has them; where soft things alone are in the way, rays are asked
/// every 1.5° along the half circle. Its seed does not matter. Boxes of things that no middle of a band meets are passed over; hidden
/// things are not: the time grows with all that is on any half circle.
///
/// *Where it is wrong.* What lies between two half circles is not seen, and what is on one counts for the whole band.
/// Among 400 houses 10, 20, 40 and 80 leave 0.85, 0.33, 0.13 and 0.04 % of what an open lawn receives under an overcast sky, 40 of them in
/// seven times the time of a cuboid that leaves as much, and among 100 000 houses in 30 (clear) to 180 (overcast) times (the bench
/// `cuboid`).
pub struct BandSky {
    around: Surround,
    count: usize,
    solid: Obstacles,
    soft: Obstacles,
    tables: Lru<[u32; 3], Table>,
}

/// The axes of a place's plane and its normal: rows a, b, n.
pub(crate) fn plane_from_world(normal: Vec3) -> DMat3 {
    let n = normal.as_dvec3();
    let a = DVec3::Y.cross(n).try_normalize().filter(|_| n.x.hypot(n.z) > 1e-6).unwrap_or(DVec3::X);
    DMat3::from_cols(a, n.cross(a), n).transpose()
}

impl BandSky {
    /// The sky that `description` describes (its `samples` do not matter) among the things of `geometry` and `bodies`, in
    /// `count` ≥ 1 bands.
    pub fn new(
        description: &Description,
        geometry: &Geometry,
        bodies: Option<&dyn Bodies>,
        count: u32,
    ) -> Self {
        Self {
            around: Surround::new(description, &OpenSky::new(&*description.sky)),
            count: count.clamp(1, 1 << 16) as usize,
            solid: Obstacles::new(geometry, |mesh| !is_soft(mesh), None),
            soft: Obstacles::new(geometry, is_soft, bodies),
            tables: Lru::new(TABLES),
        }
    }

    /// Irradiance on the plane of unit `normal` with nothing in the way, as the bands sum it \[W m⁻² nm⁻¹\].
    pub fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        let table = self.table(normal);
        let all = (0..self.count).map(|band| table.between(band, 0.0, PI));
        self.spectrum(all.fold([0.0; SPECTRAL], add))
    }

    fn table(&self, normal: Vec3) -> std::sync::Arc<Table> {
        let key = normal.to_array().map(f32::to_bits);
        self.tables.of(key, || Table::new(&self.around, plane_from_world(normal), self.count))
    }

    /// 2/N of a sum over bands.
    fn spectrum(&self, sum: [f64; SPECTRAL]) -> Spectrum {
        Spectrum(sum.map(|value| (value.max(0.0) * (2.0 / self.count as f64)) as f32))
    }

    /// The stretches that `obstacles` hide from a place, by band and in order.
    fn hidden(&self, place: &Place, obstacles: &Obstacles) -> Vec<Interval> {
        let origin = place.leave(place.normal, f32::INFINITY).origin.as_dvec3();
        let rise = origin.y - f64::from(place.position.y);
        let floor = self.around.fall(place).map_or(f64::NEG_INFINITY, |fall| -f64::from(fall) - rise);
        // Rounding of what was computed in the world's coordinates.
        let error = f64::from(place.error) + 8.0 * f64::EPSILON * origin.abs().max_element();
        let frame = plane_from_world(place.normal);
        let mut shadows = Shadows::new(frame * DVec3::Y, self.count, floor, error);
        obstacles.walk(frame, origin, &mut shadows);
        shadows.sorted()
    }
}

fn add(sum: [f64; SPECTRAL], more: [f64; SPECTRAL]) -> [f64; SPECTRAL] {
    std::array::from_fn(|band| sum[band] + more[band])
}

/// Calls `receive` with band, start and end of every stretch that none of the `hidden` (in order) covers.
fn open_stretches(hidden: &[Interval], count: usize, mut receive: impl FnMut(usize, f64, f64)) {
    let mut next = hidden.iter().peekable();
    for band in 0..count {
        let mut reached = 0.0f64;
        while let Some(interval) = next.next_if(|interval| interval.band as usize == band) {
            if interval.from > reached {
                receive(band, reached, interval.from);
            }
            reached = reached.max(interval.to);
        }
        if reached < PI {
            receive(band, reached, PI);
        }
    }
}

/// Distance between rays along a half circle \[rad\].
const RAYS: f64 = PI / 120.0;

impl Illuminate for BandSky {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let table = self.table(place.normal);
        let mut hidden = self.hidden(place, &self.solid);
        let mut through = Spectrum::ZERO;
        if !self.soft.is_empty() {
            let solid = hidden.clone();
            let soft = self.hidden(place, &self.soft);
            hidden.extend(&soft);
            hidden.sort_by(Interval::order);
            // Soft alone: open among the solid, without what is open among all.
            let mut asked = Vec::new();
            open_stretches(&solid, self.count, |band, from, to| {
                let pieces = ((to - from) / RAYS).ceil().max(1.0);
                for piece in 0..pieces as usize {
                    let at = |k: f64| from + (to - from) * ((piece as f64 + k) / pieces);
                    asked.push((band, at(0.0), at(1.0)));
                }
            });
            let rays = asked.into_iter().flat_map(|piece| alone(&soft, piece)).map(|(band, from, to)| {
                let direction = table.direction(band, 0.5 * (from + to));
                (self.around.ray(place, direction), self.spectrum(table.between(band, from, to)))
            });
            transmit(occlude, rays, |weight, transmittance| through += transmittance * weight);
        }
        let mut sum = [0.0; SPECTRAL];
        open_stretches(&hidden, self.count, |band, from, to| sum = add(sum, table.between(band, from, to)));
        let irradiance = self.spectrum(sum) + through;
        if !irradiance.is_zero() {
            receive(Arrival::Field { irradiance });
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.around.radiance(ray.direction)
    }
}

/// What of a piece (band, from, to) lies in the union of `soft` (in order).
fn alone(soft: &[Interval], (band, from, to): (usize, f64, f64)) -> Vec<(usize, f64, f64)> {
    let start = soft.partition_point(|interval| (interval.band as usize) < band);
    let (mut reached, mut covered) = (from, Vec::new());
    for interval in soft[start..].iter().take_while(|i| i.band as usize == band && i.from < to) {
        let (first, last) = (interval.from.max(reached), interval.to.min(to));
        if last > first {
            covered.push((band, first, last));
            reached = last;
        }
    }
    covered
}

#[cfg(test)]
mod tests;
