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
const ABOVE: usize = 10;
const BELOW: usize = 5;
/// Azimuths from the sun, over half a turn.
const AZIMUTHS: usize = 6;
/// Places along each ray.
const STATIONS: usize = 10;
/// Orders of scattering that are followed, from the second on.
const ORDERS: usize = 4;
/// Stands for no light where logarithms are taken.
const DARK: f64 = 1e-60;

/// Light that arrives from all around after at least one scattering, by height and sun: what scatters next.
///
/// With L_n the light of order n and P the phase function of molecules or of aerosol:
///
///   S_(n+1) = σ_s ∫ L_n P dω,     L_n = ∫ S_n T ds + T_ground ρ/π E_(n−1)
///
/// L₁ is single scattering with the true phase functions; E_n is what order n gives the ground, E₀ the direct
/// sun. From the second scattering on phase functions count up to their second Legendre polynomial (all of
/// molecules', the gist of aerosol's), so that three moments of L_n over the sphere say all: its mean, ∫ L ω
/// and ∫ L ω ω. The successive orders are followed up to the fifth; what is beyond is a geometric series with
/// the last two orders' ratio. Spherical throughout: over the horizon the sun stands elsewhere.
pub(crate) struct Orders {
    field: Field,
}

/// Moments of radiance over the sphere: Ψ = ∫ L dω/4π, and ∫ L f dω/4π for f = up, sunward, up², sunward², up ·
/// sunward, the cosines of the direction to the vertical and to the horizontal bearing of the sun.
type Moments = [Wide; 6];

/// Moments by height and sun: the first as its logarithm, the others as shares of it.
struct Field {
    /// Altitudes of the sun \[rad\], rising.
    suns: Vec<f64>,
    /// By height, then sun.
    moments: Vec<Vec<Moments>>,
    /// First and second Legendre coefficient of molecules and of aerosol.
    legendre: [[f64; 2]; 2],
}

/// Moments by height and sun, and what comes down on the ground by sun.
struct Order {
    moments: Vec<Vec<Moments>>,
    ground: Vec<Wide>,
}

/// What a ray sees the light of a place by: its height, the sine of the sun's altitude there, and the ray's
/// cosines to the vertical there and to the sun.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    pub(crate) height: f64,
    pub(crate) sun: f64,
    pub(crate) up: f64,
    pub(crate) between: f64,
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
            let term = |k: usize, part: usize, band: usize| orders[k].moments[i][j][part][band];
            // How much the last order counts, with all that would follow.
            let last: Wide = std::array::from_fn(|band| {
                let [before, last] = [ORDERS - 2, ORDERS - 1].map(|k| term(k, 0, band));
                let ratio = if before > 0.0 { (last / before).min(0.9) } else { 0.0 };
                1.0 / (1.0 - ratio)
            });
            std::array::from_fn(|part| {
                std::array::from_fn(|band| {
                    let followed: f64 = (0..ORDERS - 1).map(|k| term(k, part, band)).sum();
                    followed + term(ORDERS - 1, part, band) * last[band]
                })
            })
        };
        let moments: Vec<Vec<Moments>> =
            (0..HEIGHTS.len()).map(|i| (0..suns.len()).map(|j| sum(i, j)).collect()).collect();
        Self { field: Field::new(optics, &suns, &moments) }
    }

    /// ∫ L P dω of molecules and of aerosol, in the direction and at the place that is seen.
    pub(crate) fn at(&self, seen: Seen) -> [Wide; 2] {
        self.field.at(seen)
    }
}

impl Field {
    fn new(optics: &Optics, suns: &[f64], moments: &[Vec<Moments>]) -> Self {
        let share = |moments: &Moments| -> Moments {
            std::array::from_fn(|part| {
                std::array::from_fn(|band| {
                    let mean = moments[0][band].max(DARK);
                    if part == 0 { mean.ln() } else { moments[part][band] / mean }
                })
            })
        };
        Self {
            suns: suns.to_vec(),
            moments: moments.iter().map(|row| row.iter().map(share).collect()).collect(),
            // ¾ (1 + cos²) = 1 + ½ P₂ = 1 + 5 · ⅒ P₂.
            legendre: [[0.0, 0.1], optics.air.aerosol_phase.legendre()],
        }
    }

