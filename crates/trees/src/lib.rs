//! Trees as turning planes, with shade and shadow.
mod envelope;
mod region;
mod sheet;
mod species;

pub use envelope::Envelope;
pub use sheet::Sheet;
pub use species::{Description, Leaf, Slice, Species, SpeciesError};
