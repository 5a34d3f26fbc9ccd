//! Which faces cross a group of lines, without asking them all.

use std::ops::Range;

/// Marks a face that crosses no line of the picture.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Items sorted by (level, first group).
///
/// An item that touches groups first..=last lies on level ⌈log₂(last − first + 1)⌉, under its first group.
/// A group g is then touched only by items of level l whose first group lies in g − 2^l + 1 ..= g, which
/// stand together, and of these more than half touch it. Every item is stored once however tall
/// it is: n items take O(n) memory and a group is answered in time proportional to the answer.
pub(crate) struct Buckets<T> {
    items: Vec<T>,
    /// Where bucket (level · groups + first) begins; one more at the end.
    starts: Vec<u32>,
    groups: u32,
    levels: u32,
}

/// The bucket of an item that touches groups `first`..=`last`.
pub(crate) fn key(groups: u32, first: u32, last: u32) -> u32 {
    let level = (last - first + 1).next_power_of_two().trailing_zeros();
    level * groups + first
}

impl<T: Copy + Default> Buckets<T> {
    /// `keys[i]` is the bucket of item i or [`NOWHERE`]; the order within a bucket is that of i.
    pub(crate) fn sort(groups: u32, keys: &[u32], mut item: impl FnMut(usize) -> T) -> Self {
        let levels = groups.max(1).next_power_of_two().trailing_zeros() + 1;
        let mut starts = vec![0u32; (levels * groups) as usize + 1];
        for &key in keys.iter().filter(|&&key| key != NOWHERE) {
            starts[key as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut items = vec![T::default(); starts.last().copied().unwrap_or(0) as usize];
        let mut next = starts.clone();
        for (i, &key) in keys.iter().enumerate().filter(|(_, key)| **key != NOWHERE) {
            let slot = &mut next[key as usize];
            items[*slot as usize] = item(i);
            *slot += 1;
        }
        Self { items, starts, groups, levels }
    }

    /// All items that may touch `group`, and few others.
    pub(crate) fn touching(&self, group: u32) -> impl Iterator<Item = &[T]> {
        (0..self.levels).map(move |level| {
            let first = group.saturating_sub((1u32 << level) - 1);
            &self.items[self.range(level, first..group + 1)]
        })
    }

    fn range(&self, level: u32, firsts: Range<u32>) -> Range<usize> {
        let start = |first: u32| self.starts[(level * self.groups + first) as usize] as usize;
        start(firsts.start)..start(firsts.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_item_is_found_where_it_touches(
            groups in 1u32..70,
            spans in prop::collection::vec((0u32..70, 0u32..70), 0..50),
        ) {
            let spans: Vec<_> = spans
                .iter()
                .map(|&(a, b)| (a.min(b).min(groups - 1), a.max(b).min(groups - 1)))
                .collect();
            let keys: Vec<_> = spans.iter().map(|&(a, b)| key(groups, a, b)).collect();
            let buckets = Buckets::sort(groups, &keys, |i| i);
            for group in 0..groups {
                let mut found: Vec<_> = buckets.touching(group).flatten().copied().collect();
                found.retain(|&i| (spans[i].0..=spans[i].1).contains(&group));
                found.sort_unstable();
                let expected: Vec<_> =
                    (0..spans.len()).filter(|&i| (spans[i].0..=spans[i].1).contains(&group)).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }
}
