//! GLB or plain JSON: where the document is and where its binary chunk.

use super::fault::{Checked, Fault};

const MAGIC: &[u8; 4] = b"glTF";
const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

/// The two parts of a model file.
#[derive(Debug)]
pub(super) struct Container<'a> {
    /// The document.
    pub(super) json: &'a [u8],
    /// The GLB's own buffer.
    pub(super) binary: Option<&'a [u8]>,
}

/// Splits a file into document and binary chunk; whatever does not start like a GLB is taken for JSON.
pub(super) fn split(bytes: &[u8]) -> Checked<Container<'_>> {
    if !bytes.starts_with(MAGIC) {
        let json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        return Ok(Container { json, binary: None });
    }
    let header = |what: String| Err(Fault::new("GLB header", what));
    let (Some(version), Some(length)) = (word(bytes, 4), word(bytes, 8)) else {
        return header(format!("the file ends after {} bytes, within the header", bytes.len()));
    };
    if version != 2 {
        return header(format!("version {version}; only glTF 2 is understood"));
    }
    let Some(body) = bytes.get(12..length as usize) else {
        return header(format!("announces {length} bytes, the file has {}: it is truncated", bytes.len()));
    };
    let (kind, json, rest) = chunk(body)?;
    if kind != JSON {
        return header("the first chunk is not JSON".into());
    }
    let mut binary = None;
    let mut rest = rest;
    // Chunks of unknown kinds are to be skipped; only the first BIN is the buffer.
    while binary.is_none() && !rest.is_empty() {
        let (kind, data, after) = chunk(rest)?;
        if kind == BIN {
            binary = Some(data);
        }
        rest = after;
    }
    Ok(Container { json, binary })
}

/// Kind and content of the first chunk, and what follows it.
fn chunk(bytes: &[u8]) -> Checked<(u32, &[u8], &[u8])> {
    let (Some(length), Some(kind)) = (word(bytes, 0), word(bytes, 4)) else {
        return Err(Fault::new("GLB chunk", "the file ends within a chunk's header: it is truncated"));
    };
    let content = &bytes[8..];
    if length as usize > content.len() {
        let what = format!("announces {length} bytes, {} are left: the file is truncated", content.len());
        return Err(Fault::new("GLB chunk", what));
    }
    let (data, rest) = content.split_at(length as usize);
    Ok((kind, data, rest))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}
