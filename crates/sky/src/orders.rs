//! Light that air has scattered more than once, or that the ground has sent back.

use light::bands::BANDS;

use crate::air::{Optics, Wide};
use crate::gauss;
use crate::path::{Path, add};
use crate::phase::rayleigh;
use crate::slant::GLOBE;

/// Heights at which light is kept \[m\]; constant above.
const HEIGHTS: [f64; 11] =
    [0.0, 300.0, 900.0, 1800.0, 3200.0, 5500.0, 9000.0, 15_000.0, 24_000.0, 38_000.0, 60_000.0];
/// Altitudes of the sun at which it is kept, relative to the observer's \[degrees\]. A ray reaches places where
/// the sun stands up to 8° lower or higher; from further off comes less than a per mille.
const SUNS: [f64; 11] = [-12.0, -8.0, -5.0, -3.0, -1.5, 0.0, 1.5, 3.0, 5.0, 8.0, 12.0];
/// Cosines to the vertical above the globe's rim, and below it.
const ABOVE: usize = 12;
const BELOW: usize = 5;
/// Azimuths from the sun, over half a turn.
const AZIMUTHS: usize = 8;
/// Places along each ray.
const STATIONS: usize = 12;
/// Orders of scattering that are followed, from the second on.
const ORDERS: usize = 4;
/// Stands for no light where logarithms are taken.
const DARK: f64 = 1e-60;

/// Mean radiance from all around of what has been scattered, by height and sun: what scatters next.
///
/// From the second order on light is taken to be scattered evenly into all directions, by molecules and aerosol alike:
///
///   Ψ_n(h, sun) = (1/4π) ∫ L_(n−1) dω,     L_n = ∫ σ_s Ψ_n T ds + T_ground ρ/π E_(n−1)
///
/// L₁ is single scattering with the true phase functions; E_n is what order n gives the ground, E₀ the direct sun.
/// These successive orders are followed up to the fifth; what is beyond is a geometric series with the last two
/// orders' ratio. Spherical throughout: over the horizon the sun stands elsewhere.
pub(crate) struct Orders {
    /// Altitudes of the sun \[rad\], rising.
    suns: Vec<f64>,
    /// ln of the sum of Ψ over orders, by height, then sun.
    field: Vec<Vec<Wide>>,
}

/// A quantity by height and sun, and what comes down on the ground by sun.
struct Order {
    field: Vec<Vec<Wide>>,
    ground: Vec<Wide>,
}

/// A ray with its share of the sphere.
struct Ray {
    path: Path,
    /// Solid angle/4π of the ring that it stands for.
    share: f64,
}

impl Orders {
    /// For places around one from which the sun stands `altitude` \[rad\] high. Takes some 0.1 s.
    pub(crate) fn new(optics: &Optics, altitude: f64) -> Self {
        let mut suns: Vec<f64> = SUNS
            .iter()
            .map(|offset| {
                (altitude + offset.to_radians())
                    .clamp(-std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2)
            })
            .collect();
        suns.dedup();
        let rays: Vec<Vec<Ray>> = HEIGHTS.iter().map(|&height| rays(optics, GLOBE + height)).collect();
        let mut orders = vec![first(optics, &rays, &suns)];
        for _ in 1..ORDERS {
            let Some(last) = orders.last() else { break };
            let next = next(optics, &rays, &suns, last);
            orders.push(next);
        }
        let sum = |i: usize, j: usize| {
            std::array::from_fn(|band| {
                let term = |k: usize| orders[k].field[i][j][band];
                let (last, before) = (term(ORDERS - 1), term(ORDERS - 2));
                let ratio = if before > 0.0 { (last / before).min(0.9) } else { 0.0 };
                let rest = last * ratio / (1.0 - ratio);
                ((0..ORDERS).map(term).sum::<f64>() + rest).max(DARK).ln()
            })
        };
        let field = (0..HEIGHTS.len()).map(|i| (0..suns.len()).map(|j| sum(i, j)).collect()).collect();
        Self { suns, field }
    }

    /// Ψ where the sun's altitude has the sine `sin`.
    pub(crate) fn at(&self, height: f64, sin: f64) -> Wide {
        interpolate(&self.field, &self.suns, height, sin)
    }
}

/// e to the value between logarithms, linear in height and in the sun's altitude.
fn interpolate(logs: &[Vec<Wide>], suns: &[f64], height: f64, sin: f64) -> Wide {
    let (i, u) = between(&HEIGHTS, height);
    let (j, v) = between(suns, sin.asin());
    let next = (j + 1).min(suns.len() - 1);
    std::array::from_fn(|band| {
        let along = |row: &[Wide]| row[j][band] + v * (row[next][band] - row[j][band]);
        let (low, high) = (along(&logs[i]), along(&logs[i + 1]));
        (low + u * (high - low)).exp()
    })
}

