//! Intervals, and the union of them.

use light::Stretch;

/// Appends the union of `intervals` to `out`, in order, no two of them touching.
pub(crate) fn union(intervals: &mut [(f64, f64)], dark: bool, out: &mut Vec<Stretch>) {
    intervals.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let first = out.len();
    for &mut (from, to) in intervals {
        match out[first..].last_mut() {
            Some(last) if from <= last.to => last.to = last.to.max(to),
            _ => out.push(Stretch { from, to, dark }),
        }
    }
}

/// An interval that grows by what overlaps it: tells early, though not always, that everything is covered.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cover {
    from: f64,
    to: f64,
}

impl Cover {
    /// Takes one more; true once \[0, 1\] is covered.
    pub(crate) fn take(&mut self, (from, to): (f64, f64)) -> bool {
        if from <= self.to && self.from <= to {
            *self = Self { from: self.from.min(from), to: self.to.max(to) };
        } else if to - from > self.to - self.from {
            *self = Self { from, to };
        }
        self.from <= 0.0 && self.to >= 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overlaps_or_touches_becomes_one() {
        let mut out = vec![Stretch { from: 0.0, to: 0.1, dark: false }];
        union(&mut [(0.5, 0.6), (0.1, 0.2), (0.2, 0.3), (0.55, 0.57), (0.59, 0.7)], true, &mut out);
        let ends: Vec<_> = out.iter().map(|s| (s.from, s.to, s.dark)).collect();
        assert_eq!(ends, [(0.0, 0.1, false), (0.1, 0.3, true), (0.5, 0.7, true)]);
    }

    #[test]
    fn covered_is_said_only_when_it_is() {
        let mut cover = Cover::default();
        assert!(!cover.take((0.0, 0.4)));
        assert!(!cover.take((0.5, 1.0)));
        assert!(!cover.take((0.0, 0.2)));
        assert!(cover.take((0.0, 0.5)));
    }
}
