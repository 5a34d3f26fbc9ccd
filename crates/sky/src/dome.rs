//! The sky as a light source, with the ground that lies under it.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;
use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum};

use crate::open_sky::OpenSky;
use crate::sampling::{lattice, shift, transmit};
use crate::sky::lifted;
use crate::sky_cells::SkyCells;
use crate::{Pattern, diffuse_illuminance};

/// Keeps the sky's random choices apart from those of other sources.
const PURPOSE: u32 = 0xD0;

/// Correlated colour temperature of the clear sky's light \[K\]: stands in for the spectral model.
pub const CLEAR_TEMPERATURE: f64 = 10_000.0;
/// Correlated colour temperature of the overcast and the uniform sky's light \[K\] (CIE D65).
pub const OVERCAST_TEMPERATURE: f64 = 6_500.0;
/// Reflectance of an ordinary ground of grass and soil.
pub const GROUND_ALBEDO: f32 = 0.2;
/// Directions asked for at each place; the noise this leaves is at [`Description::samples`].
pub const SAMPLES: u32 = 64;

/// What a [`Dome`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description {
    /// How luminance is spread over the sky.
    pub pattern: Pattern,
    /// Unit vector towards the sun; below the horizon is night or twilight.
    pub toward_sun: Vec3,
    /// Diffuse illuminance of the open sky on the horizontal \[lx\], ≥ 0; none = [`diffuse_illuminance`].
    pub illuminance: Option<f32>,
    /// Irradiance of the direct sun on the horizontal \[W m⁻² nm⁻¹\], which lights the ground as well.
    pub sun_horizontal: Spectrum,
    /// Reflectance of the ground, within \[0, 1\]; grey.
    pub albedo: f32,
    /// Height y of the ground \[m\]: what is lower does not hide the ground's light. None = the ground is far
    /// below, and any ground of the scene's own hides it. A little above the scene's own ground is right.
    pub ground_height: Option<f32>,
    /// Directions asked for at each place, ≥ 1; cost grows in proportion, noise falls as samples^(−3/4).
    ///
    /// Under a clear sky 16, 48, 64 and 256 leave 6, 2.7, 2.3 and 0.7 % of what arrives (root mean square, mean
    /// over planes and suns) behind an upright edge that hides the sun's side, and up to twice as much where a
    /// sixth of the light is left; 12, 5, 4 and 1.3 % behind slanted eaves; 20, 9, 7 and 2 % in a slit 16° wide.
    /// Under an overcast sky it is about four fifths of that. The example `noise` lists all cases.
    pub samples: u32,
}

impl Description {
    /// A sky of its own brightness over an ordinary ground, without the sun's light on that ground.
    pub fn new(pattern: Pattern, toward_sun: Vec3) -> Self {
        Self {
            pattern,
            toward_sun,
            illuminance: None,
            sun_horizontal: Spectrum::ZERO,
            albedo: GROUND_ALBEDO,
            ground_height: None,
            samples: SAMPLES,
        }
    }
}

/// The light of the whole sky, and of the ground below the horizon.
///
/// *Brightness.* L(direction) = L_z · pattern, with L_z such that the open sky gives the horizontal the stated
/// illuminance. One spectrum for the whole sky, that of daylight of [`CLEAR_TEMPERATURE`] or
/// [`OVERCAST_TEMPERATURE`]: a placeholder until the sky has a spectral model.
///
/// *Ground.* Directions below the horizon see an endless matt ground, open to the whole sky and sun:
/// L_g = albedo · (E_sky + E_sun)/π, everywhere the same, without anyone's shadow on it.
///
/// *Occlusion.* With T_i the transmittance along `samples` directions ω_i in front of the place, spread evenly
/// over shares of the light (sky and ground in cells of 5.6° and less, each chosen by nearly its share of the
/// irradiance; density p) and moved by the place's seed, and E_open the exact irradiance of an open place of
/// that normal:
///
///   E = E_open · Σ w_i T_i / Σ w_i,   w_i = L_i cos_i / p_i,   for the sky and for the ground by themselves
///
/// Open places are therefore free of noise. As every ratio of estimates it is biased, by O(1/samples): with 48
/// and more by less than the mean of 400 seeds can show (0.1 to 0.7 % of what arrives). A part that no direction
/// has met counts as hidden as the other. The result stays within \[0, E_open\].
///
/// ```
/// use glam::Vec3;
/// use light::{Illuminate, Place, Vacuum};
/// use keikan_sky::{Description, Dome, Pattern};
/// let sky = Dome::new(&Description { illuminance: Some(10_000.0), ..Description::new(Pattern::Overcast, Vec3::Y) });
/// let lawn = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 1 };
/// let lux = sky.irradiance(&lawn, &Vacuum).luminance();
/// assert!((lux / 10_000.0 - 1.0).abs() < 1e-5); // rounding: an open place is exact
/// ```
#[derive(Clone, Debug)]
pub struct Dome {
    pattern: Pattern,
    toward_sun: Vec3,
    /// The pattern's shape at the zenith, inverted.
    per_zenith: f32,
    zenith: Spectrum,
    ground: Spectrum,
    ground_height: f32,
    samples: u32,
    open: OpenSky,
    cells: SkyCells,
}

