//! The sky as a light source, with the ground that lies under it.

use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

use glam::Vec3;
use light::{Arrival, Illuminate, Occlude, Place, Ray, Spectrum};

use crate::Sky;
use crate::ground::Surround;
use crate::open_sky::OpenSky;
use crate::sampling::{lattice, shift, transmit};
use crate::sky_cells::{Shares, SkyCells};

/// Keeps the sky's random choices apart from those of other sources.
const PURPOSE: u32 = 0xD0;

/// Reflectance of an ordinary ground of grass and soil.
pub const GROUND_ALBEDO: f32 = 0.2;
/// Directions asked for at each place; the noise this leaves is at [`Description::samples`].
pub const SAMPLES: u32 = 64;

/// What a [`Dome`] is made from.
#[derive(Clone)]
pub struct Description {
    /// Its light.
    pub sky: Arc<dyn Sky>,
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
    /// A sky over an ordinary ground, without the sun's light on that ground.
    pub fn new(sky: Arc<dyn Sky>) -> Self {
        Self {
            sky,
            sun_horizontal: Spectrum::ZERO,
            albedo: GROUND_ALBEDO,
            ground_height: None,
            samples: SAMPLES,
        }
    }
}

/// The light of the whole sky, and of the ground below the horizon.
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
/// band by band, L_i looked up in parts of cells 0.9° × 1.4° wide. Open places are therefore free of noise. As every ratio of estimates it is biased, by O(1/samples): with 48
/// and more by less than the mean of 400 seeds can show (0.1 to 0.7 % of what arrives). A part that no direction
/// has met counts as hidden as the other. The result stays within \[0, E_open\].
///
/// ```
/// use glam::Vec3;
/// use light::{Illuminate, Place, Vacuum};
/// use keikan_sky::{Conditions, Description, Dome, Model, Scale};
/// let overcast = Model::named("overcast").unwrap();
/// let conditions = Conditions { scale: Scale::Horizontal(10_000.0), ..Conditions::new(Vec3::Y) };
/// let sky = Dome::new(&Description::new(overcast.sky(&conditions)));
/// let lawn = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 1 };
/// let lux = sky.irradiance(&lawn, &Vacuum).luminance();
/// assert!((lux / 10_000.0 - 1.0).abs() < 1e-5); // rounding: an open place is exact
/// ```
#[derive(Clone)]
pub struct Dome {
    around: Surround,
    samples: u32,
    open: OpenSky,
    cells: SkyCells,
    /// For places that both sides of matter.
    all_around: Shares,
}

impl Dome {
    /// The sky that `description` describes. Asks the sky for 39 000 directions and takes some 15 ms besides,
    /// mostly for the table of open planes.
    pub fn new(description: &Description) -> Self {
        let sky = &*description.sky;
        let open = OpenSky::new(sky);
        let around = Surround::new(description, &open);
        let mean = open.horizontal().luminance() * FRAC_1_PI;
        let cells = SkyCells::new(sky, mean, around.ground.luminance());
        Self { all_around: cells.all_around(), cells, around, samples: description.samples.max(1), open }
    }

    /// Radiance at the zenith \[W m⁻² sr⁻¹ nm⁻¹\].
    pub fn zenith_radiance(&self) -> Spectrum {
        self.around.sky.radiance(Vec3::Y)
    }

    /// Radiance of the ground \[W m⁻² sr⁻¹ nm⁻¹\].
    pub fn ground_radiance(&self) -> Spectrum {
        self.around.ground
    }

