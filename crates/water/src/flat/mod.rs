//! Water under a flat surface: where it is, what light does at its surface and below.

mod along;
mod arriving;
mod cover;
mod fill;
mod lit;
mod points;
mod region;
mod rules;
mod shade;
mod shafts;
mod source;
mod window;

pub use fill::Fill;
pub use lit::Lit;
pub(crate) use points::beams_on;
pub use region::FlatWater;
pub use rules::{Along, Rules, Scattered};
pub use shade::SurfaceShade;
pub(crate) use shafts::on_surface;
pub use source::{Part, Source};

#[cfg(test)]
mod tests;
