//! The command line.

mod measure;
mod skies;
mod species;
mod waters;

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, Subcommand};

use crate::effort::Wanted;
use crate::frames::{Day, Frames, clock};
use crate::knobs::Preset;

pub use measure::{Against, Measure, Only};
pub use skies::{Place, Projection, Sky, Toward, When};
pub use species::{BakeModel, FromPhotos, Grow, Pictures, Tree};
pub use waters::Water;

/// Landscape and lighting simulation: pictures and lux one can trust.
#[derive(Debug, Parser)]
#[command(name = "keikan", version, about, propagate_version = true)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Threads to use; 0 = all the machine has. The answer does not depend on it.
    #[arg(long, global = true, default_value_t = 0, value_name = "N", value_parser = threads)]
    pub threads: usize,
    /// Machine-readable answer on stdout.
    #[arg(long, global = true)]
    pub json: bool,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a picture: EXR in cd/m², and PNG by a stated exposure.
    Render(Render),
    /// Make many pictures: along a camera's path, or through a day.
    Animate(Animate),
    /// Say which stages run, with which models and knobs, and why. Renders nothing.
    Plan(PlanArgs),
    /// Illuminance at the scene's sensors, by source and by the way its light takes, with estimated errors.
    Lux(Lux),
    /// What the sky of a place and time is: luminance, lux, colours; as a table, as a picture.
    Sky(Sky),
    /// What a water does to light: colours, 1/e depths, critical angle.
    Water(Water),
    /// Species of trees: list them, grow them, bake them from models, make them from photographs.
    #[command(subcommand)]
    Tree(Tree),
    /// What knobs cost and what they are off by on a scene: a table, a plot, a report with the pictures.
    Measure(Measure),
    /// Compare two pictures (EXR or PNG): relative RMSE, largest difference, ΔE2000, SSIM.
    Compare(Compare),
    /// Make again every picture of a list, such as those of the book.
    Gallery(Gallery),
    /// Print the JSON Schema of scene files.
    Schema,
}

/// What every command that looks at a scene takes.
#[derive(Args, Clone, Debug, Default)]
pub struct View {
    /// Scene file (.toml) or model (.gltf, .glb); the embedded scene `park` without one.
    pub scene: Option<PathBuf>,
    /// Camera by name or number (from 1).
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Pixels: WIDTHxHEIGHT, or WIDTH at the camera's aspect.
    #[arg(long, value_name = "WxH")]
    pub size: Option<Size>,
    /// Only this part of the picture: X,Y,WIDTH,HEIGHT in pixels from the top left.
    #[arg(long, value_name = "X,Y,W,H")]
    pub region: Option<Rectangle>,
    /// Speed against accuracy.
    #[arg(long, value_enum, default_value_t)]
    pub preset: Preset,
    /// Choose a stage or turn a knob (see `keikan plan`); may be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
}

/// When a scene is looked at.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct Moment {
    /// Time of day by the site's clock, on its date, in place of the scene's own: HH:MM. Sun, sky and weather follow; lamps stay on.
    #[arg(long, value_name = "HH:MM", value_parser = clock)]
    pub time: Option<f64>,
}

/// `keikan render`.
#[derive(Args, Clone, Debug)]
pub struct Render {
    /// The scene and the view of it.
    #[command(flatten)]
    pub view: View,
    /// When.
    #[command(flatten)]
    pub moment: Moment,
    /// Where to write; .exr and .png tell the format; may be repeated. Default: the scene's name with both.
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// With the least effort that leaves no more error than this, such as 2%: found by some pixels beforehand, checked by others
    /// afterwards, all made again with much more effort. The root mean square over the mean; what models leave out is not in it.
    /// Knobs that the scene or --set states stay.
    #[arg(long, value_name = "SHARE", conflicts_with = "maps")]
    pub error: Option<Wanted>,
    /// Keep what is known of the sky's light (sky.map=on) in this file from run to run: a further picture of the same
    /// scene, also under another sun (sky.visibility=patches), need not find it again.
    #[arg(long, value_name = "FILE")]
    pub maps: Option<PathBuf>,
    /// How it becomes files.
    #[command(flatten)]
    pub develop: Develop,
}

/// `keikan animate`.
#[derive(Args, Clone, Debug)]
#[command(after_help = ANIMATE)]
pub struct Animate {
    /// The scene and the view of it.
    #[command(flatten)]
    pub view: View,
    /// Where to write, with #### for the frame's number; .exr and .png tell the format; may be repeated.
    #[arg(short, long, value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,
    /// Which frames: 1-100, 1-100x2 or 1-100:2 (every second one), 5,10-20; numbers may be negative. Default: those
    /// that the path or the day has.
    #[arg(long, value_name = "FRAMES", allow_hyphen_values = true)]
    pub frames: Option<Frames>,
    /// Frames in a second of the camera's path.
    #[arg(long, default_value_t = 24.0, value_name = "N", value_parser = rate)]
    pub fps: f64,
    /// Frame that shows second 0 of the path and the first time of the day.
    #[arg(long, default_value_t = 1, value_name = "FRAME", allow_hyphen_values = true)]
    pub first: i32,
    /// Through a day, a frame for each time: FROM..TO/STEP by the site's clock on its date, such as
    /// 05:00..19:00/10min. Sun and weather move.
    #[arg(long, value_name = "FROM..TO/STEP")]
    pub time: Option<Day>,
    /// Make frames again whose files exist; without it they are skipped, so that a run that ended early goes on.
    #[arg(long)]
    pub overwrite: bool,
    /// Keep what is known of the sky's light (sky.map=on) in this file from run to run, as `keikan render` does.
    #[arg(long, value_name = "FILE")]
    pub maps: Option<PathBuf>,
    /// How they become files.
    #[command(flatten)]
    pub develop: Develop,
}

