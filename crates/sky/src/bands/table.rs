//! Running integrals of the sky's radiance along the half circles of one plane.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Vec3};
use light::bands::BANDS as SPECTRAL;

use crate::ground::Surround;

/// Steps along a half circle, 1.5° each.
const STEPS: usize = 120;

/// ∫ L sin² α dα from 0, by band of the dome and step.
///
/// Within a step L is taken to be what it is in the middle, but sin² is integrated exactly.
pub(crate) struct Table {
    world_from_plane: DMat3,
    directions: Vec<DVec3>,
    /// STEPS + 1 a band.
    running: Vec<[f64; SPECTRAL]>,
    /// STEPS a band.
    radiance: Vec<[f64; SPECTRAL]>,
}

/// ∫ sin² α dα from 0.
fn sine_squared(alpha: f64) -> f64 {
    0.5 * (alpha - alpha.sin() * alpha.cos())
}

/// b and n of the unit vector in the middle of a band's half circle.
pub(crate) fn middle(band: usize, count: usize) -> DVec3 {
    let cos = -1.0 + (2 * band + 1) as f64 / count as f64;
    DVec3::new(0.0, cos, (1.0 - cos * cos).max(0.0).sqrt())
}

impl Table {
    pub(crate) fn new(around: &Surround, plane_from_world: DMat3, count: usize) -> Self {
        let mut table = Self {
            world_from_plane: plane_from_world.transpose(),
            directions: (0..count).map(|band| middle(band, count)).collect(),
            running: Vec::with_capacity(count * (STEPS + 1)),
            radiance: Vec::with_capacity(count * STEPS),
        };
        let step = PI / STEPS as f64;
        for band in 0..count {
            let mut sum = [0.0; SPECTRAL];
            table.running.push(sum);
            for i in 0..STEPS {
                let [from, to] = [i, i + 1].map(|edge| edge as f64 * step);
                let radiance = around.radiance(table.direction(band, 0.5 * (from + to))).0.map(f64::from);
                let weight = sine_squared(to) - sine_squared(from);
                (0..SPECTRAL).for_each(|k| sum[k] += radiance[k] * weight);
                table.radiance.push(radiance);
                table.running.push(sum);
            }
        }
        table
    }

    /// The direction at `alpha` on a half circle.
    pub(crate) fn direction(&self, band: usize, alpha: f64) -> Vec3 {
        let (sin, cos) = alpha.sin_cos();
        (self.world_from_plane * (DVec3::X * cos + self.directions[band] * sin)).as_vec3().normalize()
    }

    /// ∫ L sin² α dα between two angles \[rad\].
    pub(crate) fn between(&self, band: usize, from: f64, to: f64) -> [f64; SPECTRAL] {
        let (low, high) = (self.upto(band, from), self.upto(band, to));
        std::array::from_fn(|k| high[k] - low[k])
    }

    fn upto(&self, band: usize, alpha: f64) -> [f64; SPECTRAL] {
        let step = PI / STEPS as f64;
        let index = ((alpha / step) as usize).min(STEPS - 1);
        let (running, radiance) =
            (self.running[band * (STEPS + 1) + index], self.radiance[band * STEPS + index]);
        let weight = sine_squared(alpha) - sine_squared(index as f64 * step);
        std::array::from_fn(|k| running[k] + radiance[k] * weight)
    }
}
