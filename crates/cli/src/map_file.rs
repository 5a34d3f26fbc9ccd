//! `--maps FILE`: what is known of the sky's light, from one run to the next.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use crate::Error;
use crate::assemble::Maps;
use crate::output::{self, Target};
use crate::plan::Plan;

/// What the file has; nothing if there is none yet.
///
/// # Errors
/// Nothing is mapped by the plan; a file that cannot be read, is none of maps, or is called like a picture: it stays as it is. Maps of
/// another scene are replaced.
pub(crate) fn read(path: &Path, plan: &Plan) -> Result<Maps, Error> {
    if plan.settings.choice("sky.map") != "on" {
        return Err(Error::Usage(format!(
            "--maps {}: no map is made, as sky.map is off; add --set sky.map=on",
            path.display()
        )));
    }
    let wrong = |what: String| Error::Usage(format!("--maps {}: {what}", path.display()));
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    if ["exr", "png", "toml", "glb", "gltf"].contains(&extension.as_str()) {
        return Err(wrong(format!(
            "\"{extension}\" is what pictures and scenes are called; name it like sky.maps"
        )));
    }
    Target::new(path)?;
    let regular = fs::metadata(path).and_then(|about| match about.is_file() {
        true => fs::read(path),
        false => Err(std::io::Error::other("is not a regular file")),
    });
    match regular {
        Ok(bytes) => Maps::from_bytes(&bytes).map_err(wrong),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(Maps::default()),
        Err(error) => Err(wrong(format!("cannot be read: {error}"))),
    }
}

/// Says what became of the file's content, once.
pub(crate) fn tell(maps: &mut Maps) {
    if let Some(said) = maps.said() {
        eprintln!("--maps: {said}");
    }
}

/// Writes what is known now, whole or not at all.
///
/// # Errors
/// What the system said.
pub(crate) fn write(path: &Path, maps: &mut Maps) -> Result<(), Error> {
    match maps.to_bytes() {
        Some(bytes) => output::write(&[(Target::new(path)?, bytes)]),
        None => Ok(()),
    }
}
