//! What a clear atmosphere leaves of the direct beam.

use light::Spectrum;

use crate::air::{Air, columns, per_column};
use crate::slant::GLOBE;
use crate::solar_spectrum;

/// Ångström's β of the clear air to which the IES' illuminances of sun and sky belong.
///
/// 0.05 is clean, 0.1 usual near towns, 0.2 hazy.
pub const CLEAR_TURBIDITY: f64 = 0.06;

/// Irradiance of the direct sun on a plane that faces it, through a clear sky \[W m⁻² nm⁻¹\].
///
/// `altitude_deg` is the height of the sun, within \[−90, 90\];
/// `elevation_m` the observer's height above the sea \[m\]; `turbidity_beta` Ångström's turbidity β ≥ 0 at
/// sea level, the vertical optical depth of aerosol at 1 µm.
///
///   I = I₀ exp(−c_R τ_R/8434 m − c_A β λ^(−1)/1200 m − c_O k_O 0.23 atm-cm),   λ in µm
///
/// with the Rayleigh depth τ_R of Bodhaine 1999, the ozone absorption k_O of Serdyuchenko, and the columns c
/// that a straight ray meets in a round atmosphere: the very depths of [`crate::AirSky`], with [`Air::CLEAR`]
/// but for the turbidity. Water vapour and oxygen, which absorb narrow lines towards the red (together below 2
/// % of the illuminance), are left out.
///
/// Finite and continuous everywhere; the little that is left at the horizon fades out below it within
/// about 2°.
///
/// ```
/// use keikan_sky::atmosphere::direct_beam;
/// let (noon, evening) = (direct_beam(60.0, 0.0, 0.1), direct_beam(5.0, 0.0, 0.1));
/// assert!(evening[0] / noon[0] < evening[7] / noon[7]); // a low sun is red
/// ```
pub fn direct_beam(altitude_deg: f64, elevation_m: f64, turbidity_beta: f64) -> Spectrum {
    let air = Air { turbidity: turbidity_beta.max(0.0), ..Air::CLEAR };
    beam(&air, altitude_deg, elevation_m)
}

/// The same through any air.
pub fn beam(air: &Air, altitude_deg: f64, elevation_m: f64) -> Spectrum {
    let columns = columns(air, GLOBE + elevation_m.max(0.0), altitude_deg.to_radians().sin());
    Spectrum::from_fn(|nm| {
        let per = per_column(air, nm);
        let depth: f64 = columns.0.iter().zip(per).map(|(column, per)| column * per).sum();
        solar_spectrum::irradiance(nm) * (-depth).exp()
    })
}

/// Relative optical air mass: 1 at the zenith (to 0.03 %), 37.9 at the horizon.
///
/// Kasten and Young 1989, h in degrees, for the apparent altitude:
///
///   m = 1 / (sin h + 0.50572 (h + 6.07995)^(−1.6364))
///
/// It is a fit for h ≥ 0 (error below 0.5 %). Below the horizon, where it has no meaning and a pole, it is
/// continued with its own value and logarithmic slope at 0, so that the beam fades without a step.
pub fn air_mass(altitude_deg: f64) -> f64 {
    const A: f64 = 0.50572;
    const B: f64 = 6.07995;
    const C: f64 = 1.6364;
    let denominator = |h: f64| h.to_radians().sin() + A * (h + B).powf(-C);
    if altitude_deg >= 0.0 {
        return 1.0 / denominator(altitude_deg.min(90.0));
    }
    let at_horizon = denominator(0.0);
    let slope = (std::f64::consts::PI / 180.0 - A * C * B.powf(-C - 1.0)) / at_horizon;
    (-slope * altitude_deg).exp() / at_horizon
}

/// Vertical optical depth of the air at sea level, 1013.25 hPa (Bodhaine et al. 1999, eq. 30), 1.
///
/// 0.0971 at 550 nm; agrees with Bucholtz 1995 and Penndorf 1957 to 0.3 and 1 %.
pub fn rayleigh_depth(nm: f64) -> f64 {
    let square = (nm / 1000.0).powi(2);
    0.002_152 * (1.045_599_6 - 341.290_61 / square - 0.902_308_5 * square)
        / (1.0 + 0.002_705_988_9 / square - 85.968_563 * square)
}

/// Absorption of ozone at 233 K from 365 nm every 10 nm \[per atm-cm\].
///
/// Source: Serdyuchenko and Gorshelev 2011 to 2014, means over 10 nm; Leckner 1978 differs by up to 5 % at
/// the peak of the Chappuis band (0.126 against 0.120).
#[rustfmt::skip]
const OZONE: [f64; 48] = [
    0.00032, 6e-05, 8e-05, 0.00018, 0.00041, 0.00074, 0.00148, 0.00227,
    0.00425, 0.00622, 0.00986, 0.01323, 0.02083, 0.02422, 0.03976, 0.04304,
    0.05747, 0.07402, 0.08305, 0.09404, 0.11462, 0.12553, 0.11817, 0.12631,
    0.13485, 0.11567, 0.10049, 0.08638, 0.07152, 0.06013, 0.04976, 0.03958,
    0.03248, 0.02532, 0.02003, 0.01764, 0.01372, 0.01115, 0.01136, 0.0087,
    0.00659, 0.00753, 0.00681, 0.00436, 0.00394, 0.00558, 0.00372, 0.00191,
];

