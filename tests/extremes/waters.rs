//! Water: phase functions, qualities, ways through the surface, from micrometres to kilometres.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use water::{Loss, Paths, Phase, Surface, Water, quality};

use crate::ledger::{Ledger, drawn, inputs, power};

/// 2π ∫ p dcos θ by steps that are even in the logarithm of the angle: nothing of the crate's own integrals.
fn whole(phase: &Phase) -> f64 {
    let steps = 40_000;
    let least = 1e-7f64.ln();
    let angle = |i: f64| (least + (PI.ln() - least) * i / f64::from(steps)).exp();
    let ring = |i: i32| {
        let (from, to) = (angle(f64::from(i)), angle(f64::from(i) + 1.0));
        TAU * (from.cos() - to.cos()) * phase.value(angle(f64::from(i) + 0.5).cos())
    };
    (0..steps).map(ring).sum()
}

#[test]
fn phase_functions() {
    let ledger = Ledger::new("phase function");
    let mut phases = vec![Phase::water(), Phase::morel(), Phase::thesis(), Phase::petzold()];
    phases.extend(inputs([(0.0, 1.0)], 3).into_iter().filter_map(|[d]| Phase::molecular(d).ok()));
    phases.extend(inputs([(-0.99, 0.99)], 10).into_iter().filter_map(|[g]| Phase::henyey_greenstein(g).ok()));
    phases.extend(
        inputs([(0.0, 0.98); 2], 10).into_iter().filter_map(|[f, b]| Phase::beardsley_zaneveld(f, b).ok()),
    );
    phases.extend(
        inputs([(1.01, 1.35), (3.3, 4.9)], 20)
            .into_iter()
            .filter_map(|[n, s]| Phase::fournier_forand(n, s).ok()),
    );
    assert!(phases.len() > 50);
    for phase in &phases {
        for [cos] in inputs([(-1.0, 1.0)], 200) {
            let value = phase.value(cos);
            ledger.holds("finite and not negative", value.is_finite() && value >= 0.0, (phase, cos));
        }
        // Steps of 4e-4 of the angle, and what the peak has within 1e-7 rad.
        ledger.note("all light goes somewhere", (whole(phase) - 1.0).abs(), 5e-3, phase);
        let shares = (0.0..=1.0).contains(&phase.backscattered()) && phase.mean_cosine().abs() <= 1.0;
        ledger.holds("shares and means within their ranges", shares, phase);
    }
    ledger.close();
}

#[test]
fn qualities() {
    let ledger = Ledger::new("water quality");
    for name in quality::names() {
        let water = Water::named(name).expect("a water of the list");
        for loss in [Loss::Beam, Loss::Diffuse] {
            let lost = water.loss(loss);
            ledger.holds("losses are positive", lost.is_finite() && lost.0.iter().all(|c| *c > 0.0), name);
            let mut before = light::Spectrum::ONE;
            for exponent in -6..=6 {
                let left = lost.attenuate(10f32.powi(exponent));
                let falls = left.0.iter().zip(&before.0).all(|(now, then)| now <= then && *now >= 0.0);
                ledger.holds("light falls with depth", falls, (name, exponent));
                before = left;
            }
        }
        ledger.holds("no more is scattered than lost", water.albedo().max() <= 1.0, name);
        ledger.holds("it sends back less than it gets", water.deep_reflectance().max() < 0.5, name);
    }
    ledger.close();
}

/// Irradiance over intensity beyond the surface, by the flux between neighbouring rays: differences of Snell's law alone.
fn by_differences(n: f64, height: f64, depth: f64, angle: f64) -> (f64, f64) {
    let lands = |angle: f64| height * angle.tan() + depth * (angle.sin() / n).asin().tan();
    let step = 1e-5 * angle.min(std::f64::consts::FRAC_PI_2 - angle);
    let ring = (lands(angle + step).powi(2) - lands(angle - step).powi(2)) * PI;
    let solid = TAU * ((angle - step).cos() - (angle + step).cos());
    // On a plane that faces the ray: over the cosine of its slope.
    (lands(angle), solid / ring / (angle.sin() / n).asin().cos())
}

#[test]
fn ways_through_the_surface() {
    let ledger = Ledger::new("refracted way");
    let ranges = [(1.0, 1.6), (-5.0, 3.0), (-5.0, 3.0), (0.01, 1.55)];
    for [n, height, depth, angle] in inputs(ranges, 4000) {
        let (height, depth) = (power(height), power(depth));
        let surface = Surface { level: 0.0, index: n };
        let (across, spread) = by_differences(n, height, depth, angle);
        let (lamp, place) = (DVec3::Y * height, DVec3::new(across, -depth, 0.0));
        let at = (n, height, depth, angle);
        let Some(leg) = surface.refracted(lamp, place, Paths::Exact) else {
            ledger.holds("there is a way", false, at);
            continue;
        };
        let sound = leg.spread.is_finite() && leg.spread > 0.0 && (0.0..=1.0).contains(&leg.share);
        ledger.holds("finite and within its range", sound, at);
        // Differences over 2e-5 of the angle: 1e-9 of their own, and roundings of lengths over that step.
        ledger.note("spread against neighbouring rays", (leg.spread / spread - 1.0).abs(), 1e-4, at);
        let Some(back) = surface.refracted(place, lamp, Paths::Exact) else {
            ledger.holds("there is a way back", false, at);
            continue;
        };
        // Radiance over n² is the same along a way: E/I scales by n² the other way.
        ledger.note("reciprocity", (back.spread * n * n / leg.spread - 1.0).abs(), 1e-9, at);
        ledger.note("the same share passes", (back.share - leg.share).abs(), 1e-9, at);
    }
    let far = proptest::array::uniform6(-1e7f64..1e7);
    for [x, y, z, a, b, c] in drawn(&far, 4000) {
        let surface = Surface { level: 0.0, index: 1.34 };
        for leg in surface.legs(DVec3::new(x, y, z), DVec3::new(a, b, c), Paths::Exact).into_iter().flatten()
        {
            let sound = leg.spread.is_finite() && leg.spread >= 0.0 && (0.0..=1.0).contains(&leg.share);
            ledger.holds("anywhere within 10 000 km", sound, (x, y, z, a, b, c));
        }
    }
    ledger.close();
}
