//! A scene as plain, checked data, and the only readers of files.
//!
//! **Answers.** [`load`] turns a scene file (TOML), a glTF/GLB model and everything they name (textures,
//! IES and EULUMDAT photometry, terrain points, EPW weather, measured skies) into one [`Scene`]: metres, +Y up, recentred, every index in
//! range, every number finite. It is the last place where anything can fail on input.
//!
//! ```
//! let text = "[site]\nlatitude = 35.68\nlongitude = 139.77\ntime = 2026-06-21T10:00:00+09:00\n\
//!             [[model]]\nbox = { size = [1, 2, 1] }\n";
//! let scene = keikan_scene::parse(text, "".as_ref(), "tower.toml".as_ref())?;
//! assert_eq!(scene.geometry.triangle_count(), 12);
//! assert!(scene.sun.is_some() && scene.cameras.len() == 1); // the sun of that hour, an automatic view
//! # Ok::<(), keikan_scene::Error>(())
//! ```
//!
//! **Leaves out.** What to do with the data: chapters never see this crate. Models' animations and skins
//! (a warning says so); what faces a set operation of solids has. Which models and knobs exist: names pass through as texts.
//!
//! **Where it is wrong.** UTC is taken for UT1 (the sun up to 0.004° off) and ΔT is an estimate; refraction
//! is that of the standard atmosphere. Lamps are points but for rectangles and spheres, which are
//! Lambertian. Positions become f32 about the scene's middle: half a
//! millimetre off at 8 km.

mod camera_path;
mod daylight;
mod document;
mod error;
mod file;
pub mod gltf;
mod image_file;
mod load;
mod material;
pub mod photometry;
mod regular_file;
mod scene;
pub mod sky_table;
mod solid;
pub mod species_folder;
mod sun;
mod tree;
pub mod triangulate;
mod water;
mod waves;
pub mod weather;

pub use camera_path::CameraPath;
pub(crate) use daylight::Daylight;
pub use error::{Error, Warning};
pub use load::{MAX_BYTES, load, moment, parse, schema};
pub use material::{Material, NormalMap, UvTransform, Volume};
pub use scene::*;
pub use sky_table::SkyTable;
pub use solid::{MAX_SOLID_DEPTH, Solid, SolidNode, SolidShape};
pub use sun::SUN_DIAMETER;
pub use tree::{
    CrownShape, PicturedTree, PlacedTree, ShapedEnvelope, TreeEnvelope, TreePicture, TreeSpecies, Trees,
};
pub use water::{MeasuredWater, Water, WaterPhase, WaterQuality};
pub use waves::{SurfaceWaves, Wave, Wind};
pub use weather::Weather;
