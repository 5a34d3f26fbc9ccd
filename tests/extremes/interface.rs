//! Fresnel and Snell, from vacuum bubbles to diamond, level to grazing.

use glam::DVec3;
use light::{fresnel, fresnel_polarised, reflect, refract};

use crate::ledger::{Ledger, inputs};

/// Fresnel's sine and tangent laws, which share nothing with the crate's form; no pole within the ranges.
fn by_angles(eta: f64, incidence: f64) -> Option<[f64; 2]> {
    let sin = incidence.sin() / eta;
    (sin < 1.0 && incidence > 1e-6).then(|| {
        let passed = sin.asin();
        let (apart, sum) = (incidence - passed, incidence + passed);
        [(apart.sin() / sum.sin()).powi(2), (apart.tan() / sum.tan()).powi(2)]
    })
}

#[test]
fn fresnel_and_snell() {
    let ledger = Ledger::new("interface");
    for [eta, cos] in inputs([(0.3, 4.0), (0.0, 1.0)], 20_000) {
        let share = fresnel(eta, cos);
        ledger.holds("reflectance within 0 and 1", (0.0..=1.0).contains(&share), (eta, cos));
        let incidence = cos.acos();
        if let Some(truth) = by_angles(eta, incidence) {
            for (found, truth) in fresnel_polarised(eta, cos).into_iter().zip(truth) {
                // Sines of differences of angles, themselves right to 1e-16, over sums: near the critical angle the arc sine has lost half.
                ledger.note(
                    "reflectance against sines and tangents",
                    (found - truth).abs(),
                    1e-7,
                    (eta, cos),
                );
            }
        }
        let incoming = DVec3::new((1.0 - cos * cos).max(0.0).sqrt(), -cos, 0.0);
        let mirrored = reflect(incoming, DVec3::Y);
        ledger.note("mirrored rays are unit vectors", (mirrored.length() - 1.0).abs(), 1e-15, (eta, cos));
        if let Some(passed) = refract(incoming, DVec3::Y, eta) {
            ledger.note("refracted rays are unit vectors", (passed.length() - 1.0).abs(), 1e-14, (eta, cos));
            ledger.note("sines keep their ratio", (incoming.x - eta * passed.x).abs(), 1e-14, (eta, cos));
            // From the other side the same share is mirrored; grazing angles square-root the rounding of the cosine.
            let back = fresnel(1.0 / eta, -passed.y);
            ledger.note("reflectance is the same both ways", (back - share).abs(), 1e-6, (eta, cos));
        } else {
            ledger.holds("what is not refracted is mirrored", share == 1.0, (eta, cos));
        }
        let near = fresnel(eta, (cos + 1e-9).min(1.0));
        // The slope at the critical angle is that of a square root: √1e-9 = 3e-5, times at most 2 · 4 η.
        ledger.note("reflectance is continuous", (near - share).abs(), 1e-3, (eta, cos));
    }
    ledger.close();
}
