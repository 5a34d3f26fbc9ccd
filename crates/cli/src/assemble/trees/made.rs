//! Species that are made on demand: grown, baked from a model, or from photographs.

use std::fmt;
use std::path::Path;

use light::Mesh;
use scene::{PicturedTree, TreeEnvelope, TreePicture, gltf, species_folder};
use trees::{
    Bake, Form, Growth, Photo, Picture, Sheet, Species, SpeciesError, TreeMesh, bake, from_photo, grow,
};

use super::model::{self, Worn};
use super::species;
use crate::Error;
use crate::args;
use crate::output::Piece;

/// Leaves longer than this share of a tree's height are probably pictures of many.
const CARD: f32 = 0.03;

/// A species that was made, and its figures; lengths in metres.
#[derive(Clone, Debug, serde::Serialize)]
pub(crate) struct Made {
    #[serde(skip)]
    species: Species,
    name: String,
    height: f32,
    width: f32,
    /// Texels of the side view.
    side: [u32; 2],
    /// Heights of the horizontal planes.
    planes: Vec<f32>,
    leaf: f32,
    /// 1/m.
    extinction: f32,
    shelter: f32,
    /// In memory.
    bytes: usize,
}

impl Made {
    fn new(name: &str, species: Species) -> Self {
        let description = species.description();
        Self {
            name: name.to_owned(),
            height: description.height,
            width: 2.0 * description.envelope.widest(),
            side: description.side.size(),
            planes: description.slices.iter().map(|slice| slice.height).collect(),
            leaf: description.leaf.size,
            extinction: species.extinction(),
            shelter: description.shelter,
            bytes: species.bytes(),
            species,
        }
    }

    /// As a folder has it.
    pub(crate) fn kept(&self) -> PicturedTree {
        let made = self.species.description();
        let slices = made.slices.iter().map(|slice| (Some(f64::from(slice.height)), picture(&slice.sheet)));
        PicturedTree {
            name: self.name.clone(),
            height: f64::from(made.height),
            half_width: f64::from(made.half_width),
            pictures: std::iter::once((None, picture(&made.side))).chain(slices).collect(),
            envelope: TreeEnvelope::Knots(
                made.envelope.knots().iter().map(|knot| knot.as_dvec2().to_array()).collect(),
            ),
            leaf: f64::from(made.leaf.size),
            reflectance: made.leaf.reflectance.map(|share| share.0.map(f64::from)),
            transmittance: made.leaf.transmittance.0.map(f64::from),
            scatter: f64::from(made.leaf.scatter),
            lean: f64::from(made.leaf.lean),
            extinction: made.extinction.map(f64::from),
            shelter: f64::from(made.shelter),
            seed: made.seed,
        }
    }

    /// Of one that comes with the program.
    ///
    /// # Errors
    /// None, unless the program is wrong.
    pub(crate) fn named(name: &str) -> Result<Self, Error> {
        let args = args::Grow { form: name.to_owned(), ..args::Grow::default() };
        Ok(grown(&args)?.0)
    }
}

fn picture(sheet: &Sheet) -> TreePicture {
    TreePicture { size: sheet.size(), texels: sheet.texels(), leaves: sheet.leaves().to_vec() }
}

/// A species grown from a few numbers, and its mesh.
///
/// # Errors
/// A form that there is not, lengths of which no tree can be.
pub(crate) fn grown(args: &args::Grow) -> Result<(Made, Vec<Piece>), Error> {
    let Some(form) = species::form(&args.form) else {
        let known: Vec<_> = species::names().collect();
        return Err(Error::Usage(format!("{}: no such form; there are: {}", args.form, known.join(", "))));
    };
    let growth = growth(form, args);
    let mesh = grow(&growth).ok_or_else(|| {
        let (height, clear) = (growth.height, growth.clear);
        Error::Usage(format!(
            "{}: does not grow {height} m high with a trunk of {clear} m below its crown",
            args.form
        ))
    })?;
    let made = made(&args.form, &mesh, &Bake { leaf: None, ..pictures(&args.pictures, species::usual()) })?;
    let pieces = mesh.parts.into_iter().map(|part| Piece {
        name: if part.leaf { "leaves" } else { "wood" },
        mesh: Mesh { material: 0, ..part.mesh },
        colour: part.colour,
    });
    Ok((made, pieces.collect()))
}

/// What is usual for the form, but for what is asked.
fn growth(form: Form, args: &args::Grow) -> Growth {
    let usual = Growth::usual(form, args.height.unwrap_or(species::HEIGHT), args.pictures.seed);
    Growth {
        spread: args.spread.unwrap_or(usual.spread),
        clear: args.clear.unwrap_or(usual.clear),
        leaves: args.leaves.unwrap_or(usual.leaves),
        leaf: args.pictures.leaf.unwrap_or(usual.leaf),
        ..usual
    }
}

fn pictures(args: &args::Pictures, usual: Bake) -> Bake {
    let rows = args.rows.unwrap_or(usual.rows);
    Bake { rows, planes: args.planes, leaf: args.leaf, seed: args.seed, ..usual }
}

