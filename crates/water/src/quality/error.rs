//! Why there is no such water.

use std::fmt;

use super::names;

/// Why there is no such water.
#[derive(Clone, Debug, PartialEq)]
pub enum QualityError {
    /// No water has this name.
    Unknown(String),
    /// Fewer or more than two of absorption, scattering and extinction are given.
    NotTwo(usize),
    /// A table has no row.
    Empty(&'static str),
    /// Wavelengths of a table do not rise at this row (counted from 1), or are not positive numbers.
    Order(&'static str, usize),
    /// A value of a table is negative or not finite: row (counted from 1) and value.
    Value(&'static str, usize, f64),
    /// More light is scattered or absorbed than is lost: what, wavelength \[nm\], its coefficient, the extinction \[1/m\].
    MoreThanLost(&'static str, f64, f64, f64),
    /// A coefficient is negative or not finite in the band around this wavelength \[nm\].
    Coefficient(&'static str, f64, f64),
    /// A number is outside its range: what, unit, value, least, largest.
    Range(&'static str, &'static str, f64, f64, f64),
}

impl fmt::Display for QualityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => {
                let known: Vec<_> = names().collect();
                write!(f, "no water is called '{name}'; there are {}", known.join(", "))
            }
            Self::NotTwo(given) => write!(
                f,
                "{given} of absorption a, scattering b and extinction c are given; two are needed, the third is c = a + b"
            ),
            Self::Empty(what) => write!(f, "the table of {what} is empty"),
            Self::Order(what, row) => {
                write!(
                    f,
                    "wavelengths of the table of {what} must be positive and rise, but row {row} does not"
                )
            }
            Self::Value(what, row, value) => {
                write!(f, "{what} in row {row} is {value}, but must be a number of 0 or more")
            }
            Self::MoreThanLost(what, nm, value, lost) => {
                write!(f, "at {nm} nm {what} ({value} 1/m) exceeds the extinction c = a + b ({lost} 1/m)")
            }
            Self::Coefficient(what, nm, value) => {
                write!(f, "{what} around {nm} nm is {value} 1/m, but must be a number of 0 or more")
            }
            Self::Range(what, unit, value, least, largest) => {
                let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
                write!(f, "{what} is {value}{unit}, but must lie within {least} and {largest}{unit}")
            }
        }
    }
}

impl std::error::Error for QualityError {}
