//! How much of the sun's light is direct and how much comes from the sky: the formulas of Bouguer and Nagata.
//!
//! With P the transmittance of the atmosphere at the zenith, h the sun's altitude, I₀ the sun outside:
//!
//!   direct, facing it    I_DN = I₀ P^m
//!   sky, horizontal      I_SH = I₀ sin h (1 − P^m) (0.66 − 0.32 sin h) (0.5 + (0.4 − 0.3 P) sin h)
//!
//! (thesis 4.4; Nagata 1978, after Udagawa.) The thesis has m = 1/sin h, which diverges at the horizon; here it is the
//! relative air mass of Kasten and Young, [`crate::atmosphere::air_mass`], within 1 % of it from 12° up.
//!
//! The formulas are of irradiance over all wavelengths. As illuminances both take the same efficacy here, that of
//! the sun outside the atmosphere (132 klx for 1361 W/m²), which keeps their ratio as the thesis has it; the blue
//! sky's true efficacy is higher by about a third.

use crate::atmosphere::air_mass;
use crate::solar_spectrum;

/// The direct sun facing it, by I₀ (that of the argument and result), the transmittance and the altitude \[degrees\].
pub fn direct_normal(outside: f64, transmittance: f64, sun_altitude_deg: f64) -> f64 {
    outside * transmittance.clamp(0.0, 1.0).powf(air_mass(sun_altitude_deg))
}

/// The sky on the horizontal, in the same way; 0 for a sun below the horizon.
pub fn sky_horizontal(outside: f64, transmittance: f64, sun_altitude_deg: f64) -> f64 {
    let p = transmittance.clamp(0.0, 1.0);
    let sin = sun_altitude_deg.clamp(0.0, 90.0).to_radians().sin();
    let scattered = 1.0 - p.powf(air_mass(sun_altitude_deg));
    outside * sin * scattered * (0.66 - 0.32 * sin) * (0.5 + (0.4 - 0.3 * p) * sin)
}

/// Illuminance of the direct sun facing it \[lx\].
pub fn sun_illuminance(transmittance: f64, sun_altitude_deg: f64) -> f64 {
    direct_normal(outside_illuminance(), transmittance, sun_altitude_deg)
}

/// Illuminance of the sky on the horizontal \[lx\].
pub fn sky_illuminance(transmittance: f64, sun_altitude_deg: f64) -> f64 {
    sky_horizontal(outside_illuminance(), transmittance, sun_altitude_deg)
}

fn outside_illuminance() -> f64 {
    f64::from(solar_spectrum::extraterrestrial().luminance())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_those_of_the_printed_formulas() {
        // With I₀ = 1367 W/m² and 1/sin h: (P, h, direct, sky).
        for (p, altitude, direct, sky) in [
            (0.6, 30.0, 492.12, 133.42),
            (0.7, 30.0, 669.83, 103.70),
            (0.7, 60.0, 905.53, 101.68),
            (0.7, 90.0, 956.90, 96.21),
            (0.8, 80.0, 1089.84, 61.90),
        ] {
            // Kasten and Young's air mass is 0.3 % below 1/sin h at 30°, 0.03 % off at the zenith: times ln P.
            let bound = if altitude < 60.0 { 0.004 } else { 0.0005 };
            assert!((direct_normal(1367.0, p, altitude) / direct - 1.0).abs() < bound, "{p} {altitude}");
            assert!((sky_horizontal(1367.0, p, altitude) / sky - 1.0).abs() < bound, "{p} {altitude}");
        }
    }

    #[test]
    fn the_horizon_is_no_pole_and_the_night_is_dark() {
        for p in [-1.0, 0.0, 0.3, 0.7, 1.0, 2.0] {
            let mut before = 0.0;
            for i in -1800..=9000 {
                let altitude = 0.01 * f64::from(i);
                let (direct, sky) = (direct_normal(1.0, p, altitude), sky_horizontal(1.0, p, altitude));
                assert!((0.0..=1.0).contains(&direct) && (0.0..=0.5).contains(&sky), "{p} {altitude}");
                // I_SH rises with sin h at first, times 0.66 · 0.5.
                assert!((sky - before).abs() < 1e-4);
                before = sky;
            }
        }
        assert_eq!(sky_illuminance(0.7, -1.0), 0.0);
        let ratio = sky_illuminance(0.7, 30.0) / (0.5 * sun_illuminance(0.7, 30.0));
        assert!((ratio - 103.70 / 334.91).abs() < 0.002, "the thesis' ratio: {ratio}");
    }
}
