//! Luminaires: tables of intensities, near and far.

use glam::{Mat3, Vec3};
use light::{Distribution, Illuminate, Luminaire, Place, Spectrum, Vacuum};

use crate::ledger::{Ledger, drawn, inputs, power};

#[test]
fn luminaires() {
    let ledger = Ledger::new("luminaire");
    let table = proptest::collection::vec(0.0f32..1e5, 4 * 7);
    for candela in drawn(&table, 40) {
        let c = vec![0.0, 90.0, 180.0, 270.0];
        let gamma = (0..7).map(|i| 30.0 * i as f32).collect();
        let distribution = Distribution::new(c, gamma, candela).expect("a sound table");
        let (exact, summed) = (distribution.total_flux(), distribution.flux(400));
        ledger.note("flux against a sum over directions", (exact / summed - 1.0).abs(), 1e-3, exact);
        for [u, v] in inputs([(-1.0, 1.0), (0.0, std::f64::consts::TAU)], 200) {
            let flat = (1.0 - u * u).max(0.0).sqrt();
            let direction = Vec3::new((flat * v.cos()) as f32, (flat * v.sin()) as f32, u as f32);
            let intensity = distribution.intensity(direction);
            let within = (0.0..=distribution.peak() * 1.000_01).contains(&intensity);
            ledger.holds("intensity within 0 and the peak", within, (u, v));
        }
    }
    for [distance, slant] in inputs([(-6.0, 6.0), (0.0, 1.57)], 2000) {
        let distance = power(distance);
        let toward = Vec3::new(slant.sin() as f32, slant.cos() as f32, 0.0);
        let lamp = Luminaire {
            position: toward * distance as f32,
            world_from_luminaire: Mat3::IDENTITY,
            distribution: Distribution::isotropic(1.0),
            spectrum: Spectrum::ONE,
            glints: true,
        };
        let place = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 0 };
        let found = f64::from(lamp.irradiance(&place, &Vacuum)[0]);
        let truth = slant.cos() / (distance * distance);
        // Six roundings of f32, of the cosine the largest near the horizon.
        ledger.note(
            "cos/r² from a micrometre to 1000 km",
            (found / truth - 1.0).abs() * slant.cos(),
            1e-6,
            (distance, slant),
        );
    }
    ledger.close();
}
