//! Numbers in running text, with the line that each stands in.

use super::Fault;

/// What a comma means.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Comma {
    /// Between two numbers (LM-63).
    Separates,
    /// The decimal sign (EULUMDAT from half of Europe).
    Decimal,
}

/// Takes one number after the other from a text, however it is wrapped into lines.
pub(super) struct Numbers<'a> {
    rest: &'a str,
    line: usize,
    comma: Comma,
}

impl<'a> Numbers<'a> {
    /// Starts at the front of `text`, which is in line `line` (counted from 1).
    pub(super) fn new(text: &'a str, line: usize, comma: Comma) -> Self {
        Self { rest: text, line, comma }
    }

    /// The line of the number taken last.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// The next word; None at the end.
    pub(super) fn word(&mut self) -> Option<&'a str> {
        let comma = self.comma;
        let between = |c: char| c.is_whitespace() || (c == ',' && comma == Comma::Separates);
        // At the end the line stays that of the last word, where a reader would look.
        let start = self.rest.find(|c| !between(c))?;
        self.line += self.rest[..start].bytes().filter(|&byte| byte == b'\n').count();
        let word = &self.rest[start..];
        let word = &word[..word.find(between).unwrap_or(word.len())];
        self.rest = &self.rest[start + word.len()..];
        Some(word)
    }

    /// The next number, finite; `what` names it in the message.
    pub(super) fn number(&mut self, what: &str) -> Result<f64, Fault> {
        let Some(word) = self.word() else {
            return Err(Fault::new(self.line, format!("the file ends where {what} should stand")));
        };
        number_in(word, self.comma).ok_or_else(|| {
            let shown: String = word.chars().take(40).collect();
            Fault::new(self.line, format!("{shown:?} is no number; {what} should stand here"))
        })
    }

    /// The next number, which must be whole and within `range`.
    pub(super) fn whole(
        &mut self,
        what: &str,
        range: std::ops::RangeInclusive<usize>,
    ) -> Result<usize, Fault> {
        let number = self.number(what)?;
        whole_in(number, &range).ok_or_else(|| {
            let (low, high) = (range.start(), range.end());
            Fault::new(
                self.line,
                format!("{what} is {number}; it can be a whole number from {low} to {high}"),
            )
        })
    }

    /// The next `count` numbers, in the range of f32.
    pub(super) fn list(&mut self, count: usize, what: &str) -> Result<Vec<f32>, Fault> {
        // Every number takes two characters, so that a count alone cannot claim memory.
        let mut list = Vec::with_capacity(count.min(self.rest.len() / 2 + 1));
        for i in 0..count {
            let number = self.number(what).map_err(|mut fault| {
                if count > 1 {
                    fault.what += &format!(" (number {} of {count})", i + 1);
                }
                fault
            })?;
            if number.abs() > f64::from(f32::MAX) {
                return Err(Fault::new(
                    self.line,
                    format!("{what} is {number:e}; at most 3.4e38 can be held"),
                ));
            }
            list.push(number as f32);
        }
        Ok(list)
    }

    /// `count` angles \[degrees\], rising, within `low` to `high`.
    pub(super) fn angles(
        &mut self,
        count: usize,
        what: &str,
        low: f32,
        high: f32,
    ) -> Result<Vec<f32>, Fault> {
        let mut angles = Vec::with_capacity(count.min(self.rest.len() / 2 + 1));
        for i in 0..count {
            let angle = self.list(1, &format!("{what} {} of {count}", i + 1))?[0];
            if !(low..=high).contains(&angle) {
                return Err(Fault::new(self.line, format!("{what} {angle} lies outside {low} to {high}°")));
            }
            if let Some(&before) = angles.last().filter(|&&before| angle <= before) {
                return Err(Fault::new(
                    self.line,
                    format!("{what} {angle} follows {before}; they must rise"),
                ));
            }
            angles.push(angle);
        }
        Ok(angles)
    }
}

/// The finite number that `word` is, if it is one.
pub(super) fn number_in(word: &str, comma: Comma) -> Option<f64> {
    let number = match comma {
        Comma::Decimal if word.contains(',') => word.replacen(',', ".", 1).parse::<f64>(),
        _ => word.parse::<f64>(),
    };
    number.ok().filter(|number| number.is_finite())
}

/// `number` as a whole number within `range`.
pub(super) fn whole_in(number: f64, range: &std::ops::RangeInclusive<usize>) -> Option<usize> {
    let fits = number.fract() == 0.0 && number >= *range.start() as f64 && number <= *range.end() as f64;
    fits.then_some(number as usize)
}
