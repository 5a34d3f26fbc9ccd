//! URIs in a model: data in the URI itself, or a file below the model's folder. Nothing else is followed.

use std::fs;
use std::path::{Path, PathBuf};

use super::fault::{Checked, Fault};
use crate::regular_file;

/// What a URI of a model stands for.
pub(super) enum Resource {
    /// The bytes were in the URI.
    Embedded(Vec<u8>),
    /// A file below the model's folder (not opened yet).
    File(PathBuf),
}

/// Understands `uri`, found at `place` in a model that lies in `folder`.
pub(super) fn resolve(uri: &str, folder: &Path, place: &str) -> Checked<Resource> {
    let wrong = |what: String| Fault::new(place, what);
    if let Some(data) = uri.strip_prefix("data:") {
        return embedded(data).map(Resource::Embedded).map_err(|what| wrong(what.to_owned()));
    }
    let shown: String = uri.chars().take(100).collect();
    let path = unescape(uri.as_bytes())
        .and_then(|bytes| String::from_utf8(bytes).ok())
        .ok_or_else(|| wrong(format!("URI \"{shown}\" has a broken % escape")))?;
    let outside = path.is_empty()
        || path.starts_with('/')
        || path.contains(['\\', ':', '\0'])
        || path.split('/').any(|part| part == "..");
    if outside {
        let what = format!(
            "URI \"{shown}\" is refused: a model may name data: URIs and files in its own folder or below it"
        );
        return Err(wrong(what));
    }
    Ok(Resource::File(folder.join(path)))
}

/// The bytes behind `uri`, at most `limit` of them.
pub(super) fn fetch(uri: &str, folder: &Path, place: &str, limit: u64) -> Checked<Vec<u8>> {
    match resolve(uri, folder, place)? {
        Resource::Embedded(bytes) => Ok(bytes),
        Resource::File(path) => {
            let io = |source| Fault::Io { place: place.to_owned(), path: path.clone(), source };
            let real = real(&path, folder, place).map_err(io)??;
            regular_file::read(&real, limit).map_err(io)
        }
    }
}

/// Where `path`, below `folder` by its name, really lies: a link could lead out of the folder.
pub(super) fn real(path: &Path, folder: &Path, place: &str) -> std::io::Result<Checked<PathBuf>> {
    let base = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (real, base) = (fs::canonicalize(path)?, fs::canonicalize(base)?);
    Ok(if real.starts_with(&base) {
        Ok(real)
    } else {
        Err(Fault::new(place, format!("{} leads out of the model's folder", path.display())))
    })
}

/// `[media type][;base64],content`.
fn embedded(data: &str) -> Result<Vec<u8>, &'static str> {
    let (head, content) = data.split_once(',').ok_or("a data: URI without a comma")?;
    if head.ends_with(";base64") {
        base64(content.as_bytes()).ok_or("a data: URI whose base64 is broken")
    } else {
        unescape(content.as_bytes()).ok_or("a data: URI with a broken % escape")
    }
}

/// RFC 4648 base64, padding optional.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let end = text.iter().rposition(|&c| c != b'=').map_or(0, |last| last + 1);
    if text.len() - end > 2 {
        return None;
    }
    let mut bytes = Vec::with_capacity(end / 4 * 3 + 2);
    for group in text[..end].chunks(4) {
        let mut bits = 0u32;
        for &c in group {
            bits = bits << 6 | u32::from(sextet(c)?);
        }
        match group.len() {
            4 => bytes.extend_from_slice(&bits.to_be_bytes()[1..]),
            3 => bytes.extend_from_slice(&(bits << 6).to_be_bytes()[1..3]),
            2 => bytes.push((bits >> 4) as u8),
            _ => return None,
        }
    }
    Some(bytes)
}

fn sextet(c: u8) -> Option<u8> {
    match c {
        b'A'..=b'Z' => Some(c - b'A'),
        b'a'..=b'z' => Some(c - b'a' + 26),
        b'0'..=b'9' => Some(c - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    }
}

/// `%41` → `A`.
fn unescape(text: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        if first == b'%' {
            let digit = |i: usize| char::from(*after.get(i)?).to_digit(16);
            bytes.push((digit(0)? * 16 + digit(1)?) as u8);
            rest = &after[2..];
        } else {
            bytes.push(first);
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_rfc_4648() {
        for (text, bytes) in [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYg", "foob")] {
            assert_eq!(base64(text.as_bytes()).as_deref(), Some(bytes.as_bytes()));
        }
        for text in ["Z", "Zg===", "Z=g=", "Zg\n="] {
            assert_eq!(base64(text.as_bytes()), None);
        }
    }

    #[test]
    fn only_files_below_the_folder() {
        let file = |uri| match resolve(uri, Path::new("models"), "/images/0/uri") {
            Ok(Resource::File(path)) => Some(path),
            _ => None,
        };
        assert_eq!(file("maps/tree%20bark.png"), Some("models/maps/tree bark.png".into()));
        assert_eq!(file("maps/..tree.png"), Some("models/maps/..tree.png".into()));
        for uri in [
            "../a.png",
            "a/../../b",
            "%2e%2e/a",
            "/etc/passwd",
            "%2Fetc/passwd",
            "file:///etc/passwd",
            "http://a/b",
            "C:/a",
            "a\\b",
            "..\\b",
            "",
            "%",
            "%4",
            "%zz",
            "%ff",
            "a%00b",
        ] {
            assert_eq!(file(uri), None, "{uri}");
        }
    }
}
