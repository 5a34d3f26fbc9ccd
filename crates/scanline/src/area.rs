//! Area between leaning borders, within a pixel.

use crate::borders::Border;

/// Area \[pixel\], and its moments about the pixel's left border and the strip's middle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Area {
    pub(crate) area: f64,
    pub(crate) x: f64,
    pub(crate) y: f64,
}

impl std::ops::Sub for Area {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { area: self.area - other.area, x: self.x - other.x, y: self.y - other.y }
    }
}

/// What lies left of a border: ∫ u dy, ∫ u²/2 dy and ∫ u y dy of u(y) = x(y) − column, brought into 0..=1.
///
/// u is 0, then rises along a line, then is 1; each of these parts may be missing. (Borders that lean to the
/// left are turned upside down.) With t = 0..1 down the strip and a line from u₀ at t₀ to u₁ at t₁:
/// ∫ u = (t₁ − t₀)(u₀ + u₁)/2, ∫ u²/2 = (t₁ − t₀)(u₀² + u₀u₁ + u₁²)/6,
/// ∫ u t = (t₁ − t₀)(u₀(2t₀ + t₁) + u₁(t₀ + 2t₁))/6.
pub(crate) fn left_of([top, bottom]: Border, column: f64, height: f64) -> Area {
    let (low, high) =
        if top <= bottom { (top - column, bottom - column) } else { (bottom - column, top - column) };
    if high <= 0.0 {
        return Area::default();
    }
    if low >= 1.0 {
        return Area { area: height, x: 0.5 * height, y: 0.0 };
    }
    let rise = high - low;
    let (t0, u0) = if low < 0.0 { (-low / rise, 0.0) } else { (0.0, low) };
    let (t1, u1) = if high > 1.0 { ((1.0 - low) / rise, 1.0) } else { (1.0, high) };
    let (length, rest) = (t1 - t0, 1.0 - t1);
    let area = length * (u0 + u1) * 0.5 + rest;
    let x = length * (u0 * u0 + u0 * u1 + u1 * u1) / 6.0 + 0.5 * rest;
    let t = length * (u0 * (2.0 * t0 + t1) + u1 * (t0 + 2.0 * t1)) / 6.0 + rest * 0.5 * (1.0 + t1);
    // About the middle of the strip.
    let y = t - 0.5 * area;
    let y = if top <= bottom { y } else { -y };
    Area { area: area * height, x: x * height, y: y * height * height }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against the midpoint rule with 4000 steps, which is wrong by less than 1/4000 where u has a kink.
        #[test]
        fn as_summed(top in -3f64..4.0, bottom in -3f64..4.0, height in 0.01f64..1.0) {
            const STEPS: u32 = 4000;
            let (mut area, mut x, mut y) = (0.0, 0.0, 0.0);
            let step = height / f64::from(STEPS);
            for i in 0..STEPS {
                let t = (f64::from(i) + 0.5) / f64::from(STEPS);
                let u = (top + (bottom - top) * t - 1.0).clamp(0.0, 1.0);
                area += u * step;
                x += 0.5 * u * u * step;
                y += u * (t - 0.5) * height * step;
            }
            let found = left_of([top, bottom], 1.0, height);
            for (a, b) in [(area, found.area), (x, found.x), (y, found.y)] {
                prop_assert!((a - b).abs() < 1.0 / f64::from(STEPS), "{} {}", a, b);
            }
        }
    }
}
