//! What one sees of a water surface.

use std::sync::Arc;

use glam::Vec3;
use light::{Arrival, Hit, Shade, Spectrum, Surroundings, fresnel, reflect, refract};

use super::FlatWater;

/// A flat water surface: what it mirrors, and what comes through it (3.21 without its cos θ_j):
///
///   L = α L_r + (1 − α) L_w/n²   from above,   L = α L_r + (1 − α) n² L_a   from below.
///
/// What is lost and added under water is no matter of the surface ([`super::Fill`]). Beams with a radius (the sun) show as a disc
/// in the mirror; points do not.
pub struct SurfaceShade {
    water: Arc<[FlatWater]>,
    index: usize,
}

impl SurfaceShade {
    /// The surface of one of the waters.
    pub fn new(water: Arc<[FlatWater]>, index: usize) -> Self {
        Self { water, index }
    }
}

impl Shade for SurfaceShade {
    fn radiance(&self, hit: &Hit, around: &dyn Surroundings) -> Spectrum {
        let Some(water) = self.water.get(self.index) else { return Spectrum::ZERO };
        let (toward, normal) = (hit.toward_eye.as_dvec3(), hit.place.normal.as_dvec3());
        let n = water.surface.index;
        let eta = if normal.y > 0.0 { n } else { 1.0 / n };
        let cos = toward.dot(normal).clamp(0.0, 1.0);
        let mirrored = fresnel(eta, cos) as f32;
        let mut sum = Spectrum::ZERO;
        if mirrored > 0.0 {
            let direction = reflect(-toward, normal).as_vec3().normalize();
            let path = hit.path.then(mirrored, hit, 2.0);
            sum += around.radiance(&hit.place.leave(direction, f32::INFINITY), path) * mirrored;
            sum += disc(hit, direction, around) * mirrored;
        }
        let passes = 1.0 - mirrored;
        if passes > 0.0
            && let Some(direction) = refract(-toward, normal, eta)
        {
            let direction = direction.as_vec3().normalize();
            let path = hit.path.then(passes, hit, (1.0 - 1.0 / eta).abs() as f32);
            let radiance = around.radiance(&hit.place.leave(direction, f32::INFINITY), path);
            sum += radiance * (f64::from(passes) / (eta * eta)) as f32;
        }
        sum
    }
}

/// Radiance of the discs that lie in a mirror direction.
fn disc(hit: &Hit, direction: Vec3, around: &dyn Surroundings) -> Spectrum {
    let mut sum = Spectrum::ZERO;
    around.beams(&hit.place, &mut |arrival| {
        if let Arrival::Beam { toward, irradiance, radius: Some(radius) } = arrival
            && radius > 0.0
            && toward.distance(direction) <= radius
        {
            sum += irradiance * (std::f32::consts::FRAC_1_PI / (radius * radius));
        }
    });
    sum
}
