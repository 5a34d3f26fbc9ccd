//! Trees of the scene → a stand of turning planes, which the eye looks through and light passes in part; meshes and photographs →
//! species.

mod crowd;
mod footing;
mod made;
mod model;
mod species;
mod submerged;

use std::sync::Arc;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use scene::{PlacedTree, Scene, TreeSpecies};
use trees::{Fade, Placed, Setting, Shading, Stand, Turn};

use crate::Error;
use crate::knobs::Settings;
use footing::Footing;
pub(super) use footing::Ground;
pub(crate) use made::{Made, baked, from_photos, grown};
pub(crate) use model::Worn;
pub(crate) use species::names;
use species::species;
pub(super) use submerged::Submerged;

/// α of eq. 5.4, where it is asked for.
const AMBIENT: f32 = 0.3;

/// All trees of a scene.
pub(super) struct Planted {
    /// Those that stand; none if none does.
    pub(super) stand: Option<Arc<Stand>>,
    /// Trees that are left out, for a higher one of their species stands at nearly the same place.
    doubled: usize,
    footing: Footing,
    origin: DVec3,
}

impl Planted {
    /// What may not be what one expects.
    pub(super) fn warnings(&self) -> impl Iterator<Item = String> {
        let doubled = (self.doubled > 0).then(|| {
            format!(
                "{} trees stand where another of their species does (within {:.0} % of its height): only the highest is kept",
                self.doubled,
                100.0 * crowd::WITHIN
            )
        });
        doubled.into_iter().chain(self.footing.warnings(self.origin))
    }
}

/// All trees of the scene; none without any. `ground` is what they stand on, where they ask for it.
///
/// # Errors
/// A species that there is not, with those that there are; pictures or numbers of which no species can be made.
pub(super) fn stand(
    scene: &Scene,
    settings: &Settings,
    ground: Ground<'_>,
) -> Result<Option<Planted>, Error> {
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
    let top = scene.geometry.bounds().map_or(0.0, |(_, high)| high.y as f32) + footing::ABOVE;
    let (mut placed, mut footing) = (Vec::new(), Footing::default());
    for trees in &scene.trees {
        let kind = kinds.iter().position(|kind| is_same(kind, &trees.species)).unwrap_or_default();
        let usual = trees.height.map_or(species[kind].description().height, |height| height as f32);
        let put = |(position, tree): (Vec3, PlacedTree)| Placed {
            species: kind as u32,
            position,
            height: usual * tree.scale,
            rotation: tree.rotation,
        };
        match trees.on_ground {
            true => placed.extend(ground.stand(&trees.placed, top, &mut footing).into_iter().map(put)),
            false => placed.par_extend(trees.placed.par_iter().map(|tree| put((place(tree), *tree)))),
        }
    }
    let doubled = crowd::thin_out(&mut placed);
    let stand = Stand::new(species, placed).map_err(|error| Error::Content(format!("[[tree]]: {error}")))?;
    let stand = stand.with(setting(settings), shading(settings));
    let stand = (!stand.trees().is_empty()).then(|| Arc::new(stand));
    Ok(Some(Planted { stand, doubled, footing, origin: scene.origin }))
}

/// Where a tree is put. −0 + 0 = 0: what is random of a tree follows from where it stands, and these are one place.
fn place(tree: &PlacedTree) -> Vec3 {
    tree.position.as_vec3() + Vec3::ZERO
}

fn is_same(a: &TreeSpecies, b: &TreeSpecies) -> bool {
    match (a, b) {
        (TreeSpecies::Named(a), TreeSpecies::Named(b)) => a == b,
        (TreeSpecies::Pictured(a), TreeSpecies::Pictured(b)) => Arc::ptr_eq(a, b) || a.name == b.name,
        _ => false,
    }
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