    /// Irradiance of sky and ground on the plane of unit `normal` with nothing in the way \[W m⁻² nm⁻¹\].
    pub fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        self.open.on_plane(normal) + self.around.ground_irradiance(normal)
    }

    /// Share of the sky's (0) and of the ground's light (1) that arrives at `place`.
    fn visible(&self, place: &Place, occlude: &dyn Occlude) -> [Spectrum; 2] {
        let offset = shift(place.seed, PURPOSE);
        let facing = self.cells.facing(place.normal);
        let rays = (0..self.samples).filter_map(|i| {
            let (direction, sky, per_density) =
                self.cells.choose(&facing, lattice(i, self.samples, offset))?;
            let cosine = direction.dot(place.normal);
            let weight = sky.unwrap_or(Spectrum::ONE) * (cosine * per_density);
            (cosine > 0.0).then(|| (self.around.ray(place, direction), (usize::from(sky.is_none()), weight)))
        });
        let mut seen = Seen::default();
        transmit(occlude, rays, |(part, weight), transmittance| seen.add(part, weight, transmittance));
        seen.shares()
    }

    /// The same for the place's plane and for its other side, of twice as many directions chosen for both together.
    fn visible_on_both_sides(&self, place: &Place, occlude: &dyn Occlude) -> [[Spectrum; 2]; 2] {
        let (offset, count, flipped) =
            (shift(place.seed, PURPOSE), self.samples.saturating_mul(2), place.flipped());
        let rays = (0..count).filter_map(|i| {
            let (direction, sky, per_density) =
                self.cells.choose(&self.all_around, lattice(i, count, offset))?;
            let cosine = direction.dot(place.normal);
            let weight = sky.unwrap_or(Spectrum::ONE) * (cosine.abs() * per_density);
            let from = if cosine < 0.0 { &flipped } else { place };
            let part = usize::from(sky.is_none());
            Some((self.around.ray(from, direction), (usize::from(cosine < 0.0), part, weight)))
        });
        let mut seen = [Seen::default(), Seen::default()];
        transmit(occlude, rays, |(side, part, weight), transmittance| {
            seen[side].add(part, weight, transmittance)
        });
        seen.map(|seen| seen.shares())
    }

    fn irradiance_by(&self, normal: Vec3, [sky, ground]: [Spectrum; 2]) -> Spectrum {
        self.open.on_plane(normal) * sky + self.around.ground_irradiance(normal) * ground
    }
}

/// What arrives and what would, of the sky (0) and of the ground (1).
#[derive(Default)]
struct Seen {
    through: [Spectrum; 2],
    open: [Spectrum; 2],
}

impl Seen {
    fn add(&mut self, part: usize, weight: Spectrum, transmittance: Spectrum) {
        self.through[part] += transmittance * weight;
        self.open[part] += weight;
    }

    /// Share of either that arrives.
    fn shares(&self) -> [Spectrum; 2] {
        // A part so small that no direction met it is taken to be as hidden as the other. Rounding of the two
        // sums must not let more through than there is.
        let share = |part: usize, band: usize| match [part, 1 - part]
            .map(|k| (self.through[k][band], self.open[k][band]))
        {
            [(through, open), _] if open > 0.0 => (through / open).min(1.0),
            [_, (through, open)] if open > 0.0 => (through / open).min(1.0),
            _ => 0.0,
        };
        [0, 1].map(|part| Spectrum(std::array::from_fn(|band| share(part, band))))
    }
}

impl Illuminate for Dome {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        if self.open.on_plane(place.normal).is_zero() && self.around.ground.is_zero() {
            return;
        }
        let irradiance = self.irradiance_by(place.normal, self.visible(place, occlude));
        if !irradiance.is_zero() {
            receive(Arrival::Field { irradiance });
        }
    }

    /// By directions chosen by the sky's light alone, whatever the plane, half of which serve either side: where many leaves ask,
    /// no table of shares has to be made for each.
    fn both_sides(&self, place: &Place, occlude: &dyn Occlude) -> [Spectrum; 2] {
        let [front, back] = self.visible_on_both_sides(place, occlude);
        [self.irradiance_by(place.normal, front), self.irradiance_by(-place.normal, back)]
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.around.radiance(ray.direction)
    }
}

#[cfg(test)]
mod tests;
