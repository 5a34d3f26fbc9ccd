//! The arguments of `keikan sky`.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use super::{Develop, assignment};
use crate::frames;

/// `keikan sky`.
#[derive(Args, Clone, Debug)]
#[command(after_help = EXAMPLES, mut_arg("layers", |argument| argument.hide(true)))]
pub struct Sky {
    /// Scene file (.toml) or model whose sky is shown; the embedded scene `park` without one and without --place or --sun.
    pub scene: Option<PathBuf>,
    /// Instead of a scene: degrees north, degrees EAST, metres above the sea (0 without it).
    #[arg(long, value_name = "LAT,LON[,M]", conflicts_with = "scene", allow_hyphen_values = true)]
    pub place: Option<Place>,
    /// When: 2026-06-21T10:00:00+09:00; for a scene also 10:00 by its clock on its date.
    #[arg(long, value_name = "TIME")]
    pub time: Option<When>,
    /// Instead of a time: the sun's altitude, and its azimuth clockwise from true north, in degrees.
    #[arg(long, value_name = "ALT,AZ", conflicts_with_all = ["scene", "time"], allow_hyphen_values = true)]
    pub sun: Option<Toward>,
    /// The sky by name; the same as --set sky.model=NAME.
    #[arg(long, value_name = "NAME")]
    pub model: Option<String>,
    /// Choose a stage or turn a knob (see `keikan plan`); may be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// Write luminances by altitude and azimuth as CSV, which [sky] table reads; - writes them to stdout.
    #[arg(long, value_name = "FILE")]
    pub table: Option<PathBuf>,
    /// Degrees from one row and column of the table to the next; 90 must be a multiple of it.
    #[arg(long, value_name = "DEGREES", default_value_t = 5.0, value_parser = step)]
    pub step: f64,
    /// Draw the sky, north up and east left as it is seen looking up; .exr and .png tell the format; may be repeated.
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Pixels across the picture.
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(1..=8192))]
    pub size: u32,
    /// From the hemisphere to the picture.
    #[arg(long, value_enum, default_value_t)]
    pub projection: Projection,
    /// Draw shares of the largest luminance above 10° of altitude, the sun's disc not counted.
    #[arg(long)]
    pub relative: bool,
    /// How it becomes files.
    #[command(flatten)]
    pub develop: Develop,
}

/// What stands below the options of `keikan sky --help`.
const EXAMPLES: &str = "\
Examples:
  keikan sky site.toml
      what the sky of a scene is: luminance, lux, colours
  keikan sky --place 35.68,139.77 --time 2026-06-21T10:00:00+09:00 --model cie-12
      the same without a scene
  keikan sky --sun 40,180 --model thesis --table sky.csv -o sky.exr -o sky.png
      a table that [sky] table = \"sky.csv\" reads, and the whole sky as a fisheye sees it

The sun's disc is in none of them. All files are written, or none.";

/// From the hemisphere to the picture's disc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Projection {
    /// Distance from the middle proportional to the angle from the zenith: an equidistant fisheye.
    #[default]
    Angular,
    /// Straight down onto the ground plane: areas of the picture are shares of horizontal illuminance.
    Horizontal,
}

/// LATITUDE,LONGITUDE or LATITUDE,LONGITUDE,ELEVATION.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Degrees, north +.
    pub latitude: f64,
    /// Degrees, EAST +.
    pub longitude: f64,
    /// Metres above the sea.
    pub elevation: f64,
}

impl FromStr for Place {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (latitude, longitude, elevation) = match numbers(text).as_deref() {
            Some(&[latitude, longitude]) => (latitude, longitude, 0.0),
            Some(&[latitude, longitude, elevation]) => (latitude, longitude, elevation),
            _ => return Err(format!("\"{text}\": write LATITUDE,LONGITUDE or LATITUDE,LONGITUDE,ELEVATION")),
        };
        within("latitude", latitude, -90.0, 90.0)?;
        within("longitude", longitude, -180.0, 180.0)?;
        within("elevation", elevation, -500.0, 9000.0)?;
        Ok(Self { latitude, longitude, elevation })
    }
}

/// ALTITUDE,AZIMUTH.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Toward {
    /// Degrees above the horizon.
    pub altitude: f64,
    /// Degrees clockwise from true north.
    pub azimuth: f64,
}

impl FromStr for Toward {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some(&[altitude, azimuth]) = numbers(text).as_deref() else {
            return Err(format!("\"{text}\": write ALTITUDE,AZIMUTH"));
        };
        within("altitude", altitude, -90.0, 90.0)?;
        within("azimuth", azimuth, -360.0, 360.0)?;
        Ok(Self { altitude, azimuth })
    }
}

/// A moment, or a time of day by the scene's clock.
#[derive(Clone, Debug, PartialEq)]
pub enum When {
    /// ISO 8601 with its offset, checked.
    Moment(String),
    /// Seconds after midnight.
    Clock(f64),
}

impl FromStr for When {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // Only dates have a dash within.
        if text.contains('-') {
            scene::moment(text).map(|_| Self::Moment(text.to_owned()))
        } else {
            frames::clock(text)
                .map(Self::Clock)
                .map_err(|said| format!("{said}, or 2026-06-21T05:30:00+09:00"))
        }
    }
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|part| part.trim().parse().ok()).collect()
}

fn within(name: &str, value: f64, low: f64, high: f64) -> Result<(), String> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(format!("{name} {value} is not within [{low}, {high}]"))
    }
}

fn step(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(step) if (0.25..=45.0).contains(&step) && ((90.0 / step).round() * step - 90.0).abs() < 1e-9 => {
            Ok(step)
        }
        _ => Err("a number from 0.25 to 45 is needed of which 90 is a multiple".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_suns_and_times_are_checked() {
        let place = |text: &str| text.parse::<Place>().map(|p| [p.latitude, p.longitude, p.elevation]);
        assert_eq!(place("-35.5,139"), Ok([-35.5, 139.0, 0.0]));
        assert_eq!(place("35, -139, 20"), Ok([35.0, -139.0, 20.0]));
        for (text, word) in [
            ("95,0", "latitude 95 is not within [-90, 90]"),
            ("0,181", "longitude 181"),
            ("0,0,9999", "elevation 9999"),
            ("nan,0", "latitude NaN"),
            ("35", "write LATITUDE,LONGITUDE"),
            ("a,b", "write LATITUDE,LONGITUDE"),
        ] {
            assert!(place(text).is_err_and(|said| said.contains(word)), "{text}");
        }
        assert_eq!("-3,190".parse(), Ok(Toward { altitude: -3.0, azimuth: 190.0 }));
        assert!("91,0".parse::<Toward>().is_err() && "3".parse::<Toward>().is_err());
        assert_eq!("10:30".parse(), Ok(When::Clock(37_800.0)));
        assert!("2026-02-30T10:00:00+09:00".parse::<When>().is_err_and(|said| said.contains("2026-02-30")));
        assert!("noon".parse::<When>().is_err());
        assert_eq!(step("2.5"), Ok(2.5));
        for wrong in ["7", "0", "-5", "0.01", "90", "nan"] {
            assert!(step(wrong).is_err(), "{wrong}");
        }
    }
}
