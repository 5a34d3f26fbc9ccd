//! A file is written whole or not at all.

use std::io::Write;
use std::path::Path;

use atomic_write_file::AtomicWriteFile;

use crate::Error;

/// Writes `bytes` to a temporary name beside `path`, then renames.
///
/// # Errors
/// [`Error::Output`] with what the system said; `path` is then untouched.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let attempt = || {
        let mut file = AtomicWriteFile::open(path)?;
        file.write_all(bytes)?;
        file.commit()
    };
    attempt().map_err(|error: std::io::Error| Error::Output {
        path: path.display().to_string(),
        what: format!("could not be written: {error}"),
    })
}
