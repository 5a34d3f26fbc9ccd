//! `keikan measure`.

use std::path::PathBuf;

use clap::Args;

use super::{Moment, View};
use crate::measure::Sweep;

/// `keikan measure`.
#[derive(Args, Clone, Debug)]
#[command(after_help = EXAMPLES)]
pub struct Measure {
    /// The scene and the view of it; 480 pixels wide where no size is given.
    #[command(flatten)]
    pub view: View,
    /// When.
    #[command(flatten)]
    pub moment: Moment,
    /// A knob or stage and what it is set to in turn: NAME=A,B,C, or NAME=LOW..HIGH in six steps of even ratio, or
    /// NAME=LOW..HIGH/STEP; may be repeated: then all combinations.
    #[arg(long, value_name = "NAME=VALUES", required = true)]
    pub knob: Vec<Sweep>,
    /// Turn one knob at a time, the others as they are, in place of all combinations.
    #[arg(long)]
    pub each: bool,
    /// What errors are differences to.
    #[arg(long, value_enum, default_value_t)]
    pub against: Against,
    /// Walks from each pixel and sensor point with --against judge; its noise falls with their root, its time grows with them.
    #[arg(long, default_value_t = 256, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1 << 24))]
    pub walks: u32,
    /// Runs of each setting, of whose times the median counts.
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=999))]
    pub runs: u16,
    /// Leave out the picture, or the sensors.
    #[arg(long, value_enum)]
    pub only: Option<Only>,
    /// Where to write; .html, .csv, .json and .svg (the plot) tell the format; may be repeated. Default: NAME-measured.html and .csv.
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
}

/// What errors are differences to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Against {
    /// The last value of every knob.
    #[default]
    Best,
    /// The preset `reference`, with what --set says.
    Reference,
    /// Random walks that share no stage with the pipeline; what they do not see of the scene is said.
    Judge,
}

/// What of a scene is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Only {
    /// The picture.
    Picture,
    /// The illuminance at sensors.
    Lux,
}

const EXAMPLES: &str = "\
Examples:
  keikan measure site.toml --knob sub-scanlines=1,2,4,8
      a table here, site-measured.html and site-measured.csv
  keikan measure site.toml --knob sky.rays=8..512 --knob sun.samples=1,8,64 -o rays.html -o rays.svg
      all 18 combinations, each against the last
  keikan measure pool.toml --knob water.paths=thesis,exact --against reference --only lux";
