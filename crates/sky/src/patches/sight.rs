//! What of the sky a place sees.

use light::Spectrum;

/// How much of the light of each patch arrives at a place: a bit for each, and the transmittance of the few that something
/// clear or cut out stands before.
#[derive(Clone, Debug, PartialEq)]
pub struct Sight {
    /// Bits of patches whose light arrives whole.
    whole: Box<[u64]>,
    /// Patches whose light arrives in part, in rising order.
    partly: Vec<(u32, Spectrum)>,
}

impl Sight {
    /// Of so many patches, nothing.
    pub(crate) fn blind(patches: usize) -> Self {
        Self { whole: vec![0; patches.div_ceil(64)].into(), partly: Vec::new() }
    }

    /// From parts as [`Self::whole`] and [`Self::partly`] give them; none if their numbers are no patches.
    pub(crate) fn new(whole: Box<[u64]>, partly: Vec<(u32, Spectrum)>) -> Option<Self> {
        let rising = partly.is_sorted_by(|a, b| a.0 < b.0);
        let last = partly.last().map_or(0, |(i, _)| *i as usize);
        (rising && last < 64 * whole.len()).then_some(Self { whole, partly })
    }

    /// The transmittance towards a patch that was not asked for before, in rising order.
    pub(crate) fn open(&mut self, patch: usize, transmittance: Spectrum) {
        if transmittance == Spectrum::ONE {
            self.whole[patch / 64] |= 1 << (patch % 64);
        } else if !transmittance.is_zero() {
            self.partly.push((patch as u32, transmittance));
        }
    }

    pub(crate) fn is_whole(&self, patch: usize) -> bool {
        self.whole.get(patch / 64).is_some_and(|bits| bits >> (patch % 64) & 1 == 1)
    }

    pub(crate) fn whole(&self) -> &[u64] {
        &self.whole
    }

    pub(crate) fn partly(&self) -> &[(u32, Spectrum)] {
        &self.partly
    }

    /// What it takes \[bytes\].
    pub fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.whole) + size_of_val(&*self.partly)
    }
}
