//! Where light crosses a flat surface, and how its bundle spreads beyond (thesis 3.3.2, repaired).

use light::fresnel;

/// How far from the foot of a source `height` above a surface its light enters the water on its way to a place `depth` below,
/// `apart` away horizontally \[m, ≥ 0\]: the root x of Snell's law (3.15)
///
///   x/√(x² + h²) = n (r − x)/√((r − x)² + d²),   n > 1,
///
/// which lies between the straight line's crossing r h/(h + d) and r. The difference of both sides rises with x: bisection and
/// Newton's steps, whichever stays within the bracket, until it does not shrink any more. 0 to rounding of `apart` where any of the three is 0.
pub fn refraction_point(height: f64, depth: f64, apart: f64, index: f64) -> f64 {
    if apart <= 0.0 || height <= 0.0 {
        return 0.0;
    }
    if depth <= 0.0 {
        return apart;
    }
    let [mut low, mut high] = [apart * (height / (height + depth)), apart];
    let mut x = low;
    for _ in 0..100 {
        let (a, b) = (x.hypot(height), (apart - x).hypot(depth));
        let off = x / a - index * (apart - x) / b;
        if off < 0.0 {
            low = x;
        } else {
            high = x;
        }
        let slope = (height / a).powi(2) / a + index * (depth / b).powi(2) / b;
        let newton = x - off / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if next == x || high - low <= f64::EPSILON * apart {
            return next;
        }
        x = next;
    }
    x
}

/// A thin bundle of light that crosses a flat surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bundle {
    /// Index of the receiver's side over the source's.
    eta: f64,
    /// Lengths of both legs \[m\]; the first is infinite for a parallel bundle.
    legs: [f64; 2],
    /// Cosines to the vertical on both.
    cos: [f64; 2],
}

impl Bundle {
    /// From a point `from` metres off the surface, over `along` on the first side and `beyond` on the second, to a place `to` metres off
    /// it; `eta` = n of the receiver's side over that of the source's.
    pub fn new(from: f64, along: f64, to: f64, beyond: f64, eta: f64) -> Self {
        let legs = [from.hypot(along), to.hypot(beyond)];
        let cosine = |height: f64, leg: f64| if leg > 0.0 { height / leg } else { 1.0 };
        Self { eta, legs, cos: [cosine(from, legs[0]), cosine(to, legs[1])] }
    }

    /// Parallel light that meets the surface under a cosine.
    pub fn parallel(cos: f64, eta: f64) -> Self {
        let sin2 = (1.0 - cos * cos).max(0.0) / (eta * eta);
        Self { eta, legs: [f64::INFINITY, 0.0], cos: [cos, (1.0 - sin2).max(0.0).sqrt()] }
    }

    /// Length of the first leg \[m\].
    pub fn first(&self) -> f64 {
        self.legs[0]
    }

    /// Irradiance on a plane that faces the light at the receiver over that at the surface point, without attenuation:
    ///
    ///   T η² cos₁ cos₂ r₁² / [(η r₁ + r₂)(η r₁ cos²₂ + r₂ cos²₁)]                                  (3.11′, 3.12′)
    ///
    /// of which T cos₁/cos₂ is left for parallel light (3.6), T = 1 − α. 0 beyond the critical angle.
    pub fn factor(&self) -> f64 {
        let Self { eta, legs: [r1, r2], cos: [c1, c2] } = *self;
        let passes = 1.0 - fresnel(eta, c1);
        if passes <= 0.0 || r1 <= 0.0 {
            return 0.0;
        }
        // Divided by r₁² before it can overflow, or be infinite over infinite.
        let q = r2 / r1;
        let spread = (eta + q) * (eta * c2 * c2 + q * c1 * c1);
        if spread > 0.0 { passes * eta * eta * c1 * c2 / spread } else { 0.0 }
    }
}

#[cfg(test)]
mod tests;
