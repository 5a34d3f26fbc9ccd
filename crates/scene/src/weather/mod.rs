//! Weather years: what sun and sky sent to a station in every hour of a typical year.
//!
//! **Answers.** [`read`] gives a [`Year`] from an EnergyPlus weather file (`.epw`), and [`Year::at`] the
//! [`Weather`] at a place and moment.
//!
//! **Leaves out.** All columns but direct and diffuse irradiance, dew point and aerosol depth; several records an
//! hour (an error). The illuminances of such files are themselves computed from irradiances.
//!
//! **Where it is wrong.** A row is the mean of an hour; clouds that pass within it are lost. The year of the moment
//! does not matter: months of a typical year come from different years.

mod epw;
mod moment;
mod numbers;

use std::path::Path;

pub use epw::parse;
pub use moment::Weather;

use crate::{Error, Warning, regular_file};

/// The longest weather file that is read \[bytes\]: a year takes 1.5 MB.
const MAX_BYTES: u64 = 64 << 20;

/// Where the weather was observed.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Its name.
    pub name: String,
    /// Degrees, north +, within \[−90, 90\].
    pub latitude: f64,
    /// Degrees, EAST +, within \[−180, 180\].
    pub longitude: f64,
    /// Standard time's offset from UTC \[s\], a multiple of 60; the rows know no summer time.
    pub offset: i32,
    /// Height above the sea \[m\].
    pub elevation: f64,
}

/// The mean of an hour; none = missing in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Hour {
    /// On a plane that faces the sun \[W/m²\], ≥ 0.
    direct_normal: Option<f64>,
    /// From the sky on a horizontal plane \[W/m²\], ≥ 0.
    diffuse_horizontal: Option<f64>,
    /// \[°C\].
    dew_point: Option<f64>,
    /// Broadband optical depth of the aerosol, > 0.
    aerosol_depth: Option<f64>,
}

/// A weather file: a year of hours, or some periods of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Year {
    /// Where.
    pub station: Station,
    /// What was repaired or is missing.
    pub warnings: Vec<Warning>,
    /// By [`slot`]; none where the file has no row.
    hours: Vec<Option<Hour>>,
}

/// Hours of a leap year.
const SLOTS: usize = 366 * 24;

/// Number of an hour in a leap year; `month`, `day` from 1, `hour` from 0. None for a day that no year has.
fn slot(month: i8, day: i8, hour: i8) -> Option<usize> {
    // Any leap year will do.
    let date = jiff::civil::Date::new(2000, month, day).ok()?;
    (0..24).contains(&hour).then(|| (date.day_of_year() as usize - 1) * 24 + hour as usize)
}

/// Reads a weather file.
///
/// # Errors
/// [`Error::Io`] from the disk; what [`parse`] finds in the file, with its line.
pub fn read(path: &Path) -> Result<Year, Error> {
    parse(&regular_file::whole(path, MAX_BYTES)?, path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_are_the_hours_of_a_leap_year() {
        assert_eq!(slot(1, 1, 0), Some(0));
        assert_eq!(slot(2, 29, 0), Some(59 * 24)); // 31 + 28 days before it
        assert_eq!(slot(12, 31, 23), Some(SLOTS - 1));
        for (month, day, hour) in [(2, 30, 0), (13, 1, 0), (0, 1, 0), (1, 0, 0), (1, 1, 24), (1, 1, -1)] {
            assert_eq!(slot(month, day, hour), None, "{month}/{day} {hour}");
        }
    }
}