/// Absorption of ozone \[per atm-cm\], linear between the table's entries, constant beyond its ends.
pub(crate) fn ozone_absorption(nm: f64) -> f64 {
    let at = ((nm - 365.0) / 10.0).clamp(0.0, (OZONE.len() - 1) as f64);
    let first = (at as usize).min(OZONE.len() - 2);
    OZONE[first] + (at - first as f64) * (OZONE[first + 1] - OZONE[first])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_are_those_of_the_tables() {
        // Bodhaine's own evaluation, printed to five digits: half a digit.
        for (nm, depth) in [(400.0, 0.36021), (550.0, 0.09707), (700.0, 0.03642)] {
            assert!((rayleigh_depth(nm) - depth).abs() <= 0.5e-5, "{nm}: {}", rayleigh_depth(nm));
        }
        // 300 DU take 3.8 % at the peak, head on (0.3 × 0.126).
        assert!((0.3 * ozone_absorption(575.0) - 0.0377).abs() < 0.5e-4);
        assert_eq!(ozone_absorption(0.0), OZONE[0]);
        assert_eq!(ozone_absorption(1e9), OZONE[47]);
    }

    #[test]
    fn air_mass_is_that_of_kasten_and_young_and_goes_on_below_the_horizon() {
        // Their own table's ends: 1 at the zenith (the fit misses by 3e-4) and 37.92 at the horizon.
        assert!((air_mass(90.0) - 1.0).abs() < 4e-4);
        assert!((air_mass(0.0) - 37.92).abs() < 0.005);
        // Continuous with its slope: across ±δ the two one-sided differences differ by O(δ²) m″ ≈ δ² · 8.
        let d = 1e-3;
        let second = air_mass(d) - 2.0 * air_mass(0.0) + air_mass(-d);
        assert!(second.abs() < 100.0 * d * d, "{second}");
    }

    #[test]
    fn direct_illuminance_is_near_that_of_the_ies() {
        // IES RP-21: 127.5 exp(−0.21 / sin h) klx: another model, not a truth. With β = 0.06 ours stays within
        // 3 % of it at these heights; below, 1/sin h is no air mass any more (at 5° ours is 20 % above).
        for altitude in [10.0_f64, 15.0, 20.0, 30.0, 45.0, 60.0, 75.0, 90.0] {
            let ies = 127_500.0 * (-0.21 / altitude.to_radians().sin()).exp();
            let ours = f64::from(direct_beam(altitude, 0.0, CLEAR_TURBIDITY).luminance());
            println!("{altitude:4}: {ours:8.0} lx, IES {ies:8.0} lx, {:+.1} %", 100.0 * (ours / ies - 1.0));
            assert!((ours / ies - 1.0).abs() < 0.03, "{altitude}: {ours} against {ies}");
        }
    }

    #[test]
    fn the_beam_rises_with_the_sun_without_a_step_and_ends_below_the_horizon() {
        let step = 0.05;
        let mut before = direct_beam(-90.0, 0.0, 0.1);
        assert!(before.is_zero());
        let brightest = direct_beam(90.0, 0.0, 0.0).max();
        for i in 1..=3600 {
            let now = direct_beam(-90.0 + step * f64::from(i), 0.0, 0.1);
            // It may fall by the rounding of its last digit, where it hardly changes.
            assert!(now.is_finite() && (now - before).0.iter().all(|&d| d >= -f32::EPSILON * brightest));
            // Steepest where m τ e^(−m τ) is largest (1/e) and m changes by 39 % a degree: 0.39/e · 0.05.
            assert!((now - before).max() <= 0.0072 * brightest, "{i}");
            before = now;
        }
    }

    #[test]
    fn height_and_clean_air_let_more_through() {
        for altitude in [0.0, 10.0, 60.0] {
            let (low, high) = (direct_beam(altitude, 0.0, 0.1), direct_beam(altitude, 2000.0, 0.1));
            let clean = direct_beam(altitude, 0.0, 0.02);
            assert!((high - low).0.iter().all(|&d| d > 0.0));
            assert!((clean - low).0.iter().all(|&d| d > 0.0));
        }
        assert!(direct_beam(30.0, 1e6, 1.0).is_finite());
        assert!(direct_beam(30.0, 0.0, 1e9).is_zero());
    }

    #[test]
    fn the_beam_and_the_sky_meet_the_same_air() {
        use crate::air::Optics;
        for altitude in [90.0f64, 30.0, 5.0, 1.0] {
            let beam = beam(&Air::CLEAR, altitude, 0.0);
            let sky = Optics::new(&Air::CLEAR).sunlight(GLOBE, altitude.to_radians().sin());
            for (band, sky) in sky.into_iter().enumerate() {
                // A whole band of width σ against one wavelength: ½ (m 4τ σ/λ)² by Rayleigh's depth, in the bluest
                // (4 · 0.25 · 11/437)²/2 = 3e-4 m², and half as much again by aerosol's.
                let air_mass = (1.0 / altitude.to_radians().sin()).min(27.0);
                let error = f64::from(beam[band]) / sky - 1.0;
                assert!(error.abs() < 5e-4 * air_mass.powi(2) + 0.001, "{altitude} {band}: {error}");
            }
        }
        for altitude in [-90.0, -30.0, -5.0, 0.0, 90.0] {
            assert!(direct_beam(altitude, 0.0, 0.0).is_finite(), "{altitude}");
        }
    }
}
