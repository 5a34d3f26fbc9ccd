//! Bodies of water, from `[[water]]` tables.

mod quality;
mod surface;

use super::models::Claims;
use super::waves;
use crate::document::Spot;
use crate::file::WaterTable;
use crate::{Error, Site, Water};

pub(crate) use surface::claims;

/// Most that a factor on the scattering may be.
const MOST_TIMES: f64 = 1e6;

/// The water of a table, the models' nodes that it claims being known.
pub(crate) fn water(
    spot: &Spot<'_>,
    number: usize,
    table: &WaterTable,
    (claims, site): (&Claims, &Site),
) -> Result<Water, Error> {
    let (surface, place) = match &table.polygon {
        Some(polygon) => surface::drawn(&spot.key("polygon"), polygon)?,
        None => surface::of_model(spot, number - 1, claims)?,
    };
    let times =
        spot.key("scattering_times").within(table.scattering_times.unwrap_or(1.0), 0.0, MOST_TIMES, "")?;
    let name = surface::name(table, number);
    Ok(Water {
        waves: waves::waves(spot, table, site, &name)?,
        name,
        surface,
        place,
        quality: quality::quality(spot, table)?,
        scattering_times: times,
        index: table.index.map(|index| spot.key("index").within(index, 1.0, 2.0, "")).transpose()?,
    })
}
