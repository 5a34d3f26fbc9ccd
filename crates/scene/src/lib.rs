//! A scene as plain, checked data, and the only readers of files.
//!
//! **Answers.** [`load`] turns a scene file (TOML), a glTF/GLB model and everything they name (textures,
//! IES and EULUMDAT photometry, terrain points) into one [`Scene`]: metres, +Y up, recentred, every index in
//! range, every number finite. It is the last place where anything can fail on input.
//!
//! **Leaves out.** What to do with the data: chapters never see this crate.

mod error;
pub mod gltf;
mod image_file;
mod material;
pub mod photometry;
mod scene;
mod sun;
pub mod triangulate;

pub use error::{Error, Warning};
pub use material::{Material, NormalMap, UvTransform, Volume};
pub use scene::*;
pub use sun::SUN_DIAMETER;
