//! Points and weights of Gauss and Legendre.

/// Nodes within (0, 1) and weights of sum 1: exact for polynomials of degree 2 `count` − 1.
///
/// Roots of Legendre's polynomial by Newton's method from cos(π (i + ¾)/(n + ½)).
pub(crate) fn points(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    let point = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        // Quadratic convergence from within 1e-2: six rounds are two more than f64 needs.
        for _ in 0..6 {
            let (mut before, mut p) = (1.0, x);
            for k in 2..=count {
                let k = k as f64;
                (before, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k);
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        (0.5 - 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_summed_exactly() {
        for count in [2, 5, 16, 40] {
            for degree in [0, 1, 3, 2 * count - 1] {
                let sum: f64 = points(count).iter().map(|&(x, w)| w * x.powi(degree as i32)).sum();
                assert!(
                    (sum * (degree as f64 + 1.0) - 1.0).abs() < 1e-13,
                    "{count} {degree}: rounding of {count} terms"
                );
            }
        }
    }
}
