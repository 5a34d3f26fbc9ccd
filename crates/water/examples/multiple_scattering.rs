//! How much light comes back from deep water, by following photons, against scattering once.
//!
//! `cargo run --release -p keikan-water --example multiple_scattering -- [PHOTONS] [--all] [--bottom=DEPTH]`. Endless water without a bottom, or with a
//! black one this many optical depths c z down, under a
//! flat surface of n = 1.34, a sun that gives E₀ = 1 just under it, a black sky. Each line: share of molecules in b, ω0, zenith
//! angle of the sun in air, of the view under water (its azimuth across the sun's, then away from it), radiance upwards just
//! under the surface, its standard error, the same by quasi-single scattering, and both ratios to the truth, without and with the factor of
//! `keikan_water::multiple`. The photons are the origin of that factor's constants.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use keikan_water::{Phase, multiple};

/// Light scattered by less than this counts as not scattered: the peak would only make noise.
const STRAIGHT_ON: f64 = 3.0 * PI / 180.0;
const INDEX: f64 = 1.34;

/// splitmix64, as its author gives it.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Angles by their share of the scattered light beyond `STRAIGHT_ON`.
struct Turns {
    /// Share of all scattered light that this is.
    share: f64,
    angles: Vec<f64>,
    below: Vec<f64>,
}

impl Turns {
    fn new(phase: &Phase) -> Self {
        let steps = 20_000;
        let angle = |i: usize| STRAIGHT_ON * (PI / STRAIGHT_ON).powf(i as f64 / f64::from(steps));
        let angles: Vec<f64> = (0..=steps as usize).map(angle).collect();
        let mut below = vec![0.0];
        for pair in angles.windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]);
            let solid = TAU * (pair[0].cos() - pair[1].cos());
            below.push(below.last().unwrap_or(&0.0) + phase.value(middle.cos()) * solid);
        }
        let share = below[steps as usize];
        below.iter_mut().for_each(|b| *b /= share);
        Self { share, angles, below }
    }

    fn sample(&self, u: f64) -> f64 {
        let i = self.below.partition_point(|b| *b <= u).clamp(1, self.angles.len() - 1);
        let within = (u - self.below[i - 1]) / (self.below[i] - self.below[i - 1]).max(1e-300);
        self.angles[i - 1] + within * (self.angles[i] - self.angles[i - 1])
    }
}

/// Mean and standard error of the radiance upwards along each of `views` (unit vectors that light takes), E₀ = 1.
fn upward(
    phase: &Phase,
    (albedo, bottom): (f64, f64),
    sun: DVec3,
    views: &[DVec3],
    photons: u32,
    seed: u64,
) -> Vec<[f64; 2]> {
    let turns = Turns::new(phase);
    // Lengths are those between turns of more than `STRAIGHT_ON`: c' = c (1 − ω0 f).
    let kept = 1.0 - albedo * (1.0 - turns.share);
    let bottom = bottom * kept;
    let albedo = albedo * turns.share / kept;
    let mut random = Random(seed);
    let mut sums = vec![[0.0; 2]; views.len()];
    for _ in 0..photons {
        let (mut way, mut depth, mut weight) = (-sun, 0.0f64, 1.0);
        let mut own = vec![0.0; views.len()];
        while weight > 0.0 {
            depth -= way.y * -(1.0 - random.next()).ln();
            if depth < 0.0 {
                weight *= light::fresnel(1.0 / INDEX, way.y);
                // What is mirrored goes on as far as it would have.
                (depth, way.y) = (-depth, -way.y);
            }
            if depth > bottom {
                break;
            }
            weight *= albedo;
            for (sum, view) in own.iter_mut().zip(views) {
                let turn = phase.value(way.dot(*view).min(STRAIGHT_ON.cos())) / turns.share;
                *sum += weight * turn * (-depth / view.y).exp() / view.y;
            }
            let (sin, cos) = turns.sample(random.next()).sin_cos();
            let (a, b) = way.any_orthonormal_pair();
            let (up, side) = (TAU * random.next()).sin_cos();
            way = (way * cos + (a * side + b * up) * sin).normalize();
            if weight < 1e-2 {
                weight = if random.next() < 0.1 { weight * 10.0 } else { 0.0 };
            }
        }
        for (sum, own) in sums.iter_mut().zip(own) {
            *sum = [sum[0] + own, sum[1] + own * own];
        }
    }
    let n = f64::from(photons);
    let error = |[sum, squares]: [f64; 2]| [sum / n, ((squares / n - (sum / n).powi(2)) / n).max(0.0).sqrt()];
    sums.into_iter().map(error).collect()
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let photons = arguments.first().and_then(|a| a.parse().ok()).unwrap_or(20_000);
    let all = arguments.iter().any(|a| a == "--all");
    let bottom =
        arguments.iter().find_map(|a| a.strip_prefix("--bottom=")?.parse().ok()).unwrap_or(f64::INFINITY);
    let degrees = |zenith: f64, azimuth: f64| {
        let ((sin, cos), (z, x)) = (zenith.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
        DVec3::new(sin * x, cos, sin * z)
    };
    let views = [(0.0, 0.0), (25.0, 90.0), (45.0, 90.0), (40.0, 0.0), (40.0, 180.0)];
    let (shares, suns): (&[f64], &[f64]) =
        if all { (&[0.0, 0.02, 0.1, 0.4, 1.0], &[0.0, 30.0, 60.0, 80.0]) } else { (&[0.0, 1.0], &[60.0]) };
    let albedos: &[f64] = if all { &[0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.98] } else { &[0.2, 0.9] };
    for &share in shares {
        let parts = vec![(share, Phase::morel()), (1.0 - share, Phase::petzold())];
        let phase = Phase::mixture(parts).expect("shares within 0 and 1");
        for &albedo in albedos {
            for &zenith in suns {
                let sine = zenith.to_radians().sin() / INDEX;
                let sun = degrees(sine.asin().to_degrees(), 0.0);
                let toward: Vec<DVec3> = views.iter().map(|v| degrees(v.0, v.1)).collect();
                let truth = upward(&phase, (albedo, bottom), sun, &toward, photons, 1);
                for ((view, ways), [mean, error]) in views.iter().zip(&toward).zip(truth) {
                    let diffuse = 1.0 - albedo * (1.0 - phase.backscattered());
                    let sideways = phase.value(-sun.dot(*ways));
                    let reached = 1.0 - (-diffuse * bottom * (1.0 / sun.y + 1.0 / ways.y)).exp();
                    let once = albedo * sideways / ((sun.y + ways.y) * diffuse) * reached;
                    let deep = multiple::factor(albedo, phase.backscattered(), sideways);
                    let factor = 1.0 + (deep - 1.0) * multiple::room(1.0, bottom);
                    println!(
                        "{share:4} {albedo:5} {zenith:4} {:4} {:4} {mean:.5e} {error:.1e} {once:.5e} {:.3} {:.3}",
                        view.0,
                        view.1,
                        once / mean,
                        once * factor / mean,
                    );
                }
            }
        }
    }
}
