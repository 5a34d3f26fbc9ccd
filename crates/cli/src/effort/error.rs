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
    /// Whether there are more of them.
    #[serde(skip)]
    pub(super) sampled: bool,
}

/// Answers of a part of a whole, and what they should be.
#[derive(Clone, Copy)]
pub(super) struct Stratum<'a> {
    /// Of the whole.
    pub(super) share: f64,
    /// Whether these are all that the part has; else a random few.
    pub(super) all: bool,
    pub(super) answers: &'a [[f64; 3]],
    pub(super) truths: &'a [[f64; 3]],
}

/// |a − b|² of each, the mean of its three.
fn squares(answers: &[[f64; 3]], truths: &[[f64; 3]]) -> impl Iterator<Item = f64> {
    let square =
        |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / 3.0;
    answers.iter().zip(truths).map(square)
}

/// Of all.
pub(super) fn mean_square(answers: &[[f64; 3]], truths: &[[f64; 3]]) -> f64 {
    squares(answers, truths).sum::<f64>() / answers.len().max(1) as f64
}

impl Stratum<'_> {
    fn count(&self) -> usize {
        self.answers.len().min(self.truths.len())
    }

    /// Means of |a − b|² and b, and the squared standard error of the former.
    fn means(&self) -> [f64; 3] {
        let n = self.count().max(1) as f64;
        let squares: Vec<f64> = squares(self.answers, self.truths).collect();
        let mean_square = squares.iter().sum::<f64>() / n;
        let spread = squares.iter().map(|q| (q - mean_square).powi(2)).sum::<f64>() / n;
        let mean = self.truths.iter().flatten().sum::<f64>() / (3.0 * n);
        [mean_square, mean, if self.all { 0.0 } else { spread / n }]
    }
}

impl Off {
    /// Of a few answers, by what they should be.
    pub(super) fn new(answers: &[[f64; 3]], truths: &[[f64; 3]]) -> Self {
        Self::stratified(&[Stratum { share: 1.0, all: false, answers, truths }])
    }

    /// Of a whole by its parts.
    ///
    /// With q = |a − b|²: r = √mean q, and its standard error by that of the mean, s/√n: s/(2 r √n).
    pub(super) fn stratified(strata: &[Stratum]) -> Self {
        let [mut square, mut mean, mut variance, mut count] = [0.0, 0.0, 0.0, 0.0];
        for stratum in strata {
            let [squares, truths, of_squares] = stratum.means();
            square += stratum.share * squares;
            mean += stratum.share * truths;
            variance += stratum.share.powi(2) * of_squares;
            count += stratum.count() as f64;
        }
        let rmse = square.sqrt();
        let over = |value: f64| if value == 0.0 { 0.0 } else { value / mean };
        let of_rmse = if rmse > 0.0 { variance.sqrt() / (2.0 * rmse) } else { 0.0 };
        let sampled = strata.iter().any(|stratum| !stratum.all);
        Self { relative_rmse: over(rmse), uncertainty: over(of_rmse), count: count as usize, sampled }
    }

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
        let off = Off::new(&[[1.1; 3], [0.9; 3]], &[[1.0; 3]; 2]);
        assert!((off.relative_rmse - 0.1).abs() < 1e-12 && off.uncertainty < 1e-12 && off.count == 2);
        assert_eq!(Off::new(&[[0.0; 3]], &[[0.0; 3]]).relative_rmse, 0.0);
        assert_eq!(Off::new(&[], &[]).count, 0);
    }

    /// A thousandth of a picture that is a hundred times too bright, and known to be; the rest is right.
    #[test]
    fn parts_count_by_their_share() {
        let truths = [[1.0; 3]; 4];
        let part = |share, all, answers| Stratum { share, all, answers, truths: &truths };
        let off = Off::stratified(&[part(0.999, false, &truths), part(1e-3, true, &[[101.0; 3]; 4])]);
        assert!((off.relative_rmse - 100.0 * 1e-3f64.sqrt()).abs() < 1e-9 && off.uncertainty == 0.0);
        assert_eq!(off.count, 8);
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
