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
/// Nothing is mapped by the plan; a file that cannot be read, or is something else: it is not overwritten.
pub(crate) fn read(path: &Path, plan: &Plan) -> Result<Maps, Error> {
    if plan.settings.choice("sky.map") != "on" {
        return Err(Error::Usage(format!(
            "--maps {}: nothing is mapped, as sky.map is off; add --set sky.map=on",
            path.display()
        )));
    }
    let wrong = |what: String| Error::Usage(format!("--maps {}: {what}", path.display()));
    Target::new(path)?;
    match fs::read(path) {
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
