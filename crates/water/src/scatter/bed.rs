//! How deep water is.

use glam::DVec2;

/// Water without a bottom counts as this deep \[m\]: nothing comes back from there, even of pure water (c z > 40).
const ENDLESS: f64 = 1e4;

/// Depths of a water by place.
#[derive(Clone, Debug, PartialEq)]
pub struct Bed {
    low: DVec2,
    step: DVec2,
    /// Places along x and z, at least 2.
    across: usize,
    /// Row by row of equal z \[m\].
    depths: Vec<f64>,
}

impl Bed {
    /// Of the rectangle between two corners of x and z, at `across` × `across` places from rim to rim (2 at least). `depth` says where the bottom
    /// lies below the level \[m\], none where there is no bottom.
    ///
    /// A place is as deep as the deepest of it and its eight neighbours: what stands in the water, no wider than two steps, is no bottom.
    pub fn new([low, high]: [DVec2; 2], across: usize, depth: impl Fn(DVec2) -> Option<f64>) -> Self {
        let across = across.max(2);
        let step = (high - low) / (across - 1) as f64;
        let place = |n: usize| low + step * DVec2::new((n % across) as f64, (n / across) as f64);
        let sound = |depth: f64| if depth.is_nan() { 0.0 } else { depth.clamp(0.0, ENDLESS) };
        let met: Vec<f64> = (0..across * across).map(|n| sound(depth(place(n)).unwrap_or(ENDLESS))).collect();
        let about = |n: usize| n.saturating_sub(1)..(n + 2).min(across);
        let deepest = |n: usize| {
            let rows = about(n / across).flat_map(|j| about(n % across).map(move |i| j * across + i));
            rows.map(|n| met[n]).fold(0.0, f64::max)
        };
        Self { low, step, across, depths: (0..across * across).map(deepest).collect() }
    }

    /// How deep the water is at x, z \[m\]: linear between places, and beyond the rim as at the rim.
    pub fn depth(&self, at: DVec2) -> f64 {
        let most = (self.across - 1) as f64;
        let on = ((at - self.low) / self.step).map(|u| if u.is_nan() { 0.0 } else { u.clamp(0.0, most) });
        let [i, j] = [on.x, on.y].map(|u| (u as usize).min(self.across - 2));
        let row = |j: usize| {
            let [a, b] = [0, 1].map(|k| self.depths[j * self.across + i + k]);
            a + (b - a) * (on.x - i as f64)
        };
        let (near, far) = (row(j), row(j + 1));
        near + (far - near) * (on.y - j as f64)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn it_is_never_shallower_than_its_places_nor_deeper_than_the_deepest(
            depths in prop::collection::vec(0.0..9.0f64, 25), x in -1.0..5.0f64, z in -1.0..5.0f64,
        ) {
            let bed = Bed::new([DVec2::ZERO, DVec2::splat(4.0)], 5, |at| Some(depths[(at.y * 5.0 + at.x) as usize]));
            let here = bed.depth(DVec2::new(x, z));
            let place = DVec2::new(x, z).clamp(DVec2::ZERO, DVec2::splat(4.0)).round();
            prop_assert!(here >= depths[(place.y * 5.0 + place.x) as usize] - 1e-12);
            prop_assert!(here <= depths.iter().copied().fold(0.0, f64::max) + 1e-12);
            // Between places 1 m apart no steeper than their depths differ, along either axis.
            prop_assert!((bed.depth(DVec2::new(x + 1e-6, z - 1e-6)) - here).abs() < 9.0 * 2.001e-6);
        }
    }

    #[test]
    fn a_post_is_no_bottom_and_no_bottom_is_deep() {
        let post = |at: DVec2| Some(if at.distance(DVec2::splat(5.0)) < 0.9 { 0.2 } else { 3.0 });
        let bed = Bed::new([DVec2::ZERO, DVec2::splat(10.0)], 11, post);
        assert_eq!(bed.depth(DVec2::splat(5.0)), 3.0);
        let none = Bed::new([DVec2::ZERO, DVec2::ONE], 33, |_| None);
        assert_eq!(none.depth(DVec2::splat(0.3)), ENDLESS);
        // A surface without an extent.
        assert_eq!(Bed::new([DVec2::ONE, DVec2::ONE], 3, |_| Some(2.0)).depth(DVec2::ONE), 2.0);
    }
}