fn made(name: &str, mesh: &TreeMesh, how: &Bake) -> Result<Made, Error> {
    let species = bake(mesh, how).map_err(|error| Error::Content(format!("{name}: {error}")))?;
    Ok(Made::new(name, species))
}

/// A species from a model, what its materials count as, and warnings.
///
/// # Errors
/// No model, or none of a tree.
pub(crate) fn baked(args: &args::BakeModel) -> Result<(Made, Vec<Worn>, Vec<String>), Error> {
    let name = args.model.display().to_string();
    let model = gltf::read(&args.model)?;
    let mut warnings: Vec<String> = model.warnings.iter().map(ToString::to_string).collect();
    let (mesh, worn) =
        model::tree(&model, args.height).map_err(|what| Error::Content(format!("{name}: {what}")))?;
    if !worn.iter().any(|worn| worn.leaves) {
        warnings.push(format!(
            "{name}: no material counts as leaves (by an alpha, a name with \"leaf\", or a green colour): all of it is wood"
        ));
    }
    let made = made(&name, &mesh, &pictures(&args.pictures, Bake::default()))?;
    if args.pictures.leaf.is_none() && made.leaf > CARD * made.height {
        warnings.push(format!(
            "{name}: by its triangles a leaf is {:.2} m long; if they show whole twigs, state the length with --leaf",
            made.leaf
        ));
    }
    Ok((made, worn, warnings))
}

/// A species from photographs, and what was made up.
///
/// # Errors
/// A picture that cannot be read, or has no alpha, or nothing else.
pub(crate) fn from_photos(args: &args::FromPhotos) -> Result<(Made, Vec<String>), Error> {
    let side = species_folder::picture(&args.side)?;
    let top = args.top.as_deref().map(species_folder::picture).transpose()?;
    for (path, photo) in args.top.iter().zip(&top) {
        cut_out(path, photo)?;
    }
    let how = Photo {
        height: args.height,
        leaf: args.leaf,
        reflectance: None,
        planes: args.planes,
        seed: args.seed,
    };
    let species = from_photo(seen(&side), top.as_ref().map(seen), &how)
        .map_err(|error| unusable(&args.side, error.to_string()))?;
    let made = Made::new(&args.side.display().to_string(), species);
    let made_up = match (&args.top, made.planes.len()) {
        (_, 0) => "no horizontal planes: from above the tree is not there".to_owned(),
        (None, _) => {
            "no picture from above: the horizontal planes are made up of pieces of the side view".to_owned()
        }
        (Some(_), n) => format!(
            "all {n} horizontal planes show the one picture from above, each as wide as the crown there"
        ),
    };
    Ok((made, vec![made_up]))
}

fn seen(photo: &TreePicture) -> Picture<'_> {
    Picture { width: photo.size[0], texels: &photo.texels }
}

/// The same for a view from above as [`from_photo`] asks of the side view.
fn cut_out(path: &Path, photo: &TreePicture) -> Result<(), Error> {
    let alphas = || photo.texels.iter().map(|texel| texel[3]);
    let wrong = match () {
        () if alphas().all(|alpha| alpha == 0) => SpeciesError::Invisible,
        () if alphas().all(|alpha| alpha == 255) => SpeciesError::NoAlpha,
        () => return Ok(()),
    };
    Err(unusable(path, wrong.to_string().replace("side view", "view from above")))
}

fn unusable(path: &Path, what: String) -> Error {
    Error::Input { path: path.display().to_string(), what }
}

impl fmt::Display for Made {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let planes: Vec<_> = self.planes.iter().map(|height| format!("{height:.2}")).collect();
        let planes = if planes.is_empty() { "none".to_owned() } else { planes.join(", ") };
        let [columns, rows] = self.side;
        writeln!(f, "{}: {:.2} m high, crown {:.2} m wide", self.name, self.height, self.width)?;
        writeln!(f, "  side view           {columns} x {rows} texels")?;
        writeln!(f, "  horizontal planes   {} at {planes} m", self.planes.len())?;
        writeln!(f, "  length of a leaf    {:.3} m", self.leaf)?;
        writeln!(
            f,
            "  extinction          {:.3} 1/m, {:.2} times as much among leaves",
            self.extinction, self.shelter
        )?;
        write!(f, "  in memory           {:.1} MB", self.bytes as f64 / 1e6)
    }
}

impl Made {
    /// A line of a list.
    pub(crate) fn line(&self) -> String {
        format!(
            "{:12} {:8.2} {:8.2} {:7} {:>12} {:8.1}",
            self.name,
            self.height,
            self.width,
            self.planes.len(),
            format!("{} x {}", self.side[0], self.side[1]),
            self.bytes as f64 / 1e6
        )
    }

    /// What stands above such lines.
    pub(crate) fn heading() -> String {
        format!(
            "{:12} {:>8} {:>8} {:>7} {:>12} {:>8}",
            "", "height m", "crown m", "planes", "side view", "MB"
        )
    }
}
