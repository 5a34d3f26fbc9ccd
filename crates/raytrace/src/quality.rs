//! How much care goes into the hierarchy before the first ray.

use obvhs::{BvhBuildParams, ploc::PlocSearchDistance};

/// How much care goes into the hierarchy: building time against rays per second.
///
/// Answers are the same with each: only time differs. Build seconds are for the million triangles of
/// `benches/rays.rs`, relative to [`Quality::Medium`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// For previews: builds in about ⅔ of the time; rays take 5 to 15 % longer.
    Fast,
    /// For stills.
    #[default]
    Medium,
    /// For pictures that trace for minutes: builds 2 to 3 times as long; rays gain up to 10 %.
    Best,
}

impl Quality {
    /// All of them, cheapest first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Medium, Self::Best];

    /// What obvhs is asked for: its presets with single-triangle leaves, because leaves are made here by
    /// the cost of our own packets, and without pre-splits, which would report a face twice.
    pub(crate) const fn binary(self) -> BvhBuildParams {
        let mut binary = match self {
            Self::Fast => BvhBuildParams::fast_build(),
            Self::Medium => BvhBuildParams::medium_build(),
            Self::Best => BvhBuildParams::slow_build(),
        };
        if matches!(self, Self::Best) {
            binary.ploc_search_distance = PlocSearchDistance::High;
        }
        binary.pre_split = false;
        binary.max_prims_per_leaf = 1;
        binary.post_collapse_reinsertion_batch_ratio_multiplier = 0.0;
        binary
    }
}
