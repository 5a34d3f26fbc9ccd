//! What can be wrong with input: whose fault, where, what was given, what was possible.

use std::path::PathBuf;

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The disk's fault.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file's fault.
    #[error("{}{}: {what}", path.display(), place_suffix(place))]
    File {
        /// The file.
        path: PathBuf,
        /// Where in it: `line 12`, `line 12, column 3`, `/meshes/0/primitives/1`, `line 12, column 3, [[light]] 2, key "file"`; may be empty.
        place: String,
        /// What was given, what is wrong with it and what was possible.
        what: String,
    },
    /// A time was asked for at which the sun's position is not known.
    #[error("the sun's position is known for the years 1 to 2999 only")]
    Time,
}

impl Error {
    /// A file that could not be read, with the place (file and place in it) that names it.
    pub(crate) fn named_in(path: PathBuf, source: &std::io::Error, place: &str) -> Self {
        let source = std::io::Error::new(source.kind(), format!("{source} (named in {place})"));
        Self::Io { path, source }
    }
}

fn place_suffix(place: &str) -> String {
    if place.is_empty() { String::new() } else { format!(": {place}") }
}

/// Something that was repaired or left out, and is worth a word to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Where: a file, and a place in it.
    pub place: String,
    /// What was found and what was made of it.
    pub what: String,
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.place, self.what)
    }
}
