//! Measured luminances of the sky: a text table by altitude and azimuth.
//!
//! **Answers.** [`read`] gives a [`SkyTable`] from a file as `keikan sky --table` writes it:
//!
//! ```text
//! # lines that begin with # are passed over
//! altitude,0,90,180,270        azimuths in degrees, clockwise from true north
//! 5,4100,6200,9800,5900        an altitude in degrees, then its luminances in cd/m²
//! 45,3000,3800,9100,3700
//! 90,2900,2900,2900,2900
//! ```
//!
//! Commas, semicolons, tabs and blanks separate. **Leaves out.** The sun's disc: what of it was measured lights the
//! scene a second time.

use std::path::Path;

use crate::{Error, regular_file};

/// The longest table that is read \[bytes\]: one of a quarter of a degree takes 5 MB.
const MAX_BYTES: u64 = 16 << 20;

/// The lowest row is no higher than this, the highest no lower than that, no gap between two is wider \[degrees\].
const ROWS: [f64; 3] = [30.0, 60.0, 45.0];
/// The widest gap between neighbouring azimuths, all the way round \[degrees\].
const GAP: f64 = 90.0;
/// Azimuths and altitudes rise by this at least \[degrees\]: less is lost in f32.
const STEP: f64 = 0.01;
/// A luminance that no sky has \[cd/m²\]: more than the sun's disc.
const MOST: f64 = 1e10;

/// Luminances by altitude and azimuth.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyTable {
    /// Rising, within \[0, 90\] \[degrees\].
    pub altitudes: Vec<f64>,
    /// Rising, within \[0, 360) \[degrees\], clockwise from true north.
    pub azimuths: Vec<f64>,
    /// By altitude, then azimuth \[cd/m²\], ≥ 0; one of them is above 0.
    pub luminances: Vec<f32>,
}

/// Reads a table.
///
/// # Errors
/// [`Error::Io`] from the disk; what [`parse`] finds in the file, with line and column.
pub fn read(path: &Path) -> Result<SkyTable, Error> {
    parse(&regular_file::whole(path, MAX_BYTES)?, path)
}

/// What is wrong, and where: line and column (the number of the field), each from 1; 0 = nowhere in particular.
struct Fault {
    line: usize,
    column: usize,
    what: String,
}

/// Reads a table from memory; `path` is what messages call it.
///
/// ```
/// let text = "altitude,0,90,180,270\n10,1,2,3,4\n50,5,6,7,8\n80,9,9,9,9\n";
/// let table = keikan_scene::sky_table::parse(text.as_bytes(), "a.csv".as_ref())?;
/// assert_eq!((table.azimuths.len(), table.luminances[6]), (4, 7.0));
/// # Ok::<(), keikan_scene::Error>(())
/// ```
///
/// # Errors
/// [`Error::File`] with line and column: what is no number, negative or beyond any sky, altitudes or azimuths that
/// do not rise, rows of another length; altitudes or azimuths that leave too much of the sky unknown; a sky without light.
pub fn parse(bytes: &[u8], path: &Path) -> Result<SkyTable, Error> {
    table(bytes).map_err(|Fault { line, column, what }| {
        let place = match (line, column) {
            (0, _) => String::new(),
            (line, 0) => format!("line {line}"),
            (line, column) => format!("line {line}, column {column}"),
        };
        Error::File { path: path.to_path_buf(), place, what }
    })
}

fn table(bytes: &[u8]) -> Result<SkyTable, Fault> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
        Fault { line, column: 0, what: "is not UTF-8 text: this is no table of luminances".to_owned() }
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let nowhere = |what: String| Fault { line: 0, column: 0, what };
    let (head, first) = lines.next().ok_or_else(|| nowhere("has no line of azimuths: it is empty".into()))?;
    let azimuths = azimuths(head, first)?;
    let (mut altitudes, mut luminances) = (Vec::new(), Vec::new());
    let mut last = head;
    for (line, text) in lines {
        let altitude = row(line, text, &azimuths, &mut luminances)?;
        follows(line, &altitudes, altitude)?;
        altitudes.push(altitude);
        last = line;
    }
    let [lowest, highest, gap] = ROWS;
    if !altitudes.first().is_some_and(|&low| low <= lowest)
        || !altitudes.last().is_some_and(|&h| h >= highest)
    {
        return Err(Fault {
            line: last,
            column: 1,
            what: format!(
                "too few rows: {} altitudes do not reach from {lowest}° or lower to {highest}° or higher, no {gap}° apart",
                altitudes.len()
            ),
        });
    }
    if luminances.iter().all(|&luminance| luminance == 0.0) {
        return Err(nowhere("is a sky without any light: all luminances are 0".into()));
    }
    Ok(SkyTable { altitudes, azimuths, luminances })
}

