//! Checks of single values; each failure names its place and what was possible.

use glam::{DVec3, Vec3};
use light::colour::decode_srgb;

use crate::document::Spot;
use crate::file::Colour;
use crate::{Error, LightSpectrum};

/// Coordinates beyond this are a mistake: the earth's circumference \[m\].
const FARTHEST: f64 = 4.0e7;

impl Spot<'_> {
    /// `value` if it lies within \[`low`, `high`\].
    pub(crate) fn within(&self, value: f64, low: f64, high: f64, unit: &str) -> Result<f64, Error> {
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        Err(self.error(format!("{value} is not within [{low}, {high}]{}{unit}", gap(unit))))
    }

    /// `value` if it is above 0 and at most `high`.
    pub(crate) fn positive(&self, value: f64, high: f64, unit: &str) -> Result<f64, Error> {
        if value > 0.0 && value <= high {
            return Ok(value);
        }
        Err(self.error(format!("{value} is not within (0, {high}]{}{unit}", gap(unit))))
    }

    /// A point \[m\] that lies on or about the earth.
    pub(crate) fn point(&self, value: [f64; 3]) -> Result<DVec3, Error> {
        let point = DVec3::from_array(value);
        if point.is_finite() && point.abs().max_element() <= FARTHEST {
            return Ok(point);
        }
        Err(self
            .error(format!("{value:?} is not a point: coordinates must be finite and within ±{FARTHEST} m")))
    }

    /// The elements of this array as points; a place is worked out only for the one that is wrong.
    pub(crate) fn points(&self, values: &[[f64; 3]]) -> Result<Vec<DVec3>, Error> {
        let sound = |p: &DVec3| p.is_finite() && p.abs().max_element() <= FARTHEST;
        let points: Vec<DVec3> = values.iter().copied().map(DVec3::from_array).collect();
        match points.iter().position(|p| !sound(p)) {
            None => Ok(points),
            Some(i) => self.index(i).point(values[i]).map(|_| points),
        }
    }

    /// A direction as a unit vector.
    pub(crate) fn direction(&self, value: [f64; 3]) -> Result<DVec3, Error> {
        let given = DVec3::from_array(value);
        // Only finite, non-zero directions have a largest component to scale by, which keeps 1e-200 exact.
        let largest = given.abs().max_element();
        let unit = (given / largest).try_normalize().filter(|_| given.is_finite() && largest > 0.0);
        unit.ok_or_else(|| {
            self.error(format!("{value:?} is not a direction: it must be finite and not zero"))
        })
    }

    /// Linear sRGB within \[0, 1\].
    pub(crate) fn colour(&self, value: &Colour) -> Result<Vec3, Error> {
        match value {
            Colour::Grey(grey) => Ok(Vec3::splat(self.within(*grey, 0.0, 1.0, "")? as f32)),
            Colour::Linear(rgb) => {
                for channel in rgb {
                    self.within(*channel, 0.0, 1.0, "")?;
                }
                Ok(DVec3::from_array(*rgb).as_vec3())
            }
            Colour::Hex(text) => hex(text).ok_or_else(|| {
                self.error(format!("{text:?} is not a colour: write \"#rrggbb\", such as \"#c8b090\""))
            }),
        }
    }

    /// The colour of a light from the three ways to give it, of which at most one may be used.
    pub(crate) fn spectrum(
        &self,
        temperature: Option<f64>,
        rgb: Option<[f64; 3]>,
        table: Option<&[[f64; 2]]>,
    ) -> Result<Option<LightSpectrum>, Error> {
        match (temperature, rgb, table) {
            (None, None, None) => Ok(None),
            (Some(kelvin), None, None) => {
                let kelvin = self.key("temperature").within(kelvin, 1000.0, 25000.0, "K")?;
                Ok(Some(LightSpectrum::Temperature(kelvin)))
            }
            (None, Some(rgb), None) => {
                let spot = self.key("rgb");
                for channel in rgb {
                    spot.within(channel, 0.0, 1e6, "")?;
                }
                if rgb == [0.0; 3] {
                    return Err(spot.error("a light has no colour where all three numbers are 0"));
                }
                Ok(Some(LightSpectrum::Rgb(DVec3::from_array(rgb).as_vec3())))
            }
            (None, None, Some(table)) => self.key("spectrum").spectrum_table(table).map(Some),
            _ => Err(self.error("the colour is given more than once: use one of temperature, rgb, spectrum")),
        }
    }

    fn spectrum_table(&self, table: &[[f64; 2]]) -> Result<LightSpectrum, Error> {
        if table.is_empty() || table.len() > 100_000 {
            return Err(self.error(format!("{} rows: from 1 to 100000 are possible", table.len())));
        }
        for (i, row) in table.iter().enumerate() {
            let spot = self.index(i);
            spot.within(row[0], 100.0, 10_000.0, "nm")?;
            spot.within(row[1], 0.0, 1e12, "")?;
            if i > 0 && table[i - 1][0] >= row[0] {
                return Err(spot.error(format!(
                    "wavelength {} nm does not rise above {}",
                    row[0],
                    table[i - 1][0]
                )));
            }
        }
        if table.iter().all(|row| row[1] == 0.0) {
            return Err(self.error("all powers are 0"));
        }
        Ok(LightSpectrum::Table(table.iter().map(|row| (row[0], row[1])).collect()))
    }

    /// Which one of the alternatives `given` (name, is it there?) is used; exactly one must be.
    pub(crate) fn exactly_one(&self, given: &[(&str, bool)]) -> Result<(), Error> {
        let used: Vec<&str> = given.iter().filter(|g| g.1).map(|g| g.0).collect();
        if used.len() == 1 {
            return Ok(());
        }
        let all = given.iter().map(|g| g.0).collect::<Vec<_>>().join(", ");
        if used.is_empty() {
            Err(self.error(format!("needs one of {all}")))
        } else {
            Err(self.error(format!("has {} at once, but only one of {all} is possible", used.join(" and "))))
        }
    }

    /// The value, or an error that it is missing.
    pub(crate) fn required<T>(&self, value: Option<T>) -> Result<T, Error> {
        value.ok_or_else(|| self.error("is required"))
    }
}

fn gap(unit: &str) -> &'static str {
    if unit.is_empty() { "" } else { " " }
}

/// `#rrggbb` in sRGB to linear.
fn hex(text: &str) -> Option<Vec3> {
    let digits =
        text.strip_prefix('#').filter(|d| d.len() == 6 && d.bytes().all(|b| b.is_ascii_hexdigit()))?;
    let code = u32::from_str_radix(digits, 16).ok()?;
    let channel = |shift: u32| decode_srgb((code >> shift & 255) as f32 / 255.0);
    Some(Vec3::new(channel(16), channel(8), channel(0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_colours_are_srgb() {
        assert_eq!(hex("#ffffff"), Some(Vec3::ONE));
        assert_eq!(hex("#000000"), Some(Vec3::ZERO));
        // IEC 61966-2-1: 0x80 = 128/255 is 0.215861 in linear light; rounding of f32 is far below 1e-6.
        assert!((hex("#800000").unwrap().x - 0.215_861).abs() < 1e-6);
        for wrong in ["ffffff", "#fff", "#gggggg", "#ffffff0", "#ää", "#+fffff"] {
            assert_eq!(hex(wrong), None, "{wrong}");
        }
    }
}
