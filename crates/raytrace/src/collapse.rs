//! From two children a node to eight, at the least expected cost.
//!
//! Which subtrees become leaves and which binary nodes vanish is decided together, by dynamic programming
//! from the leaves up (the scheme of Ylitie, Karras and Laine 2017, §4.1): with A(n) half the surface of
//! n's box, C(n, j) the least cost of n's subtree as at most j children of some wide node, and l, r its halves,
//!
//! > C(n, 1) = min(A(n) c_leaf if n has few enough primitives,  A(n) c_node + D(n, 8))
//! > C(n, j) = min(C(n, j−1), D(n, j)),   D(n, j) = min_k C(l, k) + C(r, j−k)

use crate::binary::{Kind, Node};

/// Children of a wide node.
pub(crate) const WIDTH: usize = 8;

/// Cost of one leaf in units of one node: nine loads and three edge functions against six loads and the
/// sorting of children.
const LEAF_COST: f32 = 1.0;

/// What stands in one slot of a wide node.
pub(crate) enum Child {
    /// A further wide node, made of this binary node.
    Inner(u32),
    /// A leaf with everything below this binary node.
    Leaf(u32),
}

/// The decisions of one hierarchy.
pub(crate) struct Plan<'a> {
    nodes: &'a [Node],
    /// C(n, 1..=7).
    costs: Vec<[f32; WIDTH - 1]>,
    leaf: Vec<bool>,
}

impl<'a> Plan<'a> {
    /// Decides; a leaf holds at most `most` primitives.
    pub(crate) fn new(nodes: &'a [Node], most: u32) -> Self {
        let mut plan =
            Self { nodes, costs: vec![[0.0; WIDTH - 1]; nodes.len()], leaf: vec![false; nodes.len()] };
        let mut counts = vec![1u32; nodes.len()];
        // Parents stand before children: from the back, children are ready first.
        for (n, node) in nodes.iter().enumerate().rev() {
            let area = node.bounds.half_area();
            let Kind::Inner([l, r]) = node.kind else {
                plan.leaf[n] = true;
                plan.costs[n] = [area * LEAF_COST; WIDTH - 1];
                continue;
            };
            counts[n] = counts[l as usize] + counts[r as usize];
            let inner = area + plan.distribute([l, r], WIDTH).0;
            let as_leaf = if counts[n] <= most { area * LEAF_COST } else { f32::INFINITY };
            plan.leaf[n] = as_leaf <= inner;
            plan.costs[n][0] = as_leaf.min(inner);
            for j in 2..WIDTH {
                plan.costs[n][j - 1] = plan.costs[n][j - 2].min(plan.distribute([l, r], j).0);
            }
        }
        plan
    }

    /// D(n, slots) for the halves of n, and the slots of the first half.
    fn distribute(&self, [l, r]: [u32; 2], slots: usize) -> (f32, usize) {
        let (left, right) = (&self.costs[l as usize], &self.costs[r as usize]);
        (1..slots).fold((f32::INFINITY, 1), |best, k| {
            let cost = left[k - 1] + right[slots - k - 1];
            if cost < best.0 { (cost, k) } else { best }
        })
    }

    /// What the root becomes.
    pub(crate) fn root(&self) -> Child {
        self.child(0)
    }

    fn child(&self, n: u32) -> Child {
        if self.leaf[n as usize] { Child::Leaf(n) } else { Child::Inner(n) }
    }

    /// The slots of the wide node made of binary node `n`, which is no leaf: 2 to 8 of them.
    pub(crate) fn children(&self, n: u32) -> Vec<Child> {
        let mut found = Vec::with_capacity(WIDTH);
        if let Kind::Inner(halves) = self.nodes[n as usize].kind {
            self.split(halves, WIDTH, &mut found);
        }
        found
    }

    fn split(&self, halves: [u32; 2], slots: usize, found: &mut Vec<Child>) {
        let (_, first) = self.distribute(halves, slots);
        self.gather(halves[0], first, found);
        self.gather(halves[1], slots - first, found);
    }

    /// At most seven levels deep: every level has fewer slots.
    fn gather(&self, n: u32, slots: usize, found: &mut Vec<Child>) {
        let costs = &self.costs[n as usize];
        // The fewest slots that reach the same cost.
        let slots = (1..=slots).find(|&j| costs[j - 1] == costs[slots - 1]).unwrap_or(1);
        match self.nodes[n as usize].kind {
            Kind::Inner(halves) if slots > 1 => self.split(halves, slots, found),
            _ => found.push(self.child(n)),
        }
    }

    /// Primitives below binary node `n`.
    pub(crate) fn primitives(&self, n: u32) -> Vec<u32> {
        let mut found = Vec::with_capacity(WIDTH);
        let mut open = vec![n];
        while let Some(n) = open.pop() {
            match self.nodes[n as usize].kind {
                Kind::Leaf(primitive) => found.push(primitive),
                Kind::Inner([l, r]) => open.extend([r, l]),
            }
        }
        found
    }
}
