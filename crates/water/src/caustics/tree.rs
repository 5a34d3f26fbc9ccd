//! Which cells' beams can meet a receiver: bounds over squares of cells, and of squares of those.

use glam::{DVec2, DVec3};

use super::grid::Grid;

/// Cells across a leaf.
pub(super) const LEAF: usize = 4;

/// Bounds of what the rays of some corners have: height and lean (sideways run per drop, along x and z).
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: [f32; 3],
    high: [f32; 3],
}

/// Of no rays.
const NONE: Bounds = Bounds { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

impl Bounds {
    fn add(&mut self, other: &Self) {
        for k in 0..3 {
            self.low[k] = self.low[k].min(other.low[k]);
            self.high[k] = self.high[k].max(other.high[k]);
        }
    }
}

/// A quadtree over the cells of a grid.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// From the leaves up to one: nodes along x, and nodes.
    levels: Vec<(usize, Vec<Bounds>)>,
}

/// Where light goes that a tree is asked about.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    /// The middle of the receiving square.
    pub(super) at: DVec3,
    /// Half of its side \[m\].
    pub(super) half: f64,
    /// Height of the surface at rest \[m\].
    pub(super) level: f64,
    /// 1 when beams go down, −1 when they go up.
    pub(super) down: f64,
}

impl Tree {
    /// Over the rays (height, lean) of a grid's corners; cells that are not `lit` do not count.
    pub(super) fn new(
        grid: &Grid,
        ray: impl Fn(usize) -> [f32; 3],
        lit: impl Fn([usize; 2]) -> bool,
    ) -> Self {
        let mut counts = grid.cells.map(|n| n.div_ceil(LEAF));
        let mut leaves = Vec::with_capacity(counts[0] * counts[1]);
        for j in 0..counts[1] {
            for i in 0..counts[0] {
                let mut bounds = NONE;
                for cell in cells(grid, [i, j]).filter(|cell| lit(*cell)) {
                    let [x, z] = cell;
                    for corner in [[x, z], [x + 1, z], [x, z + 1], [x + 1, z + 1]] {
                        let ray = ray(grid.index(corner));
                        bounds.add(&Bounds { low: ray, high: ray });
                    }
                }
                leaves.push(bounds);
            }
        }
        let mut levels = vec![(counts[0], leaves)];
        while counts != [1, 1] {
            let below = counts;
            counts = counts.map(|n| n.div_ceil(2));
            let mut nodes = vec![NONE; counts[0] * counts[1]];
            if let Some((_, children)) = levels.last() {
                for (n, child) in children.iter().enumerate() {
                    nodes[n / below[0] / 2 * counts[0] + n % below[0] / 2].add(child);
                }
            }
            levels.push((counts[0], nodes));
        }
        Self { levels }
    }

    /// Calls `visit` with each leaf whose beams may meet the target, always in the same order.
    pub(super) fn visit(&self, grid: &Grid, target: &Target, visit: &mut dyn FnMut([usize; 2])) {
        self.descend(grid, target, self.levels.len() - 1, [0, 0], visit);
    }

    fn descend(
        &self,
        grid: &Grid,
        target: &Target,
        level: usize,
        node: [usize; 2],
        visit: &mut dyn FnMut([usize; 2]),
    ) {
        let (across, nodes) = &self.levels[level];
        let [i, j] = node;
        if i >= *across {
            return;
        }
        let Some(bounds) = nodes.get(j * across + i) else { return };
        if !meets(grid, target, bounds, LEAF << level, node) {
            return;
        }
        if level == 0 {
            return visit(node);
        }
        for child in [[2 * i, 2 * j], [2 * i + 1, 2 * j], [2 * i, 2 * j + 1], [2 * i + 1, 2 * j + 1]] {
            self.descend(grid, target, level - 1, child, visit);
        }
    }
}

/// The cells of a leaf.
pub(super) fn cells(grid: &Grid, leaf: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
    let [first_x, first_z] = leaf.map(|n| n * LEAF);
    let [end_x, end_z] = [0, 1].map(|k| ((leaf[k] + 1) * LEAF).min(grid.cells[k]));
    (first_z..end_z).flat_map(move |z| (first_x..end_x).map(move |x| [x, z]))
}

/// Whether rays within these bounds, from a square of `size` cells, can meet the target: each coordinate of where they meet its
/// plane is x + lean · drop, with the drop between 0 and what the heights allow.
fn meets(grid: &Grid, target: &Target, bounds: &Bounds, size: usize, node: [usize; 2]) -> bool {
    let heights = [bounds.low[0], bounds.high[0]].map(|height| target.level + f64::from(height));
    let drops = heights.map(|height| (height - target.at.y) * target.down);
    let (least, most) = (drops[0].min(drops[1]).max(0.0), drops[0].max(drops[1]));
    if most <= 0.0 || bounds.low[0] > bounds.high[0] {
        return false;
    }
    let last = [0, 1].map(|k| ((node[k] + 1) * size).min(grid.cells[k]));
    let (low, high) = (grid.at(node.map(|n| n * size)), grid.at(last));
    let lean = |bound: [f32; 3]| DVec2::new(f64::from(bound[1]), f64::from(bound[2]));
    let (left, right) = (lean(bounds.low), lean(bounds.high));
    let low = low + (left * least).min(left * most);
    let high = high + (right * least).max(right * most);
    // Sums of a few roundings of the farthest coordinate.
    let reach = target.half + 1e-12 * (low.abs().max_element() + high.abs().max_element());
    let at = DVec2::new(target.at.x, target.at.z);
    low.cmple(at + reach).all() && high.cmpge(at - reach).all()
}
