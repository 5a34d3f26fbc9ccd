//! Trees of the scene → a stand of turning planes, which the eye looks through and light passes in part.

use std::sync::Arc;

use glam::{Vec2, Vec3};
use light::{Nearest, Ray, Spectrum};
use rayon::prelude::*;
use scene::{PicturedTree, Scene, TreeSpecies};
use trees::{
    Bake, Description, Envelope, Fade, Form, Growth, Leaf, Placed, Setting, Shading, Sheet, Slice, Species,
    Stand, Turn, bake, grow,
};

use crate::Error;
use crate::knobs::Settings;

/// Species that come with the program: grown and baked when a scene names them, always the same.
const NAMED: [(&str, Form); 4] = [
    ("broadleaf", Form::Spreading),
    ("zelkova", Form::Vase),
    ("poplar", Form::Columnar),
    ("spruce", Form::Conifer),
];

/// Their height \[m\].
const HEIGHT: f32 = 12.0;

/// α of eq. 5.4, where it is asked for.
const AMBIENT: f32 = 0.3;

/// Trees that stand on the ground are let fall from this far above the highest thing \[m\].
const ABOVE: f32 = 1.0;

/// Names of the species that come with the program.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    NAMED.iter().map(|(name, _)| *name)
}

/// All trees of the scene; none without any. `dry` is what they stand on, where they ask for it.
///
/// # Errors
/// A species that there is not, with those that there are; pictures or numbers of which no species can be made.
pub(super) fn stand(
    scene: &Scene,
    settings: &Settings,
    dry: &dyn Nearest,
) -> Result<Option<Arc<Stand>>, Error> {
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
            let position = tree.position.as_vec3();
            Placed {
                species: kind as u32,
                position: if trees.on_ground { on_ground(position, top, dry) } else { position },
                height: usual * tree.scale,
                rotation: tree.rotation,
            }
        }));
    }
    let stand = Stand::new(species, placed).map_err(|error| Error::Content(format!("[[tree]]: {error}")))?;
    Ok((!stand.trees().is_empty()).then(|| Arc::new(stand.with(setting(settings), shading(settings)))))
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

fn species(kind: &TreeSpecies, planes: u32) -> Result<Species, Error> {
    match kind {
        TreeSpecies::Named(name) => named(name, planes),
        TreeSpecies::Pictured(pictured) => self::pictured(pictured, planes),
    }
}

fn named(name: &str, planes: u32) -> Result<Species, Error> {
    let Some((_, form)) = NAMED.iter().find(|(known, _)| *known == name) else {
        let known: Vec<_> = names().collect();
        return Err(Error::Content(format!(
            "[[tree]] species = \"{name}\": no such species and no folder of that name; there are: {}",
            known.join(", ")
        )));
    };
    let wrong = |what: &str| Error::Content(format!("[[tree]] species = \"{name}\": {what}"));
    let mesh = grow(&Growth::usual(*form, HEIGHT, 1)).ok_or_else(|| wrong("does not grow"))?;
    bake(&mesh, &Bake { planes, ..Bake::default() }).map_err(|error| wrong(&error.to_string()))
}

/// Of the folder's planes the `most` that are spread most evenly.
fn pictured(tree: &PicturedTree, most: u32) -> Result<Species, Error> {
    let wrong = |what: String| Error::Content(format!("{}: {what}", tree.name));
    let mut sheets = Vec::new();
    for (height, picture) in &tree.pictures {
        let [width, rows] = picture.size;
        let sheet = Sheet::new(width, rows, &picture.texels, &picture.leaves);
        sheets.push((*height, sheet.ok_or_else(|| wrong("has a picture without texels".to_owned()))?));
    }
    let mut slices = Vec::new();
    let mut side = None;
    for (height, sheet) in sheets {
        match height {
            None => side = Some(sheet),
            Some(height) => slices.push(Slice { height: height as f32, sheet }),
        }
    }
    slices.sort_by(|a, b| a.height.total_cmp(&b.height));
    let (have, most) = (slices.len(), most as usize);
    if have > most {
        let keep: Vec<usize> = (0..most).map(|i| (2 * i + 1) * have / (2 * most)).collect();
        slices = slices.into_iter().enumerate().filter(|(i, _)| keep.contains(i)).map(|(_, s)| s).collect();
    }
    let knots: Vec<Vec2> = tree.envelope.iter().map(|&[h, r]| Vec2::new(h as f32, r as f32)).collect();
    let bands = |values: [f64; light::bands::BANDS]| Spectrum(values.map(|value| value as f32));
    Species::new(Description {
        height: tree.height as f32,
        half_width: tree.half_width as f32,
        side: side.ok_or_else(|| wrong("has no side view".to_owned()))?,
        slices,
        envelope: Envelope::fitted(&knots).ok_or_else(|| {
            wrong(
                "envelope must be rows of height and radius, heights rising, some radius above 0".to_owned(),
            )
        })?,
        leaf: Leaf {
            size: tree.leaf as f32,
            reflectance: tree.reflectance.map(bands),
            transmittance: bands(tree.transmittance),
            scatter: tree.scatter as f32,
            lean: tree.lean as f32,
        },
        extinction: tree.extinction.map(|extinction| extinction as f32),
        shelter: tree.shelter as f32,
        seed: tree.seed,
    })
    .map_err(|error| wrong(error.to_string()))
}
