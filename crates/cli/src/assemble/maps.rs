//! What of the sky's light is kept from picture to picture, and from run to run.
//!
//! ```text
//! "keikanMS"  length u64  illuminance map  length u64  sights     (little-endian; a length of 0 = there are none)
//! ```

use std::sync::Arc;

use light::Geometry;
use sky::WholeSky;
use sky::map::{Described, Mapped, Settings, Sights};

const MAGIC: &[u8; 8] = b"keikanMS";

/// Illuminance maps and sights: those of the last picture, and what a file had.
#[derive(Default)]
pub struct Maps {
    mapped: Option<Arc<Mapped>>,
    sights: Option<Arc<Sights>>,
    /// Map and sights of another run, not looked at yet.
    file: Option<[Vec<u8>; 2]>,
    /// What became of these.
    said: Option<String>,
}

impl Maps {
    /// What another run has kept.
    ///
    /// # Errors
    /// In words, if that is no such file. Whether it belongs to the scene is seen later ([`Self::said`]).
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let mut rest = bytes.strip_prefix(MAGIC).ok_or("not a file of keikan's maps")?;
        let mut part = || {
            let (length, after) = rest.split_first_chunk()?;
            let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
            let (part, after) = after.split_at_checked(length)?;
            rest = after;
            Some(part.to_vec())
        };
        let parts = [part(), part()];
        match parts {
            [Some(map), Some(sights)] if rest.is_empty() => {
                Ok(Self { file: Some([map, sights]), ..Self::default() })
            }
            _ => Err("the file of maps is damaged: its parts do not add up to its length".to_owned()),
        }
    }

    /// All that the last picture has, for another run; none if it had no map.
    pub fn to_bytes(&self) -> Option<Vec<u8>> {
        let mapped = self.mapped.as_ref()?;
        let sights = self.sights.as_ref().filter(|sights| sights.count() > 0);
        let mut bytes = MAGIC.to_vec();
        for part in [mapped.to_bytes(), sights.map_or(Vec::new(), |sights| sights.to_bytes())] {
            bytes.extend((part.len() as u64).to_le_bytes());
            bytes.extend(part);
        }
        Some(bytes)
    }

    /// What became of what another run has kept, in words, once.
    pub fn said(&mut self) -> Option<String> {
        self.said.take()
    }

    /// A map of `inner`, with all that is known of it already.
    pub(super) fn map(
        &mut self,
        inner: Arc<dyn WholeSky>,
        geometry: &Arc<Geometry>,
        fineness: Settings,
        described: &Described,
    ) -> Arc<Mapped> {
        let mut map = Mapped::new(inner, Arc::clone(geometry), fineness, described);
        if let Some([values, sights]) = self.file.take() {
            self.said = Some(self.take_over(&mut map, &values, &sights));
        }
        let known = self.sights.take().filter(|sights| sights.belong_to(map.key()));
        let sights = known.unwrap_or_else(|| Arc::new(Sights::new(map.key())));
        let map = Arc::new(map.with_sights(Arc::clone(&sights)));
        (self.mapped, self.sights) = (Some(Arc::clone(&map)), Some(sights));
        map
    }

    /// Takes over what fits, and says so.
    fn take_over(&mut self, map: &mut Mapped, values: &[u8], sights: &[u8]) -> String {
        let sights = match sights {
            [] => None,
            bytes => Some(Sights::from_bytes(map.key(), bytes)),
        };
        let faces = map.recall(values);
        let said = match (&faces, &sights) {
            (Ok(faces), _) => format!("{faces} mapped sides of faces are used again"),
            (Err(fault), Some(Ok(sights))) => {
                format!("{fault}; what {} points see of the sky is used again", sights.count())
            }
            (Err(fault), None) => format!("made anew: {fault}"),
            (Err(fault), Some(Err(other))) if fault == other => format!("made anew: {fault}"),
            (Err(fault), Some(Err(other))) => format!("made anew: {fault}; {other}"),
        };
        self.sights = sights.and_then(Result::ok).map(Arc::new);
        said
    }
}
