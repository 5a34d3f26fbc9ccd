//! The slow reference of single scattering: thesis 4.15 by the midpoint rule, with depths summed along the way.

use glam::{DVec3, Vec3};

use crate::air::Optics;
use crate::slant::GLOBE;

const CENTRE: DVec3 = DVec3::new(0.0, -GLOBE, 0.0);
const HIGH: f64 = 120_000.0;

/// Extinction of the band at a height, and what of it molecules and aerosol scatter \[1/m\].
fn air(optics: &Optics, band: usize, h: f64) -> [f64; 3] {
    let molecules = optics.molecules[band] * (-h / optics.air.molecule_scale_height).exp();
    let aerosol = optics.aerosol[band] * (-h / 1200.0).exp();
    let layer = (12_000.0..32_000.0).contains(&h);
    let ozone = if layer { optics.ozone_depth(band) / 20_000.0 } else { 0.0 };
    [molecules + aerosol + ozone, molecules, aerosol * optics.air.aerosol_albedo]
}

fn height(p: DVec3) -> f64 {
    (p - CENTRE).length() - GLOBE
}

/// Distance to the sphere of that height from a point inside it.
fn exit(p: DVec3, direction: DVec3, top: f64) -> f64 {
    let to = p - CENTRE;
    let along = to.dot(direction);
    (along * along - to.length_squared() + (GLOBE + top).powi(2)).sqrt() - along
}

/// Depth from a point to the sun: midpoint rule with steps that grow with the distance from the lowest place.
fn sunward(optics: &Optics, band: usize, p: DVec3, sun: DVec3) -> f64 {
    let length = exit(p, sun, HIGH.max(height(p) + 1.0));
    let lowest = (-(p - CENTRE).dot(sun)).clamp(0.0, length);
    let mut depth = 0.0;
    for (from, to) in [(lowest, 0.0), (lowest, length)] {
        let steps = 150;
        for i in 0..steps {
            let [a, b] = [i, i + 1].map(|i| from + (to - from) * (f64::from(i) / f64::from(steps)).powi(2));
            depth += air(optics, band, height(p + sun * (0.5 * (a + b))))[0] * (b - a).abs();
        }
    }
    depth
}

/// Radiance from `direction`.
pub(super) fn radiance(optics: &Optics, band: usize, direction: Vec3, sun: Vec3, elevation: f64) -> f64 {
    let [v, sun] = [direction, sun].map(|d| d.as_dvec3().normalize());
    let eye = DVec3::new(0.0, elevation, 0.0);
    let length = exit(eye, v, optics.air.top);
    let cos = v.dot(sun);
    let rayleigh = 3.0 / (16.0 * std::f64::consts::PI) * (1.0 + cos * cos);
    let aerosol = f64::from(optics.air.aerosol_phase.value(cos as f32));
    let (mut depth, mut sum, steps) = (0.0, 0.0, 1500);
    for i in 0..steps {
        let [a, b] = [i, i + 1].map(|i| length * (f64::from(i) / f64::from(steps)).powi(2));
        let p = eye + v * (0.5 * (a + b));
        let [extinction, m, s] = air(optics, band, height(p));
        let half = 0.5 * extinction * (b - a);
        depth += half;
        let up = (p - CENTRE).normalize();
        // The sun's disc over the rim as the model has it.
        let risen = Optics::risen((p - CENTRE).length(), up.dot(sun));
        if risen > 0.0 {
            let through = (-depth - sunward(optics, band, p, sun)).exp();
            sum += risen * (m * rayleigh + s * aerosol) * through * (b - a);
        }
        depth += half;
    }
    sum * optics.sun[band]
}
