//! What light loses and gains along a ray under water.

use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

use light::{Arrival, Path, Place, Ray, Spectrum, Surroundings, Traverse, Way};

use super::FlatWater;
use crate::{Loss, Water};

/// Points of the quadrature along a ray: Gauss and Legendre's eight, on \[0, 1\].
const POINTS: [[f32; 2]; 8] = [
    [0.019_855_07, 0.050_614_27],
    [0.101_666_76, 0.111_190_52],
    [0.237_233_8, 0.156_853_32],
    [0.408_282_68, 0.181_341_9],
    [0.591_717_3, 0.181_341_9],
    [0.762_766_2, 0.156_853_32],
    [0.898_333_25, 0.111_190_52],
    [0.980_144_9, 0.050_614_27],
];

/// Water between things: what the eye sees through it is dimmed by e^(−c r), and light scattered once is added (3.26, 3.28):
///
///   L = ∫ β(θ) E e^(−K r) dr
///
/// by eight points of even shares of e^(−K̄ r), K̄ the bands' mean, for whatever arrives there. Light that lights the water is
/// dimmed by K = a + b_b on both legs (quasi-single scattering); of light from all around the scattering is taken to be even.
pub struct Fill {
    waters: Arc<[FlatWater]>,
}

impl Fill {
    /// All of these waters.
    pub fn new(waters: Arc<[FlatWater]>) -> Self {
        Self { waters }
    }
}

impl Traverse for Fill {
    fn way(&self, ray: &Ray, path: Path, around: &dyn Surroundings) -> Way {
        // Rays end at surfaces: where a ray begins tells where all of it is.
        let step = 1e-3f32.min(0.5 * ray.length);
        let begins = ray.at(step).as_dvec3();
        let within = |water: &&FlatWater| water.depth(begins).is_some_and(|depth| depth > 0.0);
        let Some(water) = self.waters.iter().find(within) else { return Way::CLEAR };
        let transmittance = water.water.loss(Loss::Beam).attenuate(ray.length.min(f32::MAX));
        let added = match water.water.scattering().is_zero() || path.share <= 0.0 {
            true => Spectrum::ZERO,
            false => scattered(&water.water, ray, around),
        };
        Way { transmittance, added }
    }
}

/// Light scattered into the ray.
fn scattered(water: &Water, ray: &Ray, around: &dyn Surroundings) -> Spectrum {
    let loss = water.loss(Loss::Diffuse);
    let mean = (loss.0.iter().sum::<f32>() / loss.0.len() as f32).max(1e-6);
    let reach = 1.0 - (-mean * ray.length).exp();
    let even = water.scattering() * (0.25 * FRAC_1_PI);
    let mut sum = Spectrum::ZERO;
    for [at, weight] in POINTS {
        // r of even shares: dr = reach/(K̄ e^(−K̄ r)) du.
        let left = 1.0 - at * reach;
        let r = -left.ln() / mean;
        let dr = reach / (mean * left) * weight;
        let position = ray.at(r);
        let seed = position.x.to_bits() ^ position.z.to_bits().rotate_left(16);
        let place = Place { position, error: 0.0, normal: -ray.direction, seed };
        let mut into = Spectrum::ZERO;
        for normal in [place.normal, -place.normal] {
            around.arrivals(&Place { normal, ..place }, &mut |arrival| match arrival {
                // Beams may come for either normal: each counts for the one that it is in front of.
                Arrival::Beam { toward, irradiance, .. } if toward.dot(normal) > 0.0 => {
                    into += water.volume_scattering(f64::from(toward.dot(ray.direction))) * irradiance;
                }
                Arrival::Beam { .. } => {}
                Arrival::Field { irradiance } => into += even * irradiance,
            });
        }
        sum += into * loss.attenuate(r) * dr;
    }
    sum
}
