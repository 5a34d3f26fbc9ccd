//! A water from what was measured of it.

use light::Spectrum;

use super::{QualityError, Scatterer, Water};
use crate::Phase;

/// Rows of wavelength \[nm\], rising, and coefficient \[1/m\].
type Table<'a> = &'a [(f64, f64)];

/// Two of the three coefficients by wavelength, and what no spectrometer tells.
#[derive(Clone, Debug)]
pub struct Measured<'a> {
    /// Absorption a: rows of wavelength \[nm\], rising, and coefficient \[1/m\].
    pub absorption: Option<Table<'a>>,
    /// Scattering b, likewise.
    pub scattering: Option<Table<'a>>,
    /// Extinction c = a + b, likewise.
    pub extinction: Option<Table<'a>>,
    /// Where scattered light goes.
    pub phase: Phase,
    /// Index of refraction relative to air, 1 to 2.
    pub index: f64,
}

impl Water {
    /// The water of these measurements: linear between the rows, constant beyond them.
    ///
    /// ```
    /// use keikan_water::{Phase, Water, quality::{FRESH, Measured}};
    /// let pond = Measured {
    ///     absorption: None,
    ///     scattering: Some(&[(550.0, 2.0)]),
    ///     extinction: Some(&[(400.0, 3.0), (600.0, 1.0)]),
    ///     phase: Phase::petzold(),
    ///     index: FRESH,
    /// };
    /// let error = Water::measured(&pond).unwrap_err().to_string();
    /// assert_eq!(error, "at 550 nm scattering b (2 1/m) exceeds the extinction c = a + b (1.5 1/m)");
    /// ```
    pub fn measured(measured: &Measured) -> Result<Self, QualityError> {
        let tables = [
            ("absorption", measured.absorption),
            ("scattering", measured.scattering),
            ("extinction", measured.extinction),
        ];
        for (what, table) in tables {
            table.map_or(Ok(()), |table| check(what, table))?;
        }
        let (absorption, scattering) = match tables.map(|(_, table)| table) {
            [Some(a), Some(b), None] => (Spectrum::from_table(a), Spectrum::from_table(b)),
            [Some(a), None, Some(c)] => (Spectrum::from_table(a), rest("absorption a", a, c)?),
            [None, Some(b), Some(c)] => (rest("scattering b", b, c)?, Spectrum::from_table(b)),
            given => return Err(QualityError::NotTwo(given.iter().flatten().count())),
        };
        let scatterer = Scatterer { scattering, phase: measured.phase.clone() };
        Self::new(absorption, vec![scatterer], measured.index)
    }
}

fn check(what: &'static str, table: Table) -> Result<(), QualityError> {
    if table.is_empty() {
        return Err(QualityError::Empty(what));
    }
    let mut before = 0.0;
    for (row, &(nm, value)) in table.iter().enumerate() {
        if !(nm > before && nm.is_finite()) {
            return Err(QualityError::Order(what, row + 1));
        }
        if !(value >= 0.0 && value.is_finite()) {
            return Err(QualityError::Value(what, row + 1, value));
        }
        before = nm;
    }
    Ok(())
}

/// c − part, if that is nowhere negative: both are linear between rows, so it suffices to look at the rows of either.
fn rest(what: &'static str, part: Table, whole: Table) -> Result<Spectrum, QualityError> {
    for &(nm, _) in part.iter().chain(whole) {
        let (part, whole) = (read(part, nm), read(whole, nm));
        if part > whole {
            return Err(QualityError::MoreThanLost(what, nm, part, whole));
        }
    }
    Ok(Spectrum::from_fn(|nm| (read(whole, nm) - read(part, nm)).max(0.0)))
}

/// Linear between rows, constant beyond them; as [`Spectrum::from_table`].
pub(super) fn read(table: Table, nm: f64) -> f64 {
    let after = table.partition_point(|row| row.0 <= nm);
    match (after.checked_sub(1).and_then(|i| table.get(i)), table.get(after)) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (nm - a.0) / (b.0 - a.0),
        (Some(end), None) | (None, Some(end)) => end.1,
        (None, None) => 0.0,
    }
}
