//! Water under a flat surface: where it is, what light does at its surface and below.

mod fill;
mod lit;
mod region;
mod shade;

pub use fill::Fill;
pub use lit::{Lit, Source};
pub use region::FlatWater;
pub use shade::SurfaceShade;

#[cfg(test)]
mod tests;
