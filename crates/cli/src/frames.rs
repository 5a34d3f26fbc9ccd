//! Which frames: ranges of numbers, times of a day, and the names of their files.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Most frames of one command.
const MOST: usize = 1_000_000;

/// Frame numbers, each once, in the order asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frames(pub Vec<i32>);

impl FromStr for Frames {
    type Err = String;

    /// `1-100`, `1-100x2` and `1-100:2` (every second one), `10-1:-1` (backwards), lists of those with commas; numbers
    /// may be negative: `-5--1`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (mut seen, mut all) = (BTreeSet::new(), Vec::new());
        for part in text.split(',') {
            let (from, to, step) = range(part.trim())?;
            let count = (i64::from(to) - i64::from(from)) / i64::from(step) + 1;
            if count < 1 {
                return Err(format!("\"{part}\" has no frame: to run backwards, write {from}-{to}:-1"));
            }
            if all.len() as u64 + count as u64 > MOST as u64 {
                return Err(format!("more than {MOST} frames"));
            }
            let numbers = (0..count).map(|i| (i64::from(from) + i * i64::from(step)) as i32);
            all.extend(numbers.filter(|number| seen.insert(*number)));
        }
        Ok(Self(all))
    }
}

/// First, last, step (not 0) of a range or a single number.
fn range(part: &str) -> Result<(i32, i32, i32), String> {
    let wrong = || format!("\"{part}\" is no range of frames: write 7, 1-100, 1-100x2 or 1-100:2");
    let (from, rest) = integer(part).ok_or_else(wrong)?;
    if rest.is_empty() {
        return Ok((from, from, 1));
    }
    let (to, rest) = rest.strip_prefix('-').and_then(integer).ok_or_else(wrong)?;
    let step = match rest.strip_prefix(['x', ':']).map(integer) {
        None if rest.is_empty() => 1,
        Some(Some((step, ""))) if step != 0 => step,
        _ => return Err(wrong()),
    };
    Ok((from, to, step))
}

/// The whole number that a text begins with, and the rest.
fn integer(text: &str) -> Option<(i32, &str)> {
    let sign = usize::from(text.starts_with('-'));
    let digits = text[sign..].bytes().take_while(u8::is_ascii_digit).count();
    let (number, rest) = text.split_at(sign + digits);
    Some((number.parse().ok()?, rest))
}

/// Times of a day by its local clock.
#[derive(Clone, Debug, PartialEq)]
pub struct Day {
    /// Of the first one, seconds after midnight.
    pub from: f64,
    /// Seconds from one to the next, > 0.
    pub step: f64,
    /// How many, ≥ 1.
    pub count: usize,
}

impl FromStr for Day {
    type Err = String;

    /// `05:00..19:00/10min`: both ends included if a step ends there; an end before the beginning is that of the next
    /// day.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong =
            || format!("\"{text}\" is no stretch of a day: write FROM..TO/STEP, such as 05:00..19:00/10min");
        let (ends, step) = text.split_once('/').ok_or_else(wrong)?;
        let (from, to) = ends.split_once("..").ok_or_else(wrong)?;
        let (from, to) = (clock(from.trim())?, clock(to.trim())?);
        let step = duration(step.trim())?;
        let length = if to < from { to + 86_400.0 - from } else { to - from };
        // A step that ends within a thousandth of itself before the end ends there: 1/3 s has no exact number.
        let count = (length / step + 1e-3).floor() as usize + 1;
        if count > MOST {
            return Err(format!("more than {MOST} frames"));
        }
        Ok(Self { from, step, count })
    }
}

/// `HH:MM` or `HH:MM:SS` in seconds.
pub(crate) fn clock(text: &str) -> Result<f64, String> {
    let wrong = || format!("\"{text}\" is no time of day: write it like 05:30");
    let parts: Vec<u32> = text.split(':').map(str::parse).collect::<Result<_, _>>().map_err(|_| wrong())?;
    let (hours, minutes, seconds) = match parts[..] {
        [hours, minutes] => (hours, minutes, 0),
        [hours, minutes, seconds] => (hours, minutes, seconds),
        _ => return Err(wrong()),
    };
    let second = hours.saturating_mul(3600).saturating_add(60 * minutes.min(60) + seconds.min(60));
    if minutes < 60 && seconds < 60 && second <= 86_400 { Ok(f64::from(second)) } else { Err(wrong()) }
}