/// What stands below the options of `keikan animate --help`.
const ANIMATE: &str = "\
Examples:
  keikan animate walk.toml -o frames/####.exr -o frames/####.png --exposure 900
      the whole path of the first camera, 24 frames a second
  keikan animate walk.toml -o frames/####.exr --frames 1-100x2 --fps 12
      every second frame from 1 to 99
  keikan animate -o day-###.png --time 05:00..19:00/10min --exposure 2000
      85 frames of the embedded scene from five in the morning to seven in the evening

The folder of the files must exist. Each file is written whole or not at all. Without --exposure every PNG is exposed
by itself, so that brightness may flicker.";

/// How a picture becomes files.
#[derive(Args, Clone, Debug)]
pub struct Develop {
    /// A further layer in the EXR for every light.
    #[arg(long)]
    pub layers: bool,
    /// Luminance that the PNG shows as mid grey (18 %), in cd/m²; found from the picture without it.
    #[arg(long, value_name = "CD/M2", value_parser = positive)]
    pub exposure: Option<f32>,
    /// Tone curve of the PNG.
    #[arg(long, value_enum, default_value_t)]
    pub tone: Tone,
    /// Write the PNG in false colour with a legend in cd/m²: --false-colour, or =MIN:MAX; logarithmic.
    #[arg(long, value_name = "MIN:MAX", num_args = 0..=1, require_equals = true, default_missing_value = "auto")]
    pub false_colour: Option<Span>,
    /// False colour on a linear scale.
    #[arg(long, requires = "false_colour")]
    pub linear: bool,
    /// Name of the owner, written into the EXR.
    #[arg(long, default_value = "")]
    pub owner: String,
}

/// `keikan plan`.
#[derive(Args, Clone, Debug)]
pub struct PlanArgs {
    /// The scene and the view of it.
    #[command(flatten)]
    pub view: View,
    /// When.
    #[command(flatten)]
    pub moment: Moment,
}

/// `keikan lux`.
#[derive(Args, Clone, Debug)]
pub struct Lux {
    /// The scene.
    #[command(flatten)]
    pub view: View,
    /// When.
    #[command(flatten)]
    pub moment: Moment,
    /// With the least effort that leaves no more error than this over all sensor points, such as 2%, as `keikan render` does.
    #[arg(long, value_name = "SHARE")]
    pub error: Option<Wanted>,
}

/// `keikan compare`.
#[derive(Args, Clone, Debug)]
#[command(mut_arg("layers", |argument| argument.hide(true)))]
pub struct Compare {
    /// The picture to judge.
    pub a: PathBuf,
    /// The picture to judge it by.
    pub b: PathBuf,
    /// Draw |a − b|; .exr and .png tell the format; may be repeated. False colour is of luminance.
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// How it becomes files.
    #[command(flatten)]
    pub develop: Develop,
}

/// `keikan gallery`.
#[derive(Args, Clone, Debug)]
pub struct Gallery {
    /// The list; its paths begin at the current folder.
    #[arg(default_value = "docs/gallery.toml")]
    pub list: PathBuf,
    /// Only pictures whose names begin so.
    #[arg(long, value_name = "NAME")]
    pub only: Option<String>,
}

/// How luminance becomes grey.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Tone {
    /// Proportional up to 70 % of white, highlights rolled off and bleached.
    #[default]
    Soft,
    /// Proportional, clipped at white.
    Linear,
}

/// WIDTHxHEIGHT or WIDTH.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels in a row.
    pub width: u32,
    /// Rows, if given.
    pub height: Option<u32>,
}

impl FromStr for Size {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let pixels = |part: &str| match part.trim().parse::<u32>() {
            Ok(n) if (1..=65536).contains(&n) => Ok(n),
            _ => Err(format!("\"{part}\" is not a whole number of pixels from 1 to 65536")),
        };
        match text.split_once(['x', 'X', '×']) {
            Some((width, height)) => Ok(Self { width: pixels(width)?, height: Some(pixels(height)?) }),
            None => Ok(Self { width: pixels(text)?, height: None }),
        }
    }
}

/// X,Y,WIDTH,HEIGHT.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rectangle {
    /// Left.
    pub x: u32,
    /// Top.
    pub y: u32,
    /// ≥ 1.
    pub width: u32,
    /// ≥ 1.
    pub height: u32,
}

impl FromStr for Rectangle {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Self { x, y, width, height }),
            _ => Err("four whole numbers are needed: X,Y,WIDTH,HEIGHT, the last two above 0".to_owned()),
        }
    }
}

/// MIN:MAX or `auto`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Span {
    /// From the picture.
    Auto,
    /// As given, MIN < MAX.
    Fixed(f32, f32),
}

impl FromStr for Span {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        let ends = text.split_once(':').and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        match ends {
            Some((low, high)) if 0.0 <= low && low < high && f32::is_finite(high) => {
                Ok(Self::Fixed(low, high))
            }
            _ => Err("MIN:MAX in cd/m², 0 ≤ MIN < MAX, or auto".to_owned()),
        }
    }
}

fn rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (1e-3..=1e6).contains(&value) => Ok(value),
        _ => Err("a number from 0.001 to 1000000 is needed".to_owned()),
    }
}

fn positive(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("a number above 0 is needed".to_owned()),
    }
}

/// More threads than any machine has are a slip of the pen, and would bring it down.
fn threads(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(n) if n <= 1024 => Ok(n),
        _ => Err("a whole number from 0 to 1024 is needed".to_owned()),
    }
}

fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("NAME=VALUE is needed".to_owned()),
    }
}
