//! Trees, from `[[tree]]` tables.

mod places;

use std::path::Path;
use std::sync::Arc;

use super::missing;
use crate::document::Spot;
use crate::file::TreeTable;
pub(crate) use places::MOST_TREES;

use crate::{Error, TreeSpecies, Trees, species_folder};

/// Highest tree \[m\]: no tree that stands is half of it.
const HIGHEST: f64 = 300.0;

/// The trees of a table.
pub(crate) fn trees(spot: &Spot<'_>, table: &TreeTable, left: usize) -> Result<Trees, Error> {
    let species = species(spot, table)?;
    let height = table.height.map(|height| spot.key("height").positive(height, HIGHEST, "m")).transpose()?;
    let usual = height.unwrap_or(match &species {
        TreeSpecies::Pictured(pictured) => pictured.height,
        TreeSpecies::Named(_) => places::USUAL_HEIGHT,
    });
    let placed = places::placed(spot, table, usual, left)?;
    Ok(Trees { species, placed, height, on_ground: table.ground.unwrap_or(false) })
}

/// A folder if the name looks like a path or such a folder exists; else one that comes with the program.
fn species(spot: &Spot<'_>, table: &TreeTable) -> Result<TreeSpecies, Error> {
    let spot = spot.key("species");
    let Some(name) = &table.species else {
        return Err(spot.error("is required: the name of a species, or a folder with a tree.toml"));
    };
    let folder = spot.file(Path::new(name));
    if name.contains(['/', '\\', '.']) || folder.is_dir() {
        let pictured = species_folder::load(&folder).map_err(|error| missing(&spot, error))?;
        return Ok(TreeSpecies::Pictured(Arc::new(pictured)));
    }
    Ok(TreeSpecies::Named(name.clone()))
}
