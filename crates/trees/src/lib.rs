//! Trees as turning planes, with shade and shadow.

mod bake;
mod envelope;
mod grow;
mod hierarchy;
mod leaf;
mod planes;
pub mod reference;
mod region;
mod seen;
mod shadow;
mod sheet;
mod species;
mod stand;
mod tree_mesh;

pub use bake::{Bake, BakeError, TRANSMITTANCE, bake};
pub use envelope::Envelope;
pub use grow::{Form, Growth, grow};
pub use leaf::{Crossing, Shading};
pub use planes::{Fade, Setting, Turn};
pub use sheet::Sheet;
pub use species::{Description, Leaf, Slice, Species, SpeciesError};
pub use stand::{Placed, Stand, StandError};
pub use tree_mesh::{Part, TreeMesh};

#[cfg(test)]
mod stand_tests;
