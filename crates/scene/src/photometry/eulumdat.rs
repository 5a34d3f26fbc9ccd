//! EULUMDAT (Stockmar 1990; `.ldt`): one quantity a line, in fixed order.
//!
//! Intensities are in cd per 1000 lm of the lamps: I = table × conversion factor × lamp flux / 1000. The
//! light output ratio is a result of that table, not a factor on it. Lamp sets are alternatives; the first is
//! used. A negative number of lamps marks absolute photometry (DIAL and Lighting Analysts, 2009): lamp flux is the
//! luminaire's own.
//!
//! The file's C90–C270 plane holds the luminaire's length, C0–C180 goes across; in LM-63 and in
//! [`light::Distribution`] the length is along C = 0. For a street lamp C90 is the file's street side, C = 0
//! that of LM-63. Both say C = C_file − 90°.

use super::colour_temperature;
use super::numbers::{Comma, Numbers, number_in, whole_in};
use super::planes::{Symmetry, Table};
use super::{Fault, MAX_INTENSITIES, Notes, Opening, Photometry};

/// From the file's C to that of [`light::Distribution`] \[degrees\].
const TURN: f32 = -90.0;

/// Takes one line after the other.
struct Lines<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Lines<'a> {
    fn text(&mut self, what: &str) -> Result<&'a str, Fault> {
        if self.rest.is_empty() {
            return Err(Fault::new(self.line, format!("the file ends where {what} should stand")));
        }
        let (line, rest) = self.rest.split_once('\n').unwrap_or((self.rest, ""));
        (self.rest, self.line) = (rest, self.line + 1);
        Ok(line.trim())
    }

    /// A number; an empty line is 0, as files leave out what they do not know.
    fn number(&mut self, what: &str) -> Result<f64, Fault> {
        let text = self.text(what)?;
        if text.is_empty() {
            return Ok(0.0);
        }
        number_in(text, Comma::Decimal).ok_or_else(|| {
            let shown: String = text.chars().take(40).collect();
            Fault::new(self.line, format!("{shown:?} is no number; {what} should stand here"))
        })
    }

    fn whole(&mut self, what: &str, range: std::ops::RangeInclusive<usize>) -> Result<usize, Fault> {
        let number = self.number(what)?;
        whole_in(number, &range).ok_or_else(|| {
            let (low, high) = (range.start(), range.end());
            Fault::new(
                self.line,
                format!("{what} is {number}; it can be a whole number from {low} to {high}"),
            )
        })
    }

    fn skip(&mut self, count: usize, what: &str) -> Result<(), Fault> {
        (0..count).try_for_each(|_| self.text(what).map(drop))
    }
}

/// One alternative of lamps.
struct LampSet {
    absolute: bool,
    lumens: f64,
    colour_temperature: Option<f64>,
    watts: f64,
}

/// Reads EULUMDAT text; line ends are `\n`.
pub(super) fn parse(text: &str, notes: &mut Notes) -> Result<Photometry, Fault> {
    let mut lines = Lines { rest: text, line: 0 };
    let manufacturer = lines.text("the company")?.to_owned();
    lines.whole("the type", 0..=3)?;
    let isym = lines.whole("the symmetry", 0..=4)?;
    let planes = lines.whole("the number of C planes", 1..=MAX_INTENSITIES)?;
    let counts_line = lines.line;
    lines.number("the distance of C planes")?;
    let gammas = lines.whole("the number of intensities in a plane", 2..=MAX_INTENSITIES)?;
    if planes.checked_mul(gammas).is_none_or(|count| count > MAX_INTENSITIES) {
        let what = format!("{planes} × {gammas} intensities; at most {MAX_INTENSITIES} are read");
        return Err(Fault::new(lines.line, what));
    }
    lines.number("the distance of intensities in a plane")?;
    lines.text("the report's number")?;
    let name = lines.text("the luminaire's name")?.to_owned();
    lines.skip(3, "the luminaire's number, file name or date")?;
    lines.skip(3, "the luminaire's size")?;
    let opening = opening(&mut lines)?;
    lines.number("the downward flux fraction")?;
    let output_ratio = lines.number("the light output ratio")?;
    let conversion = conversion_factor(&mut lines, notes)?;
    if lines.number("the tilt during measurement")? != 0.0 {
        notes.add(
            lines.line,
            "measured tilted; the table is taken as it stands, in the luminaire's own frame",
        );
    }
    let lamp = lamp_sets(&mut lines, notes)?;
    lines.skip(10, "a direct ratio")?;
    let (table, line) = table(&mut lines, (isym, planes, gammas), counts_line, notes)?;
    let table = table.distribution(conversion, line, notes)?;
    let distribution = table.clone().scaled((per_table_unit(&lamp, table.total_flux(), line, notes)) as f32);
    if !distribution.peak().is_finite() {
        return Err(Fault::new(line, format!("intensities overflow at {} lm", lamp.lumens)));
    }
    let flux = distribution.total_flux();
    let stated = lamp.lumens * output_ratio / 100.0;
    // Tables are coarse and ratios rounded to a per cent; a tenth off is another lamp.
    if output_ratio > 0.0 && (flux - stated).abs() > 0.1 * stated {
        notes
            .add(line, format!("intensities make {flux:.0} lm, lamps and light output ratio {stated:.0} lm"));
    }
    Ok(Photometry {
        name,
        manufacturer,
        distribution,
        flux,
        rated_lumens: (!lamp.absolute).then_some(lamp.lumens),
        watts: (lamp.watts > 0.0).then_some(lamp.watts),
        opening,
        colour_temperature: lamp.colour_temperature,
        tilt: None,
        warnings: Vec::new(),
    })
}

