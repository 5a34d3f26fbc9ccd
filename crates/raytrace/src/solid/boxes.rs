//! Boxes around bodies, and a hierarchy of them (thesis 2.2, 2c).

use glam::DVec3;

/// A box whose faces are square to the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Bounds {
    pub(crate) const EMPTY: Self =
        Self { low: DVec3::splat(f64::INFINITY), high: DVec3::splat(f64::NEG_INFINITY) };

    pub(crate) fn around(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |b, &p| Self { low: b.low.min(p), high: b.high.max(p) })
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Nothing in common when `low` > `high` on an axis.
    pub(crate) fn common(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// Larger by a share of its coordinates that covers the rounding of whatever made it.
    pub(crate) fn padded(self) -> Self {
        let by = DVec3::splat(1e-12 * self.low.abs().max(self.high.abs()).max_element());
        Self { low: self.low - by, high: self.high + by }
    }

    pub(crate) fn is_empty(&self) -> bool {
        !self.low.cmple(self.high).all()
    }

    fn centre(&self) -> DVec3 {
        (self.low + self.high) * 0.5
    }

    /// Where the line enters, if it meets the box between 0 and `reach`.
    fn enters(&self, origin: DVec3, inverse: DVec3, reach: f64) -> Option<f64> {
        let (a, b) = ((self.low - origin) * inverse, (self.high - origin) * inverse);
        let (near, far) = (a.min(b).max_element().max(0.0), a.max(b).min_element().min(reach));
        // A slab costs three roundings either way.
        (near <= far * (1.0 + 8.0 * f64::EPSILON)).then_some(near)
    }
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// Inner: index of the second child, the first follows. Leaf: index of the body.
    next: u32,
    leaf: bool,
}

/// Bodies in boxes, two by two.
#[derive(Clone, Debug)]
pub(crate) struct Boxes {
    nodes: Vec<Node>,
}

impl Boxes {
    pub(crate) fn new(bounds: &[Bounds]) -> Self {
        let mut order: Vec<u32> = (0..).zip(bounds).filter(|(_, b)| !b.is_empty()).map(|(i, _)| i).collect();
        let mut nodes = Vec::with_capacity(2 * order.len());
        if !order.is_empty() {
            split(bounds, &mut order, &mut nodes);
        }
        Self { nodes }
    }

    /// Visits bodies whose box the line meets between 0 and what `visit` returns: how far is still of interest.
    pub(crate) fn along(
        &self,
        (origin, direction): (DVec3, DVec3),
        mut reach: f64,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        // Never infinite: 0 · ∞ is not a number.
        let inverse = direction.recip().clamp(DVec3::splat(-1e300), DVec3::splat(1e300));
        let mut stack = [(0u32, 0.0); 64];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let (index, near) = stack[height];
            if near > reach {
                continue;
            }
            let node = self.nodes[index as usize];
            if node.leaf {
                reach = visit(node.next, reach);
                continue;
            }
            let enters = |child: u32| {
                self.nodes[child as usize].bounds.enters(origin, inverse, reach).map(|near| (child, near))
            };
            let mut children = [enters(index + 1), enters(node.next)];
            // The nearer one on top of the stack.
            if let [Some(a), Some(b)] = children
                && a.1 < b.1
            {
                children.swap(0, 1);
            }
            for child in children.into_iter().flatten() {
                stack[height] = child;
                height += 1;
            }
        }
    }

    /// Visits bodies whose box has something in common with `region`.
    pub(crate) fn within(&self, region: Bounds, mut visit: impl FnMut(u32)) {
        let mut index = 0;
        let mut stack = Vec::new();
        loop {
            let Some(node) = self.nodes.get(index as usize) else { return };
            if !node.bounds.common(region).is_empty() {
                if !node.leaf {
                    stack.push(node.next);
                    index += 1;
                    continue;
                }
                visit(node.next);
            }
            let Some(next) = stack.pop() else { return };
            index = next;
        }
    }
}

/// Splits at the median of the longest axis: depth ≤ ⌈log₂ n⌉, so that 64 entries of stack are plenty.
fn split(bounds: &[Bounds], order: &mut [u32], nodes: &mut Vec<Node>) {
    let around = order.iter().fold(Bounds::EMPTY, |all, &i| all.union(bounds[i as usize]));
    let here = nodes.len();
    nodes.push(Node { bounds: around, next: order[0], leaf: true });
    if order.len() == 1 {
        return;
    }
    let centres: Vec<DVec3> = order.iter().map(|&i| bounds[i as usize].centre()).collect();
    let extent = Bounds::around(&centres);
    let axis = (extent.high - extent.low).max_position();
    let middle = order.len() / 2;
    let key = |&i: &u32| bounds[i as usize].centre()[axis];
    order.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
    let (first, second) = order.split_at_mut(middle);
    split(bounds, first, nodes);
    nodes[here] = Node { bounds: around, next: nodes.len() as u32, leaf: false };
    split(bounds, second, nodes);
}
