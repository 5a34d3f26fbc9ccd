//! The sun's spectrum outside the atmosphere.

use light::Spectrum;

/// Wavelength of the first entry of [`IRRADIANCE`] \[nm\].
const FIRST_NM: f64 = 360.0;
/// Wavelength from one entry to the next \[nm\].
const STEP_NM: f64 = 5.0;

/// Irradiance facing the sun at its mean distance (1 au), 360 to 830 nm every 5 nm \[W m⁻² nm⁻¹\].
///
/// Source: the extraterrestrial column of ASTM G173-03 (Gueymard 2004), averaged over ±2.5 nm. The older
/// spectrum of Neckel and Labs (Bird and Riordan 1986) agrees within 4 % from 420 nm up.
#[rustfmt::skip]
const IRRADIANCE: [f64; 95] = [
    0.9291, 1.1507, 1.1946, 1.0526, 1.1893, 0.9339, 1.1739, 0.9382, 1.6258, 1.7064,
    1.7116, 1.7606, 1.7257, 1.7061, 1.4578, 1.743, 1.7696, 1.9107, 2.05, 2.012,
    2.0379, 2.0089, 1.9975, 2.027, 2.0612, 1.8822, 1.9184, 1.9748, 1.8998, 1.9343,
    1.9353, 1.8076, 1.8139, 1.8463, 1.9276, 1.8693, 1.8367, 1.8769, 1.8648, 1.858,
    1.8177, 1.8328, 1.8308, 1.8518, 1.8287, 1.8359, 1.7533, 1.7913, 1.7543, 1.7631,
    1.731, 1.6786, 1.7034, 1.6651, 1.6609, 1.6447, 1.6303, 1.6121, 1.5769, 1.4844,
    1.5511, 1.5551, 1.5326, 1.5087, 1.4942, 1.4629, 1.471, 1.4454, 1.4178, 1.4154,
    1.3942, 1.3674, 1.3429, 1.3491, 1.3188, 1.32, 1.2775, 1.2902, 1.2742, 1.2691,
    1.2543, 1.2339, 1.2153, 1.208, 1.1971, 1.1869, 1.169, 1.1398, 1.1387, 1.1227,
    1.1111, 1.111, 1.0742, 1.0734, 1.0603,
];

/// Irradiance facing the sun outside the atmosphere, at the mean distance of the earth \[W m⁻² nm⁻¹\].
///
/// Over a year the distance changes this by ±3.4 %, which is left out.
pub fn extraterrestrial() -> Spectrum {
    Spectrum::from_fn(irradiance)
}

/// The table at a wavelength \[nm\], linear between its entries, constant beyond its ends.
pub(crate) fn irradiance(nm: f64) -> f64 {
    let at = ((nm - FIRST_NM) / STEP_NM).clamp(0.0, (IRRADIANCE.len() - 1) as f64);
    let first = (at as usize).min(IRRADIANCE.len() - 2);
    IRRADIANCE[first] + (at - first as f64) * (IRRADIANCE[first + 1] - IRRADIANCE[first])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_holds_the_solar_constant_of_its_range() {
        // Planck's law at 5772 K (IAU 2015) puts 52.7 % of 1361 W/m² between 360 and 830 nm; the real sun
        // is less even than a black body, but by less than 5 % over so wide a range.
        let total: f64 = IRRADIANCE.iter().sum::<f64>() * STEP_NM;
        assert!((total / (0.527 * 1361.0) - 1.0).abs() < 0.05, "{total}");
    }

    #[test]
    fn illuminance_outside_the_atmosphere_is_the_solar_illuminance_constant() {
        // 132.2 klx: the table weighed with V(λ) in steps of 5 nm. Bands keep luminance within 2 %.
        let lux = extraterrestrial().luminance();
        assert!((lux / 132_200.0 - 1.0).abs() < 0.02, "{lux}");
    }

    #[test]
    fn the_table_is_linear_between_its_entries_and_constant_beyond() {
        assert_eq!(irradiance(365.0), 1.1507);
        assert!((irradiance(362.5) - (0.9291 + 1.1507) / 2.0).abs() < 1e-15, "rounding");
        assert_eq!(irradiance(100.0), IRRADIANCE[0]);
        assert_eq!(irradiance(2000.0), IRRADIANCE[IRRADIANCE.len() - 1]);
    }
}
