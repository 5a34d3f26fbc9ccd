//! Files are written whole or not at all, and all of them or none.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use atomic_write_file::AtomicWriteFile;

use crate::Error;

/// A place for a file that will be written later, looked at beforehand: what can be known to fail fails
/// before an hour of rendering, not after.
#[derive(Debug)]
pub struct Target {
    path: PathBuf,
}

impl Target {
    /// Checks that a file can stand at `path`: its folder exists, and it is no folder itself. A link is
    /// followed, so that what it points to is replaced and not the link.
    ///
    /// # Errors
    /// [`Error::Output`] with what is in the way.
    pub fn new(path: &Path) -> Result<Self, Error> {
        let wrong = |what: String| Error::Output { path: path.display().to_string(), what };
        if path.is_dir() {
            return Err(wrong("is a folder; a file is to be written there".to_owned()));
        }
        let real = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let folder = match real.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        match fs::metadata(folder) {
            Ok(metadata) if !metadata.is_dir() => Err(wrong(format!("{} is no folder", folder.display()))),
            Ok(metadata) if metadata.permissions().readonly() => {
                Err(wrong(format!("the folder {} may not be written to", folder.display())))
            }
            Ok(_) => Ok(Self { path: real }),
            Err(error) => Err(wrong(format!("the folder {} cannot be used: {error}", folder.display()))),
        }
    }
}

/// Writes all `files` under temporary names beside their targets, and renames them when all are there.
///
/// # Errors
/// [`Error::Output`] with what the system said; no target has then been touched, unless renaming itself
/// fails half-way.
pub fn write(files: &[(Target, Vec<u8>)]) -> Result<(), Error> {
    let wrong = |target: &Target, error: io::Error| Error::Output {
        path: target.path.display().to_string(),
        what: format!("could not be written: {error}"),
    };
    let mut written = Vec::new();
    for (target, bytes) in files {
        let attempt = || {
            let mut file = AtomicWriteFile::open(&target.path)?;
            file.write_all(bytes)?;
            file.sync_all()?;
            Ok(file)
        };
        // Files that are dropped without being committed take their temporary names with them.
        written.push((target, attempt().map_err(|error| wrong(target, error))?));
    }
    written.into_iter().try_for_each(|(target, file)| file.commit().map_err(|error| wrong(target, error)))
}
