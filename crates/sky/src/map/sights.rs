//! What the points of a map see of the sky, kept while the sun moves.
//!
//! ```text
//! "keikanSG"  version u32  bands u32  words u32  places u128  points u64
//! per point   slot u64  weights f64 × 2  word u64 …  partly u32  (patch u32  transmittance f32 × bands) …
//! end         FNV-1a of all before, u128
//! ```
//!
//! Little-endian; points ascend by slot and weights.

use std::sync::Arc;

use glam::DVec2;
use light::bands::BANDS;

use super::kept::{KeptError, Reader, begin, content, sealed};
use super::key::Key;
use super::shelves::{PointKey, Shelves};
use crate::Sight;

const MAGIC: &[u8; 8] = b"keikanSG";

/// What the points of a map see of the sky, apart from how bright it is: a moved sun asks for none of them again.
///
/// It belongs to all maps whose [`Key::places`] is its own, whatever their sky. A point takes some 140 bytes with 330 patches (10 rows), and a bit for each further one.
pub struct Sights {
    places: u128,
    points: Shelves<Arc<Sight>>,
}

impl Sights {
    /// None yet, for maps of this key.
    pub fn new(key: Key) -> Self {
        Self { places: key.places, points: Shelves::default() }
    }

    /// Whether they belong to maps of this key.
    pub fn belong_to(&self, key: Key) -> bool {
        self.places == key.places
    }

    /// How many points are known.
    pub fn count(&self) -> usize {
        self.points.size()[0]
    }

    pub(crate) fn of(&self, slot: usize, at: DVec2, find: impl FnOnce() -> Sight) -> Arc<Sight> {
        self.points.of(slot, at, || Arc::new(find()))
    }

    /// All that is known, for another run.
    pub fn to_bytes(&self) -> Vec<u8> {
        let all = self.points.all();
        let words = all.first().map_or(0, |(_, sight)| sight.whole().len());
        let mut bytes = begin(MAGIC);
        bytes.extend((words as u32).to_le_bytes());
        bytes.extend(self.places.to_le_bytes());
        bytes.extend((all.len() as u64).to_le_bytes());
        for ((slot, at), sight) in all {
            bytes.extend([slot as u64, at[0], at[1]].map(u64::to_le_bytes).as_flattened());
            sight.whole().iter().for_each(|word| bytes.extend(word.to_le_bytes()));
            bytes.extend((sight.partly().len() as u32).to_le_bytes());
            for (patch, transmittance) in sight.partly() {
                bytes.extend(patch.to_le_bytes());
                bytes.extend(transmittance.0.map(f32::to_le_bytes).as_flattened());
            }
        }
        sealed(bytes)
    }

    /// The reverse, for maps of this key.
    ///
    /// # Errors
    /// What is damaged, or belongs to other places.
    pub fn from_bytes(key: Key, bytes: &[u8]) -> Result<Self, KeptError> {
        let mut reader = content(bytes, MAGIC)?;
        let words = reader.u32()?;
        if reader.u128()? != key.places {
            return Err(KeptError::OtherPlaces);
        }
        let sights = Self::new(key);
        for _ in 0..reader.u64()? {
            let (key, sight) = point(&mut reader, words)?;
            sights.points.put(key, Arc::new(sight));
        }
        if reader.is_empty() { Ok(sights) } else { Err(KeptError::Damaged) }
    }
}

fn point(reader: &mut Reader, words: u32) -> Result<(PointKey, Sight), KeptError> {
    let slot = usize::try_from(reader.u64()?).map_err(|_| KeptError::Damaged)?;
    let at = [reader.u64()?, reader.u64()?];
    let whole = (0..words).map(|_| reader.u64()).collect::<Result<_, _>>()?;
    let count = reader.u32()?;
    if u64::from(count) * (4 + 4 * BANDS as u64) > reader.left() as u64 {
        return Err(KeptError::Damaged);
    }
    let partly = (0..count).map(|_| Ok((reader.u32()?, reader.value()?))).collect::<Result<_, _>>()?;
    Ok(((slot, at), Sight::new(whole, partly).ok_or(KeptError::Damaged)?))
}
