//! Species of trees on disk: a folder with `tree.toml` and its pictures.

use std::path::{Path, PathBuf};

use image::{ImageFormat, ImageReader};
use light::bands::BANDS;
use serde::{Deserialize, Serialize};

use crate::{Error, PicturedTree, TreeEnvelope, TreePicture, image_file, regular_file};

/// What the table of a species is called.
pub const TABLE: &str = "tree.toml";

/// Longest table \[bytes\].
const MAX_TABLE: u64 = 1 << 20;

/// Longest picture \[bytes\].
const MAX_PICTURE: u64 = 1 << 28;

/// `tree.toml`. Lengths in metres of the tree as it was made; a scene scales it.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Table {
    height: f64,
    half_width: f64,
    side: PathBuf,
    side_leaves: Option<PathBuf>,
    envelope: TreeEnvelope,
    leaf: f64,
    reflectance: Option<[f64; BANDS]>,
    transmittance: [f64; BANDS],
    scatter: f64,
    #[serde(default)]
    lean: f64,
    extinction: Option<f64>,
    #[serde(default = "one")]
    shelter: f64,
    #[serde(default)]
    seed: u32,
    #[serde(default)]
    slice: Vec<SliceTable>,
}

fn one() -> f64 {
    1.0
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct SliceTable {
    height: f64,
    picture: PathBuf,
    leaves: Option<PathBuf>,
}

/// Reads a species.
///
/// # Errors
/// A file that is missing, no table or no picture of a tree, with its name.
pub fn load(folder: &Path) -> Result<PicturedTree, Error> {
    let path = folder.join(TABLE);
    let wrong = |what: String| Error::File { path: path.clone(), place: String::new(), what };
    let text = String::from_utf8(regular_file::whole(&path, MAX_TABLE)?)
        .map_err(|error| wrong(format!("is not UTF-8 from byte {} on", error.utf8_error().valid_up_to())))?;
    let table: Table = toml::from_str(&text).map_err(|error| wrong(error.message().trim_end().to_owned()))?;
    let numbers = [table.height, table.half_width, table.leaf, table.scatter];
    if numbers.iter().any(|number| !(number.is_finite() && *number > 0.0)) {
        return Err(wrong("height, half_width, leaf and scatter must be above 0".to_owned()));
    }
    let read = |picture: &Path, leaves: Option<&PathBuf>| {
        picture_of(&folder.join(picture), leaves.map(|name| folder.join(name)).as_deref())
    };
    let mut pictures = vec![(None, read(&table.side, table.side_leaves.as_ref())?)];
    for slice in &table.slice {
        pictures.push((Some(slice.height), read(&slice.picture, slice.leaves.as_ref())?));
    }
    Ok(PicturedTree {
        name: folder.display().to_string(),
        height: table.height,
        half_width: table.half_width,
        pictures,
        envelope: table.envelope,
        leaf: table.leaf,
        reflectance: table.reflectance,
        transmittance: table.transmittance,
        scatter: table.scatter,
        lean: table.lean,
        extinction: table.extinction,
        shelter: table.shelter,
        seed: table.seed,
    })
}

/// A picture with alpha, and the mask of its leaves.
fn picture_of(path: &Path, leaves: Option<&Path>) -> Result<TreePicture, Error> {
    let mut picture = picture(path)?;
    if let Some(path) = leaves {
        let mask = self::picture(path)?;
        if mask.size != picture.size {
            let what = format!(
                "has {} × {} texels, its picture {} × {}",
                mask.size[0], mask.size[1], picture.size[0], picture.size[1]
            );
            return Err(Error::File { path: path.to_path_buf(), place: String::new(), what });
        }
        picture.leaves = mask.texels.iter().map(|texel| texel[1]).collect();
    }
    Ok(picture)
}

/// Reads a PNG or JPEG as it is.
///
/// # Errors
/// What is no picture, or too large.
pub fn picture(path: &Path) -> Result<TreePicture, Error> {
    let bytes = regular_file::whole(path, MAX_PICTURE)?;
    let wrong = |what: String| Error::File { path: path.to_path_buf(), place: String::new(), what };
    let size = image_file::size(&bytes).map_err(wrong)?;
    let reader = ImageReader::new(std::io::Cursor::new(bytes)).with_guessed_format();
    let decoded = reader.map_err(|error| wrong(error.to_string()))?.decode();
    let rgba = decoded.map_err(|error| wrong(error.to_string()))?.into_rgba8();
    let texels = rgba.pixels().map(|pixel| pixel.0).collect();
    Ok(TreePicture { size, texels, leaves: Vec::new() })
}

/// The files of a species: names within its folder and what is in them.
///
/// # Errors
/// A picture that cannot be written.
pub fn files(tree: &PicturedTree) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let mut files = Vec::new();
    let mut slices = Vec::new();
    let mut side_leaves = None;
    for (i, (height, picture)) in tree.pictures.iter().enumerate() {
        let name = if i == 0 { "side".to_owned() } else { format!("slice-{i}") };
        let colours = picture.texels.iter().flatten().copied().collect();
        files.push((format!("{name}.png"), png(picture.size, colours, image::ExtendedColorType::Rgba8)?));
        let mask = (!picture.leaves.is_empty()).then(|| format!("{name}-leaves.png"));
        if let Some(mask) = &mask {
            files.push((
                mask.clone(),
                png(picture.size, picture.leaves.clone(), image::ExtendedColorType::L8)?,
            ));
        }
        match height {
            None => side_leaves = mask.map(PathBuf::from),
            Some(height) => slices.push(SliceTable {
                height: *height,
                picture: format!("{name}.png").into(),
                leaves: mask.map(PathBuf::from),
            }),
        }
    }
    let table = Table {
        height: tree.height,
        half_width: tree.half_width,
        side: "side.png".into(),
        side_leaves,
        envelope: tree.envelope.clone(),
        leaf: tree.leaf,
        reflectance: tree.reflectance,
        transmittance: tree.transmittance,
        scatter: tree.scatter,
        lean: tree.lean,
        extinction: tree.extinction,
        shelter: tree.shelter,
        seed: tree.seed,
        slice: slices,
    };
    let text = toml::to_string(&table).map_err(|error| unwritable(&error))?;
    files.push((TABLE.to_owned(), text.into_bytes()));
    Ok(files)
}

fn png([width, height]: [u32; 2], codes: Vec<u8>, kind: image::ExtendedColorType) -> Result<Vec<u8>, Error> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut bytes, &codes, width, height, kind, ImageFormat::Png)
        .map_err(|error| unwritable(&error))?;
    Ok(bytes.into_inner())
}

fn unwritable(error: &dyn std::error::Error) -> Error {
    Error::File { path: TABLE.into(), place: String::new(), what: error.to_string() }
}
