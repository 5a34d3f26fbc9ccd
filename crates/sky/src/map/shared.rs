//! Values of points that several faces have.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::DVec2;
use light::Spectrum;

/// Parts with a lock each, so that threads seldom meet.
const SHELVES: usize = 32;

/// The owner's side, and bits of the weights there.
type Key = (usize, [u64; 2]);
type Shelf = HashMap<Key, Spectrum>;

/// Values of points that several faces have: found once, by whoever comes first; all would find the same.
#[derive(Default)]
pub(crate) struct Shared([Mutex<Shelf>; SHELVES]);

impl Shared {
    /// The value at weights `at` of side `slot`, or what `find` finds.
    pub(crate) fn value(&self, slot: usize, at: DVec2, find: impl FnOnce() -> Spectrum) -> Spectrum {
        let key = (slot, at.to_array().map(f64::to_bits));
        let shelf = &self.0[slot / 2 % SHELVES];
        let known = open(shelf).get(&key).copied();
        known.unwrap_or_else(|| {
            // Found without the lock: two threads may find the same, but none waits for another's rays.
            let value = find();
            open(shelf).insert(key, value);
            value
        })
    }

    /// \[bytes\]
    pub(crate) fn bytes(&self) -> usize {
        self.0.iter().map(|shelf| open(shelf).capacity() * size_of::<(Key, Spectrum)>()).sum()
    }
}

/// Nothing is changed but by whole entries: what a panic elsewhere has left is right.
fn open(shelf: &Mutex<Shelf>) -> MutexGuard<'_, Shelf> {
    shelf.lock().unwrap_or_else(PoisonError::into_inner)
}
