//! EnergyPlus weather files: eight header lines, then a row of 35 columns for every hour.
//!
//! "Auxiliary Programs", EnergyPlus documentation, chapter on the EPW format. What is asked of a file here is only
//! what its columns need: rows may have fewer or more of them, lines may end in CR LF, names may be in Latin-1.

use std::path::Path;

use super::numbers::{aerosol, irradiance, needed, temperature, whole};
use super::{Hour, SLOTS, Station, Year, slot};
use crate::{Error, Warning};

/// Columns, counted from 0.
const MONTH: usize = 1;
const DAY: usize = 2;
const HOUR: usize = 3;
const DEW_POINT: usize = 7;
const DIRECT_NORMAL: usize = 14;
const DIFFUSE_HORIZONTAL: usize = 15;
const AEROSOL_DEPTH: usize = 29;

/// A row of the file.
struct Row {
    slot: usize,
    hour: Hour,
}

/// Reads a weather file from memory; `path` is what messages call it.
///
/// # Errors
/// [`Error::File`] with the line: no `LOCATION` or `DATA PERIODS` line, several records an hour, a row that is no
/// row of numbers, a day that does not exist, an hour given twice, a value that no weather has; no row at all.
/// Missing rows and missing values are warnings: they matter only at the hours that are asked for.
pub fn parse(bytes: &[u8], path: &Path) -> Result<Year, Error> {
    let text = text(bytes);
    let fault = |line: usize, what: String| Error::File {
        path: path.to_path_buf(),
        place: if line == 0 { String::new() } else { format!("line {line}") },
        what,
    };
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    let (first, head) = lines.find(|(_, line)| !line.is_empty()).unwrap_or((0, ""));
    let station = station(head).map_err(|what| fault(first, what))?;
    let (at, periods) = lines.find(|(_, line)| starts(line, "DATA PERIODS")).ok_or_else(|| {
        fault(0, "has no line that begins with DATA PERIODS: not a whole EPW file".to_owned())
    })?;
    records_an_hour(periods).map_err(|what| fault(at, what))?;

    let mut hours = vec![None; SLOTS];
    let mut from = vec![0; SLOTS];
    for (number, line) in lines.filter(|(_, line)| !line.is_empty()) {
        let Row { slot, hour } = row(line).map_err(|what| fault(number, what))?;
        if hours[slot].replace(hour).is_some() {
            let what = format!("this hour stands in line {} already", from[slot]);
            return Err(fault(number, what));
        }
        from[slot] = number;
    }
    if hours.iter().all(Option::is_none) {
        return Err(fault(0, "has no row of data after DATA PERIODS".to_owned()));
    }
    in_unity(&mut hours);
    let warnings = lacks(&hours, &from, path);
    Ok(Year { station, warnings, hours })
}

