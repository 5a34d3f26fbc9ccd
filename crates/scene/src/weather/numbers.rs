//! Fields of a weather file: numbers, and the codes that say that there is none.

/// A field as a number; none if it is empty.
fn number(text: &str) -> Result<Option<f64>, String> {
    let text = text.trim();
    if text.is_empty() {
        return Ok(None);
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(Some(value)),
        _ => Err(format!("{text:?} is not a number")),
    }
}

/// A field that must be there, within \[`low`, `high`\].
pub(super) fn needed(text: &str, name: &str, low: f64, high: f64) -> Result<f64, String> {
    match number(text).map_err(|what| format!("{name}: {what}"))? {
        Some(value) if (low..=high).contains(&value) => Ok(value),
        Some(value) => Err(format!("{name}: {value} is not within [{low}, {high}]")),
        None => Err(format!("{name} is missing")),
    }
}

/// A whole number that must be there, within \[`low`, `high`\].
pub(super) fn whole(text: &str, name: &str, low: i8, high: i8) -> Result<i8, String> {
    let value = needed(text, name, f64::from(low), f64::from(high))?;
    if value.fract() == 0.0 { Ok(value as i8) } else { Err(format!("{name}: {value} is not a whole number")) }
}

/// An irradiance \[W/m²\]: 9999 and more means missing; a few watts below zero are the instrument's zero.
pub(super) fn irradiance(text: &str, name: &str) -> Result<Option<f64>, String> {
    /// The sun outside the atmosphere gives 1412 W/m² in January.
    const MOST: f64 = 1500.0;
    const ZERO_OFF: f64 = -20.0;
    match number(text).map_err(|what| format!("{name}: {what}"))? {
        Some(value) if value >= 9999.0 => Ok(None),
        Some(value) if !(ZERO_OFF..=MOST).contains(&value) => {
            Err(format!("{name}: {value} W/m² is not within [0, {MOST}]; 9999 means missing"))
        }
        value => Ok(value.map(|value| value.max(0.0))),
    }
}

/// A temperature \[°C\]: 99.9 and more means missing.
pub(super) fn temperature(text: &str, name: &str) -> Result<Option<f64>, String> {
    match number(text).map_err(|what| format!("{name}: {what}"))? {
        Some(value) if value >= 99.0 => Ok(None),
        Some(value) if !(-100.0..=70.0).contains(&value) => {
            Err(format!("{name}: {value} °C is not within [-100, 70]; 99.9 means missing"))
        }
        value => Ok(value),
    }
}

/// An aerosol depth as the file has it: 0.999, 999 and more, 0 (no air is without aerosol) mean missing.
pub(super) fn aerosol(text: &str, name: &str) -> Result<Option<f64>, String> {
    let value = number(text).map_err(|what| format!("{name}: {what}"))?;
    // 0.999 as written in any number of digits.
    let code = |value: f64| (value - 0.999).abs() < 5e-4 || value >= 999.0;
    match value {
        Some(value) if value < 0.0 => Err(format!("{name}: {value} is below 0")),
        value => Ok(value.filter(|&value| value > 0.0 && !code(value))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_for_missing_values_are_no_values() {
        for text in ["9999", "9999.", " 99999 ", ""] {
            assert_eq!(irradiance(text, "a"), Ok(None), "{text}");
        }
        assert_eq!(irradiance(" 812.5", "a"), Ok(Some(812.5)));
        assert_eq!(irradiance("-3", "a"), Ok(Some(0.0)));
        assert_eq!(temperature("99.9", "a"), Ok(None));
        assert_eq!(temperature("-12.5", "a"), Ok(Some(-12.5)));
        for text in [".999", "0.9990", "999", "9999", "0", ""] {
            assert_eq!(aerosol(text, "a"), Ok(None), "{text}");
        }
        assert_eq!(aerosol("0.259", "a"), Ok(Some(0.259)));
    }

    #[test]
    fn absurd_values_are_named() {
        for (result, word) in [
            (irradiance("1e4x", "direct"), "direct: \"1e4x\" is not a number"),
            (irradiance("nan", "direct"), "not a number"),
            (irradiance("2000", "direct"), "2000 W/m² is not within [0, 1500]"),
            (irradiance("-200", "direct"), "-200 W/m²"),
            (temperature("-300", "dew point"), "dew point: -300 °C"),
            (aerosol("-1", "aerosol"), "aerosol: -1 is below 0"),
        ] {
            assert!(result.clone().is_err_and(|what| what.contains(word)), "{result:?}");
        }
        assert!(whole("6.5", "month", 1, 12).is_err_and(|what| what.contains("whole")));
        assert_eq!(whole("12", "month", 1, 12), Ok(12));
    }
}
