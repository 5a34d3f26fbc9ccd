//! Trees, from `[[tree]]` tables.

mod geojson;
mod local;
mod places;

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use super::missing;
use crate::document::Spot;
use crate::file::TreeTable;
use geojson::Listed;
pub(crate) use places::MOST_TREES;
use places::Strewn;

use crate::{Error, Site, TreeSpecies, Trees, Warning, species_folder};

/// Highest tree \[m\]: no tree that stands is half of it.
const HIGHEST: f64 = 300.0;

/// The trees of a table, no more than are `left`: of one species, but for those of a list that names several. `site` is the
/// scene's, if the file has one.
pub(crate) fn trees(
    spot: &Spot<'_>,
    table: &TreeTable,
    left: usize,
    (site, warnings): (Option<&Site>, &mut Vec<Warning>),
) -> Result<Vec<Trees>, Error> {
    places::one_source(spot, table)?;
    let height = table.height.map(|height| spot.key("height").positive(height, HIGHEST, "m")).transpose()?;
    if let Some(file) = &table.points {
        let points = spot.key("points");
        let list = geojson::read(&points.file(file), table.coordinates, site, HIGHEST)
            .map_err(|error| missing(&points, error))?;
        if list.trees.len() > left {
            let what = format!("makes {} trees: {left} more are possible", list.trees.len());
            return Err(points.error(what));
        }
        warnings.extend(list.placeless.map(|(count, first)| {
            points.warning(format!(
                "{count} features have no geometry and are left out, the first /features/{first}"
            ))
        }));
        return listed(spot, table, list.trees, height);
    }
    let species = species(spot, table.species.as_deref())?;
    let usual = height.unwrap_or(usual(&species));
    let placed = places::placed(spot, table, usual, left)?;
    Ok(vec![Trees { species, placed, height, on_ground: is_on_ground(table) }])
}

fn is_on_ground(table: &TreeTable) -> bool {
    table.ground.unwrap_or(false)
}

/// How high a species is that states no height \[m\].
fn usual(species: &TreeSpecies) -> f64 {
    match species {
        TreeSpecies::Pictured(pictured) => pictured.height,
        TreeSpecies::Named(_) => places::USUAL_HEIGHT,
    }
}

/// Trees of a list, those of one species together, in the order in which the list names species first.
fn listed(
    spot: &Spot<'_>,
    table: &TreeTable,
    list: Vec<Listed>,
    height: Option<f64>,
) -> Result<Vec<Trees>, Error> {
    let strewn = Strewn::of(spot, table)?;
    let (mut numbers, mut all) = (HashMap::new(), Vec::<Trees>::new());
    for (i, tree) in list.into_iter().enumerate() {
        let name = tree.species.as_deref().or(table.species.as_deref());
        let known = numbers.get(&tree.species).copied();
        let k = match known {
            Some(k) => k,
            None => {
                let species = species(spot, name)?;
                // Stated heights are factors on one that is known.
                let height = Some(height.unwrap_or(usual(&species)));
                all.push(Trees { species, placed: Vec::new(), height, on_ground: is_on_ground(table) });
                numbers.insert(tree.species, all.len() - 1);
                all.len() - 1
            }
        };
        let usual = all[k].height.unwrap_or(places::USUAL_HEIGHT);
        let own = (tree.height.map(|height| height / usual), tree.rotation);
        all[k].placed.push(strewn.tree(i, tree.position, own));
    }
    Ok(all)
}

/// A folder if the name looks like a path or such a folder exists; else one that comes with the program.
fn species(spot: &Spot<'_>, name: Option<&str>) -> Result<TreeSpecies, Error> {
    let spot = spot.key("species");
    let Some(name) = name else {
        return Err(spot.error("is required: the name of a species, or a folder with a tree.toml"));
    };
    let folder = spot.file(Path::new(name));
    if name.contains(['/', '\\', '.']) || folder.is_dir() {
        let pictured = species_folder::load(&folder).map_err(|error| missing(&spot, error))?;
        return Ok(TreeSpecies::Pictured(Arc::new(pictured)));
    }
    Ok(TreeSpecies::Named(name.to_owned()))
}
