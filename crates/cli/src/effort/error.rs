//! How far answers are off, and how far that may be off itself.

use std::fmt;
use std::str::FromStr;

/// A relative root mean square error.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub(crate) struct Off {
    /// √mean |a − b|² / mean b over what was asked again.
    pub(crate) relative_rmse: f64,
    /// Standard error of that, from the spread of |a − b|².
    pub(crate) uncertainty: f64,
    /// How many pixels or points it comes from.
    pub(crate) count: usize,
}

impl Off {
    /// Of answers by what they should be, each of one or three numbers.
    ///
    /// With q = |a − b|²: r = √mean q, and its standard error by that of the mean, s/√n: s/(2 r √n).
    pub(super) fn new<const N: usize>(answers: &[[f64; N]], truths: &[[f64; N]]) -> Self {
        let count = answers.len().min(truths.len());
        let n = count.max(1) as f64;
        let squares: Vec<f64> = answers
            .iter()
            .zip(truths)
            .map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / N as f64)
            .collect();
        let mean = truths.iter().flatten().sum::<f64>() / (n * N as f64);
        let square = squares.iter().sum::<f64>() / n;
        let spread = squares.iter().map(|q| (q - square).powi(2)).sum::<f64>() / n;
        let rmse = square.sqrt();
        let over = |value: f64| if value == 0.0 { 0.0 } else { value / mean };
        let of_rmse = if rmse > 0.0 { (spread / n).sqrt() / (2.0 * rmse) } else { 0.0 };
        Self { relative_rmse: over(rmse), uncertainty: over(of_rmse), count }
    }
}

impl Off {
    /// What it is at most, but for one chance in six.
    pub(super) fn most(self) -> f64 {
        self.relative_rmse + self.uncertainty
    }
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.2} % ± {:.2} %", 100.0 * self.relative_rmse, 100.0 * self.uncertainty)
    }
}

/// What error is asked for: `2%` or `0.02`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted(pub f64);

impl FromStr for Wanted {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (number, unit) =
            text.trim().strip_suffix('%').map_or((text.trim(), 1.0), |number| (number, 0.01));
        match number.trim().parse::<f64>() {
            Ok(value) if (1e-4..=1.0).contains(&(value * unit)) => Ok(Self(value * unit)),
            _ => Err("a share from 0.01% to 100% is needed, such as 2% or 0.02".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_relative_to_the_mean() {
        let off = Off::new(&[[1.1], [0.9]], &[[1.0], [1.0]]);
        assert!((off.relative_rmse - 0.1).abs() < 1e-12 && off.uncertainty < 1e-12 && off.count == 2);
        assert_eq!(Off::new(&[[0.0]], &[[0.0]]).relative_rmse, 0.0);
        assert_eq!(Off::new::<1>(&[], &[]).count, 0);
    }

    #[test]
    fn shares_are_read_either_way() {
        assert_eq!("2%".parse(), Ok(Wanted(0.02)));
        assert_eq!("0.5 %".parse(), Ok(Wanted(0.005)));
        assert_eq!("0.02".parse(), Ok(Wanted(0.02)));
        for bad in ["", "%", "0", "-1%", "200%", "2 percent", "nan", "1e-9"] {
            assert!(bad.parse::<Wanted>().is_err(), "{bad}");
        }
    }
}
