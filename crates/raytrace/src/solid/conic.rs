//! What a plane cuts out of a quadric, and what two of these have in common.

use glam::DVec2;

use super::roots::{partings, quadratic};

/// F = xx x² + 2 xy x y + yy y² + 2 x x + 2 y y + one, its largest coefficient 1.
pub(crate) struct Conic {
    xx: f64,
    xy: f64,
    yy: f64,
    x: f64,
    y: f64,
    one: f64,
}

impl Conic {
    /// From the coefficients in the order of the fields, none of which need be 1.
    pub(crate) fn new(all: [f64; 6]) -> Self {
        let largest = all.iter().fold(f64::MIN_POSITIVE, |largest, c| largest.max(c.abs()));
        let [xx, xy, yy, x, y, one] = all.map(|c| c / largest);
        Self { xx, xy, yy, x, y, one }
    }

    fn value(&self, p: DVec2) -> f64 {
        let quadratic = self.xx * p.x * p.x + 2.0 * self.xy * p.x * p.y + self.yy * p.y * p.y;
        quadratic + 2.0 * (self.x * p.x + self.y * p.y) + self.one
    }

    /// F(p + t v) as a polynomial in t.
    pub(crate) fn along(&self, p: DVec2, v: DVec2) -> [f64; 3] {
        let gradient = DVec2::new(self.xx * p.x + self.xy * p.y, self.xy * p.x + self.yy * p.y)
            + DVec2::new(self.x, self.y);
        let second = self.xx * v.x * v.x + 2.0 * self.xy * v.x * v.y + self.yy * v.y * v.y;
        [self.value(p), 2.0 * gradient.dot(v), second]
    }

    /// F as a polynomial in y, whose coefficients are polynomials in x.
    fn columns(&self) -> [[f64; 3]; 3] {
        [[self.one, 2.0 * self.x, self.xx], [2.0 * self.y, 2.0 * self.xy, 0.0], [self.yy, 0.0, 0.0]]
    }

    /// Points that both may have in common, within ±1.
    ///
    /// a y² + b y + c and a' y² + b' y + c' have a root in common where
    /// (a c' − a' c)² = (a b' − a' b) (b c' − b' c).
    ///
    /// That root is sought among those of both: where one is a line along y, of it any y is a point.
    pub(crate) fn meet(&self, other: &Self, mut visit: impl FnMut(DVec2)) {
        let ([c, b, a], [c2, b2, a2]) = (self.columns(), other.columns());
        let minor = |p: [f64; 3], q: [f64; 3], r: [f64; 3], s: [f64; 3]| {
            let (one, two) = (product(p, q), product(r, s));
            std::array::from_fn(|i| one[i] - two[i])
        };
        let (ac, ab, bc): ([f64; 5], [f64; 5], [f64; 5]) =
            (minor(a, c2, a2, c), minor(a, b2, a2, b), minor(b, c2, b2, c));
        let mut resultant = [0.0; 5];
        for i in 0..5 {
            for j in 0..5 - i {
                resultant[i + j] += ac[i] * ac[j] - ab[i] * bc[j];
            }
        }
        partings(resultant, |x| {
            for (one, two) in [(self, other), (other, self)] {
                for y in quadratic(one.along(DVec2::new(x, 0.0), DVec2::Y)) {
                    let point = DVec2::new(x, y);
                    // Where both turn, y is only as exact as the root of x.
                    if two.value(point).abs() < 1e-4 {
                        visit(point);
                    }
                }
            }
        });
    }
}

fn product(p: [f64; 3], q: [f64; 3]) -> [f64; 5] {
    let mut out = [0.0; 5];
    for i in 0..3 {
        for j in 0..3 {
            out[i + j] += p[i] * q[j];
        }
    }
    out
}
