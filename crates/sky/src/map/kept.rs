//! Maps as bytes, for the next run.
//!
//! ```text
//! "keikanIM"  version u32  bands u32  places u128  sky u128  faces u64
//! per face    slot u64  nodes u32  values u32  node u32 …  value f32 × bands …
//! end         FNV-1a of all before, u128
//! ```
//!
//! Little-endian. A slot is twice the number of the triangle, counted through all placements, plus 1 for the back;
//! slots ascend. Nodes are cuts in preorder.

use std::fmt;

use light::Spectrum;
use light::bands::BANDS;

use super::key::{Fnv, Key};
use super::tree::{FaceMap, LEAF, Node, uncut};

const MAGIC: &[u8; 8] = b"keikanIM";
/// To be raised with everything that changes where points are, what is asked for them, or which patches there are.
pub(crate) const VERSION: u32 = 2;

/// Why kept maps cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeptError {
    /// Not a map of this program.
    Foreign,
    /// Of another version of it.
    Version(u32),
    /// Cut short, too long, or altered.
    Damaged,
    /// Of another geometry, or made with other settings.
    OtherPlaces,
    /// Of another sky: model, sun, ground.
    OtherSky,
}

impl fmt::Display for KeptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign => f.write_str("not an illuminance map of keikan"),
            Self::Version(found) => write!(f, "an illuminance map of version {found}; this is {VERSION}"),
            Self::Damaged => f.write_str("the illuminance map is damaged"),
            Self::OtherPlaces => f.write_str("the illuminance map is of another scene or other settings"),
            Self::OtherSky => f.write_str("the illuminance map is of another sky"),
        }
    }
}

impl std::error::Error for KeptError {}

/// The beginning of every file: what it is, of which version, for how many bands.
pub(crate) fn begin(magic: &[u8; 8]) -> Vec<u8> {
    let mut bytes = magic.to_vec();
    bytes.extend([VERSION, BANDS as u32].map(u32::to_le_bytes).as_flattened());
    bytes
}

/// Its end.
pub(crate) fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let seal = Fnv::new().bytes(&bytes).number();
    bytes.extend(seal.to_le_bytes());
    bytes
}

/// What is between both, if both are right.
pub(crate) fn content<'a>(bytes: &'a [u8], magic: &[u8; 8]) -> Result<Reader<'a>, KeptError> {
    let rest = bytes.strip_prefix(magic).ok_or(KeptError::Foreign)?;
    let version = Reader(rest).u32()?;
    if version != VERSION {
        return Err(KeptError::Version(version));
    }
    let (content, seal) = bytes.split_last_chunk().ok_or(KeptError::Damaged)?;
    if Fnv::new().bytes(content).number() != u128::from_le_bytes(*seal) {
        return Err(KeptError::Damaged);
    }
    let mut reader = Reader(&content[magic.len() + 4..]);
    if reader.u32()? == BANDS as u32 { Ok(reader) } else { Err(KeptError::Damaged) }
}

/// Maps of some faces as bytes; slots ascend.
pub(crate) fn write(key: &Key, faces: &[(usize, &FaceMap)]) -> Vec<u8> {
    let mut bytes = begin(MAGIC);
    bytes.extend([key.places, key.sky].map(u128::to_le_bytes).as_flattened());
    bytes.extend((faces.len() as u64).to_le_bytes());
    for (slot, face) in faces {
        bytes.extend((*slot as u64).to_le_bytes());
        bytes
            .extend([face.nodes.len() as u32, face.values.len() as u32].map(u32::to_le_bytes).as_flattened());
        face.nodes.iter().for_each(|node| bytes.extend(node.cut.to_le_bytes()));
        face.values.iter().flat_map(|value| value.0).for_each(|band| bytes.extend(band.to_le_bytes()));
    }
    sealed(bytes)
}

/// The reverse: the key, and maps by slot, all slots below `slots`.
pub(crate) fn read(bytes: &[u8], slots: usize) -> Result<(Key, Vec<(usize, FaceMap)>), KeptError> {
    let mut reader = content(bytes, MAGIC)?;
    let key = Key { places: reader.u128()?, sky: reader.u128()? };
    let count = reader.u64()?;
    let mut faces: Vec<(usize, FaceMap)> = Vec::new();
    for _ in 0..count {
        let slot = usize::try_from(reader.u64()?).ok().filter(|slot| *slot < slots);
        let slot = slot.filter(|slot| faces.last().is_none_or(|last| last.0 < *slot));
        faces.push((slot.ok_or(KeptError::Damaged)?, reader.face()?));
    }
    if reader.is_empty() { Ok((key, faces)) } else { Err(KeptError::Damaged) }
}

/// What is left to read.
pub(crate) struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// \[bytes\]
    pub(crate) fn left(&self) -> usize {
        self.0.len()
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], KeptError> {
        let (first, rest) = self.0.split_first_chunk().ok_or(KeptError::Damaged)?;
        self.0 = rest;
        Ok(*first)
    }

    pub(crate) fn u32(&mut self) -> Result<u32, KeptError> {
        self.take().map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self) -> Result<u64, KeptError> {
        self.take().map(u64::from_le_bytes)
    }

    pub(crate) fn u128(&mut self) -> Result<u128, KeptError> {
        self.take().map(u128::from_le_bytes)
    }

    fn face(&mut self) -> Result<FaceMap, KeptError> {
        let [nodes, values] = [self.u32()? as u64, self.u32()? as u64];
        // Nothing is made room for that is not there.
        if nodes * 4 + values * (4 * BANDS as u64) > self.0.len() as u64 || values < 3 {
            return Err(KeptError::Damaged);
        }
        let cuts = (0..nodes).map(|_| self.u32()).collect::<Result<Vec<_>, _>>()?;
        let nodes = tree(&cuts, values as usize).ok_or(KeptError::Damaged)?;
        let values = (0..values).map(|_| self.value()).collect::<Result<Box<[_]>, _>>()?;
        Ok(FaceMap { values, nodes })
    }

    pub(crate) fn value(&mut self) -> Result<Spectrum, KeptError> {
        let mut value = Spectrum::ZERO;
        for band in &mut value.0 {
            *band = self.take().map(f32::from_le_bytes)?;
            if !(0.0..=1.0).contains(band) {
                return Err(KeptError::Damaged);
            }
        }
        Ok(value)
    }
}

/// The tree whose cuts in preorder these are; none if they are not one whole tree over `values` points.
fn tree(cuts: &[u32], values: usize) -> Option<Box<[Node]>> {
    let mut nodes: Vec<Node> = Vec::with_capacity(cuts.len());
    // Cells whose second part is still to come.
    let mut open: Vec<usize> = Vec::new();
    let mut whole = false;
    for &cut in cuts {
        if whole {
            return None;
        }
        let here = nodes.len();
        nodes.push(Node { cut, second: 0 });
        if cut != LEAF {
            let (apex, middle) = uncut(cut);
            if apex > 2 || middle < 3 || middle as usize >= values {
                return None;
            }
            open.push(here);
        } else if let Some(cell) = open.pop() {
            nodes[cell].second = nodes.len() as u32;
        } else {
            whole = true;
        }
    }
    whole.then(|| nodes.into())
}
