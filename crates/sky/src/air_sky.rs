//! The sky as light scattered by air.

use std::f32::consts::FRAC_2_PI;
use std::f64::consts::FRAC_PI_2;

use glam::Vec3;
use light::Spectrum;
use light::bands::BANDS;
use rayon::prelude::*;

use crate::Sky;
use crate::air::{Air, Optics, Wide};
use crate::orders::Orders;
use crate::path::{Path, add};
use crate::phase::{Lobes, rayleigh};
use crate::sky::lifted;
use crate::slant::GLOBE;

/// Rows of the table over the direction's altitude h, which are even in √h: closest at the horizon.
const ROWS: usize = 64;
/// Columns over (1 − cos azimuth)/2 from the sun, even.
const COLUMNS: usize = 48;
/// Places along each ray.
const STATIONS: usize = 32;

/// The sky as light that molecules and aerosol scatter towards an observer (thesis 4.15, repaired):
///
///   L = ∫ [σ_R P_R(θ) + ϖ σ_A P_A(θ)] I_sun e^(−τ(s) − τ(s′)) ds + ∫ S e^(−τ(s)) ds
///
/// s from the observer to the place of scattering, s′ from there to the sun, through a round atmosphere, and S
/// what is scattered there that has been scattered before or comes from the ground. θ is the same along the
/// whole ray, so that a table keeps the three integrals without their phase functions: they vary slowly over
/// the sky, and the sun's bright surroundings are exact.
///
/// The table is bilinear in logarithms between 64 altitudes and 48 azimuths: within 0.2 % of the integrals by day,
/// 1 % with the sun on the horizon and below. One wavelength for each band leaves 0.5 % against spectra in steps of
/// 5 nm under suns from 20° up, under one at 5° 4 % in the bluest, of luminance 0.2 %. Single scattering is within
/// 1 % of a plain sum by day (3 % by dusk), and irradiance on the ground within 2 % of what single paths of light,
/// followed one by one, bring there under suns from 5° up; so the tests find. Deep twilight has no such reference
/// here. A sky takes some 0.3 s to make with multiple scattering, 0.05 s without.
#[derive(Clone, Debug)]
pub struct AirSky {
    /// Not below the horizon, for `brightest`.
    brightest: Vec3,
    toward_sun: Vec3,
    /// Unit horizontal vector towards the sun's azimuth.
    ahead: Vec3,
    phase: Lobes,
    /// By row and column: once scattered by molecules and by aerosol, without the phase functions, and the rest; as
    /// logarithms, after `floor` was added.
    table: Vec<[[Spectrum; 3]; COLUMNS]>,
    /// What is next to nothing in each of the three.
    floor: [Spectrum; 3],
}

impl AirSky {
    /// The sky over an observer `elevation_m` above the sea, 0 to 50 000, under a sun at `toward_sun` (a unit
    /// vector, at any depth below the horizon).
    pub fn new(air: &Air, toward_sun: Vec3, elevation_m: f64) -> Self {
        Self::with(&Optics::new(air), toward_sun, elevation_m)
    }

    fn with(optics: &Optics, toward_sun: Vec3, elevation_m: f64) -> Self {
        let r = GLOBE + elevation_m.clamp(0.0, 50_000.0);
        let sun = altitude(toward_sun);
        let orders = optics.air.multiple.then(|| Orders::new(optics, sun));
        let row = |row: usize| {
            let mu = (FRAC_PI_2 * (row as f64 / (ROWS - 1) as f64).powi(2)).sin();
            let whole = Path::rising(optics, r, mu, 0.0, STATIONS);
            std::array::from_fn(|column| {
                let across = 1.0 - 2.0 * column as f64 / (COLUMNS - 1) as f64;
                let between = mu * sun.sin() + (1.0 - mu * mu).sqrt() * sun.cos() * across;
                let view = View { optics, orders: orders.as_ref(), sun: sun.sin(), between };
                view.integrals(&whole).map(|wide| Spectrum(wide.map(|x| x as f32)))
            })
        };
        let mut table: Vec<[[Spectrum; 3]; COLUMNS]> = (0..ROWS).into_par_iter().map(row).collect();
        let floor = floor(&table);
        for cell in table.iter_mut().flatten() {
            for (part, floor) in cell.iter_mut().zip(floor) {
                *part = (*part + floor).map(f32::ln);
            }
        }
        let brightest = lifted(toward_sun);
        Self {
            brightest,
            toward_sun,
            ahead: Vec3::new(brightest.x, 0.0, brightest.z).try_normalize().unwrap_or(Vec3::NEG_Z),
            phase: optics.air.aerosol_phase,
            table,
            floor,
        }
    }
}

