//! How much care goes into the hierarchy before the first ray.

use obvhs::{BvhBuildParams, ploc::PlocSearchDistance};

/// How much care goes into the hierarchy: building time against rays per second.
///
/// Answers are the same with each: only time differs. Measured on the million triangles of
/// `benches/rays.rs` (even terrain, two busy cores), where all three trace within 7 % of each other;
/// uneven scenes gain more from care.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// For previews: built in 0.54 s.
    Fast,
    /// For stills: built in 0.59 s.
    #[default]
    Medium,
    /// For pictures that trace for minutes: built in 1.1 s.
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
