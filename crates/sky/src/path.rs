//! A ray through the air, as the points of a quadrature.

use light::bands::BANDS;

use crate::air::{Optics, Wide};
use crate::gauss;
use crate::orders::Seen;
use crate::slant::GLOBE;

/// A place on a ray where it picks up scattered light.
pub(crate) struct Station {
    /// Distance along the ray \[m\].
    pub(crate) s: f64,
    /// Distance from the globe's centre \[m\].
    pub(crate) r: f64,
    /// Quadrature weight times scattering coefficient times what comes through to the ray's start: of molecules
    /// and of aerosol.
    pub(crate) scatter: [Wide; 2],
}

/// A ray, with what it ends on.
pub(crate) struct Path {
    /// Cosine to the vertical at the start.
    pub(crate) mu: f64,
    /// Distance of the start from the globe's centre \[m\].
    pub(crate) r: f64,
    pub(crate) stations: Vec<Station>,
    /// Where it meets the ground \[m\], and what comes through from there.
    pub(crate) ground: Option<(f64, Wide)>,
}

/// A place on a rising ray: distance from its foot, from the globe's centre, and the step between places \[m\].
struct Step {
    x: f64,
    r: f64,
    dx: f64,
}

/// Points of Gauss along a ray that rises from distance `r` at cosine `mu` ≥ 0 up to distance `end`, between two
/// values of t, 0 at the foot and 1 at the end.
///
/// Heights are foot + (end − foot) t⁴: then x is smooth in t even where the ray is level (x ∝ t²), and the lowest,
/// densest air has most points.
fn climb(r: f64, mu: f64, end: f64, [from, to]: [f64; 2], count: usize) -> Vec<Step> {
    let rule = gauss::points(count);
    let span = (end - r).max(0.0);
    let level = r * mu;
    let place = |&(node, weight): &(f64, f64)| {
        let t = from + (to - from) * node;
        let rise = span * t.powi(4);
        let square = rise * (2.0 * r + rise);
        let root = (level * level + square).sqrt();
        let slope = if root > 0.0 { (r + rise) / root } else { 0.0 };
        Step {
            x: if root > 0.0 { square / (level + root) } else { 0.0 },
            r: r + rise,
            dx: slope * 4.0 * span * t.powi(3) * weight * (to - from),
        }
    };
    rule.iter().map(place).collect()
}

impl Path {
    /// The part from t₀ on (see [`climb`]) of a ray that rises to the top of the air.
    pub(crate) fn rising(optics: &Optics, r: f64, mu: f64, start: f64, count: usize) -> Self {
        let whole = optics.columns(r, mu);
        let steps = climb(r, mu, (GLOBE + optics.air.top).max(r), [start, 1.0], count);
        let stations = steps.iter().map(|step| {
            let ahead = optics.columns(step.r, (r * mu + step.x) / step.r);
            station(optics, step.x, step, &optics.transmittance(&whole.less(ahead)))
        });
        Self { mu, r, stations: stations.collect(), ground: None }
    }

    /// The whole ray from distance `r` at any cosine `mu` to the vertical.
    pub(crate) fn whole(optics: &Optics, r: f64, mu: f64, count: usize) -> Self {
        if mu >= 0.0 {
            return Self::rising(optics, r, mu, 0.0, count);
        }
        let lowest = r * (1.0 - mu * mu).max(0.0).sqrt();
        if lowest <= GLOBE {
            Self::falling(optics, r, mu, lowest, count)
        } else {
            Self::passing(optics, r, mu, lowest, count)
        }
    }

    /// One that falls to the ground.
    fn falling(optics: &Optics, r: f64, mu: f64, lowest: f64, count: usize) -> Self {
        let foot = ((GLOBE - lowest) * (GLOBE + lowest)).max(0.0).sqrt();
        let length = -r * mu - foot;
        // The same ray from its other end.
        let behind = optics.columns(r, -mu);
        let stations = climb(GLOBE, foot / GLOBE, r, [0.0, 1.0], count);
        let stations = stations.iter().map(|step| {
            let back = optics.columns(step.r, (foot + step.x) / step.r);
            station(optics, length - step.x, step, &optics.transmittance(&back.less(behind)))
        });
        let through = optics.transmittance(&optics.columns(GLOBE, foot / GLOBE).less(behind));
        Self { mu, r, stations: stations.collect(), ground: Some((length, through)) }
    }

    /// One that passes above the ground: down to its lowest point, and up again.
    fn passing(optics: &Optics, r: f64, mu: f64, lowest: f64, count: usize) -> Self {
        let length = -r * mu;
        let (behind, turn) = (optics.columns(r, -mu), optics.columns(lowest, 0.0));
        let down = climb(lowest, 0.0, r, [0.0, 1.0], count);
        let up = climb(lowest, 0.0, GLOBE + optics.air.top, [0.0, 1.0], count);
        let down = down.iter().map(|step| {
            let back = optics.columns(step.r, step.x / step.r);
            station(optics, length - step.x, step, &optics.transmittance(&back.less(behind)))
        });
        let whole = turn.plus(turn).less(behind);
        let up = up.iter().map(|step| {
            let ahead = optics.columns(step.r, step.x / step.r);
            station(optics, length + step.x, step, &optics.transmittance(&whole.less(ahead)))
        });
        Self { mu, r, stations: down.chain(up).collect(), ground: None }
    }

    /// What the ray sees of a station, the sun at cosine `sun` to the vertical at the ray's start and `between` to
    /// the ray.
    pub(crate) fn seen(&self, station: &Station, sun: f64, between: f64) -> Seen {
        Seen {
            height: station.r - GLOBE,
            sun: self.sun_at(station.s, station.r, sun, between),
            up: ((self.r * self.mu + station.s) / station.r).clamp(-1.0, 1.0),
            between,
        }
    }

    /// Cosine to the vertical of the sun at distance `s` along the ray and `r` from the centre, where it is
    /// `sun` at the start and `between` to the ray.
    pub(crate) fn sun_at(&self, s: f64, r: f64, sun: f64, between: f64) -> f64 {
        ((self.r * sun + s * between) / r).clamp(-1.0, 1.0)
    }
}

fn station(optics: &Optics, s: f64, step: &Step, through: &Wide) -> Station {
    let [molecules, aerosol] = optics.densities(step.r - GLOBE);
    let scattered = aerosol * optics.air.aerosol_albedo;
    let scatter = [
        std::array::from_fn(|band| optics.molecules[band] * molecules * step.dx * through[band]),
        std::array::from_fn(|band: usize| optics.aerosol[band] * scattered * step.dx * through[band]),
    ];
    Station { s, r: step.r, scatter }
}

/// Adds `factor` · `light` · `weight` to `sum`.
pub(crate) fn add(sum: &mut Wide, weight: &Wide, light: &Wide, factor: f64) {
    for band in 0..BANDS {
        sum[band] += weight[band] * light[band] * factor;
    }
}
