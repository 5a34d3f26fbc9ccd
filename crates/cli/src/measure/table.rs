//! Errors beside times: the table of `keikan measure`.

use std::fmt;

use super::trial::{Answer, Trial, words};
use crate::Error;
use crate::compare::{self, Picture};

/// One setting, what it costs and what it is off by.
#[derive(Clone, Debug, Default, serde::Serialize)]
pub(super) struct Row {
    /// Knobs and their values, in words.
    pub setting: String,
    /// Seconds of the picture without loading, median of all runs.
    pub seconds: Option<f64>,
    /// Seconds of the sensors, median of all runs.
    pub lux_seconds: Option<f64>,
    /// Seconds of each run, of the picture where there is one.
    pub runs: Vec<f64>,
    /// Most memory of the process meanwhile \[MiB\], where the system tells.
    pub memory_mib: Option<f64>,
    /// √mean (a − b)² / mean b over pixels and channels.
    pub relative_rmse: Option<f64>,
    /// Mean CIEDE2000.
    pub delta_e: Option<f64>,
    /// Σ |a − b| / Σ b over sensor points.
    pub lux_error: Option<f64>,
    /// Largest |a − b| / b of a sensor point, where b is at least a hundredth of the mean.
    pub lux_worst: Option<f64>,
    /// Whether no other setting is at once as quick and as near.
    pub best_of_its_time: bool,
}

impl Row {
    /// Of a trial by what it should have given.
    pub(super) fn new(trial: &Trial, truth: &Answer) -> Result<Self, Error> {
        let difference = match (&trial.answer.picture, &truth.picture) {
            (Some(a), Some(b)) => Some(compare::compare(&plain(a), &plain(b))?),
            _ => None,
        };
        let lux = lux_errors(&trial.answer.lux, &truth.lux);
        Ok(Self {
            setting: words(&trial.setting),
            seconds: trial.seconds[0],
            lux_seconds: trial.seconds[1],
            runs: trial.runs.clone(),
            memory_mib: trial.memory_mib,
            relative_rmse: difference.map(|difference| difference.relative_rmse),
            delta_e: difference.map(|difference| difference.delta_e_mean),
            lux_error: lux.map(|[mean, _]| mean),
            lux_worst: lux.map(|[_, worst]| worst),
            best_of_its_time: false,
        })
    }

    /// Seconds and error that stand for it: of its picture, or of its sensors without one.
    pub(super) fn point(&self) -> Option<[f64; 2]> {
        let picture = self.seconds.zip(self.relative_rmse);
        picture.or(self.lux_seconds.zip(self.lux_error)).map(|(seconds, error)| [seconds, error])
    }
}

fn plain(picture: &crate::output::Picture) -> Picture {
    Picture { width: picture.width, height: picture.height, rgb: picture.rgb.clone() }
}

/// Below this share of the mean, the largest relative error of a point says nothing.
const FAINT: f64 = 0.01;

/// Mean and largest error of illuminances, as shares; none without any.
fn lux_errors(lux: &[f64], truth: &[f64]) -> Option<[f64; 2]> {
    let sum: f64 = truth.iter().sum();
    if truth.is_empty() || lux.len() != truth.len() {
        return None;
    }
    let pairs = || lux.iter().zip(truth).map(|(a, b)| ((a - b).abs(), *b));
    let off: f64 = pairs().map(|(off, _)| off).sum();
    // Light where there should be none is off by more than any share.
    let mean = if off == 0.0 { 0.0 } else { off / sum };
    let seen = pairs().filter(|(_, b)| *b > 0.0 && *b >= FAINT * sum / truth.len() as f64);
    Some([mean, seen.map(|(off, b)| off / b).fold(0.0, f64::max)])
}

/// Marks the rows that no other beats in both time and error (the Pareto front).
pub(super) fn mark_best(rows: &mut [Row]) {
    let points: Vec<Option<[f64; 2]>> = rows.iter().map(Row::point).collect();
    for (i, row) in rows.iter_mut().enumerate() {
        let Some(own) = points[i] else { continue };
        let beats = |other: &[f64; 2]| other[0] <= own[0] && other[1] <= own[1] && *other != own;
        row.best_of_its_time = !points.iter().flatten().any(beats);
    }
}

