//! Integrals of what fades exponentially.

/// A ray without end goes on for this long \[m\].
const ENDLESS: f64 = 1e9;

/// ∫ e^(−start − rate r) dr over 0 to `length`: without cancellation for any rate (1 − e^(−x) by `exp_m1`), and finite for
/// rates below 0 as long as start + rate · length ≥ 0.
pub(super) fn fading(start: f64, rate: f64, length: f64) -> f64 {
    let length = length.clamp(0.0, ENDLESS);
    let x = rate * length;
    // From whichever end is brighter.
    let (start, x) = if x < 0.0 { (start + x, -x) } else { (start, x) };
    let mean = if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 };
    (-start).exp() * mean * length
}

/// ∫ (first + (last − first) r/length) e^(−rate r) dr over 0 to `length` (finite), rate ≥ 0.
pub(super) fn fading_slope(first: f64, last: f64, rate: f64, length: f64) -> f64 {
    let x = rate * length;
    // ∫ t e^(−x t) dt over 0 to 1: (1 − e^(−x) (1 + x))/x², whose series to x⁴ is right to 1e-13 below 1e-2.
    let ramp = if x < 1e-2 {
        0.5 - x * (1.0 / 3.0 - x * (0.125 - x * (1.0 / 30.0 - x / 144.0)))
    } else {
        (-(-x).exp_m1() - x * (-x).exp()) / (x * x)
    };
    first * fading(0.0, rate, length) + (last - first) * ramp * length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_forms_are_what_they_integrate() {
        for (start, rate, length) in
            [(0.0, 1.0, 2.0), (3.0, -1.0, 3.0), (0.5, 1e-12, 7.0), (0.0, 0.0, 5.0), (0.1, 40.0, 9.0)]
        {
            // Simpson with 20 000 intervals: (h rate)⁴ · length/180 · f, below 1e-11 for the steepest.
            let steps = 20_000;
            let h = length / f64::from(steps);
            let sum = |f: &dyn Fn(f64) -> f64| {
                let weight = |i| {
                    if i == 0 || i == steps {
                        1.0
                    } else if i % 2 == 1 {
                        4.0
                    } else {
                        2.0
                    }
                };
                (0..=steps).map(|i| weight(i) * f(f64::from(i) * h)).sum::<f64>() * h / 3.0
            };
            let plain = sum(&|r| (-start - rate * r).exp());
            assert!((fading(start, rate, length) / plain - 1.0).abs() < 1e-9, "{start} {rate} {length}");
            if rate >= 0.0 {
                let sloped = sum(&|r| (2.0 - 1.5 * r / length) * (-rate * r).exp());
                assert!(
                    (fading_slope(2.0, 0.5, rate, length) / sloped - 1.0).abs() < 1e-9,
                    "{rate} {length}"
                );
            }
        }
        // Both sides of the switch to the series.
        let [below, above] = [0.999_999e-2, 1.000_001e-2].map(|x| fading_slope(0.0, 1.0, x, 1.0));
        assert!((below - above).abs() < 1e-8, "slope 1/3 over 2e-8, and the series' 1e-13");
        assert_eq!(fading(0.0, 2.0, f64::INFINITY), 0.5);
        assert!(fading(0.0, 0.0, f64::INFINITY).is_finite());
    }
}
