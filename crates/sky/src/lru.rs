//! The tables used last, by key.

use std::sync::{Arc, Mutex, PoisonError};

/// A store of the `capacity` values used last, shared by threads.
///
/// A value must be a function of its key alone: then what happens to be in the store changes no answer.
pub(crate) struct Lru<K, V> {
    capacity: usize,
    /// The one used last at the end.
    entries: Mutex<Vec<(K, Arc<V>)>>,
}

impl<K: PartialEq, V> Lru<K, V> {
    pub(crate) fn new(capacity: usize) -> Self {
        Self { capacity: capacity.max(1), entries: Mutex::new(Vec::new()) }
    }

    /// The value of `key`, made where it is not there. Others are not kept waiting meanwhile; two threads may both make it.
    pub(crate) fn of(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        if let Some(value) = self.find(&key) {
            return value;
        }
        let value = Arc::new(make());
        // A thread that panicked can have left nothing half done that matters.
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        if entries.len() >= self.capacity {
            entries.remove(0);
        }
        entries.push((key, Arc::clone(&value)));
        value
    }

    fn find(&self, key: &K) -> Option<Arc<V>> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let index = entries.iter().rposition(|(k, _)| k == key)?;
        // In short lists moving is as quick as links.
        entries[index..].rotate_left(1);
        entries.last().map(|(_, value)| Arc::clone(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_used_for_longest_is_forgotten() {
        let store = Lru::new(2);
        let made = std::cell::Cell::new(0);
        let ask = |key: u32| {
            let value = store.of(key, || {
                made.set(made.get() + 1);
                key * 10
            });
            assert_eq!(*value, key * 10);
            made.get()
        };
        assert_eq!([1, 2, 1, 3, 1, 2].map(ask), [1, 2, 2, 3, 3, 4]);
    }
}
