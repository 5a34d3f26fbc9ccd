//! From the root to the leaves, nearest child first.

#![allow(unsafe_code, reason = "entering the AVX2 build of the walk; the gain is stated above `walk`")]

use light::rounding::gamma;

use crate::{
    collapse::WIDTH,
    lanes::{Lanes, Plain},
    shot::Shot,
    tree::{DEEPEST, LEAF, Node, Tree},
};

/// Places on the stack: every level leaves at most seven siblings behind.
const STACK: usize = (WIDTH - 1) * DEEPEST + 1;

/// Looks into leaves.
pub(crate) trait Visit {
    /// Looks into one leaf. `reach` is how far along the ray anything is still of interest; it may be
    /// lowered. True ends the walk.
    fn leaf<L: Lanes>(&mut self, leaf: u32, reach: &mut f32) -> bool;
}

/// Whether this machine has AVX2.
#[cfg(target_arch = "x86_64")]
pub(crate) fn wide() -> bool {
    std::arch::is_x86_feature_detected!("avx2")
}

/// Visits the leaves that `shot` meets between `floor` and `reach`; true when a visit ended it.
///
/// Builds of the same code for AVX2 and for plain SSE2, chosen by the machine.
pub(crate) fn walk<V: Visit>(tree: &Tree, shot: &Shot, floor: f32, reach: f32, visit: &mut V) -> bool {
    #[cfg(target_arch = "x86_64")]
    if wide() {
        // SAFETY: the feature was just detected.
        return unsafe { walk_avx2(tree, shot, floor, reach, visit) };
    }
    walk_with::<Plain, V>(tree, shot, floor, reach, visit)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walk_avx2<V: Visit>(tree: &Tree, shot: &Shot, floor: f32, reach: f32, visit: &mut V) -> bool {
    walk_with::<crate::lanes::Avx2, V>(tree, shot, floor, reach, visit)
}

/// The slabs of eight boxes, ready for one ray.
struct Slabs<L> {
    inverse: [L; 3],
    origin_in: [L; 3],
    origin_out: [L; 3],
    floor: L,
    /// 1 + 2 γ₃: each distance to a plane is a subtraction, a reciprocal and a product away from the exact
    /// one (Ize 2013), at both ends.
    slack: L,
}

impl<L: Lanes> Slabs<L> {
    #[inline(always)]
    fn new(shot: &Shot, floor: f32) -> Self {
        Self {
            inverse: shot.inverse.map(L::splat),
            origin_in: shot.origin_in.map(L::splat),
            origin_out: shot.origin_out.map(L::splat),
            floor: L::splat(floor),
            slack: L::splat(1.0 + 2.0 * gamma(3)),
        }
    }

    /// One bit for each box that is met, and where the ray enters each.
    #[inline(always)]
    fn meet(&self, node: &Node, near: &[usize; 3], reach: f32) -> (u32, L) {
        let enter =
            |axis: usize| L::load(&node.planes[near[axis]]).sub(self.origin_in[axis]).mul(self.inverse[axis]);
        let leave = |axis: usize| {
            L::load(&node.planes[near[axis] ^ 1]).sub(self.origin_out[axis]).mul(self.inverse[axis])
        };
        let into = enter(0).max(enter(1)).max(enter(2).max(self.floor));
        let out = leave(0).min(leave(1)).min(leave(2)).mul(self.slack).min(L::splat(reach));
        (into.le(out), into)
    }
}

#[inline(always)]
fn walk_with<L: Lanes, V: Visit>(tree: &Tree, shot: &Shot, floor: f32, reach: f32, visit: &mut V) -> bool {
    let Some(mut current) = tree.root else { return false };
    let slabs = Slabs::<L>::new(shot, floor);
    let mut reach = reach;
    let mut stack = [(0u32, 0f32); STACK];
    let mut height = 0usize;
    loop {
        if current & LEAF != 0 {
            if visit.leaf::<L>(current & !LEAF, &mut reach) {
                return true;
            }
        } else {
            let node = &tree.nodes[current as usize];
            let (mut mask, into) = slabs.meet(node, &shot.near, reach);
            if mask != 0 {
                let into = into.store();
                let bottom = height;
                while mask != 0 {
                    let slot = mask.trailing_zeros() as usize;
                    mask &= mask - 1;
                    // Farthest at the bottom, nearest on top.
                    let mut at = height;
                    while at > bottom && stack[at - 1].1 < into[slot] {
                        stack[at] = stack[at - 1];
                        at -= 1;
                    }
                    stack[at] = (node.children[slot], into[slot]);
                    height += 1;
                }
            }
        }
        loop {
            if height == 0 {
                return false;
            }
            height -= 1;
            if stack[height].1 <= reach {
                current = stack[height].0;
                break;
            }
        }
    }
}
