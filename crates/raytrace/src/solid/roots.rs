//! Polynomials of up to the fourth degree, and where they are 0.

use glam::DVec3;

/// The roots of c₀ + c₁ x + c₂ x², in no order; what is not a finite number is none.
///
/// With h = c₁/2 they are q/c₂ and c₀/q, q = −(h + sign h √(h² − c₀ c₂)), which adds what has one sign. A double
/// root that rounding has just undone is still one: nobody here minds a place too many.
pub(crate) fn quadratic([c, b, a]: [f64; 3]) -> [f64; 2] {
    let h = 0.5 * b;
    let discriminant = h * h - a * c;
    if discriminant < -1e-6 * h * h {
        return [f64::NAN; 2];
    }
    let q = -(h + discriminant.max(0.0).sqrt().copysign(h));
    [q / a, c / q]
}

/// |v + s w|² as a polynomial in s.
pub(crate) fn square(v: DVec3, w: DVec3) -> [f64; 3] {
    [v.length_squared(), 2.0 * v.dot(w), w.length_squared()]
}

/// One polynomial less another.
pub(crate) fn difference(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| p[i] - q[i])
}

/// Most numbers that [`partings`] finds: −1, 1 and 4 + 3 + 2 + 1 zeros.
const MOST: usize = 12;

/// Numbers in \[−1, 1\], in order, that part it so that Σ cᵢ xⁱ and each of its derivatives is monotonous between
/// neighbours, and the zeros of all of them. A double zero is that of a derivative, found as exactly as any.
pub(crate) fn partings(mut polynomials: [f64; 5], mut visit: impl FnMut(f64)) {
    let mut derivatives = [[0.0; 5]; 4];
    for derivative in &mut derivatives {
        *derivative = polynomials;
        let lower: [f64; 4] = std::array::from_fn(|i| polynomials[i + 1] * (i + 1) as f64);
        polynomials = [lower[0], lower[1], lower[2], lower[3], 0.0];
    }
    let mut cuts = [1.0; MOST];
    (cuts[0], cuts[1]) = (-1.0, 1.0);
    let mut count = 2;
    for polynomial in derivatives.iter().rev() {
        let known = count;
        for i in 1..known {
            if let Some(zero) = zero(polynomial, cuts[i - 1], cuts[i])
                && count < MOST
            {
                cuts[count] = zero;
                count += 1;
            }
        }
        cuts[..count].sort_unstable_by(f64::total_cmp);
    }
    cuts[..count].iter().for_each(|&x| visit(x));
}

fn value(polynomial: &[f64; 5], x: f64) -> (f64, f64) {
    polynomial.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c, slope * x + value))
}

/// The zero of a polynomial that is monotonous between `low` and `high`, if it changes its sign there: Newton's
/// steps, halving where they lead out.
fn zero(polynomial: &[f64; 5], mut low: f64, mut high: f64) -> Option<f64> {
    let at_low = value(polynomial, low).0;
    if (at_low < 0.0) == (value(polynomial, high).0 < 0.0) {
        return None;
    }
    let mut x = 0.5 * (low + high);
    // Halving alone is done after 53 steps; Newton's are mostly 5.
    for _ in 0..60 {
        let (here, slope) = value(polynomial, x);
        if (here < 0.0) == (at_low < 0.0) {
            low = x
        } else {
            high = x
        }
        let next = x - here / slope;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - x).abs() <= f64::EPSILON {
            return Some(next);
        }
        x = next;
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn quadratics_of_all_kinds() {
        assert_eq!(quadratic([-6.0, 1.0, 1.0]), [-3.0, 2.0]);
        assert!(quadratic([1.0, 0.0, 1.0]).iter().all(|x| x.is_nan()));
        let [none, one] = quadratic([-3.0, 2.0, 0.0]);
        assert!(!none.is_finite() && one == 1.5);
        // (x − 0.1)², undone by rounding.
        assert!(quadratic([0.010_000_000_000_000_002, -0.2, 1.0]).iter().all(|x| (x - 0.1).abs() < 1e-8));
    }

    proptest! {
        /// Zeros of (x − a)(x − b)(x − c)(x − d), two of them the same or not.
        #[test]
        fn every_zero_is_found(a in -0.9f64..0.9, b in -0.9f64..0.9, c in -0.9f64..0.9, twice in prop::bool::ANY) {
            let d = if twice { a } else { -2.0 };
            let mut product = [1.0, 0.0, 0.0, 0.0, 0.0];
            for zero in [a, b, c, d] {
                product = std::array::from_fn(|i| if i > 0 { product[i - 1] } else { 0.0 } - zero * product[i]);
            }
            let mut found = Vec::new();
            partings(product, |x| found.push(x));
            prop_assert!(found.windows(2).all(|w| w[0] <= w[1]));
            for zero in [a, b, c] {
                let nearest = found.iter().map(|x| (x - zero).abs()).fold(f64::INFINITY, f64::min);
                // Coefficients round by 1e-16 of up to 10; m zeros that fall together move by the m-th root of it,
                // and three within 1e-3 of each other count as together.
                let others = [a, b, c, d].iter().filter(|x| (*x - zero).abs() < 1e-3).count();
                prop_assert!(nearest < if others > 2 { 1e-3 } else { 1e-9 }, "{nearest:e}");
            }
        }
    }
}
