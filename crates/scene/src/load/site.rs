//! Place, time, north; and the sun and sky that follow from them.

use std::sync::Arc;

use jiff::Timestamp;
use jiff::fmt::temporal::Pieces;
use jiff::tz::Offset;

use super::draft::Draft;
use crate::daylight::Observed;
use crate::document::Spot;
use crate::file::{Moment, SceneFile, SiteTable, SkyTable, SunTable};
use crate::sky_table;
use crate::weather::{self, Station};
use crate::{Error, SUN_DIAMETER, Site, Sky, Sun, Warning};

/// Brightest sun that is believed \[lx\]: the solar constant gives 134,000 lx outside the atmosphere.
pub(crate) const BRIGHTEST_SUN: f64 = 150_000.0;

/// An example that messages show.
const EXAMPLE: &str = "write it like 2026-06-21T10:00:00+09:00";

/// Farther from its station weather is another one \[m\].
const FAR: f64 = 100_000.0;

/// Place and time, and the sun and sky that follow.
pub(crate) fn daylight(root: &Spot<'_>, file: &SceneFile, draft: &mut Draft) -> Result<(), Error> {
    let observed = weather(root, file)?;
    let station = observed.as_ref().map(|observed| &observed.year.station);
    draft.site = site(root, file.site.as_ref(), station)?;
    draft.sun = sun(root, file, &draft.site)?;
    let timed = file.site.as_ref().is_some_and(|site| site.time.is_some());
    let placed = file.sun.as_ref().is_some_and(|sun| sun.off || sun.altitude.is_some());
    draft.daylight.sun_follows = timed && !placed;
    draft.sun_is_open = file.sun.is_none() && !timed;
    draft.sky = sky(root, file)?;
    if let (Some(observed), Some(sky)) = (observed, &mut draft.sky) {
        draft.warnings.extend(observed.year.warnings.iter().cloned());
        draft.warnings.extend(too_far(root, &observed.year.station, &draft.site));
        let (weather, night) = observed.at(&draft.site)?;
        sky.weather = Some(weather);
        draft.warnings.extend(night);
        draft.daylight.observed = Some(observed);
    }
    Ok(())
}

/// The weather file, if `[sky]` names one.
fn weather(root: &Spot<'_>, file: &SceneFile) -> Result<Option<Arc<Observed>>, Error> {
    let Some(name) = file.sky.as_ref().filter(|sky| !sky.off).and_then(|sky| sky.weather.as_ref()) else {
        return Ok(None);
    };
    let spot = root.key("sky").key("weather");
    if file.sky.as_ref().is_some_and(|sky| sky.table.is_some()) {
        return Err(spot.error("is not possible beside table: one of them says how bright the sky is"));
    }
    if file.site.as_ref().is_none_or(|site| site.time.is_none()) {
        return Err(spot.error(format!("needs a [site] with a time; {EXAMPLE}")));
    }
    let path = spot.file(name);
    let year = weather::read(&path).map_err(|error| super::missing(&spot, error))?;
    Ok(Some(Arc::new(Observed { path, year })))
}

fn too_far(root: &Spot<'_>, station: &Station, site: &Site) -> Option<Warning> {
    let distance = station.distance(site.latitude, site.longitude);
    let what = || format!("the station {} is {:.0} km away from the [site]", station.name, distance / 1000.0);
    (distance > FAR).then(|| root.key("sky").key("weather").warning(what()))
}

/// Latitude, longitude and elevation: as written, or those of the weather's station where neither of the first two is.
fn place(spot: &Spot<'_>, table: &SiteTable, station: Option<&Station>) -> Result<[f64; 3], Error> {
    let (latitude, longitude, elevation) = match (table.latitude, table.longitude, station) {
        (None, None, Some(station)) => (station.latitude, station.longitude, station.elevation),
        (latitude, longitude, _) => {
            let latitude = spot.key("latitude").required(latitude)?;
            (latitude, spot.key("longitude").required(longitude)?, 0.0)
        }
    };
    Ok([
        spot.key("latitude").within(latitude, -90.0, 90.0, "degrees")?,
        spot.key("longitude").within(longitude, -180.0, 180.0, "degrees, east positive")?,
        spot.key("elevation").within(table.elevation.unwrap_or(elevation), -500.0, 9000.0, "m")?,
    ])
}

