//! From a film to files: each is written whole under a temporary name, then renamed.

mod develop;
mod exr_file;
mod false_colour;
mod folder;
mod glb_file;
mod png_file;
mod whole;

pub use develop::{Picture, develop};
pub use exr_file::{Header, encode as encode_exr};
pub use false_colour::{Scale, draw as draw_false_colour};
pub(crate) use folder::Folder;
pub(crate) use glb_file::{Piece, encode as encode_glb};
pub use png_file::{Exposure, encode as encode_png};
pub use whole::{Target, write};
