//! From the root to the leaves, nearest child first.
//!
//! `unsafe` here and in `lanes.rs` buys, on the terrain of `benches/rays.rs` (Mrays/s of one thread, one run,
//! primary/bounce/random/sun/sky): 6.1/2.9/1.7/3.7/3.2 with AVX2 against 4.3/2.1/1.3/2.3/2.2 with the same code for
//! SSE2; fetching children ahead is 7/5/4/0/1 % of that.

#![allow(unsafe_code, reason = "AVX2 entry, uninitialised stack, prefetch: measured above")]

use std::mem::MaybeUninit;

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
    /// Whether children are to be visited nearest first: costs a little order, saves what a lowered
    /// `reach` cuts off.
    const ORDERED: bool;

    /// Announces that a leaf may be visited soon.
    #[inline(always)]
    fn announce(&self, leaf: u32) {
        let _ = leaf;
    }

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
pub(crate) fn walk<V: Visit>(tree: &Tree, shot: &Shot, floor: f32, reach: &mut f32, visit: &mut V) -> bool {
    #[cfg(target_arch = "x86_64")]
    if wide() {
        // SAFETY: the feature was just detected.
        return unsafe { walk_avx2(tree, shot, floor, reach, visit) };
    }
    walk_with::<Plain, V>(tree, shot, floor, reach, visit)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn walk_avx2<V: Visit>(tree: &Tree, shot: &Shot, floor: f32, reach: &mut f32, visit: &mut V) -> bool {
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

#[inline(always)]
fn splat<L: Lanes>(of: [f32; 3]) -> [L; 3] {
    [L::splat(of[0]), L::splat(of[1]), L::splat(of[2])]
}

// No closures over lanes anywhere here: they would be compiled without AVX2.
impl<L: Lanes> Slabs<L> {
    #[inline(always)]
    fn new(shot: &Shot, floor: f32) -> Self {
        Self {
            inverse: splat(shot.inverse),
            origin_in: splat(shot.origin_in),
            origin_out: splat(shot.origin_out),
            floor: L::splat(floor),
            slack: L::splat(1.0 + 2.0 * gamma(3)),
        }
    }

    #[inline(always)]
    fn enter(&self, node: &Node, near: &[usize; 3], axis: usize) -> L {
        L::load(&node.planes[near[axis]]).sub(self.origin_in[axis]).mul(self.inverse[axis])
    }

    #[inline(always)]
    fn leave(&self, node: &Node, near: &[usize; 3], axis: usize) -> L {
        L::load(&node.planes[near[axis] ^ 1]).sub(self.origin_out[axis]).mul(self.inverse[axis])
    }

    /// One bit for each box that is met, and where the ray enters each.
    #[inline(always)]
    fn meet(&self, node: &Node, near: &[usize; 3], reach: f32) -> (u32, L) {
        let into = self.enter(node, near, 0).max(self.enter(node, near, 1));
        let into = into.max(self.enter(node, near, 2).max(self.floor));
        let out = self.leave(node, near, 0).min(self.leave(node, near, 1)).min(self.leave(node, near, 2));
        let out = out.mul(self.slack).min(L::splat(reach));
        (into.le(out), into)
    }
}

/// Nodes that wait for their turn, and where the ray enters them.
///
/// Uninitialised: 3.6 kB would else be written for each ray.
struct Stack {
    slots: [MaybeUninit<(u32, f32)>; STACK],
    height: usize,
}

impl Stack {
    #[inline(always)]
    fn push(&mut self, child: u32, into: f32) {
        // SAFETY: no tree is deeper than DEEPEST, every level leaves at most WIDTH − 1 waiting, and STACK
        // holds as many: `Tree::build` makes no other.
        debug_assert!(self.height < STACK);
        unsafe { self.slots.get_unchecked_mut(self.height) }.write((child, into));
        self.height += 1;
    }

    #[inline(always)]
    fn at(&mut self, at: usize) -> &mut (u32, f32) {
        debug_assert!(at < self.height);
        // SAFETY: everything below `height` has been pushed, callers stay below it.
        unsafe { self.slots.get_unchecked_mut(at).assume_init_mut() }
    }

    /// The next one that the ray enters no later than `reach`.
    #[inline(always)]
    fn pop(&mut self, reach: f32) -> Option<u32> {
        while self.height > 0 {
            let (child, into) = *self.at(self.height - 1);
            self.height -= 1;
            if into <= reach {
                return Some(child);
            }
        }
        None
    }

    /// Nearest on top, among the at most eight that stand above `bottom`.
    #[inline(always)]
    fn sort(&mut self, bottom: usize) {
        for fresh in bottom + 1..self.height {
            let mut at = fresh;
            while at > bottom && self.at(at - 1).1 < self.at(at).1 {
                let (low, high) = (*self.at(at - 1), *self.at(at));
                (*self.at(at - 1), *self.at(at)) = (high, low);
                at -= 1;
            }
        }
    }
}

/// Fetches the first lines of a child from memory before its turn comes.
#[inline(always)]
fn announce<V: Visit>(tree: &Tree, child: u32, visit: &V) {
    if child & LEAF != 0 {
        visit.announce(child & !LEAF);
    } else {
        fetch(&tree.nodes, child);
    }
}

/// Asks for all cache lines of `items[index]`, which need not exist.
#[inline(always)]
pub(crate) fn fetch<T>(items: &[T], index: u32) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let start = items.as_ptr().wrapping_add(index as usize).cast::<i8>();
        for line in (0..size_of::<T>()).step_by(64) {
            // SAFETY: a prefetch has no effect on memory and never faults.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (items, index);
}

#[inline(always)]
fn walk_with<L: Lanes, V: Visit>(
    tree: &Tree,
    shot: &Shot,
    floor: f32,
    reach: &mut f32,
    visit: &mut V,
) -> bool {
    let Some(mut current) = tree.root else { return false };
    let slabs = Slabs::<L>::new(shot, floor);
    let mut stack = Stack { slots: [const { MaybeUninit::uninit() }; STACK], height: 0 };
    loop {
        if current & LEAF != 0 {
            if visit.leaf::<L>(current & !LEAF, reach) {
                return true;
            }
        } else {
            let node = &tree.nodes[current as usize];
            let (mut mask, into) = slabs.meet(node, &shot.near, *reach);
            if mask != 0 {
                let into = into.store();
                let slot = mask.trailing_zeros() as usize & (WIDTH - 1);
                mask &= mask - 1;
                if mask == 0 {
                    current = node.children[slot];
                    continue;
                }
                let bottom = stack.height;
                stack.push(node.children[slot], into[slot]);
                while mask != 0 {
                    let slot = mask.trailing_zeros() as usize & (WIDTH - 1);
                    mask &= mask - 1;
                    announce(tree, node.children[slot], visit);
                    stack.push(node.children[slot], into[slot]);
                }
                if V::ORDERED {
                    stack.sort(bottom);
                }
            }
        }
        match stack.pop(*reach) {
            Some(child) => current = child,
            None => return false,
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::{
        Quality,
        tree::{Faces, Name},
        triangle::candidates,
    };

    /// Writes down which leaves are visited, and which lanes of them are candidates.
    struct Log<'a>(&'a Faces, &'a Shot, Vec<(u32, u32, u32)>);

    impl Visit for Log<'_> {
        const ORDERED: bool = true;

        fn leaf<L: Lanes>(&mut self, leaf: u32, _: &mut f32) -> bool {
            let (inside, zeros) = candidates::<L, true>(&self.0.packets[leaf as usize], self.1);
            self.2.push((leaf, inside, zeros));
            false
        }
    }

    /// The promise that a picture does not depend on the machine: same leaves, same order, same lanes.
    #[test]
    fn plain_and_avx2_walks_are_the_same() {
        let mut seed = 1u32;
        let mut next = || {
            seed = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (seed >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        let mut point = |size: f32| Vec3::new(next(), next(), next()) * size;
        let corners: Vec<[Vec3; 3]> = (0..3000)
            .map(|_| {
                let at = point(10.0);
                [at + point(0.5), at + point(0.5), at + point(0.5)]
            })
            .collect();
        let faces = Faces::build(&corners, &vec![Name::default(); 3000], Quality::Medium);
        for i in 0..2000 {
            let mut toward = point(1.0).as_dvec3();
            toward.x *= f64::from(u8::from(i % 5 != 0)); // some parallel to a plane of two axes
            let origin = point(20.0).as_dvec3() + DVec3::splat(1e-9);
            let Some(shot) = Shot::new(origin, toward, faces.tree.reach) else { continue };
            let mut here = Log(&faces, &shot, Vec::new());
            let mut reach = f32::INFINITY;
            walk(&faces.tree, &shot, 0.0, &mut reach, &mut here);
            let mut plain = Log(&faces, &shot, Vec::new());
            walk_with::<Plain, _>(&faces.tree, &shot, 0.0, &mut reach, &mut plain);
            assert_eq!(here.2, plain.2);
        }
    }
}
