//! What a scene calls a species → pictures on planes.

use glam::Vec2;
use light::Spectrum;
use scene::{CrownShape, PicturedTree, ShapedEnvelope, TreeEnvelope, TreeSpecies};
use trees::{Bake, Description, Envelope, Form, Growth, Leaf, Sheet, Slice, Species, bake, grow};

use crate::Error;

/// Species that come with the program: grown and baked when a scene names them, always the same.
const NAMED: [(&str, Form); 4] = [
    ("broadleaf", Form::Spreading),
    ("zelkova", Form::Vase),
    ("poplar", Form::Columnar),
    ("spruce", Form::Conifer),
];

/// Rows of their pictures, and samples along each side of a texel: 3 cm a texel, in a second or so for each species.
const ROWS: u32 = 384;
const SAMPLES: u32 = 3;

/// Their height \[m\].
pub(super) const HEIGHT: f32 = 12.0;

/// How grown trees become pictures.
pub(super) fn usual() -> Bake {
    Bake { rows: ROWS, samples: SAMPLES, ..Bake::default() }
}

/// Names of the species that come with the program.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    NAMED.iter().map(|(name, _)| *name)
}

/// How a species by that name grows.
pub(super) fn form(name: &str) -> Option<Form> {
    NAMED.iter().find(|(known, _)| *known == name).map(|(_, form)| *form)
}

pub(super) fn species(kind: &TreeSpecies, planes: u32) -> Result<Species, Error> {
    match kind {
        TreeSpecies::Named(name) => named(name, planes),
        TreeSpecies::Pictured(pictured) => self::pictured(pictured, planes),
    }
}

fn named(name: &str, planes: u32) -> Result<Species, Error> {
    let Some(form) = form(name) else {
        let known: Vec<_> = names().collect();
        return Err(Error::Content(format!(
            "[[tree]] species = \"{name}\": no such species and no folder of that name; there are: {}",
            known.join(", ")
        )));
    };
    let wrong = |what: &str| Error::Content(format!("[[tree]] species = \"{name}\": {what}"));
    let mesh = grow(&Growth::usual(form, HEIGHT, 1)).ok_or_else(|| wrong("does not grow"))?;
    bake(&mesh, &Bake { planes, ..usual() }).map_err(|error| wrong(&error.to_string()))
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
    let bands = |values: [f64; light::bands::BANDS]| Spectrum(values.map(|value| value as f32));
    Species::new(Description {
        height: tree.height as f32,
        half_width: tree.half_width as f32,
        side: side.ok_or_else(|| wrong("has no side view".to_owned()))?,
        slices,
        envelope: envelope(tree).map_err(wrong)?,
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

/// The outline that a folder states.
fn envelope(tree: &PicturedTree) -> Result<Envelope, String> {
    match &tree.envelope {
        TreeEnvelope::Knots(knots) => {
            let knots: Vec<Vec2> = knots.iter().map(|&[h, r]| Vec2::new(h as f32, r as f32)).collect();
            Envelope::fitted(&knots).ok_or_else(|| {
                "envelope must be rows of height and radius, heights rising, some radius above 0".to_owned()
            })
        }
        TreeEnvelope::Shape(ShapedEnvelope { shape, base, top, radius }) => {
            let made = match shape {
                CrownShape::Ellipsoid => Envelope::ellipsoid,
                CrownShape::Pencil => Envelope::pencil,
                CrownShape::InvertedCone => Envelope::inverted_cone,
            };
            let top = top.unwrap_or(tree.height);
            made(*base as f32, top as f32, *radius as f32).ok_or_else(|| {
                format!(
                    "envelope: no crown is {radius} m wide from {base} to {top} m: the radius must be above 0, and base below top"
                )
            })
        }
    }
}
