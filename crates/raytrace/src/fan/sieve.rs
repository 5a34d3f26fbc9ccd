//! Which boxes and triangles may meet a fan: eight at once, in f32, never one too few.
//!
//! `unsafe` is the way into AVX2.

#![allow(
    unsafe_code,
    reason = "AVX2 entry: a segment of a pixel takes 0.7 to 0.8 of the time of plain SSE2 (`benches/shadows.rs`)"
)]

use glam::DVec3;
use light::rounding::UNIT;

use super::frame::Fan;
use crate::{
    collapse::WIDTH,
    lanes::{Lanes, Plain},
    tree::{Node, Packet},
};
#[cfg(target_arch = "x86_64")]
use crate::{lanes::Avx2, walk::wide};

/// A linear function of position, at least 0 (or, for the first, exactly 0) in the fan.
#[derive(Clone, Copy, Debug)]
struct Half {
    /// Its gradient, negated; Σ|gradient| = 1.
    down: [f32; 3],
    /// Its value at the origin.
    offset: f32,
    /// Where it is largest in a box: which of [`Node::planes`], per axis.
    most: [usize; 3],
}

impl Half {
    /// With this direction of growth, zero at `anchor`.
    fn new(gradient: DVec3, anchor: DVec3) -> Self {
        let gradient = gradient / gradient.abs().element_sum();
        Self {
            down: (-gradient).as_vec3().to_array(),
            offset: -gradient.dot(anchor) as f32,
            most: std::array::from_fn(|axis| 2 * axis + usize::from(gradient[axis] > 0.0)),
        }
    }

    /// Its value at eight points, by coordinate.
    #[inline(always)]
    fn value<L: Lanes>(&self, at: [&[f32; WIDTH]; 3]) -> L {
        let mut value = L::splat(self.offset);
        for (&down, at) in self.down.iter().zip(at) {
            value = value.sub(L::splat(down).mul(L::load(at)));
        }
        value
    }

    /// Its largest value in each box (`other` = 0) or its smallest (`other` = 1).
    #[inline(always)]
    fn extreme<L: Lanes>(&self, node: &Node, other: usize) -> L {
        let plane = |axis: usize| &node.planes[self.most[axis] ^ other];
        self.value([plane(0), plane(1), plane(2)])
    }

    /// Its values at the corners of eight triangles. No closure over lanes: it would be compiled without
    /// AVX2.
    #[inline(always)]
    fn corners<L: Lanes>(&self, packet: &Packet) -> (L, L, L) {
        let [a, b, c] = &packet.corners;
        (self.value(a.each_ref()), self.value(b.each_ref()), self.value(c.each_ref()))
    }
}

/// A fan made ready for one hierarchy.
#[derive(Clone, Debug)]
pub(crate) struct Sieve {
    /// Distance from the plane.
    plane: Half,
    /// Beyond a, before b, before the segment's line, all as seen within the plane.
    sides: [Half; 3],
    /// Box around the fan, low and high.
    low: [f32; 3],
    high: [f32; 3],
    /// How far rounding may move anything.
    pad: f32,
}

impl Sieve {
    /// For a hierarchy whose coordinates are within ± `reach`; `fan` in the same coordinates.
    ///
    /// *Padding.* A value is Σ gᵢ xᵢ − k with Σ|gᵢ| = 1 and |k| ≤ |a|∞ or |b|∞: each product is off by 2 u of
    /// itself, the sums by u of at most `reach` + |k| thrice, k by u of itself: below 6 u (reach + |k|). That
    /// corners have been rounded to f32 adds u `reach`.
    pub(crate) fn new(fan: &Fan, toward: DVec3, reach: f32) -> Self {
        let (a, b) = (fan.a, fan.a + fan.d);
        let closing = match fan.lamp {
            Some(_) => -fan.along - fan.height,
            None => -fan.along,
        };
        let largest = a.abs().max(b.abs()).max_element() as f32;
        let pad = 8.0 * UNIT * (reach + largest);
        let (mut low, mut high) = (a.min(b), a.max(b));
        if let Some(lamp) = fan.lamp {
            (low, high) = (low.min(lamp), high.max(lamp));
        } else {
            for axis in 0..3 {
                if toward[axis] > 0.0 {
                    high[axis] = f64::INFINITY;
                } else if toward[axis] < 0.0 {
                    low[axis] = f64::NEG_INFINITY;
                }
            }
        }
        if let Some(level) = fan.ceiling {
            high.y = high.y.min(level);
        }
        // A lamp far away is rounded by more than the padding knows: outwards with it.
        let down = |value: f64| (value - f64::from(pad)).max(f64::from(f32::MIN)) as f32;
        let up = |value: f64| (value + f64::from(pad)).min(f64::from(f32::MAX)) as f32;
        Self {
            plane: Half::new(fan.normal, a),
            sides: [Half::new(fan.along, a), Half::new(closing, b), Half::new(fan.height, a)],
            low: low.to_array().map(|value| down(value).next_down()),
            high: high.to_array().map(|value| up(value).next_up()),
            pad,
        }
    }

    /// One bit for each box that may meet the fan; none for empty slots.
    pub(crate) fn boxes(&self, node: &Node) -> u32 {
        #[cfg(target_arch = "x86_64")]
        if wide() {
            // SAFETY: the feature was just detected.
            return unsafe { boxes_avx2(self, node) };
        }
        self.boxes_plain(node)
    }

    pub(crate) fn boxes_plain(&self, node: &Node) -> u32 {
        self.boxes_with::<Plain>(node)
    }

    /// One bit for each triangle that may meet the fan; none for empty lanes.
    pub(crate) fn triangles(&self, packet: &Packet) -> u32 {
        #[cfg(target_arch = "x86_64")]
        if wide() {
            // SAFETY: the feature was just detected.
            return unsafe { triangles_avx2(self, packet) };
        }
        self.triangles_plain(packet)
    }

    pub(crate) fn triangles_plain(&self, packet: &Packet) -> u32 {
        self.triangles_with::<Plain>(packet)
    }

    #[inline(always)]
    fn boxes_with<L: Lanes>(&self, node: &Node) -> u32 {
        let (least, most) = (L::splat(-self.pad), L::splat(self.pad));
        let mut mask = least.le(self.plane.extreme::<L>(node, 0));
        mask &= self.plane.extreme::<L>(node, 1).le(most);
        for axis in 0..3 {
            mask &= L::load(&node.planes[2 * axis]).le(L::splat(self.high[axis]));
            mask &= L::splat(self.low[axis]).le(L::load(&node.planes[2 * axis + 1]));
        }
        for side in &self.sides {
            if mask == 0 {
                break;
            }
            mask &= least.le(side.extreme::<L>(node, 0));
        }
        mask
    }

    #[inline(always)]
    fn triangles_with<L: Lanes>(&self, packet: &Packet) -> u32 {
        let (least, most) = (L::splat(-self.pad), L::splat(self.pad));
        let (a, b, c) = self.plane.corners::<L>(packet);
        let mut mask = a.min(b).min(c).le(most) & least.le(a.max(b).max(c));
        for side in &self.sides {
            if mask == 0 {
                break;
            }
            let (a, b, c) = side.corners::<L>(packet);
            mask &= least.le(a.max(b).max(c));
        }
        mask
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn boxes_avx2(sieve: &Sieve, node: &Node) -> u32 {
    sieve.boxes_with::<Avx2>(node)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn triangles_avx2(sieve: &Sieve, packet: &Packet) -> u32 {
    sieve.triangles_with::<Avx2>(packet)
}
