//! What moves a water's surface, from its table.

use glam::DVec2;

use crate::document::Spot;
use crate::file::{WaterTable, WaveTable, WindTable};
use crate::{Error, Site, SurfaceWaves, Wave, Wind};

/// How many waves a water may have, given one by one or raised by a wind.
const MOST: usize = 1024;

/// How many waves stand for a wind's unless it is said.
const FOR_WIND: u32 = 48;

/// The waves of the water called `name`.
pub(crate) fn waves(
    spot: &Spot<'_>,
    table: &WaterTable,
    site: &Site,
    name: &str,
) -> Result<SurfaceWaves, Error> {
    let given = table.waves.as_deref().unwrap_or_default();
    let key = spot.key("waves");
    if given.len() > MOST {
        return Err(key.error(format!("{} waves are too many: up to {MOST} are possible", given.len())));
    }
    let each = given.iter().enumerate().map(|(i, table)| wave(&key.index(i), table, site));
    let seed =
        || name.bytes().fold(0x811C_9DC5u32, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193));
    let wind = table.wind.as_ref().map(|table| wind(&spot.key("wind"), table, site, seed()));
    let moment = table.moment.map(|moment| spot.key("moment").within(moment, -1e9, 1e9, "s"));
    Ok(SurfaceWaves {
        each: each.collect::<Result<_, _>>()?,
        wind: wind.transpose()?,
        moment: moment.transpose()?.unwrap_or(0.0),
    })
}

fn wave(spot: &Spot<'_>, table: &WaveTable, site: &Site) -> Result<Wave, Error> {
    Ok(Wave {
        amplitude: spot.key("amplitude").within(table.amplitude, 0.0, 100.0, "m")?,
        wavelength: spot.key("wavelength").positive(table.wavelength, 1e6, "m")?,
        toward: along(site, spot.key("direction").within(table.direction, -360.0, 360.0, "degrees")?),
        phase: spot.key("phase").within(table.phase, -1e6, 1e6, "degrees")?.to_radians(),
    })
}

fn wind(spot: &Spot<'_>, table: &WindTable, site: &Site, by_name: u32) -> Result<Wind, Error> {
    let depth = table.depth.map(|depth| spot.key("depth").positive(depth, 12_000.0, "m"));
    let waves = table.waves.unwrap_or(FOR_WIND);
    spot.key("waves").within(f64::from(waves), 1.0, MOST as f64, "")?;
    Ok(Wind {
        speed: spot.key("speed").positive(table.speed, 100.0, "m/s")?,
        fetch: spot.key("fetch").positive(table.fetch, 1e7, "m")?,
        toward: -along(site, spot.key("direction").within(table.direction, -360.0, 360.0, "degrees")?),
        depth: depth.transpose()?,
        waves,
        seed: table.seed.unwrap_or(by_name),
    })
}

/// Unit vector of x and z at an azimuth.
fn along(site: &Site, azimuth: f64) -> DVec2 {
    let direction = site.direction(0.0, azimuth);
    DVec2::new(direction.x, direction.z)
}
