//! From files to a [`Scene`]: read, check, place, recentre.

mod areas;
mod check;
mod draft;
mod eyes;
mod framing;
mod ground;
mod hull;
mod inline;
mod lamps;
mod materials;
mod models;
mod names;
mod paths;
mod placement;
mod punctual;
mod recentre;
mod settings;
mod site;
mod solids;
mod trees;
mod waters;
mod waves;

use std::path::Path;

use crate::document::{Document, Spot};
use crate::file::SceneFile;
use crate::{Error, Scene, Sky, regular_file};
use draft::Draft;
pub(crate) use placement::look_along;
pub use site::moment;

/// The longest scene file that is read \[bytes\].
pub const MAX_BYTES: u64 = 256 << 20;

/// Loads a scene file (`.toml`), or a model (`.glb`, `.gltf`) as a scene of its own.
///
/// A model stands at the default [`crate::Site`] under its sun (or the model's own directional light) and a
/// clear sky, on an added level ground; without a camera it is framed automatically.
pub fn load(path: &Path) -> Result<Scene, Error> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    match extension.as_str() {
        "glb" | "gltf" => model(path),
        "toml" => {
            let bytes = regular_file::whole(path, MAX_BYTES)?;
            let wrong = |what: String| Error::File { path: path.to_path_buf(), place: String::new(), what };
            let text = String::from_utf8(bytes).map_err(|error| {
                wrong(format!("is not UTF-8 from byte {} on", error.utf8_error().valid_up_to()))
            })?;
            parse(&text, path.parent().unwrap_or(Path::new("")), path)
        }
        other => {
            let what = format!("{other:?} is not a kind of scene file: .toml, .glb and .gltf are possible");
            Err(Error::File { path: path.to_path_buf(), place: String::new(), what })
        }
    }
}

/// Reads a scene file from memory; `folder` is where the files that it names lie, `path_for_messages` what
/// errors call it.
///
/// ```
/// let text = r#"
///     [[model]]
///     box = { size = [1, 2, 1] }
///     [[light]]
///     position = [0, 4, 0]
///     intensity = 100
/// "#;
/// let scene = keikan_scene::parse(text, "".as_ref(), "tower.toml".as_ref())?;
/// assert_eq!(scene.geometry.triangle_count(), 12);
/// assert_eq!(scene.lights[0].distribution.peak(), 100.0);
/// # Ok::<(), keikan_scene::Error>(())
/// ```
pub fn parse(toml_text: &str, folder: &Path, path_for_messages: &Path) -> Result<Scene, Error> {
    let text = toml_text.strip_prefix('\u{feff}').unwrap_or(toml_text);
    let document = Document { text, path: path_for_messages.to_path_buf(), folder: folder.to_path_buf() };
    let file: SceneFile = toml::from_str(text).map_err(|error| document.syntax(&error))?;
    let root = document.root();
    let mut draft = Draft::default();
    site::daylight(&root, &file, &mut draft)?;
    draft.settings = settings::settings(&root, &file)?;
    place(&root, &file, &mut draft)?;
    Ok(draft.finish(&path_for_messages.display().to_string()))
}

/// JSON Schema (2020-12) of scene files, for editors.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(SceneFile).to_value()
}

/// A model as a scene.
fn model(path: &Path) -> Result<Scene, Error> {
    let sky = Some(Sky { model: "clear".to_owned(), illuminance: None, weather: None, table: None });
    let mut draft = Draft { sky, sun_is_open: true, ..Draft::default() };
    models::add_file(&mut draft, path)?;
    if draft.sun.is_none() {
        draft.sun = draft.site.sun();
        draft.daylight.sun_follows = true;
    }
    ground::add(&mut draft, &path.display().to_string());
    Ok(draft.finish(&path.display().to_string()))
}

/// Everything that stands in the scene. The file's own cameras come before those of models: the first is
/// the one that is used unless another is asked for.
fn place(root: &Spot<'_>, file: &SceneFile, draft: &mut Draft) -> Result<(), Error> {
    for (i, table) in file.camera.iter().enumerate() {
        draft.cameras.push(eyes::camera(&root.key("camera").index(i), i + 1, table)?);
    }
    let (named, names) = materials::named(root, &file.material)?;
    draft.materials = named;
    let mut photometry = lamps::Files::default();
    for (i, table) in file.light.iter().enumerate() {
        let spot = root.key("light").index(i);
        match areas::lamp(&spot, i + 1, table)? {
            Some(lamp) => areas::add(draft, lamp),
            None => {
                draft.lights.push(lamps::lamp(&spot, i + 1, table, &mut photometry, &mut draft.warnings)?);
            }
        }
    }
    let mut claims = waters::claims(root, &file.water)?;
    let mut library = models::Library::default();
    for (i, table) in file.model.iter().enumerate() {
        models::add(draft, &mut library, &root.key("model").index(i), table, &names, &mut claims)?;
    }
    solids::add(draft, root, &file.solid, &names)?;
    for (i, table) in file.water.iter().enumerate() {
        draft.waters.push(waters::water(&root.key("water").index(i), i + 1, table, (&claims, &draft.site))?);
    }
    let mut left = trees::MOST_TREES;
    for (i, table) in file.tree.iter().enumerate() {
        let site = file.site.is_some().then_some(&draft.site);
        let spot = root.key("tree").index(i);
        let trees = trees::trees(&spot, table, left, (site, &mut draft.warnings))?;
        left -= trees.iter().map(|trees| trees.placed.len()).sum::<usize>();
        draft.trees.extend(trees);
    }
    let mut left = eyes::MOST_POINTS;
    for (i, table) in file.sensor.iter().enumerate() {
        let sensor = eyes::sensor(&root.key("sensor").index(i), i + 1, table, left)?;
        left = left.saturating_sub(sensor.points.len() as u64);
        draft.sensors.push(sensor);
    }
    Ok(())
}

/// A file that could not be opened, with the place that names it.
fn missing(spot: &Spot<'_>, error: Error) -> Error {
    match error {
        Error::Io { path, source } => Error::named_in(path, &source, &spot.warning("").place),
        other => other,
    }
}