/// `10min`, `30s`, `1h` in seconds.
fn duration(text: &str) -> Result<f64, String> {
    let units = [("min", 60.0), ("h", 3600.0), ("s", 1.0)];
    let found = units.iter().find_map(|(unit, seconds)| Some((text.strip_suffix(unit)?, seconds)));
    match found.and_then(|(number, unit)| Some(number.trim().parse::<f64>().ok()? * unit)) {
        // Outputs state whole seconds.
        Some(seconds) if (1.0..=86_400.0).contains(&seconds) => Ok(seconds),
        _ => Err(format!("\"{text}\" is no step: write it like 10min, 30s or 1h, from 1s to 24h")),
    }
}

/// The name of a frame's file: every run of `#` in the last part of `pattern` becomes the number with at least as many
/// digits (the sign not counted). None if there is no `#`, or the name is no text.
pub fn numbered(pattern: &Path, number: i32) -> Option<PathBuf> {
    let name = pattern.file_name()?.to_str()?;
    let (mut made, mut rest) = (String::new(), name);
    while let Some(at) = rest.find('#') {
        let width = rest[at..].bytes().take_while(|&b| b == b'#').count();
        let sign = if number < 0 { "-" } else { "" };
        made += &format!("{}{sign}{:0width$}", &rest[..at], number.unsigned_abs());
        rest = &rest[at + width..];
    }
    (rest.len() < name.len()).then(|| pattern.with_file_name(made + rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(text: &str) -> Vec<i32> {
        text.parse::<Frames>().unwrap().0
    }

    #[test]
    fn ranges_are_those_of_renderers_and_of_open_job_description() {
        assert_eq!(frames("7"), [7]);
        assert_eq!(frames("1-4"), [1, 2, 3, 4]);
        assert_eq!(frames("1-6x2"), [1, 3, 5]);
        assert_eq!(frames("1-6:2"), [1, 3, 5]);
        assert_eq!(frames("3-1:-1"), [3, 2, 1]);
        assert_eq!(frames("-3--1"), [-3, -2, -1]);
        assert_eq!(frames("-1-1"), [-1, 0, 1]);
        assert_eq!(frames("5, 1-3,2-4"), [5, 1, 2, 3, 4]);
        for (wrong, word) in [
            ("", "no range"),
            ("a", "no range"),
            ("1-", "no range"),
            ("1-5y2", "no range"),
            ("1-5x0", "no range"),
            ("1-5x2x2", "no range"),
            ("5-1", "5-1:-1"),
            ("1-5:-1", "has no frame"),
            ("-2147483648-2147483647", "more than"),
            ("99999999999", "no range"),
        ] {
            let said = wrong.parse::<Frames>().unwrap_err();
            assert!(said.contains(word), "{wrong}: {said}");
        }
    }

    #[test]
    fn days_have_both_ends_and_may_pass_midnight() {
        let day = |text: &str| text.parse::<Day>().map(|day| (day.from, day.step, day.count));
        assert_eq!(day("05:00..19:00/10min"), Ok((18_000.0, 600.0, 85)));
        assert_eq!(day("05:00..05:25/10min"), Ok((18_000.0, 600.0, 3)));
        assert_eq!(day("12:00..12:00/1h"), Ok((43_200.0, 3600.0, 1)));
        assert_eq!(day("22:30:30..01:30:30/0.5h"), Ok((81_030.0, 1800.0, 7)));
        assert_eq!(day("00:00..24:00/1h"), Ok((0.0, 3600.0, 25)));
        for wrong in [
            "05:00",
            "05:00..19:00",
            "5..19/1h",
            "05:60..06:00/1h",
            "24:01..06:00/1h",
            "05:00..06:00/0s",
            "05:00..06:00/10",
        ] {
            assert!(day(wrong).is_err(), "{wrong}");
        }
        assert!(day("05:00..06:00/-1h").is_err_and(|said| said.contains("10min")));
    }

    #[test]
    fn names_are_padded() {
        let name =
            |pattern: &str, number| numbered(Path::new(pattern), number).map(|p| p.display().to_string());
        assert_eq!(name("a/f####.exr", 7), Some("a/f0007.exr".into()));
        assert_eq!(name("f####.exr", -7), Some("f-0007.exr".into()));
        assert_eq!(name("f##.exr", 12345), Some("f12345.exr".into()));
        assert_eq!(name("#-###.png", 3), Some("3-003.png".into()));
        assert_eq!(name("a###/f.exr", 7), None);
    }
}
