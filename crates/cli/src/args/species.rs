//! The arguments of `keikan tree`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::positive;

/// `keikan tree`.
#[derive(Clone, Debug, Subcommand)]
pub enum Tree {
    /// The species that come with the program.
    List,
    /// Grow a tree from a few numbers and make a species of it.
    Grow(Grow),
    /// Make a species of a model of a tree (.glb, .gltf).
    Bake(BakeModel),
    /// Make a species of photographs without background.
    Photo(FromPhotos),
}

/// `keikan tree grow`.
#[derive(Args, Clone, Debug, Default)]
pub struct Grow {
    /// How it grows: as one of `keikan tree list`.
    pub form: String,
    /// Folder of the species; made if there is none.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// How high it is, in metres. Default: 12.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub height: Option<f32>,
    /// Radius of its crown, in metres. Default: as usual for the form.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub spread: Option<f32>,
    /// Height of the trunk below the crown, in metres. Default: as usual for the form.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub clear: Option<f32>,
    /// About how many leaves (tufts of needles). Default: as usual for the form.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub leaves: Option<u32>,
    /// Also write its mesh there.
    #[arg(long, value_name = "FILE.glb")]
    pub mesh: Option<PathBuf>,
    /// How it is pictured.
    #[command(flatten)]
    pub pictures: Pictures,
}

/// `keikan tree bake`.
#[derive(Args, Clone, Debug)]
#[command(after_help = BAKE)]
pub struct BakeModel {
    /// The model; its lowest part is the foot.
    pub model: PathBuf,
    /// Folder of the species; made if there is none.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// How high it is, in metres, whatever unit the model has. Default: as high as the model.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub height: Option<f32>,
    /// How it is pictured.
    #[command(flatten)]
    pub pictures: Pictures,
}

/// What stands below the options of `keikan tree bake --help`.
const BAKE: &str = "\
Materials whose name has leaf, leaves, needle, foliage, Blatt, Laub or Nadel in it count as leaves, and those named
bark, trunk, stem, wood, Stamm, Rinde or Holz as wood; of the others those with an alpha, those that light shines
through, and green ones count as leaves. The answer says which.";

/// `keikan tree photo`.
#[derive(Args, Clone, Debug)]
pub struct FromPhotos {
    /// The tree from the side, background removed (alpha).
    pub side: PathBuf,
    /// The same from above; the horizontal planes are made up of the side view without it.
    pub top: Option<PathBuf>,
    /// Folder of the species; made if there is none.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// How high the tree is, in metres.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub height: f32,
    /// Length of a leaf, in metres.
    #[arg(long, value_name = "M", default_value_t = 0.08, value_parser = positive)]
    pub leaf: f32,
    /// Horizontal planes.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=64))]
    pub planes: u32,
    /// Decides what is random.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u32,
}

/// How a mesh becomes pictures.
#[derive(Args, Clone, Debug)]
pub struct Pictures {
    /// Horizontal planes.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=64))]
    pub planes: u32,
    /// Texels over its height. Default: 384 of grown trees, 512 of models.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=4096))]
    pub rows: Option<u32>,
    /// Length of a leaf, in metres. Default: as usual for the form, or as the model's triangles say.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub leaf: Option<f32>,
    /// Decides what is random.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u32,
}

impl Default for Pictures {
    fn default() -> Self {
        Self { planes: 4, rows: None, leaf: None, seed: 1 }
    }
}
