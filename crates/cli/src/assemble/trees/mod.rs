//! Trees of the scene → a stand of turning planes, which the eye looks through and light passes in part; meshes and photographs →
//! species.

mod made;
mod model;
mod species;

use std::sync::Arc;

use glam::Vec3;
use light::{Nearest, Ray};
use rayon::prelude::*;
use scene::{Scene, TreeSpecies};
use trees::{Fade, Placed, Setting, Shading, Stand, Turn};

use crate::Error;
use crate::knobs::Settings;
pub(crate) use made::{Made, baked, from_photos, grown};
pub(crate) use model::Worn;
pub(crate) use species::names;
use species::species;

/// α of eq. 5.4, where it is asked for.
const AMBIENT: f32 = 0.3;

/// Trees that stand on the ground are let fall from this far above the highest thing \[m\].
const ABOVE: f32 = 1.0;

/// All trees of a scene.
pub(super) struct Planted {
    pub(super) stand: Arc<Stand>,
    /// Trees that are left out, for another of their species stands at the very same place.
    doubled: usize,
}

impl Planted {
    /// What may not be what one expects.
    pub(super) fn warning(&self) -> Option<String> {
        (self.doubled > 0).then(|| {
            format!(
                "{} trees stand where another of their species does: only the highest is kept",
                self.doubled
            )
        })
    }
}

/// All trees of the scene; none without any. `dry` is what they stand on, where they ask for it.
///
/// # Errors
/// A species that there is not, with those that there are; pictures or numbers of which no species can be made.
pub(super) fn stand(scene: &Scene, settings: &Settings, dry: &dyn Nearest) -> Result<Option<Planted>, Error> {
    if scene.trees.is_empty() || settings.choice("trees") == "off" {
        return Ok(None);
    }
    let mut kinds: Vec<&TreeSpecies> = Vec::new();
    for trees in &scene.trees {
        if !kinds.iter().any(|kind| is_same(kind, &trees.species)) {
            kinds.push(&trees.species);
        }
    }
    let planes = settings.integer("trees.planes");
    let species = kinds.par_iter().map(|kind| species(kind, planes)).collect::<Result<Vec<_>, Error>>()?;
    let top = scene.geometry.bounds().map_or(0.0, |(_, high)| high.y as f32) + ABOVE;
    let mut placed = Vec::new();
    for trees in &scene.trees {
        let kind = kinds.iter().position(|kind| is_same(kind, &trees.species)).unwrap_or_default();
        let usual = trees.height.map_or(species[kind].description().height, |height| height as f32);
        placed.par_extend(trees.placed.par_iter().map(|tree| {
            // −0 + 0 = 0: what is random of a tree follows from where it stands, and these are one place.
            let position = tree.position.as_vec3() + Vec3::ZERO;
            Placed {
                species: kind as u32,
                position: if trees.on_ground { on_ground(position, top, dry) } else { position },
                height: usual * tree.scale,
                rotation: tree.rotation,
            }
        }));
    }
    let doubled = keep_highest(&mut placed);
    let stand = Stand::new(species, placed).map_err(|error| Error::Content(format!("[[tree]]: {error}")))?;
    let stand = stand.with(setting(settings), shading(settings));
    Ok((!stand.trees().is_empty()).then(|| Planted { stand: Arc::new(stand), doubled }))
}

/// Leaves one tree of a species at each place, and says how many went: rays would cross all of them one by one.
fn keep_highest(placed: &mut Vec<Placed>) -> usize {
    let place = |tree: &Placed| (tree.species, tree.position.to_array().map(f32::to_bits));
    placed.par_sort_by(|a, b| place(a).cmp(&place(b)).then(b.height.total_cmp(&a.height)));
    let before = placed.len();
    placed.dedup_by(|after, first| place(after) == place(first));
    before - placed.len()
}

fn is_same(a: &TreeSpecies, b: &TreeSpecies) -> bool {
    match (a, b) {
        (TreeSpecies::Named(a), TreeSpecies::Named(b)) => a == b,
        (TreeSpecies::Pictured(a), TreeSpecies::Pictured(b)) => Arc::ptr_eq(a, b) || a.name == b.name,
        _ => false,
    }
}

/// Where the vertical through a point first meets something from above; the point itself where it meets nothing.
fn on_ground(at: Vec3, top: f32, dry: &dyn Nearest) -> Vec3 {
    let hit = dry.nearest(&Ray::new(at.with_y(top), Vec3::NEG_Y));
    hit.map_or(at, |hit| at.with_y(hit.place.position.y))
}

fn setting(settings: &Settings) -> Setting {
    Setting {
        fade: match settings.choice("trees.fade") {
            "thesis" => Fade::Thesis,
            "opaque" => Fade::Opaque,
            _ => Fade::Density,
        },
        turn: match settings.choice("trees.turn") {
            "eye" => Turn::WithEye,
            _ => Turn::Fixed,
        },
    }
}

fn shading(settings: &Settings) -> Shading {
    match settings.choice("trees.shading") {
        "thesis" => Shading::Thesis { ambient: AMBIENT },
        _ => Shading::Leaves,
    }
}
