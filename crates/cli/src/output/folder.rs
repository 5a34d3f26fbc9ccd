//! A folder of files that belong together: all of them or none.

use std::fs;
use std::path::{Path, PathBuf};

use super::{Target, write};
use crate::Error;

/// A place for a folder of a species, looked at beforehand.
#[derive(Debug)]
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Checks that a folder can stand at `path`: it is one already that is empty or of the same kind (has a
    /// [`scene::species_folder::TABLE`]), or the folder that it is to stand in exists.
    ///
    /// # Errors
    /// [`Error::Output`] with what is in the way.
    pub(crate) fn new(path: &Path) -> Result<Self, Error> {
        let table = scene::species_folder::TABLE;
        if path.is_dir() {
            let filled = fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_some());
            let target = Target::new(&path.join(table))?;
            drop(target);
            if filled && !path.join(table).exists() {
                let what = format!("has files in it, and no {table}: a folder of its own is needed");
                return Err(Error::Output { path: path.display().to_string(), what });
            }
        } else {
            // What could be said of a file there holds for a folder too, but that a file must not be there.
            Target::new(path)?;
            if path.exists() {
                let what = "is no folder".to_owned();
                return Err(Error::Output { path: path.display().to_string(), what });
            }
        }
        Ok(Self { path: path.to_path_buf() })
    }

    /// Writes `files` by their names into the folder, together with others that are `ready`; a folder that was made for it
    /// goes again where that fails. Other files that are there stay. Their paths come back.
    ///
    /// # Errors
    /// [`Error::Output`] with what the system said.
    pub(crate) fn write(
        self,
        files: Vec<(String, Vec<u8>)>,
        ready: Vec<(Target, Vec<u8>)>,
    ) -> Result<Vec<PathBuf>, Error> {
        let made = !self.path.is_dir();
        if made {
            fs::create_dir(&self.path).map_err(|error| Error::Output {
                path: self.path.display().to_string(),
                what: format!("could not be made: {error}"),
            })?;
        }
        let paths: Vec<PathBuf> = files.iter().map(|(name, _)| self.path.join(name)).collect();
        let attempt = || {
            let mut all = ready;
            for (path, (_, bytes)) in paths.iter().zip(files) {
                all.push((Target::new(path)?, bytes));
            }
            write(&all)
        };
        let written = attempt();
        if written.is_err() && made {
            // It is empty, or else it stays.
            let _ = fs::remove_dir(&self.path);
        }
        written.map(|()| paths)
    }
}
