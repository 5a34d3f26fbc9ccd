//! A hierarchy of boxes.

use glam::{DAffine3, DVec3};

/// A box in any frame: lower and upper corner \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Bounds {
    const NOTHING: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// Of points; never too small, even where these come out of a transformation once more with other rounding.
    pub(crate) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let exact =
            points.into_iter().fold(Self::NOTHING, |b, p| Self { low: b.low.min(p), high: b.high.max(p) });
        let margin = 8.0 * f64::EPSILON * exact.low.abs().max(exact.high.abs());
        Self { low: exact.low - margin, high: exact.high + margin }
    }

    fn with(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Square of the distance from the origin; 0 inside.
    pub(crate) fn distance_squared(&self) -> f64 {
        self.low.max(-self.high).max(DVec3::ZERO).length_squared()
    }

    /// True where every coordinate is a finite number.
    pub(crate) fn is_finite(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }
}

/// A box that stands anyhow: its middle and its half axes \[m\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Oriented {
    pub(crate) middle: DVec3,
    pub(crate) axes: [DVec3; 3],
}

impl Oriented {
    /// `bounds` as `to` brings them there.
    pub(crate) fn brought(bounds: &Bounds, to: &DAffine3) -> Self {
        let half = 0.5 * (bounds.high - bounds.low);
        let m = to.matrix3;
        Self {
            middle: to.transform_point3(0.5 * (bounds.low + bounds.high)),
            axes: [m.x_axis * half.x, m.y_axis * half.y, m.z_axis * half.z],
        }
    }

    /// The box along the frame's axes around it.
    pub(crate) fn bounds(&self) -> Bounds {
        let reach = self.axes.iter().map(|axis| axis.abs()).sum::<DVec3>();
        Bounds { low: self.middle - reach, high: self.middle + reach }
    }

    /// The largest value of `along` · p over its points p.
    pub(crate) fn most(&self, along: DVec3) -> f64 {
        along.dot(self.middle) + self.axes.iter().map(|axis| along.dot(*axis).abs()).sum::<f64>()
    }

    pub(crate) fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let side = |k: usize| if i >> k & 1 == 0 { -self.axes[k] } else { self.axes[k] };
            self.middle + side(0) + side(1) + side(2)
        })
    }
}

/// A node: a leaf with `count` items from `first`, or with `count` = 0 an inner node whose children are the
/// next node and the node `first`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) bounds: Bounds,
    pub(crate) first: u32,
    pub(crate) count: u32,
}

/// Boxes split at the median of their middles along the widest axis.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    /// Numbers of the boxes, leaf by leaf.
    pub(crate) items: Vec<u32>,
}

impl Tree {
    /// Leaves hold `leaf` items at most. Boxes that are not finite are left out.
    pub(crate) fn new(boxes: &[Bounds], leaf: usize) -> Self {
        let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
        items.retain(|&item| boxes[item as usize].is_finite());
        let mut nodes = Vec::new();
        if !items.is_empty() {
            split(&mut nodes, boxes, &mut items, 0, leaf);
        }
        Self { nodes, items }
    }
}

/// Appends the node of `items`, which lie from `first` on, and what is below it.
fn split(nodes: &mut Vec<Node>, boxes: &[Bounds], items: &mut [u32], first: usize, leaf: usize) {
    let of = |item: u32| boxes[item as usize];
    let bounds = items.iter().fold(Bounds::NOTHING, |b, &item| b.with(of(item)));
    let node = nodes.len();
    nodes.push(Node { bounds, first: first as u32, count: items.len() as u32 });
    if items.len() <= leaf {
        return;
    }
    let middle = |item: u32| of(item).low + of(item).high;
    let middles = Bounds::around(items.iter().map(|&item| middle(item)));
    let axis = (middles.high - middles.low).max_position();
    let half = items.len() / 2;
    // Equal middles in the order of their numbers: the tree is the same wherever it is built.
    items.select_nth_unstable_by(half, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b)));
    let (left, right) = items.split_at_mut(half);
    split(nodes, boxes, left, first, leaf);
    (nodes[node].first, nodes[node].count) = (nodes.len() as u32, 0);
    split(nodes, boxes, right, first + half, leaf);
}