/// Interval of a rising list that `x` lies in, and how far into it; the ends beyond it.
fn between(list: &[f64], x: f64) -> (usize, f64) {
    let index = list.partition_point(|&at| at <= x).saturating_sub(1).min(list.len().saturating_sub(2));
    let (low, high) = (list[index], list[(index + 1).min(list.len() - 1)]);
    (index, if high > low { ((x - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 })
}

/// Rays from a height into all directions: above the globe's rim cosines crowd towards it, as t², where the
/// air is brightest.
fn rays(optics: &Optics, r: f64) -> Vec<Ray> {
    let rim = -((r - GLOBE) * (r + GLOBE)).max(0.0).sqrt() / r;
    let above = gauss::points(ABOVE)
        .into_iter()
        .map(|(t, weight)| (rim + (1.0 - rim) * t * t, (1.0 - rim) * 2.0 * t * weight));
    let below = gauss::points(BELOW)
        .into_iter()
        .map(|(t, weight)| (rim - (1.0 + rim) * t * t, (1.0 + rim) * 2.0 * t * weight));
    above
        .chain(below)
        .map(|(mu, weight)| {
            let path = if r <= GLOBE && mu < 0.0 {
                // On the ground: nothing lies between.
                Path { mu, r, stations: Vec::new(), ground: Some((0.0, [1.0; BANDS])) }
            } else {
                Path::whole(optics, r, mu, STATIONS)
            };
            Ray { path, share: 0.5 * weight }
        })
        .collect()
}

/// ∫ of something along every ray: the mean over the sphere, and E on the horizontal from above.
fn gather(rays: &[Ray], sun: f64, light: impl Fn(&Path, f64) -> Wide) -> [Wide; 2] {
    let mut sums = [[0.0; BANDS]; 2];
    let across = (1.0 - sun * sun).max(0.0).sqrt();
    for ray in rays {
        let mu = ray.path.mu;
        let level = (1.0 - mu * mu).max(0.0).sqrt() * across;
        for k in 0..AZIMUTHS {
            let azimuth = std::f64::consts::PI * (k as f64 + 0.5) / AZIMUTHS as f64;
            let radiance = light(&ray.path, mu * sun + level * azimuth.cos());
            let share = ray.share / AZIMUTHS as f64;
            for band in 0..BANDS {
                sums[0][band] += radiance[band] * share;
                sums[1][band] += radiance[band] * share * 4.0 * std::f64::consts::PI * mu.max(0.0);
            }
        }
    }
    sums
}

/// ρ/π E where a ray meets the ground, of `irradiance` by the sine of the sun's altitude there.
fn from_ground(
    optics: &Optics,
    path: &Path,
    sun: f64,
    between: f64,
    irradiance: impl Fn(f64) -> Wide,
) -> Wide {
    let Some((s, through)) = &path.ground else { return [0.0; BANDS] };
    let mut sum = [0.0; BANDS];
    let light = irradiance(path.sun_at(*s, GLOBE, sun, between));
    add(&mut sum, through, &light, optics.air.ground_albedo / std::f64::consts::PI);
    sum
}

/// Single scattering, and the direct sun on the ground, as they arrive everywhere.
fn first(optics: &Optics, rays: &[Vec<Ray>], suns: &[f64]) -> Order {
    let light = |path: &Path, sun: f64, between: f64| {
        let mut sum = from_ground(optics, path, sun, between, |sin| {
            optics.sunlight(GLOBE, sin).map(|beam| beam * sin.max(0.0))
        });
        let cos = between as f32;
        let phases = [rayleigh(cos), optics.air.aerosol_phase.value(cos)].map(f64::from);
        for station in &path.stations {
            let beam = optics.sunlight(station.r, path.sun_at(station.s, station.r, sun, between));
            for (scatter, phase) in station.scatter.iter().zip(phases) {
                add(&mut sum, scatter, &beam, phase);
            }
        }
        sum
    };
    order(rays, suns, light)
}

/// The order after `last`.
fn next(optics: &Optics, rays: &[Vec<Ray>], suns: &[f64], last: &Order) -> Order {
    let log = |wide: &Wide| wide.map(|x| x.max(DARK).ln());
    let logs: Vec<Vec<Wide>> = last.field.iter().map(|row| row.iter().map(log).collect()).collect();
    let ground = vec![last.ground.iter().map(log).collect::<Vec<Wide>>(); HEIGHTS.len()];
    let light = |path: &Path, sun: f64, between: f64| {
        let mut sum = from_ground(optics, path, sun, between, |sin| interpolate(&ground, suns, 0.0, sin));
        for station in &path.stations {
            let sin = path.sun_at(station.s, station.r, sun, between);
            let field = interpolate(&logs, suns, station.r - GLOBE, sin);
            for scatter in &station.scatter {
                add(&mut sum, scatter, &field, 1.0);
            }
        }
        sum
    };
    order(rays, suns, light)
}

fn order(rays: &[Vec<Ray>], suns: &[f64], light: impl Fn(&Path, f64, f64) -> Wide) -> Order {
    let gathered = |rays: &[Ray]| -> Vec<[Wide; 2]> {
        let one = |&sun: &f64| gather(rays, sun.sin(), |path, between| light(path, sun.sin(), between));
        suns.iter().map(one).collect()
    };
    let all: Vec<Vec<[Wide; 2]>> = rays.iter().map(|rays| gathered(rays)).collect();
    Order {
        ground: all[0].iter().map(|sums| sums[1]).collect(),
        field: all.iter().map(|row| row.iter().map(|sums| sums[0]).collect()).collect(),
    }
}
