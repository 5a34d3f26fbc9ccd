//! Place, time, north; and the sun and sky that follow from them.

use jiff::Timestamp;
use jiff::fmt::temporal::Pieces;
use jiff::tz::Offset;

use crate::document::Spot;
use crate::file::{Moment, SceneFile, SiteTable, SkyTable, SunTable};
use crate::{Error, SUN_DIAMETER, Site, Sky, Sun};

/// Brightest sun that is believed \[lx\]: the solar constant gives 134,000 lx outside the atmosphere.
pub(crate) const BRIGHTEST_SUN: f64 = 150_000.0;

/// An example that messages show.
const EXAMPLE: &str = "write it like 2026-06-21T10:00:00+09:00";

/// The site; the default one where the file has none.
pub(crate) fn site(root: &Spot<'_>, table: Option<&SiteTable>) -> Result<Site, Error> {
    let Some(table) = table else { return Ok(Site::default()) };
    let spot = root.key("site");
    let latitude = spot.key("latitude");
    let latitude = latitude.within(latitude.required(table.latitude)?, -90.0, 90.0, "degrees")?;
    let longitude = spot.key("longitude");
    let longitude =
        longitude.within(longitude.required(table.longitude)?, -180.0, 180.0, "degrees, east positive")?;
    let elevation = spot.key("elevation").within(table.elevation.unwrap_or(0.0), -500.0, 9000.0, "m")?;
    let north = spot.key("north").within(table.north.unwrap_or(0.0), -360.0, 360.0, "degrees")?;
    let default = Site::default();
    let (time, offset) = match &table.time {
        None => (default.time, default.offset),
        Some(moment) => time(&spot.key("time"), moment)?,
    };
    let site = Site { latitude, longitude, elevation, time, offset, north };
    if site.sun().is_none() {
        return Err(spot.key("time").error("the sun's position is known for the years 1 to 2999 only"));
    }
    Ok(site)
}

/// A moment and the offset of the clock that shows it.
fn time(spot: &Spot<'_>, moment: &Moment) -> Result<(Timestamp, Offset), Error> {
    let text = match moment {
        Moment::Text(text) => text.clone(),
        Moment::Native(datetime) => datetime.to_string(),
    };
    let wrong = |why: &str| spot.error(format!("{text:?}: {why}; {EXAMPLE}"));
    let pieces = Pieces::parse(&text).map_err(|error| wrong(&error.to_string()))?;
    let clock = pieces.time().ok_or_else(|| wrong("the time of day is missing"))?;
    let offset = pieces.to_numeric_offset().ok_or_else(|| wrong("the offset from UTC is missing"))?;
    // Clocks on earth run from UTC−12 to UTC+14.
    if !(-12 * 3600..=14 * 3600).contains(&offset.seconds()) {
        return Err(wrong("the offset must be within −12:00 and +14:00"));
    }
    let time =
        offset.to_timestamp(pieces.date().to_datetime(clock)).map_err(|error| wrong(&error.to_string()))?;
    if !(1..=2999).contains(&pieces.date().year()) {
        return Err(wrong("years from 1 to 2999 are possible"));
    }
    Ok((time, offset))
}

/// The sun: as `[sun]` says, else that of place and time if the file gives both. Below the horizon it stays
/// where it is: it lights nothing, but a sky at dusk asks where it went.
pub(crate) fn sun(root: &Spot<'_>, file: &SceneFile, site: &Site) -> Result<Option<Sun>, Error> {
    let timed = file.site.as_ref().is_some_and(|site| site.time.is_some());
    let Some(table) = &file.sun else { return Ok(if timed { site.sun() } else { None }) };
    if table.off {
        return Ok(None);
    }
    let spot = root.key("sun");
    let placed = explicit(&spot, table, site)?;
    if placed.is_none() && !timed {
        return Err(spot.error("needs altitude and azimuth, or a [site] with latitude, longitude and time"));
    }
    let Some(mut sun) = placed.or_else(|| site.sun()) else { return Ok(None) };
    sun.illuminance =
        table.illuminance.map(|lx| spot.key("illuminance").within(lx, 0.0, 1e9, "lx")).transpose()?;
    sun.spectrum = spot.spectrum(table.temperature, table.rgb, table.spectrum.as_deref())?;
    if let Some(diameter) = table.diameter {
        sun.diameter = spot.key("diameter").within(diameter, 0.0, 10.0, "degrees")?;
    }
    Ok(Some(sun))
}

fn explicit(spot: &Spot<'_>, table: &SunTable, site: &Site) -> Result<Option<Sun>, Error> {
    match (table.altitude, table.azimuth) {
        (None, None) => Ok(None),
        (Some(altitude), Some(azimuth)) => {
            let altitude = spot.key("altitude").within(altitude, -90.0, 90.0, "degrees")?;
            let azimuth = spot.key("azimuth").within(azimuth, -360.0, 360.0, "degrees")?.rem_euclid(360.0);
            let toward = site.direction(altitude, azimuth);
            Ok(Some(Sun {
                toward,
                altitude,
                azimuth,
                illuminance: None,
                spectrum: None,
                diameter: SUN_DIAMETER,
            }))
        }
        (Some(_), None) => Err(spot.key("azimuth").error("is required beside altitude")),
        (None, Some(_)) => Err(spot.key("altitude").error("is required beside azimuth")),
    }
}

/// The sky: as `[sky]` says, else a clear one where place and time are given.
pub(crate) fn sky(root: &Spot<'_>, file: &SceneFile) -> Result<Option<Sky>, Error> {
    let timed = file.site.as_ref().is_some_and(|site| site.time.is_some());
    let clear = || Sky { model: "clear".to_owned(), illuminance: None };
    let Some(table) = &file.sky else { return Ok(timed.then(clear)) };
    let SkyTable { off, model, illuminance, more: _ } = table;
    if *off {
        return Ok(None);
    }
    let spot = root.key("sky");
    let model = model.clone().unwrap_or_else(|| clear().model);
    if model.is_empty() {
        return Err(spot
            .key("model")
            .error("is empty; clear, overcast and uniform are among the possible names"));
    }
    let illuminance = illuminance.map(|lx| spot.key("illuminance").within(lx, 0.0, 1e6, "lx")).transpose()?;
    Ok(Some(Sky { model, illuminance }))
}
