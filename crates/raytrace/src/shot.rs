//! A ray made ready for one hierarchy: everything that does not depend on the node or triangle.

use glam::DVec3;
use light::rounding::UNIT;

/// A ray in the coordinates of one hierarchy, aimed and sheared.
///
/// Positions along it are measured in its own `direction`'s length, which is 1 in the world and whatever
/// a placement makes of it elsewhere: a distance means the same in the world and in every instance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shot {
    /// Where it starts, and where it goes.
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    /// `origin` as the sum of two f32: what translates corners without losing digits.
    pub(crate) origin_high: [f32; 3],
    pub(crate) origin_low: [f32; 3],
    /// 1 / direction, finite.
    pub(crate) inverse: [f32; 3],
    /// Origin moved by the padding, for planes where the ray comes in and where it goes out.
    pub(crate) origin_in: [f32; 3],
    pub(crate) origin_out: [f32; 3],
    /// Which of `Node::planes` the ray meets first, per axis; the other one is at the index ^ 1.
    pub(crate) near: [usize; 3],
    /// Axis of the largest direction component last, the other two before it.
    pub(crate) axes: [usize; 3],
    /// Direction along the first two of `axes` per unit along the last.
    pub(crate) shear: [f32; 2],
}

impl Shot {
    /// Makes a ray ready for a hierarchy whose coordinates are all within ± `reach`. None when the ray is
    /// not finite or goes nowhere: it meets nothing.
    ///
    /// *Padding.* The triangle test sees corners translated by the origin and sheared along the ray. The
    /// translation rounds once (u |v − o|), the shear is off by u (its quotient), u (its product) and its
    /// subtraction rounds once more: below 4 u |v − o|∞ with |v − o|∞ ≤ |o|∞ + reach. A box must therefore
    /// be met whenever the exact ray passes it by no more; the padded origins below are rounded themselves,
    /// by u (|o|∞ + pad), and the planes minus origin once more: 8 u covers all. The origin is padded instead of
    /// the boxes, because only then a ray from far away is right too, at no cost per box.
    pub(crate) fn new(origin: DVec3, direction: DVec3, reach: f32) -> Option<Self> {
        let high = origin.as_vec3();
        let low = (origin - high.as_dvec3()).as_vec3();
        let toward = direction.as_vec3();
        let size = toward.abs();
        if !(high.is_finite() && toward.is_finite() && size.max_element() > 0.0) {
            return None;
        }
        let last = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let axes = [(last + 1) % 3, (last + 2) % 3, last];
        let pad = 8.0 * UNIT * (high.abs().max_element() + reach);
        let forward = toward.to_array().map(|d| d.is_sign_positive());
        let ahead = |i: usize| if forward[i] { pad } else { -pad };
        Some(Self {
            origin,
            direction,
            origin_high: high.to_array(),
            origin_low: low.to_array(),
            // ±MAX instead of ±∞ where the ray is parallel to an axis: 0 · ∞ would be NaN.
            inverse: toward.to_array().map(|d| (1.0 / d).clamp(f32::MIN, f32::MAX)),
            origin_in: std::array::from_fn(|i| high[i] + ahead(i)),
            origin_out: std::array::from_fn(|i| high[i] - ahead(i)),
            near: std::array::from_fn(|i| 2 * i + usize::from(!forward[i])),
            axes,
            shear: [toward[axes[0]] / toward[last], toward[axes[1]] / toward[last]],
        })
    }

    /// Origin along the i-th of `axes`, its high part.
    #[inline(always)]
    pub(crate) fn high(&self, i: usize) -> f32 {
        self.origin_high[self.axes[i]]
    }

    /// Origin along the i-th of `axes`, its low part.
    #[inline(always)]
    pub(crate) fn low(&self, i: usize) -> f32 {
        self.origin_low[self.axes[i]]
    }
}
