//! Sun and sky under water, and the sun off its surface (thesis 3.2, 3.6, 3.7).

mod rays;
mod sky;
mod sun;
mod table;
#[cfg(test)]
mod tests;

pub(crate) use rays::Rays;
pub use sky::SkyBelow;
pub use sun::{SunBelow, mirrored_sun};
pub(crate) use table::Table;