    /// With m and M the shares ∫Lω/4πΨ and ∫Lωω/4πΨ, v the ray's direction:
    ///
    ///   ∫ L P dω = Ψ (1 + 3 g₁ m·v + 5 g₂ (3 v·M·v − 1)/2)
    fn at(&self, seen: Seen) -> [Wide; 2] {
        let (i, u) = between(&HEIGHTS, seen.height);
        let (j, v) = between(&self.suns, seen.sun.asin());
        let next = (j + 1).min(self.suns.len() - 1);
        let corners = [
            &self.moments[i][j],
            &self.moments[i][next],
            &self.moments[i + 1][j],
            &self.moments[i + 1][next],
        ];
        let shares = [(1.0 - u) * (1.0 - v), (1.0 - u) * v, u * (1.0 - v), u * v];
        // The ray's direction in the place's own frame: up, towards the sun's bearing, and across.
        let cos = (1.0 - seen.sun * seen.sun).max(0.0).sqrt();
        let ahead = if cos > 1e-6 { (seen.between - seen.up * seen.sun) / cos } else { 0.0 };
        let [uu, ss, us] = [seen.up * seen.up, ahead * ahead, seen.up * ahead];
        let pp = (1.0 - uu - ss).max(0.0);
        let mix = |part: usize| -> Wide {
            std::array::from_fn(|band| (0..4).map(|k| corners[k][part][band] * shares[k]).sum())
        };
        let mean = mix(0).map(f64::exp);
        let [up, sunward, up2, sunward2, both] = [mix(1), mix(2), mix(3), mix(4), mix(5)];
        let mut sums = [[0.0; BANDS]; 2];
        for (sum, [g1, g2]) in sums.iter_mut().zip(self.legendre) {
            for band in 0..BANDS {
                let first = up[band] * seen.up + sunward[band] * ahead;
                let across = 1.0 - up2[band] - sunward2[band];
                let second = up2[band] * uu + sunward2[band] * ss + 2.0 * both[band] * us + across * pp;
                // A phase function cut short may fall below zero, light may not.
                sum[band] = mean[band] * (1.0 + 3.0 * g1 * first + 2.5 * g2 * (3.0 * second - 1.0)).max(0.0);
            }
        }
        sums
    }
}

/// e to the value between logarithms, linear in the sun's altitude.
fn interpolate(logs: &[Wide], suns: &[f64], sin: f64) -> Wide {
    let (j, v) = between(suns, sin.asin());
    let next = (j + 1).min(suns.len() - 1);
    std::array::from_fn(|band| (logs[j][band] + v * (logs[next][band] - logs[j][band])).exp())
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

/// The moments of the light along every ray, and E on the horizontal from above.
fn gather(rays: &[Ray], sun: f64, light: impl Fn(&Path, f64) -> Wide) -> (Moments, Wide) {
    let (mut moments, mut ground) = ([[0.0; BANDS]; 6], [0.0; BANDS]);
    let across = (1.0 - sun * sun).max(0.0).sqrt();
    for ray in rays {
        let mu = ray.path.mu;
        let level = (1.0 - mu * mu).max(0.0).sqrt();
        let share = ray.share / AZIMUTHS as f64;
        for k in 0..AZIMUTHS {
            let azimuth = std::f64::consts::PI * (k as f64 + 0.5) / AZIMUTHS as f64;
            let ahead = level * azimuth.cos();
            let radiance = light(&ray.path, mu * sun + ahead * across);
            let factors = [1.0, mu, ahead, mu * mu, ahead * ahead, mu * ahead];
            for (moment, factor) in moments.iter_mut().zip(factors) {
                add(moment, &radiance, &[1.0; BANDS], share * factor);
            }
            add(&mut ground, &radiance, &[1.0; BANDS], share * 4.0 * std::f64::consts::PI * mu.max(0.0));
        }
    }
    (moments, ground)
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
    let field = Field::new(optics, suns, &last.moments);
    let ground: Vec<Wide> = last.ground.iter().map(|wide| wide.map(|x| x.max(DARK).ln())).collect();
    let light = |path: &Path, sun: f64, between: f64| {
        let mut sum = from_ground(optics, path, sun, between, |sin| interpolate(&ground, suns, sin));
        for station in &path.stations {
            let scattered = field.at(path.seen(station, sun, between));
            for (scatter, light) in station.scatter.iter().zip(&scattered) {
                add(&mut sum, scatter, light, 1.0);
            }
        }
        sum
    };
    order(rays, suns, light)
}

fn order(rays: &[Vec<Ray>], suns: &[f64], light: impl Fn(&Path, f64, f64) -> Wide) -> Order {
    let all = rays.iter().map(|rays| {
        let one = |&sun: &f64| gather(rays, sun.sin(), |path, between| light(path, sun.sin(), between));
        suns.iter().map(one).unzip()
    });
    let (moments, ground): (Vec<Vec<Moments>>, Vec<Vec<Wide>>) = all.unzip();
    Order { moments, ground: ground.into_iter().next().unwrap_or_default() }
}