fn opening(lines: &mut Lines) -> Result<Opening, Fault> {
    let metres = 1e-3;
    let length = lines.number("the luminous area's length")? * metres;
    let width = lines.number("the luminous area's width")? * metres;
    let mut height = 0.0_f64;
    for _ in 0..4 {
        height = height.max(lines.number("the luminous area's height")? * metres);
    }
    Ok(Opening::from_eulumdat(length, width, height))
}

fn conversion_factor(lines: &mut Lines, notes: &mut Notes) -> Result<f64, Fault> {
    let factor = lines.number("the conversion factor")?;
    if factor == 0.0 {
        notes.add(lines.line, "the conversion factor is 0; taken as 1");
        return Ok(1.0);
    }
    Ok(factor)
}

/// The first of the alternatives; the others are named in a warning.
fn lamp_sets(lines: &mut Lines, notes: &mut Notes) -> Result<LampSet, Fault> {
    let count = lines.whole("the number of lamp sets", 1..=1000)?;
    let line = lines.line;
    let mut first = None;
    let mut others = Vec::new();
    for _ in 0..count {
        let lamps = lines.number("the number of lamps")?;
        let kind = lines.text("the type of lamps")?;
        let lumens = lines.number("the lamps' flux")?;
        let lumens_line = lines.line;
        let colour_temperature = colour_temperature::in_field(lines.text("the colour appearance")?);
        lines.text("the colour rendering")?;
        let watts = lines.number("the watts")?;
        if first.is_none() {
            if lumens <= 0.0 {
                let what = format!("the lamps' flux is {lumens} lm; cd per 1000 lm need one above 0");
                return Err(Fault::new(lumens_line, what));
            }
            first = Some(LampSet { absolute: lamps < 0.0, lumens, colour_temperature, watts });
        } else if others.len() < 5 {
            let kind: String = kind.chars().take(40).collect();
            others.push(format!("{kind:?} of {lumens} lm"));
        }
    }
    if count > 1 {
        let others = others.join(", ");
        notes.add(line, format!("of {count} alternative lamp sets the first is used, not {others}"));
    }
    first.ok_or_else(|| Fault::new(line, "no lamp set"))
}

/// Candela for 1 in the table: lumens / 1000.
///
/// Absolute files are agreed to keep cd/klm, with the luminaire's own flux; some hold plain candela. The table
/// knows: its integral is 1000 lm in the first case, the stated flux in the second.
fn per_table_unit(lamp: &LampSet, table_flux: f64, line: usize, notes: &mut Notes) -> f64 {
    let off = |flux: f64| (table_flux / flux).ln().abs();
    if lamp.absolute && table_flux > 0.0 && off(lamp.lumens) < off(1000.0) {
        notes
            .add(line, "absolute photometry whose table makes the stated flux: taken as candela, not cd/klm");
        return 1.0;
    }
    lamp.lumens / 1000.0
}

/// The table in the frame of [`light::Distribution`], and the line where its intensities begin.
fn table(
    lines: &mut Lines,
    (isym, planes, gammas): (usize, usize, usize),
    counts_line: usize,
    notes: &mut Notes,
) -> Result<(Table, usize), Fault> {
    let (symmetry, first, count) = match isym {
        1 => (Symmetry::Axial, 0, 1),
        2 => (Symmetry::AcrossC0, 0, planes / 2 + 1),
        3 => (Symmetry::AcrossC90, 3 * (planes / 4), planes / 2 + 1),
        4 => (Symmetry::Quadrants, 0, planes / 4 + 1),
        _ => (Symmetry::None, 0, planes),
    };
    let divisor = [1, 1, 2, 4, 4][isym];
    if planes % divisor != 0 {
        let what = format!("{planes} C planes with symmetry {isym}, which needs a multiple of {divisor}");
        return Err(Fault::new(counts_line, what));
    }
    let mut numbers = Numbers::new(lines.rest, lines.line + 1, Comma::Decimal);
    let all = numbers.angles(planes, "C angle", 0.0, 360.0)?;
    let gamma = numbers.angles(gammas, "γ angle", 0.0, 180.0)?;
    let c: Vec<f32> = (0..count).map(|i| all[(first + i) % planes]).collect();
    let line = numbers.line();
    check_part(&c, isym, line)?;
    let intensity = numbers.list(count * gammas, "an intensity")?;
    if let Some(word) = numbers.word() {
        let word: String = word.chars().take(20).collect();
        notes.add(numbers.line(), format!("{word:?} and what follows is more than announced; not read"));
    }
    if symmetry == Symmetry::None && planes == 1 {
        notes.add(counts_line, "no symmetry, but one C plane only; it is taken for all");
    }
    Ok((Table { c, gamma, intensity }.completed(symmetry, TURN), line))
}

/// Whether the planes of a symmetric file begin and end where its symmetry asks.
fn check_part(c: &[f32], isym: usize, line: usize) -> Result<(), Fault> {
    let (from, to) = match isym {
        2 => (0.0, 180.0),
        3 => (270.0, 90.0),
        4 => (0.0, 90.0),
        _ => return Ok(()),
    };
    let (first, last) = (c[0], c[c.len() - 1]);
    // Files round angles to two decimals at worst.
    if (first - from).abs() < 0.01 && (last - to).abs() < 0.01 {
        return Ok(());
    }
    let what =
        format!("the planes of symmetry {isym} go from C {from} to {to}°, these from {first} to {last}°");
    Err(Fault::new(line, what))
}
