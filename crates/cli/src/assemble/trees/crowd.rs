//! Trees that stand in each other: rays would cross all of them one by one, and one would see the highest.

use std::cmp::Ordering;
use std::collections::HashMap;

use rayon::prelude::*;
use trees::Placed;

/// Feet nearer to that of a higher tree of the species than this share of its height \[–\] belong to the same tree: half of what
/// a trunk is thick at most, so that no two trees that can be told apart are one.
pub(super) const WITHIN: f32 = 0.02;

/// Width of a cell of the grid over the distance within which trees are one: wide enough that most lie in one cell only, narrow
/// enough that few of those that are kept share one.
const CELL: f32 = 4.0;

/// Leaves one tree of those whose feet lie within [`WITHIN`] of the height of a higher one of their species that stays, and says
/// how many went. Which ones stay does not depend on their order.
pub(super) fn thin_out(placed: &mut Vec<Placed>) -> usize {
    placed.par_sort_unstable_by(first);
    let mut levels: Vec<(u32, i32)> = placed.par_iter().map(|tree| (tree.species, level(tree))).collect();
    levels.par_sort_unstable();
    levels.dedup();
    let mut kept = Kept { cells: HashMap::with_capacity(placed.len()), next: Vec::new(), levels };
    let before = placed.len();
    let mut count = 0;
    for i in 0..before {
        let tree = placed[i];
        if !kept.holds(&placed[..count], &tree) {
            kept.add(&tree);
            placed[count] = tree;
            count += 1;
        }
    }
    placed.truncate(count);
    before - count
}

/// Higher ones first; the rest only so that the order is always the same.
fn first(a: &Placed, b: &Placed) -> Ordering {
    let rest =
        |tree: &Placed| (tree.species, tree.position.to_array().map(f32::to_bits), tree.rotation.to_bits());
    b.height.total_cmp(&a.height).then_with(|| rest(a).cmp(&rest(b)))
}

/// Heights of a level differ by less than a factor of two.
fn level(tree: &Placed) -> i32 {
    tree.height.log2().floor() as i32
}

/// Trees that stay, in a grid for each species and level.
struct Kept {
    /// The last one in each cell.
    cells: HashMap<(u32, i32, [i64; 3]), u32>,
    /// The one before it in its cell.
    next: Vec<Option<u32>>,
    /// Species and level of all trees, rising.
    levels: Vec<(u32, i32)>,
}

impl Kept {
    /// Whether one of those that stay (`placed`, higher ones all) is the same tree.
    fn holds(&self, placed: &[Placed], tree: &Placed) -> bool {
        let from = self.levels.partition_point(|known| *known < (tree.species, level(tree)));
        let of_species = self.levels[from..].iter().take_while(|(species, _)| *species == tree.species);
        of_species.into_iter().any(|&(species, level)| {
            let reach = reach(level);
            let at = tree.position.to_array().map(f64::from);
            let [low, high] = [-reach, reach].map(|by| at.map(|x| cell(x + by, level)));
            let x = low[0]..=high[0];
            x.into_iter().any(|x| {
                (low[1]..=high[1]).any(|y| {
                    (low[2]..=high[2]).any(|z| {
                        let last = self.cells.get(&(species, level, [x, y, z])).copied();
                        std::iter::successors(last, |i| self.next[*i as usize])
                            .any(|i| is_same(&placed[i as usize], tree))
                    })
                })
            })
        })
    }

    fn add(&mut self, tree: &Placed) {
        let level = level(tree);
        let at = tree.position.to_array().map(|x| cell(f64::from(x), level));
        let number = self.next.len() as u32;
        self.next.push(self.cells.insert((tree.species, level, at), number));
    }
}

/// The farthest that any tree of a level takes others in \[m\].
fn reach(level: i32) -> f64 {
    f64::from(WITHIN) * 2f64.powi(level + 1)
}

fn cell(x: f64, level: i32) -> i64 {
    (x / (f64::from(CELL) * reach(level))).floor() as i64
}

fn is_same(kept: &Placed, tree: &Placed) -> bool {
    let within = WITHIN * kept.height;
    kept.position.distance_squared(tree.position) <= within * within
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use light::sampling::lattice;

    use super::*;

    fn tree(species: u32, position: Vec3, height: f32) -> Placed {
        Placed { species, position, height, rotation: 0.0 }
    }

    /// Trees at `places`, all heights between 8 and 16 m.
    fn strewn(count: u32, place: impl Fn([f32; 2]) -> Vec3) -> Vec<Placed> {
        let one = |i: u32| {
            let [u, v] = lattice(i, count, [0; 2]);
            let [h, _] = lattice(i, count, [77, 1 << 31]);
            tree(i % 2, place([u, v]), 8.0 + 8.0 * h)
        };
        (0..count).map(one).collect()
    }

    /// The same by comparing each with all.
    fn slowly(mut placed: Vec<Placed>) -> Vec<Placed> {
        placed.sort_by(first);
        let mut kept: Vec<Placed> = Vec::new();
        for tree in placed {
            let same = |other: &&Placed| other.species == tree.species && is_same(other, &tree);
            if !kept.iter().any(|other| same(&other)) {
                kept.push(tree);
            }
        }
        kept
    }

    #[test]
    fn a_million_within_a_centimetre_are_one_of_each_species() {
        let mut placed = strewn(1_000_000, |[u, v]| Vec3::new(0.01 * u, 0.0, 0.01 * v));
        let highest = placed.iter().fold(0.0, |highest: f32, tree| highest.max(tree.height));
        assert_eq!(thin_out(&mut placed), 999_998);
        assert_eq!((placed.len(), placed[0].height), (2, highest));
    }

    #[test]
    fn a_forest_keeps_all() {
        // 2000 within 200 m: a lattice of so many keeps them metres apart.
        let mut placed = strewn(2000, |[u, v]| Vec3::new(200.0 * u, 5.0 * v, 200.0 * v));
        assert_eq!((thin_out(&mut placed), placed.len()), (0, 2000));
    }

    #[test]
    fn the_grid_finds_what_comparing_all_finds_in_any_order() {
        for wide in [1.0, 4.0, 12.0] {
            let trees = strewn(3000, |[u, v]| Vec3::new(wide * (u - 0.5), 0.1 * (u - v), wide * (v - 0.5)));
            let expected = slowly(trees.clone());
            assert!(expected.len() > 10 && expected.len() < 3000);
            let (mut forth, mut back) = (trees.clone(), trees.into_iter().rev().collect::<Vec<_>>());
            assert_eq!(thin_out(&mut forth), 3000 - expected.len());
            thin_out(&mut back);
            assert_eq!(forth, expected);
            assert_eq!(back, expected);
        }
    }

    #[test]
    fn a_low_tree_at_the_foot_of_a_high_one_goes_and_one_beside_it_stays() {
        let at = |x: f32, height: f32| tree(0, Vec3::X * x, height);
        // 2 % of 20 m are 0.4 m; of 1 m they are 0.02 m.
        let mut placed = vec![at(0.39, 1.0), at(0.0, 20.0), at(0.41, 1.0), at(0.44, 0.5)];
        assert_eq!(thin_out(&mut placed), 1);
        assert_eq!(placed, [at(0.0, 20.0), at(0.41, 1.0), at(0.44, 0.5)]);
    }
}