/// The fields of a line.
fn fields(line: &str) -> impl Iterator<Item = &str> {
    // Blanks beside another separator belong to it; elsewhere they separate themselves.
    let blank = !line.contains([',', ';', '\t']);
    line.split(move |c: char| matches!(c, ',' | ';' | '\t') || (blank && c == ' '))
        .map(str::trim)
        .filter(move |field| !blank || !field.is_empty())
}

fn number(line: usize, column: usize, field: &str, what: &str, high: f64) -> Result<f64, Fault> {
    let fault = |said: String| Fault { line, column, what: format!("{what}: {said}") };
    match field.trim_matches('"').trim().parse::<f64>() {
        Ok(value) if (0.0..=high).contains(&value) => Ok(value),
        Ok(value) if value.is_finite() => Err(fault(format!("{value} is not within [0, {high}]"))),
        _ => Err(fault(format!("{:?} is not a number", field.chars().take(40).collect::<String>()))),
    }
}

/// The heading: whatever stands in its first field, then azimuths. 360° beside 0° is left to [`row`] as a
/// column too many.
fn azimuths(line: usize, text: &str) -> Result<Vec<f64>, Fault> {
    let mut azimuths: Vec<f64> = Vec::new();
    for (i, field) in fields(text).enumerate().skip(1) {
        let azimuth = number(line, i + 1, field, "azimuth", 360.0)?;
        if azimuth >= 360.0 {
            let what = "azimuth: 360° is 0° once more; leave this column out".to_owned();
            return Err(Fault { line, column: i + 1, what });
        }
        if azimuths.last().is_some_and(|&before| azimuth < before + STEP) {
            let what = format!("azimuth: {azimuth} does not rise by {STEP}° or more");
            return Err(Fault { line, column: i + 1, what });
        }
        azimuths.push(azimuth);
    }
    let next = azimuths.iter().skip(1).copied().chain(azimuths.first().map(|first| first + 360.0));
    // Without any azimuth all 360° are a gap.
    let widest = azimuths
        .iter()
        .zip(next)
        .map(|(at, next)| next - at)
        .fold(None, |most: Option<f64>, gap| Some(most.map_or(gap, |most| most.max(gap))));
    let widest = widest.unwrap_or(360.0);
    if widest > GAP {
        let what = format!(
            "{} azimuths do not cover the circle: {widest}° lie between two neighbours, {GAP}° at most are possible",
            azimuths.len()
        );
        return Err(Fault { line, column: 0, what });
    }
    Ok(azimuths)
}

/// One row: its altitude; its luminances are appended.
fn row(line: usize, text: &str, azimuths: &[f64], luminances: &mut Vec<f32>) -> Result<f64, Fault> {
    let mut fields = fields(text);
    let altitude = number(line, 1, fields.next().unwrap_or(""), "altitude", 90.0)?;
    let mut count = 0;
    for field in fields {
        count += 1;
        // A row that is too long is told apart below.
        if let Some(azimuth) = azimuths.get(count - 1) {
            let what = format!("luminance at altitude {altitude}°, azimuth {azimuth}°");
            luminances.push(number(line, count + 1, field, &what, MOST)? as f32);
        }
    }
    if count == azimuths.len() {
        return Ok(altitude);
    }
    let what = format!("{count} luminances stand beside {} azimuths", azimuths.len());
    Err(Fault { line, column: count.min(azimuths.len()) + 2, what })
}

/// Whether this altitude may follow those before.
fn follows(line: usize, before: &[f64], altitude: f64) -> Result<(), Fault> {
    let fault = |what: String| Err(Fault { line, column: 1, what });
    match before.last() {
        Some(&below) if altitude < below + STEP => {
            fault(format!("altitude: {altitude} does not rise by {STEP}° or more above {below}"))
        }
        Some(&below) if altitude - below > ROWS[2] => {
            fault(format!("altitude: too few rows: {altitude} is more than {}° above {below}", ROWS[2]))
        }
        _ => Ok(()),
    }
}
