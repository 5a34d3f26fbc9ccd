//! Files from disk: plain ones only, and not more of them than asked for.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Opens a plain file; its length \[bytes\] comes along. A pipe or a device would never end, or block even while
/// it is being opened.
pub(crate) fn open(path: &Path) -> Result<(File, u64)> {
    let about = std::fs::metadata(path)?;
    if !about.is_file() {
        return Err(Error::other(if about.is_dir() { "is a folder" } else { "not a regular file" }));
    }
    Ok((File::open(path)?, about.len()))
}

/// Reads a plain file, at most `limit` bytes.
pub(crate) fn read(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let (file, length) = open(path)?;
    let mut bytes = Vec::with_capacity(usize::try_from(length.min(limit)).unwrap_or(0));
    file.take(limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads a plain file whole.
///
/// # Errors
/// [`crate::Error::Io`] from the disk; [`crate::Error::File`] for one of more than `most` bytes.
pub(crate) fn whole(path: &Path, most: u64) -> std::result::Result<Vec<u8>, crate::Error> {
    let io = |source| crate::Error::Io { path: path.to_path_buf(), source };
    // One byte more than allowed tells a file that is too long.
    let bytes = read(path, most + 1).map_err(io)?;
    if bytes.len() as u64 <= most {
        return Ok(bytes);
    }
    let what = format!("is longer than {} MiB", most >> 20);
    Err(crate::Error::File { path: path.to_path_buf(), place: String::new(), what })
}