impl Dome {
    /// The sky that `description` describes. Takes some 25 ms, mostly for the table of open planes.
    pub fn new(description: &Description) -> Self {
        let Description { pattern, toward_sun, samples, .. } = *description;
        let altitude = f64::from(toward_sun.y.clamp(-1.0, 1.0)).asin().to_degrees();
        let own = || diffuse_illuminance(pattern, altitude) as f32;
        let illuminance = description.illuminance.unwrap_or_else(own).max(0.0);
        let temperature = match pattern {
            Pattern::Clear => CLEAR_TEMPERATURE,
            Pattern::Overcast | Pattern::Uniform => OVERCAST_TEMPERATURE,
        };
        let horizontal = Spectrum::light_of_temperature(temperature) * illuminance;
        let open = OpenSky::new(pattern, toward_sun);
        let zenith = horizontal * (1.0 / open.horizontal());
        let ground =
            (horizontal + description.sun_horizontal) * (description.albedo.clamp(0.0, 1.0) * FRAC_1_PI);
        Self {
            pattern,
            toward_sun: lifted(toward_sun),
            per_zenith: 1.0 / pattern.shape(Vec3::Y, lifted(toward_sun)),
            zenith,
            ground,
            ground_height: description.ground_height.unwrap_or(f32::NEG_INFINITY),
            samples: samples.max(1),
            open,
            cells: SkyCells::new(pattern, toward_sun, [zenith.mean(), ground.mean()]),
        }
    }

    /// Radiance at the zenith \[W m⁻² sr⁻¹ nm⁻¹\].
    pub fn zenith_radiance(&self) -> Spectrum {
        self.zenith
    }

    /// Radiance of the ground \[W m⁻² sr⁻¹ nm⁻¹\].
    pub fn ground_radiance(&self) -> Spectrum {
        self.ground
    }

    /// Irradiance of sky and ground on the plane of unit `normal` with nothing in the way \[W m⁻² nm⁻¹\].
    pub fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        self.zenith * self.open.on_plane(normal) + self.ground_irradiance(normal)
    }

    /// The ground's share of it: π L_g (1 − cos tilt)/2.
    fn ground_irradiance(&self, normal: Vec3) -> Spectrum {
        self.ground * (PI * (0.5 - 0.5 * normal.y).clamp(0.0, 1.0))
    }

    /// Luminance along a direction that is not below the horizon, per that at the zenith.
    fn relative(&self, direction: Vec3) -> f32 {
        self.pattern.shape(direction, self.toward_sun) * self.per_zenith
    }

    /// The ray from `place` to where light comes from: the sky, or the ground.
    fn ray(&self, place: &Place, direction: Vec3) -> Ray {
        let fall = place.position.y - self.ground_height;
        let length = if direction.y < 0.0 && fall >= 0.0 { fall / -direction.y } else { f32::INFINITY };
        place.leave(direction, length)
    }

    /// Directions around `place` where light comes from: the sky's (0) and the ground's (1), each with what it
    /// counts among its own.
    fn directions(&self, place: &Place) -> impl Iterator<Item = (Vec3, usize, f32)> {
        let offset = shift(place.seed, PURPOSE);
        let (normal, facing) = (place.normal, self.cells.facing(place.normal));
        (0..self.samples).filter_map(move |i| {
            let (direction, part, per_density) = facing.choose(lattice(i, self.samples, offset))?;
            let cosine = direction.dot(normal);
            let luminance = if part == 0 { self.relative(direction) } else { 1.0 };
            (cosine > 0.0).then_some((direction, part, luminance * cosine * per_density))
        })
    }

    /// Share of the sky's and of the ground's light that arrives at `place`.
    fn visible(&self, place: &Place, occlude: &dyn Occlude) -> [Spectrum; 2] {
        let rays = self
            .directions(place)
            .map(|(direction, part, weight)| (self.ray(place, direction), (part, weight)));
        let (mut through, mut open) = ([Spectrum::ZERO; 2], [0.0f32; 2]);
        transmit(occlude, rays, |(part, weight), transmittance| {
            through[part] += transmittance * weight;
            open[part] += weight;
        });
        // A part so small that no direction met it is taken to be as hidden as the other.
        let share = |part: usize| match part {
            part if open[part] > 0.0 => through[part] * (1.0 / open[part]),
            _ if open[1 - part] > 0.0 => through[1 - part] * (1.0 / open[1 - part]),
            _ => Spectrum::ZERO,
        };
        // Rounding of the two sums must not let more through than there is.
        [share(0), share(1)].map(|share| share.map(|band| band.min(1.0)))
    }
}

impl Illuminate for Dome {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        if self.zenith.is_zero() && self.ground.is_zero() {
            return;
        }
        let [sky, ground] = self.visible(place, occlude);
        let from_sky = self.zenith * self.open.on_plane(place.normal) * sky;
        let irradiance = from_sky + self.ground_irradiance(place.normal) * ground;
        if !irradiance.is_zero() {
            receive(Arrival::Field { irradiance });
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        if ray.direction.y < 0.0 { self.ground } else { self.zenith * self.relative(ray.direction) }
    }
}

#[cfg(test)]
mod tests;
