//! How a command can end otherwise than well.

/// Why a command did not do all that was asked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The caller asked for something that does not exist: exit code 2.
    #[error("{0}")]
    Usage(String),
    /// The scene could not be loaded: exit code 1.
    #[error(transparent)]
    Scene(#[from] scene::Error),
    /// The scene asks for something that does not exist: exit code 1.
    #[error("{0}")]
    Content(String),
    /// An output could not be written whole: exit code 1.
    #[error("{path}: {what}")]
    Output {
        /// Which file.
        path: String,
        /// Why.
        what: String,
    },
    /// A picture that is given could not be read or used: exit code 1.
    #[error("{path}: {what}")]
    Input {
        /// Which file.
        path: String,
        /// Why.
        what: String,
    },
    /// Ctrl-C: exit code 130.
    #[error("interrupted; nothing was written")]
    Interrupted,
    /// Ctrl-C after so many frames of several: exit code 130.
    #[error("interrupted; {0} frames were written before, each whole, and are skipped when it is run again")]
    InterruptedAfter(usize),
}

impl Error {
    /// The same, but the scene file's fault instead of the caller's.
    pub(crate) fn in_scene(self) -> Self {
        match self {
            Self::Usage(what) => Self::Content(what),
            other => other,
        }
    }

    /// The process exit code of this error.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Scene(_) | Self::Content(_) | Self::Output { .. } | Self::Input { .. } => 1,
            Self::Interrupted | Self::InterruptedAfter(_) => 130,
        }
    }
}
