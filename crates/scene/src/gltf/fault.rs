//! What a model can be accused of, and what was let pass with a word.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::{Error, Warning};

/// Why a model cannot be read; [`Fault::into_error`] adds whose file it is.
#[derive(Debug)]
pub(super) enum Fault {
    /// Something in the model is wrong.
    Data {
        /// JSON pointer, or "GLB header".
        place: String,
        /// What is there, and what would be right.
        what: String,
    },
    /// A file that the model names cannot be read.
    Io {
        /// JSON pointer to what names it.
        place: String,
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl Fault {
    pub(super) fn new(place: impl Into<String>, what: impl Into<String>) -> Self {
        Self::Data { place: place.into(), what: what.into() }
    }

    pub(super) fn into_error(self, model: &Path) -> Error {
        match self {
            Self::Data { place, what } => Error::File { path: model.to_path_buf(), place, what },
            Self::Io { place, path, source } => {
                Error::named_in(path, &source, &format!("{}: {place}", model.display()))
            }
        }
    }
}

/// Shorthand for what every part of the reader returns.
pub(super) type Checked<T> = Result<T, Fault>;

/// Things repaired or left out, counted: one warning per kind, however many there are.
#[derive(Debug, Default)]
pub(super) struct Notes {
    /// By sentence: how many, and where the first was.
    tallies: BTreeMap<String, (u64, String)>,
}

impl Notes {
    /// Notes `count` more of what `sentence` describes; nothing when `count` is 0.
    pub(super) fn add(&mut self, sentence: impl Into<String>, count: u64, place: &str) {
        if count > 0 {
            self.tallies.entry(sentence.into()).or_insert_with(|| (0, place.to_owned())).0 += count;
        }
    }

    /// The warnings, in alphabetical order of their sentences.
    pub(super) fn into_warnings(self, model: &Path) -> Vec<Warning> {
        let warning = |(sentence, (count, place)): (String, (u64, String))| Warning {
            place: format!("{}: {place}", model.display()),
            what: if count == 1 { sentence } else { format!("{sentence} ({count} times, the first here)") },
        };
        self.tallies.into_iter().map(warning).collect()
    }
}
