//! A knob and what it is set to in turn.

use std::str::FromStr;

/// Values of a range without a step.
const STEPS: u32 = 6;

/// Most values of one knob.
const MOST: usize = 1000;

/// A knob and what it is set to in turn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sweep {
    /// Its name, unchecked.
    pub knob: String,
    /// Its values, unchecked, at least one.
    pub values: Vec<String>,
}

impl FromStr for Sweep {
    type Err = String;

    /// `NAME=A,B,C`, `NAME=LOW..HIGH`, `NAME=LOW..HIGH/STEP`.
    fn from_str(text: &str) -> Result<Self, String> {
        let split = text.split_once('=').map(|(knob, values)| (knob.trim(), values.trim()));
        let Some((knob, values)) = split.filter(|(knob, values)| !knob.is_empty() && !values.is_empty())
        else {
            return Err("NAME=VALUES is needed: NAME=A,B,C or NAME=LOW..HIGH".to_owned());
        };
        let values = match values.split_once("..") {
            Some((low, rest)) => range(low, rest)?,
            None => values.split(',').map(|value| value.trim().to_owned()).collect(),
        };
        Ok(Self { knob: knob.to_owned(), values })
    }
}

/// Whole numbers stay whole.
fn range(low: &str, rest: &str) -> Result<Vec<String>, String> {
    let (high, step) = rest.split_once('/').map_or((rest, None), |(high, step)| (high, Some(step)));
    let number = |text: &str| {
        let value = text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| format!("\"{text}\" is no number: LOW..HIGH or LOW..HIGH/STEP is needed"))
    };
    let (low, high, step) = (number(low)?, number(high)?, step.map(number).transpose()?);
    if low >= high || step.is_some_and(|step| step <= 0.0) {
        return Err(format!(
            "from {low} to {high} there is nothing to go through: LOW < HIGH and STEP > 0 are needed"
        ));
    }
    let whole = [low, high, step.unwrap_or(1.0)].iter().all(|value| value.fract() == 0.0);
    let values: Vec<f64> = match step {
        Some(step) => {
            let count = ((high - low) / step * (1.0 + f64::EPSILON)).floor();
            if count >= MOST as f64 {
                return Err(format!("more than {MOST} values from {low} to {high}"));
            }
            (0..=count as u32).map(|i| low + f64::from(i) * step).collect()
        }
        None => (0..STEPS).map(|i| between(low, high, f64::from(i) / f64::from(STEPS - 1))).collect(),
    };
    let mut texts: Vec<String> = values
        .into_iter()
        .map(|value| if whole { value.round().to_string() } else { short(value, [low, high]) })
        .collect();
    texts.dedup();
    Ok(texts)
}

/// Four digits, but for the ends, which stay as they are.
fn short(value: f64, ends: [f64; 2]) -> String {
    let near = |end: f64| (value - end).abs() <= 1e-12 * end.abs();
    let end = ends.into_iter().find(|end| near(*end));
    end.or_else(|| format!("{value:.3e}").parse().ok()).unwrap_or(value).to_string()
}

/// In even ratios, or evenly where there are none.
fn between(low: f64, high: f64, share: f64) -> f64 {
    if low > 0.0 { low * (high / low).powf(share) } else { low + (high - low) * share }
}

/// Every knob at its last value.
pub(super) fn best(sweeps: &[Sweep]) -> Vec<(String, String)> {
    let last = |sweep: &Sweep| sweep.values.last().map(|value| (sweep.knob.clone(), value.clone()));
    sweeps.iter().filter_map(last).collect()
}

/// All combinations, the last knob fastest, or each knob by itself; a setting is a value for some knobs.
pub(super) fn settings(sweeps: &[Sweep], each: bool) -> Vec<Vec<(String, String)>> {
    let one = |sweep: &Sweep| -> Vec<Vec<(String, String)>> {
        sweep.values.iter().map(|value| vec![(sweep.knob.clone(), value.clone())]).collect()
    };
    if each {
        return sweeps.iter().flat_map(one).collect();
    }
    sweeps.iter().fold(vec![Vec::new()], |so_far, sweep| {
        let with = |setting: &Vec<(String, String)>| -> Vec<_> {
            one(sweep).into_iter().map(|value| [setting.clone(), value].concat()).collect()
        };
        so_far.iter().flat_map(with).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        text.parse::<Sweep>().unwrap().values
    }

    #[test]
    fn lists_and_ranges_are_read() {
        assert_eq!(values("sub-scanlines=1, 2,4"), ["1", "2", "4"]);
        assert_eq!(values("water.paths=thesis,exact"), ["thesis", "exact"]);
        assert_eq!(values("sky.cuboid=5..15/5"), ["5", "10", "15"]);
        assert_eq!(values("a=1..32"), ["1", "2", "4", "8", "16", "32"]);
        assert_eq!(values("a=0..0.5"), ["0", "0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(values("a=1e-6..1e-3")[..2], ["0.000001", "0.000003981"]);
        // Roundings of a range that is too short for its steps are one value.
        assert_eq!(values("a=1..3"), ["1", "2", "3"]);
    }

    #[test]
    fn what_cannot_be_read_says_what_can() {
        for bad in ["", "=1", "a", "a=", "a=5..1", "a=x..3", "a=1..3/0", "a=0..1e9/1", "a=1..inf"] {
            assert!(bad.parse::<Sweep>().is_err(), "{bad}");
        }
    }

    #[test]
    fn knobs_are_combined_or_turned_one_by_one() {
        let sweeps = ["a=1,2", "b=x,y,z"].map(|text| text.parse().unwrap());
        let all = settings(&sweeps, false);
        assert_eq!(all.len(), 6);
        assert_eq!(all[1], [("a".to_owned(), "1".to_owned()), ("b".to_owned(), "y".to_owned())]);
        assert_eq!(settings(&sweeps, true).len(), 5);
        assert_eq!(best(&sweeps), [("a".to_owned(), "2".to_owned()), ("b".to_owned(), "z".to_owned())]);
    }
}
