//! The document and its buffers; every index is looked up here, checked.

use std::borrow::Cow;
use std::cell::Cell;
use std::path::Path;

use gltf::json::Root;
use serde::Deserialize;

use super::container::Container;
use super::fault::{Checked, Fault};
use super::resource;

/// A parsed model with its bytes.
pub(super) struct Document<'a> {
    pub(super) root: Root,
    /// Placements as the file has them: the `gltf` crate keeps only f32, which at 10⁶ m is a step of 6 cm.
    pub(super) placements: Vec<RawPlacement>,
    pub(super) folder: &'a Path,
    buffers: Vec<Cow<'a, [u8]>>,
    /// Elements (vertices, corners, instances) that may still be made.
    budget: Cell<u64>,
}

/// How a node is placed, in full precision.
#[derive(Debug, Default, Deserialize)]
pub(super) struct RawPlacement {
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct RawNodes {
    #[serde(default)]
    nodes: Vec<RawPlacement>,
}

/// Elements that a file may make per byte of its own, so that a small hostile file (ten thousand
/// primitives on one accessor) cannot ask for unbounded memory. Honest files that share one vertex
/// list between a thousand primitives stay below it.
const ELEMENTS_PER_BYTE: u64 = 64;
/// Elements granted to any file.
const ELEMENTS_FREE: u64 = 1 << 20;

impl<'a> Document<'a> {
    /// Parses the JSON and collects the buffers.
    pub(super) fn new(container: &Container<'a>, folder: &'a Path) -> Checked<Self> {
        let root: Root = parse(container.json)?;
        let raw: RawNodes = parse(container.json)?;
        let mut buffers = Vec::with_capacity(root.buffers.len());
        for (i, buffer) in root.buffers.iter().enumerate() {
            let place = format!("/buffers/{i}");
            let length = buffer.byte_length.0;
            let bytes = match (&buffer.uri, container.binary) {
                (Some(uri), _) => Cow::Owned(resource::fetch(uri, folder, &format!("{place}/uri"), length)?),
                (None, Some(binary)) if i == 0 => Cow::Borrowed(binary),
                // Legal (a fallback that a compression extension fills), empty for us.
                (None, _) => Cow::Borrowed(&[][..]),
            };
            if !bytes.is_empty() && (bytes.len() as u64) < length {
                let what = format!("byteLength is {length}, but only {} bytes are there", bytes.len());
                return Err(Fault::new(place, what));
            }
            buffers.push(bytes);
        }
        let bytes = container.json.len() + buffers.iter().map(|b| b.len()).sum::<usize>();
        let budget = Cell::new(ELEMENTS_FREE + ELEMENTS_PER_BYTE * bytes as u64);
        Ok(Self { root, placements: raw.nodes, folder, buffers, budget })
    }

    /// Takes `elements` from what this file may make; an error when it asks for more than its size warrants.
    pub(super) fn spend(&self, elements: u64, place: &str) -> Checked<()> {
        match self.budget.get().checked_sub(elements) {
            Some(left) => {
                self.budget.set(left);
                Ok(())
            }
            None => Err(Fault::new(
                place,
                format!("asks for {elements} more elements, out of all proportion to the size of the file"),
            )),
        }
    }

    /// The bytes of a buffer view and its stride.
    pub(super) fn view(&self, index: usize, user: &str) -> Checked<(&[u8], Option<usize>)> {
        let view = item(&self.root.buffer_views, index, "bufferViews", user)?;
        let place = format!("/bufferViews/{index}");
        let buffer = item(&self.buffers, view.buffer.value(), "buffers", &place)?;
        let offset = view.byte_offset.map_or(0, |offset| offset.0);
        let range = offset.checked_add(view.byte_length.0).and_then(|end| {
            let (start, end) = (usize::try_from(offset).ok()?, usize::try_from(end).ok()?);
            buffer.get(start..end)
        });
        let bytes = range.ok_or_else(|| {
            let what = format!(
                "bytes {offset} + {} lie outside buffer {}, which has {}",
                view.byte_length.0,
                view.buffer.value(),
                buffer.len()
            );
            Fault::new(&place, what)
        })?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0)))
    }
}

/// `list[index]`, or an error that says which list has how many.
pub(super) fn item<'l, T>(list: &'l [T], index: usize, name: &str, user: &str) -> Checked<&'l T> {
    list.get(index).ok_or_else(|| {
        let valid = match list.len() {
            0 => "there are none".to_owned(),
            n => format!("valid are 0 to {}", n - 1),
        };
        Fault::new(user, format!("index {index} into {name}: {valid}"))
    })
}

fn parse<'j, T: Deserialize<'j>>(json: &'j [u8]) -> Checked<T> {
    serde_json::from_slice(json).map_err(|error| Fault::new("JSON", error.to_string()))
}
