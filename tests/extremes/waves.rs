//! Waves from ripples to swell, as steep as they may be.

use glam::DVec2;
use water::waves::{Stokes, Waves};

use crate::ledger::{Ledger, inputs, power};

#[test]
fn stokes_waves() {
    let ledger = Ledger::new("waves");
    for [length, steepness, turn, phase] in inputs([(-2.0, 3.0), (0.0, 0.44), (0.0, 6.3), (0.0, 6.3)], 300) {
        let length = power(length);
        let amplitude = steepness * length / std::f64::consts::TAU;
        let Ok(wave) = Stokes::new(amplitude, length, DVec2::from_angle(turn), phase) else {
            // Too steep to stand: said, not drawn.
            ledger.holds(
                "what is too steep is refused only where it is",
                steepness > 0.3,
                (length, steepness),
            );
            continue;
        };
        let waves = Waves::new(vec![wave], DVec2::ZERO);
        let at = (length, steepness, turn, phase);
        for i in 0..64 {
            let point = DVec2::from_angle(turn) * (length * f64::from(i) / 64.0);
            let (height, near) = (waves.height(point), waves.height(point + DVec2::splat(1e-7 * length)));
            ledger.note(
                "no higher than its crest",
                (height.abs() - waves.highest()).max(0.0) / length,
                1e-12,
                at,
            );
            let slope = waves.normal(point);
            let steep = slope.x.hypot(slope.z) / slope.y;
            ledger.note("no steeper than its steepest", (steep - waves.steepest()).max(0.0), 1e-9, at);
            ledger.note("heights are continuous", (near - height).abs() / length, 2e-7, at);
            // The slope against a difference of heights: of the third order of 1e-4, and roundings over it.
            let step = 1e-4 * length;
            let along = DVec2::from_angle(turn);
            let rise =
                (waves.height(point + along * step) - waves.height(point - along * step)) / (2.0 * step);
            let slope = -(slope.x * along.x + slope.z * along.y) / slope.y;
            ledger.note("slopes are those of the heights", (slope - rise).abs(), 1e-6, at);
        }
    }
    ledger.close();
}
