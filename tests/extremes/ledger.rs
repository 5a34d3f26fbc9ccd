//! What a model leaves at worst, against what it may.

use std::cell::RefCell;
use std::collections::BTreeMap;

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Worst found so far of each law: what it is off by, what it may be, and where that was.
pub(crate) struct Ledger {
    model: &'static str,
    worst: RefCell<BTreeMap<&'static str, (f64, f64, String)>>,
}

impl Ledger {
    pub(crate) fn new(model: &'static str) -> Self {
        Self { model, worst: RefCell::default() }
    }

    /// That a law is off by `off` where it may be by `bound`, at some input.
    pub(crate) fn note(&self, law: &'static str, off: f64, bound: f64, at: impl std::fmt::Debug) {
        let mut worst = self.worst.borrow_mut();
        let entry = worst.entry(law).or_insert((0.0, bound, String::new()));
        // What is no number is worse than anything.
        if off.is_nan() || off / bound > entry.0 / entry.1 || (bound == 0.0 && off > entry.0) {
            *entry = (off, bound, format!("{at:?}"));
        }
    }

    /// That a law holds or not.
    pub(crate) fn holds(&self, law: &'static str, holds: bool, at: impl std::fmt::Debug) {
        self.note(law, f64::from(u8::from(!holds)), 0.0, at);
    }

    /// Prints what was worst.
    ///
    /// # Panics
    /// Where it is beyond its bound.
    pub(crate) fn close(self) {
        let mut broken = Vec::new();
        for (law, (off, bound, at)) in self.worst.into_inner() {
            println!("{:18} {law:44} {off:9.2e} of {bound:8.1e}  {at}", self.model);
            if off.is_nan() || off > bound {
                broken.push(format!("{law}: {off} where {bound} is allowed, at {at}"));
            }
        }
        assert!(broken.is_empty(), "{}: {broken:#?}", self.model);
    }
}

/// All corners of some ranges, and `count` points within, the same in every run.
pub(crate) fn inputs<const N: usize>(ranges: [(f64, f64); N], count: usize) -> Vec<[f64; N]> {
    let corner = |i: usize| std::array::from_fn(|k| if i >> k & 1 == 0 { ranges[k].0 } else { ranges[k].1 });
    let mut all: Vec<[f64; N]> = (0..1 << N).map(corner).collect();
    let within = ranges.map(|(low, high)| low..=high);
    all.extend(drawn(&within, count));
    all
}

/// Some values of a strategy, the same in every run.
pub(crate) fn drawn<S: Strategy>(strategy: &S, count: usize) -> Vec<S::Value> {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    (0..count).map(|_| strategy.new_tree(&mut runner).expect("a value").current()).collect()
}

/// 10 to a power between two: lengths of all sizes.
pub(crate) fn power(exponent: f64) -> f64 {
    10f64.powf(exponent)
}
