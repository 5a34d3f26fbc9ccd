//! Which water a table means.

use crate::document::Spot;
use crate::file::{PhaseTable, WaterTable};
use crate::{Error, MeasuredWater, WaterPhase, WaterQuality};

/// What water is when nothing is said of it.
const QUALITY: &str = "pool";

/// Longest table of a spectrum or a phase function.
const MOST_ROWS: usize = 100_000;

/// The water of a table.
pub(super) fn quality(spot: &Spot<'_>, table: &WaterTable) -> Result<WaterQuality, Error> {
    let measured = [&table.absorption, &table.scattering, &table.extinction];
    let is_measured = measured.iter().any(|rows| rows.is_some());
    let given = [
        ("quality", table.quality.is_some()),
        ("secchi", table.secchi.is_some()),
        ("chlorophyll", table.chlorophyll.is_some()),
        ("absorption, scattering or extinction", is_measured),
    ];
    if given.iter().any(|(_, is)| *is) {
        spot.exactly_one(&given)?;
    }
    if table.phase.is_some() && !is_measured {
        let what =
            "is for water that is measured: absorption, scattering, extinction; other waters have their own";
        return Err(spot.key("phase").error(what));
    }
    match (&table.quality, table.secchi, table.chlorophyll) {
        (Some(name), ..) => Ok(WaterQuality::Named(name.clone())),
        (_, Some(depth), _) => Ok(WaterQuality::Secchi(depth)),
        (.., Some(chlorophyll)) => Ok(WaterQuality::Chlorophyll(chlorophyll)),
        _ if is_measured => Ok(WaterQuality::Measured(self::measured(spot, table)?)),
        _ => Ok(WaterQuality::Named(QUALITY.to_owned())),
    }
}

fn measured(spot: &Spot<'_>, table: &WaterTable) -> Result<MeasuredWater, Error> {
    let rows = |key: &str, rows: &Option<Vec<[f64; 2]>>| {
        rows.as_ref().map(|rows| self::rows(&spot.key(key), rows)).transpose()
    };
    let measured = MeasuredWater {
        absorption: rows("absorption", &table.absorption)?,
        scattering: rows("scattering", &table.scattering)?,
        extinction: rows("extinction", &table.extinction)?,
        phase: table
            .phase
            .as_ref()
            .map_or(Ok(WaterPhase::default()), |phase| self::phase(&spot.key("phase"), phase))?,
    };
    let given = [&measured.absorption, &measured.scattering, &measured.extinction];
    match given.iter().filter(|rows| rows.is_some()).count() {
        2 => Ok(measured),
        count => Err(spot.error(format!(
            "{count} of absorption a, scattering b and extinction c = a + b are given, but two are needed"
        ))),
    }
}

/// Pairs of numbers; what they may be is for the water to say.
fn rows(spot: &Spot<'_>, rows: &[[f64; 2]]) -> Result<Vec<(f64, f64)>, Error> {
    if rows.is_empty() || rows.len() > MOST_ROWS {
        return Err(spot.error(format!("{} rows: from 1 to {MOST_ROWS} are possible", rows.len())));
    }
    Ok(rows.iter().map(|[x, y]| (*x, *y)).collect())
}

fn phase(spot: &Spot<'_>, table: &PhaseTable) -> Result<WaterPhase, Error> {
    Ok(match table {
        PhaseTable::Named(name) => match name.as_str() {
            "petzold" => WaterPhase::Petzold,
            "molecular" => WaterPhase::Molecular,
            "thesis" => WaterPhase::Thesis,
            _ => {
                let what =
                    format!("{name:?} is unknown; there are \"petzold\", \"molecular\" and \"thesis\"");
                return Err(spot.error(what));
            }
        },
        PhaseTable::BeardsleyZaneveld { forward, backward } => {
            WaterPhase::BeardsleyZaneveld([*forward, *backward])
        }
        PhaseTable::FournierForand { index, slope } => WaterPhase::FournierForand([*index, *slope]),
        PhaseTable::Table(rows) => WaterPhase::Table(self::rows(spot, rows)?),
    })
}
