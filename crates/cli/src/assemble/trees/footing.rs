//! Trees that stand on the ground: what is below each, and whether it is dry.

use glam::{DVec2, DVec3, Vec3};
use light::{Nearest, Ray};
use rayon::prelude::*;
use scene::PlacedTree;
use water::flat::FlatWater;

/// Trees are let fall from this far above the highest thing \[m\].
pub(super) const ABOVE: f32 = 1.0;

/// What there is to stand on.
#[derive(Clone, Copy)]
pub(in crate::assemble) struct Ground<'a> {
    /// Everything but water surfaces.
    pub(in crate::assemble) dry: &'a dyn Nearest,
    /// Waters on it.
    pub(in crate::assemble) waters: &'a [FlatWater],
}

/// What the ground has made of trees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Footing {
    /// How many would stand in water and are left out, and where the first would.
    pub(super) drowned: (usize, Option<DVec3>),
    /// How many have nothing below or above them and stay at their own height, and where the first is.
    pub(super) floating: (usize, Option<DVec3>),
}

/// Where a tree's vertical ends.
enum Foot {
    On(Vec3),
    Under(Vec3),
    Nowhere(Vec3),
}

impl Ground<'_> {
    /// The trees that find a place, let fall from `top`.
    pub(super) fn stand(
        self,
        trees: &[PlacedTree],
        top: f32,
        footing: &mut Footing,
    ) -> Vec<(Vec3, PlacedTree)> {
        let feet: Vec<Foot> = trees.par_iter().map(|tree| self.foot(super::place(tree), top)).collect();
        let count = |(count, first): &mut (usize, Option<DVec3>), at: Vec3| {
            *count += 1;
            first.get_or_insert(at.as_dvec3());
        };
        let standing = feet.into_iter().zip(trees).filter_map(|(foot, tree)| match foot {
            Foot::On(at) => Some((at, *tree)),
            Foot::Nowhere(at) => {
                count(&mut footing.floating, at);
                Some((at, *tree))
            }
            Foot::Under(at) => {
                count(&mut footing.drowned, at);
                None
            }
        });
        standing.collect()
    }

    /// Where the vertical through a point first meets something from above.
    fn foot(self, at: Vec3, top: f32) -> Foot {
        let covers = |water: &FlatWater| water.covers(DVec2::new(f64::from(at.x), f64::from(at.z)));
        match self.dry.nearest(&Ray::new(at.with_y(top), Vec3::NEG_Y)) {
            Some(hit) => {
                let foot = at.with_y(hit.place.position.y);
                // A rounding above the bed of a puddle is no water.
                let under = |water: &FlatWater| {
                    water.depth(foot.as_dvec3()).is_some_and(|depth| depth > f64::from(hit.place.error))
                };
                if self.waters.iter().any(under) { Foot::Under(foot) } else { Foot::On(foot) }
            }
            // A sea without a bed.
            None if self.waters.iter().any(covers) => Foot::Under(at),
            None => Foot::Nowhere(at),
        }
    }
}

impl Footing {
    /// In words, with coordinates of the file, whose origin lies at −`origin`.
    pub(super) fn warnings(&self, origin: DVec3) -> impl Iterator<Item = String> {
        let say = |(count, first): (usize, Option<DVec3>), what: &str| {
            let at = first? + origin;
            Some(format!(
                "[[tree]] with ground = true: {count} {what}; the first at [{:.2}, {:.2}, {:.2}]",
                at.x, at.y, at.z
            ))
        };
        [
            say(self.drowned, "would stand in a [[water]] and are left out"),
            say(self.floating, "have nothing below or above them and stay at the height of their positions"),
        ]
        .into_iter()
        .flatten()
    }
}
