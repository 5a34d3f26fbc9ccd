//! How much light the sky gives: horizontal illuminance by the sun's altitude.

/// Altitude of the sun at which astronomical twilight ends \[degrees\].
const NIGHT_DEG: f64 = -18.0;
/// Decades of illuminance lost per degree of the sun's depression.
///
/// From 3.4 lx at −6° to 0.008 lx at −12° (ends of civil and nautical twilight, Explanatory Supplement to the
/// Astronomical Almanac) it is 0.44; from the 800 lx below at 0° to 3.4 lx it is 0.40.
const DECADES_PER_DEGREE: f64 = 0.41;

/// Diffuse illuminance of the unobstructed sky on the horizontal \[lx\], by the sun's altitude \[degrees\] and the
/// share of clear sky, 0 (overcast) to 1 (clear).
///
///   clear   800 + 15 500 √(sin h)       overcast   300 + 21 000 sin h
///
/// and between the two in proportion.
/// (Illuminating Engineering Society RP-21, after Gillette and Krochmann; medians of widely spread measurements.)
/// Below the horizon the value at 0° falls by 0.41 decades per degree, as twilight does within a
/// factor of 2 down to −12°, and reaches 0 at −18°: stars, moon and lamps of the town are not this crate's.
/// Continuous everywhere.
///
/// ```
/// use keikan_sky::diffuse_illuminance;
/// assert!((diffuse_illuminance(0.0, 30.0) - 10_800.0).abs() < 1e-6);
/// ```
pub fn diffuse_illuminance(clear: f64, sun_altitude_deg: f64) -> f64 {
    let sin = sun_altitude_deg.clamp(0.0, 90.0).to_radians().sin();
    let (cloudless, overcast) = (800.0 + 15_500.0 * sin.sqrt(), 300.0 + 21_000.0 * sin);
    (overcast + clear.clamp(0.0, 1.0) * (cloudless - overcast)) * twilight(sun_altitude_deg)
}

/// Factor on the light of the sky for a sun below the horizon: 1 at 0° and above, 0 from −18° down.
fn twilight(altitude_deg: f64) -> f64 {
    let left = |h: f64| 10f64.powf(DECADES_PER_DEGREE * h.min(0.0));
    // The little that is left at night is taken off, so that the end is not a step.
    let night = left(NIGHT_DEG);
    ((left(altitude_deg) - night) / (1.0 - night)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn illuminances_are_those_of_the_tables() {
        // IES RP-21 in klx to three decimals: (altitude, clear, overcast).
        for (h, clear, overcast) in [
            (0.0, 0.8, 0.3),
            (5.0, 5.376, 2.130),
            (30.0, 11.760, 10.800),
            (60.0, 15.224, 18.487),
            (90.0, 16.3, 21.3),
        ] {
            assert!((diffuse_illuminance(1.0, h) / 1000.0 - clear).abs() <= 0.5e-3);
            assert!((diffuse_illuminance(0.0, h) / 1000.0 - overcast).abs() <= 0.5e-3);
        }
    }

    #[test]
    fn twilight_falls_without_a_step_to_nothing() {
        // Within the factor of 2 the page states, at the ends of civil and nautical twilight.
        for (h, lux) in [(-6.0, 3.4), (-12.0, 0.008)] {
            let factor = diffuse_illuminance(1.0, h) / lux;
            assert!((0.5..=2.0).contains(&factor), "{h}: {factor}");
        }
        for clear in [0.0, 0.5, 1.0] {
            let mut before = diffuse_illuminance(clear, 0.0);
            for i in 1..=9000 {
                let now = diffuse_illuminance(clear, -0.01 * f64::from(i));
                // 0.41 decades a degree are 0.95 % per 0.01°; of the largest value, at most.
                assert!(now >= 0.0 && now <= before && before - now <= 0.0095 * 800.0);
                before = now;
            }
            assert_eq!(diffuse_illuminance(clear, NIGHT_DEG), 0.0);
            assert_eq!(before, 0.0);
        }
    }
}