/// Columns of numbers: header, digits, value.
type Column = (&'static str, usize, fn(&Row) -> Option<f64>);

const COLUMNS: [Column; 7] = [
    ("seconds", 3, |row| row.seconds),
    ("lux_seconds", 3, |row| row.lux_seconds),
    ("memory_mib", 0, |row| row.memory_mib),
    ("relative_rmse", 5, |row| row.relative_rmse),
    ("delta_e2000", 3, |row| row.delta_e),
    ("lux_error", 5, |row| row.lux_error),
    ("lux_worst", 5, |row| row.lux_worst),
];

/// All rows, as text.
pub(super) struct Table<'a>(pub(super) &'a [Row]);

impl Table<'_> {
    /// Headers, of which those columns are left out that no row has.
    pub(super) fn columns(&self) -> impl Iterator<Item = &'static Column> {
        COLUMNS.iter().filter(|(_, _, value)| self.0.iter().any(|row| value(row).is_some()))
    }

    /// As CSV with a header line.
    pub(super) fn csv(&self) -> String {
        let header: Vec<&str> = self.columns().map(|(name, ..)| *name).collect();
        let mut text = format!("setting,{},best_of_its_time\n", header.join(","));
        for row in self.0 {
            let numbers: Vec<String> = self
                .columns()
                .map(|(_, _, value)| value(row).map_or_else(String::new, |value| value.to_string()))
                .collect();
            text += &format!("\"{}\",{},{}\n", row.setting, numbers.join(","), row.best_of_its_time);
        }
        text
    }
}

/// A number of a column, or a dash.
pub(super) fn cell(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
}

impl fmt::Display for Table<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let wide = self.0.iter().map(|row| row.setting.chars().count()).max().unwrap_or(0).max(7);
        write!(f, "{:wide$}", "setting")?;
        for (name, ..) in self.columns() {
            write!(f, "  {name:>13}")?;
        }
        for row in self.0 {
            write!(f, "\n{:wide$}", row.setting)?;
            for (_, digits, value) in self.columns() {
                write!(f, "  {:>13}", cell(value(row), *digits))?;
            }
            if row.best_of_its_time {
                f.write_str("  *")?;
            }
        }
        f.write_str("\n* = none of the others is as quick and as near")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(seconds: f64, error: f64) -> Row {
        Row {
            setting: String::new(),
            seconds: Some(seconds),
            lux_seconds: None,
            runs: Vec::new(),
            memory_mib: None,
            relative_rmse: Some(error),
            delta_e: None,
            lux_error: None,
            lux_worst: None,
            best_of_its_time: false,
        }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let mut rows = [row(1.0, 0.5), row(2.0, 0.6), row(3.0, 0.1), row(3.0, 0.2), row(9.0, 0.0)];
        mark_best(&mut rows);
        assert_eq!(rows.map(|row| row.best_of_its_time), [true, false, true, false, true]);
    }

    #[test]
    fn errors_of_lux_are_shares() {
        assert_eq!(lux_errors(&[], &[]), None);
        assert_eq!(lux_errors(&[110.0, 90.0], &[100.0, 100.0]), Some([0.1, 0.1]));
        // A point that gets next to nothing has no say in the worst.
        let [mean, worst] = lux_errors(&[100.0, 0.5], &[100.0, 0.1]).unwrap();
        assert!(mean < 0.005 && worst == 0.0);
        assert_eq!(lux_errors(&[0.0], &[0.0]), Some([0.0, 0.0]));
        assert_eq!(lux_errors(&[5.0], &[0.0]).unwrap()[0], f64::INFINITY);
    }

    #[test]
    fn columns_that_nobody_has_are_left_out() {
        let rows = [row(1.0, 0.5)];
        assert!(Table(&rows).csv().starts_with("setting,seconds,relative_rmse,best_of_its_time\n"));
    }
}