/// The site; the default one where the file has none.
fn site(root: &Spot<'_>, table: Option<&SiteTable>, station: Option<&Station>) -> Result<Site, Error> {
    let Some(table) = table else { return Ok(Site::default()) };
    let spot = root.key("site");
    let [latitude, longitude, elevation] = place(&spot, table, station)?;
    let north = spot.key("north").within(table.north.unwrap_or(0.0), -360.0, 360.0, "degrees")?;
    let default = Site::default();
    let (time, offset) = match &table.time {
        None => (default.time, default.offset),
        Some(moment) => time(&spot.key("time"), moment)?,
    };
    let site = Site { latitude, longitude, elevation, time, offset, north };
    if site.sun().is_none() {
        return Err(spot.key("time").error(Error::Time.to_string()));
    }
    Ok(site)
}

/// A moment and the offset of the clock that shows it.
fn time(spot: &Spot<'_>, moment: &Moment) -> Result<(Timestamp, Offset), Error> {
    let text = match moment {
        Moment::Text(text) => text.clone(),
        Moment::Native(datetime) => datetime.to_string(),
    };
    self::moment(&text).map_err(|what| spot.error(what))
}

/// A moment and the offset of the clock that shows it, as ISO 8601 writes them: `2026-06-21T10:00:00+09:00`.
///
/// ```
/// let (time, offset) = keikan_scene::moment("2026-06-21T10:00:00+09:00")?;
/// assert_eq!((time.to_string().as_str(), offset.seconds()), ("2026-06-21T01:00:00Z", 32_400));
/// assert!(keikan_scene::moment("2026-02-30T10:00:00+09:00").is_err()); // no such day
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
/// What is wrong with `text`, in words, and an example: no such day, no offset, an offset that no clock on earth
/// has, years beyond 1 to 2999.
pub fn moment(text: &str) -> Result<(Timestamp, Offset), String> {
    let wrong = |why: &str| format!("{text:?}: {why}; {EXAMPLE}");
    let pieces = Pieces::parse(text).map_err(|error| wrong(&error.to_string()))?;
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
fn sun(root: &Spot<'_>, file: &SceneFile, site: &Site) -> Result<Option<Sun>, Error> {
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
fn sky(root: &Spot<'_>, file: &SceneFile) -> Result<Option<Sky>, Error> {
    let timed = file.site.as_ref().is_some_and(|site| site.time.is_some());
    let clear = || Sky { model: "clear".to_owned(), illuminance: None, weather: None, table: None };
    let Some(table) = &file.sky else { return Ok(timed.then(clear)) };
    let SkyTable { off, model, illuminance, .. } = table;
    if *off {
        return Ok(None);
    }
    let spot = root.key("sky");
    let own = || match (&table.weather, &table.table) {
        (Some(_), _) => "perez".to_owned(),
        (None, Some(_)) => MEASURED.to_owned(),
        (None, None) => clear().model,
    };
    let model = model.clone().unwrap_or_else(own);
    let measured = measured(&spot, table, &model)?;
    if model.is_empty() {
        return Err(spot
            .key("model")
            .error("is empty; clear, overcast and uniform are among the possible names"));
    }
    let illuminance = illuminance.map(|lx| spot.key("illuminance").within(lx, 0.0, 1e6, "lx")).transpose()?;
    Ok(Some(Sky { model, illuminance, weather: None, table: measured }))
}

/// The model of a sky with a table.
const MEASURED: &str = "measured";

/// The table that `[sky]` names. It is the whole sky: neither another model nor the weather have a say.
fn measured(spot: &Spot<'_>, table: &SkyTable, model: &str) -> Result<Option<Arc<crate::SkyTable>>, Error> {
    let Some(name) = &table.table else {
        return match model {
            MEASURED => {
                Err(spot.key("model").error("\"measured\" needs a table beside it: table = \"sky.csv\""))
            }
            _ => Ok(None),
        };
    };
    let key = spot.key("table");
    if model != MEASURED {
        let said = format!("{model:?} is not possible beside table: leave it out, or write \"measured\"");
        return Err(spot.key("model").error(said));
    }
    let read = sky_table::read(&key.file(name)).map_err(|error| super::missing(&key, error))?;
    Ok(Some(Arc::new(read)))
}