/// A millionth of the largest value of each part and band: where the globe's shadow ends a logarithm needs one.
fn floor(table: &[[[Spectrum; 3]; COLUMNS]]) -> [Spectrum; 3] {
    std::array::from_fn(|part| {
        let largest = table.iter().flatten().fold(Spectrum::ZERO, |largest, cell| {
            Spectrum(std::array::from_fn(|band| largest[band].max(cell[part][band])))
        });
        largest.map(|x| (1e-6 * x).max(f32::MIN_POSITIVE))
    })
}

/// Altitude of a unit vector \[rad\].
fn altitude(v: Vec3) -> f64 {
    let [x, y, z] = v.to_array().map(f64::from);
    y.atan2(x.hypot(z)).clamp(-FRAC_PI_2, FRAC_PI_2)
}

/// A ray under a sun.
struct View<'a> {
    optics: &'a Optics,
    orders: Option<&'a Orders>,
    /// Sine of the sun's altitude at the observer.
    sun: f64,
    /// Cosine between ray and sun.
    between: f64,
}

impl View<'_> {
    /// The three integrals along a ray that rises from the observer.
    fn integrals(&self, whole: &Path) -> [Wide; 3] {
        let lit = self.lit_from(whole);
        let [molecules, aerosol] = if lit == 0.0 {
            self.once(whole)
        } else if lit < 1.0 {
            self.once(&Path::rising(self.optics, whole.r, whole.mu, lit, STATIONS))
        } else {
            [[0.0; BANDS]; 2]
        };
        [molecules, aerosol, self.again(whole)]
    }

    /// Light scattered once by molecules and by aerosol, without the phase functions.
    fn once(&self, path: &Path) -> [Wide; 2] {
        let mut sums = [[0.0; BANDS]; 2];
        for station in &path.stations {
            let sun = path.sun_at(station.s, station.r, self.sun, self.between);
            let beam = self.optics.sunlight(station.r, sun);
            sums.iter_mut().zip(&station.scatter).for_each(|(sum, scatter)| add(sum, scatter, &beam, 1.0));
        }
        sums
    }

    /// Light scattered more often, or from the ground.
    fn again(&self, path: &Path) -> Wide {
        let mut sum = [0.0; BANDS];
        let Some(orders) = self.orders else { return sum };
        for station in &path.stations {
            let scattered = orders.at(path.seen(station, self.sun, self.between));
            station
                .scatter
                .iter()
                .zip(&scattered)
                .for_each(|(scatter, light)| add(&mut sum, scatter, light, 1.0));
        }
        sum
    }

    /// Where the ray leaves the globe's shadow, by t of [`Path::rising`]: 0 when it starts in the light, 1 when it
    /// stays dark. Once out it stays out.
    fn lit_from(&self, path: &Path) -> f64 {
        let lit = |t: f64| {
            let rise = (GLOBE + self.optics.air.top - path.r) * t.powi(4);
            let level = path.r * path.mu;
            let square = rise * (2.0 * path.r + rise);
            let s = (level * level + square).sqrt() - level;
            let r = path.r + rise;
            Optics::risen(r, path.sun_at(s, r, self.sun, self.between)) > 0.0
        };
        if lit(0.0) {
            return 0.0;
        }
        if !lit(1.0) {
            return 1.0;
        }
        let [mut dark, mut light] = [0.0, 1.0];
        for _ in 0..40 {
            let middle = 0.5 * (dark + light);
            *(if lit(middle) { &mut light } else { &mut dark }) = middle;
        }
        dark
    }
}

impl Sky for AirSky {
    fn radiance(&self, direction: Vec3) -> Spectrum {
        let direction = lifted(direction);
        let up = (direction.y.min(1.0).asin() * FRAC_2_PI).sqrt() * (ROWS - 1) as f32;
        // (1 − cos azimuth)/2, any at the zenith.
        let level = direction.x.hypot(direction.z);
        let cos = if level > 0.0 { direction.dot(self.ahead) / level } else { 0.0 };
        let around = (0.5 - 0.5 * cos).clamp(0.0, 1.0) * (COLUMNS - 1) as f32;
        let (i, j) = ((up as usize).min(ROWS - 2), (around as usize).min(COLUMNS - 2));
        let (u, v) = (up - i as f32, around - j as f32);
        let corners = [[i, j], [i, j + 1], [i + 1, j], [i + 1, j + 1]].map(|[i, j]| &self.table[i][j]);
        let shares = [(1.0 - u) * (1.0 - v), (1.0 - u) * v, u * (1.0 - v), u * v];
        let between = direction.dot(self.toward_sun);
        let phases = [rayleigh(between), self.phase.value(between), 1.0];
        let part = |part: usize| {
            let mut log = Spectrum::ZERO;
            for (corner, share) in corners.iter().zip(shares) {
                log = corner[part].mul_add(Spectrum::splat(share), log);
            }
            (log.map(f32::exp) - self.floor[part]).map(|x| x.max(0.0)) * phases[part]
        };
        part(0) + part(1) + part(2)
    }

    fn brightest(&self) -> Vec3 {
        self.brightest
    }
}

#[cfg(test)]
mod tests;
