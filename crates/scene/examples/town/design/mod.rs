//! What the town looks like: a block of towers around a square, between streets, among flats and low houses.
//!
//! Metres; x east, y up, z south, the square's middle at 0, carriageways at y = 0. Whatever stands on something is sunk
//! into it, and whatever lies on something stands out by 2 cm or more, so that no two faces share a plane.

mod document;
mod flats;
mod houses;
mod palette;
mod shapes;
mod site;
mod square;
mod streets;
mod towers;

/// Decides sizes, colours and turns.
pub(crate) const SEED: u32 = 19_950_415;

/// The whole town as a glTF file in text, buffer included.
pub(crate) fn gltf() -> String {
    let mut site = site::Site::new(SEED);
    streets::lay(&mut site);
    towers::build(&mut site);
    square::lay(&mut site);
    flats::build(&mut site);
    houses::build(&mut site);
    streets::plant(&mut site);
    document::text(&site)
}
