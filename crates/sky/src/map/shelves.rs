//! What is known of points, by whose they are.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::DVec2;

/// Parts with a lock each, so that threads seldom meet.
const SHELVES: usize = 32;

/// The owner's side, and bits of the weights there.
pub(crate) type PointKey = (usize, [u64; 2]);
type Shelf<V> = HashMap<PointKey, V>;

/// What is known of points: found once, by whoever comes first; all would find the same.
pub(crate) struct Shelves<V>([Mutex<Shelf<V>>; SHELVES]);

impl<V> Default for Shelves<V> {
    fn default() -> Self {
        Self(std::array::from_fn(|_| Mutex::default()))
    }
}

impl<V: Clone> Shelves<V> {
    /// What is known at weights `at` of side `slot`, or what `find` finds.
    pub(crate) fn of(&self, slot: usize, at: DVec2, find: impl FnOnce() -> V) -> V {
        let key = (slot, at.to_array().map(f64::to_bits));
        let known = open(self.shelf(&key)).get(&key).cloned();
        known.unwrap_or_else(|| {
            // Found without the lock: two threads may find the same, but none waits for another's rays.
            let value = find();
            self.put(key, value.clone());
            value
        })
    }

    pub(crate) fn put(&self, key: PointKey, value: V) {
        open(self.shelf(&key)).insert(key, value);
    }

    /// How many points are known, and how many there is room for.
    pub(crate) fn size(&self) -> [usize; 2] {
        let sizes = self.0.iter().map(|shelf| open(shelf)).map(|shelf| [shelf.len(), shelf.capacity()]);
        sizes.fold([0; 2], |[a, b], [c, d]| [a + c, b + d])
    }

    /// All that is known, in the order of the keys.
    pub(crate) fn all(&self) -> Vec<(PointKey, V)> {
        let copy =
            |shelf: &Mutex<Shelf<V>>| open(shelf).iter().map(|(k, v)| (*k, v.clone())).collect::<Vec<_>>();
        let mut all: Vec<_> = self.0.iter().flat_map(copy).collect();
        all.sort_unstable_by_key(|(key, _)| *key);
        all
    }

    fn shelf(&self, key: &PointKey) -> &Mutex<Shelf<V>> {
        &self.0[key.0 / 2 % SHELVES]
    }
}

/// Nothing is changed but by whole entries: what a panic elsewhere has left is right.
fn open<V>(shelf: &Mutex<Shelf<V>>) -> MutexGuard<'_, Shelf<V>> {
    shelf.lock().unwrap_or_else(PoisonError::into_inner)
}