/// UTF-8, or Latin-1 where it is not.
fn text(bytes: &[u8]) -> String {
    let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

fn starts(line: &str, name: &str) -> bool {
    line.get(..name.len()).is_some_and(|start| start.eq_ignore_ascii_case(name))
}

/// `LOCATION,city,region,country,source,WMO,latitude,longitude,zone,elevation`. The numbers are looked for from the
/// end, because names with commas in them occur.
fn station(line: &str) -> Result<Station, String> {
    if !starts(line, "LOCATION") {
        return Err("does not begin with LOCATION: not an EPW file".to_owned());
    }
    let fields: Vec<&str> = line.trim_end_matches([',', ' ']).split(',').map(str::trim).collect();
    let [_, names @ .., latitude, longitude, zone, elevation] = &fields[..] else {
        return Err("LOCATION needs a name, latitude, longitude, time zone and elevation".to_owned());
    };
    // Clocks on earth run from UTC−12 to UTC+14; half and quarter hours occur.
    let zone = needed(zone, "time zone", -12.0, 14.0)?;
    Ok(Station {
        name: names.first().map_or("", |name| name.trim_matches('"')).to_owned(),
        latitude: needed(latitude, "latitude", -90.0, 90.0)?,
        longitude: needed(longitude, "longitude", -180.0, 180.0)?,
        offset: (zone * 60.0).round() as i32 * 60,
        elevation: needed(elevation, "elevation", -500.0, 9000.0)?,
    })
}

/// `DATA PERIODS,how many,records an hour,…`.
fn records_an_hour(line: &str) -> Result<(), String> {
    match line.split(',').nth(2).map(str::trim) {
        Some("1") => Ok(()),
        Some(other) => {
            Err(format!("{other:?} records an hour: files with one record an hour are understood"))
        }
        None => Err("DATA PERIODS does not say how many records there are an hour".to_owned()),
    }
}

fn row(line: &str) -> Result<Row, String> {
    let fields: Vec<&str> = line.split(',').collect();
    if fields.len() <= DIFFUSE_HORIZONTAL {
        let least = DIFFUSE_HORIZONTAL + 1;
        return Err(format!(
            "has {} columns, but irradiances stand in columns {DIRECT_NORMAL} to {least}",
            fields.len()
        ));
    }
    let month = whole(fields[MONTH], "month", 1, 12)?;
    let day = whole(fields[DAY], "day", 1, 31)?;
    // Hour 1 is the one that ends at 1:00.
    let hour = whole(fields[HOUR], "hour", 1, 24)? - 1;
    let slot = slot(month, day, hour).ok_or_else(|| format!("there is no day {day} in month {month}"))?;
    let hour = Hour {
        direct_normal: irradiance(fields[DIRECT_NORMAL], "direct normal irradiance")?,
        diffuse_horizontal: irradiance(fields[DIFFUSE_HORIZONTAL], "diffuse horizontal irradiance")?,
        dew_point: temperature(fields[DEW_POINT], "dew point")?,
        aerosol_depth: aerosol(fields.get(AEROSOL_DEPTH).copied().unwrap_or(""), "aerosol depth")?,
    };
    Ok(Row { slot, hour })
}

/// The format says thousandths, most files (those made from IWEC and TMY3) hold the depth itself: a file whose
/// median is 1 or more means thousandths. Depths are about 0.02 to 0.6.
fn in_unity(hours: &mut [Option<Hour>]) {
    let mut depths: Vec<f64> = hours.iter().flatten().filter_map(|hour| hour.aerosol_depth).collect();
    depths.sort_unstable_by(f64::total_cmp);
    if depths.get(depths.len() / 2).is_some_and(|&median| median >= 1.0) {
        hours
            .iter_mut()
            .flatten()
            .filter_map(|hour| hour.aerosol_depth.as_mut())
            .for_each(|depth| *depth /= 1000.0);
    }
}

/// What the year lacks, in words.
fn lacks(hours: &[Option<Hour>], from: &[usize], path: &Path) -> Vec<Warning> {
    let warning = |place: String, what: String| Warning { place, what };
    let path = path.display();
    let mut warnings = Vec::new();
    let count = hours.iter().flatten().count();
    let leap_day = 59 * 24..60 * 24;
    let common = || hours.iter().enumerate().all(|(i, hour)| hour.is_some() || leap_day.contains(&i));
    if !(count == SLOTS || count == SLOTS - 24 && common()) {
        let what = format!("has {count} hours; a whole year has 8760 or 8784");
        warnings.push(warning(path.to_string(), what));
    }
    let dark = |hour: &Hour| hour.direct_normal.is_none() || hour.diffuse_horizontal.is_none();
    let missing = || hours.iter().zip(from).filter(|(hour, _)| hour.as_ref().is_some_and(dark));
    if let Some(first) = missing().map(|(_, line)| *line).min() {
        let what = format!("irradiance is missing in {} hours (here first)", missing().count());
        warnings.push(warning(format!("{path}: line {first}"), what));
    }
    warnings
}
