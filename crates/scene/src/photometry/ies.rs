//! IES LM-63, editions 1986, 1991, 1995, 2002 and 2019.
//!
//! Lines of words up to `TILT=`, then numbers however wrapped: lamps, lumens per lamp (−1: absolute
//! photometry), multiplier, counts of vertical and horizontal angles, type (1 C, 2 B, 3 A), unit (1 feet,
//! 2 metres), width, length, height of the opening, ballast factor, a second factor, watts, the vertical
//! angles, the horizontal ones, the candela, vertical angles running fastest.
//!
//! The second factor is the ballast-lamp photometric factor in 1986 and 1991 and is applied; it is reserved
//! in 1995 and 2002 and tells how the file was made in 2019, so there it is not.

use super::colour_temperature;
use super::goniometer::{Goniometer, Kind};
use super::numbers::{Comma, Numbers};
use super::planes::{Symmetry, Table};
use super::{Fault, MAX_INTENSITIES, Notes, Opening, Photometry};

/// How a lamp's flux changes with the luminaire's tilt (`TILT=INCLUDE`).
#[derive(Clone, Debug, PartialEq)]
pub struct Tilt {
    /// How the lamp lies: 1 base up or down, 2 along C0–C180, 3 along C90–C270; each when the luminaire looks
    /// down.
    pub geometry: usize,
    /// Tilt of the luminaire \[degrees\] and the factor on its intensities there.
    pub factors: Vec<(f32, f32)>,
}

/// Editions, as far as they differ.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Edition {
    Before1995,
    Of1995,
    Of2002,
    Of2019,
}

/// Whether this is the line that ends the words: `TILT=NONE`, in whatever case.
pub(super) fn is_tilt_line(line: &str) -> bool {
    tilt_of(line).is_some()
}

/// What follows `TILT=`.
fn tilt_of(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let rest = line.get(..4).filter(|word| word.eq_ignore_ascii_case("TILT")).map(|_| &line[4..])?;
    rest.trim_start().strip_prefix('=').map(str::trim)
}

/// The words of a file, up to `TILT=`.
struct Header<'a> {
    edition: Edition,
    keywords: Vec<(&'a str, &'a str)>,
    tilt: &'a str,
    numbers: Numbers<'a>,
}

impl<'a> Header<'a> {
    fn of(text: &'a str) -> Result<Self, Fault> {
        let mut edition = Edition::Before1995; // 1986 has no first line of its own
        let mut keywords = Vec::new();
        let mut rest = text;
        let mut line_number = 0;
        while !rest.is_empty() {
            let (line, after) = rest.split_once('\n').unwrap_or((rest, ""));
            (rest, line_number) = (after, line_number + 1);
            if let Some(tilt) = tilt_of(line) {
                let numbers = Numbers::new(rest, line_number + 1, Comma::Separates);
                return Ok(Self { edition, keywords, tilt, numbers });
            }
            if line_number == 1 {
                edition = edition_of(line);
            }
            if let Some((keyword, value)) =
                line.trim().strip_prefix('[').and_then(|line| line.split_once(']'))
            {
                keywords.push((keyword.trim(), value.trim()));
            }
        }
        Err(Fault::new(line_number, "the file ends without a line TILT=NONE, TILT=INCLUDE or TILT=<file>"))
    }

    /// The value of the first keyword that is there and has one.
    fn value(&self, keywords: &[&str]) -> String {
        let of = |name: &&str| {
            let given =
                self.keywords.iter().find(|(key, value)| key.eq_ignore_ascii_case(name) && !value.is_empty());
            given.map(|(_, value)| (*value).to_owned())
        };
        keywords.iter().find_map(of).unwrap_or_default()
    }

    /// From a keyword meant for it, or else from any that writes it with its unit.
    fn colour_temperature(&self) -> Option<f64> {
        let meant = |key: &str| {
            let key = key.to_ascii_uppercase();
            ["CCT", "COLORTEMP", "COLOURTEMP"].iter().any(|name| key.contains(name))
        };
        let field = self.keywords.iter().filter(|(key, _)| meant(key));
        field
            .clone()
            .find_map(|(_, value)| colour_temperature::in_field(value))
            .or_else(|| self.keywords.iter().find_map(|(_, value)| colour_temperature::with_unit(value)))
    }
}

fn edition_of(first_line: &str) -> Edition {
    let line = first_line.to_ascii_uppercase();
    let names = |words: &[&str]| words.iter().any(|word| line.contains(word));
    match () {
        () if !line.trim_start().starts_with("IES") => Edition::Before1995,
        // Only 2019 and what may follow it call the society IES.
        () if line.trim_start().starts_with("IES:") || names(&["LM-63-2019"]) => Edition::Of2019,
        () if names(&["LM-63-2002", "LM-63-02"]) => Edition::Of2002,
        () if names(&["LM-63-1995", "LM-63-95"]) => Edition::Of1995,
        () => Edition::Before1995,
    }
}

/// The numbers between `TILT=` and the angles.
struct Quantities {
    rated_lumens: Option<f64>,
    factor: f64,
    verticals: usize,
    horizontals: usize,
    kind: usize,
    opening: Opening,
    watts: f64,
}

/// Reads LM-63 text; line ends are `\n`.
pub(super) fn parse(text: &str, notes: &mut Notes) -> Result<Photometry, Fault> {
    let mut header = Header::of(text)?;
    let tilt = tilt(&mut header, notes)?;
    let Quantities { rated_lumens, factor, verticals, horizontals, kind, opening, watts } =
        quantities(&mut header, notes)?;
    let numbers = &mut header.numbers;
    // The editions give types A and B ±90° of either; CIE's B planes and A planes go all the way round.
    let [(v_low, v_high), (h_low, h_high)] = match kind {
        1 => [(0.0, 180.0), (0.0, 360.0)],
        2 => [(-180.0, 180.0), (-90.0, 90.0)],
        _ => [(-90.0, 90.0), (-180.0, 180.0)],
    };
    let vertical = numbers.angles(verticals, "vertical angle", v_low, v_high)?;
    let horizontal = numbers.angles(horizontals, "horizontal angle", h_low, h_high)?;
    let line = numbers.line();
    note_gaps(&vertical, kind, line, notes);
    let intensity = numbers.list(verticals * horizontals, "an intensity")?;
    let table = match kind {
        1 => {
            let symmetry = symmetry(&horizontal, line, notes)?;
            Table { c: horizontal, gamma: vertical, intensity }.completed(symmetry, 0.0)
        }
        _ if horizontals < 2 => {
            return Err(Fault::new(line, "one horizontal angle; types A and B have 0 to 90 or −90 to 90"));
        }
        2 => Goniometer { kind: Kind::B, horizontal, vertical, intensity }.by_c_and_gamma(),
        _ => {
            notes.add(
                line,
                "type A: the beam's axis (H = 0, V = 0) is C = 0, γ = 90°, square to the lamp's axis",
            );
            Goniometer { kind: Kind::A, horizontal, vertical, intensity }.by_c_and_gamma()
        }
    };
    let distribution = table.distribution(factor, line, notes)?;
    if let Some(word) = header.numbers.word() {
        let word: String = word.chars().take(20).collect();
        notes.add(
            header.numbers.line(),
            format!("{word:?} and what follows is more than announced; not read"),
        );
    }
    let flux = distribution.total_flux();
    // A coarse table may integrate to a little more than its lamps give; a tenth more is another lamp.
    if let Some(lumens) = rated_lumens.filter(|lumens| flux > 1.1 * lumens) {
        notes.add(
            line,
            format!("the intensities make {flux:.0} lm, more than the {lumens:.0} lm of the lamps"),
        );
    }
    Ok(Photometry {
        name: header.value(&["LUMINAIRE", "LUMCAT", "TEST"]),
        manufacturer: header.value(&["MANUFAC"]),
        distribution,
        flux,
        rated_lumens,
        watts: (watts > 0.0).then_some(watts),
        opening,
        colour_temperature: header.colour_temperature(),
        tilt,
        warnings: Vec::new(),
    })
}

fn tilt(header: &mut Header, notes: &mut Notes) -> Result<Option<Tilt>, Fault> {
    let line = header.numbers.line() - 1;
    match header.tilt.to_ascii_uppercase().as_str() {
        "NONE" => Ok(None),
        "" => {
            notes.add(line, "TILT= says nothing; taken as NONE");
            Ok(None)
        }
        "INCLUDE" => {
            let numbers = &mut header.numbers;
            let geometry = numbers.whole("the lamp's geometry", 1..=3)?;
            let count = numbers.whole("the count of tilt angles", 1..=MAX_INTENSITIES)?;
            let angles = numbers.list(count, "a tilt angle")?;
            let factors = numbers.list(count, "a tilt factor")?;
            notes.add(
                line,
                "the factors of TILT=INCLUDE are kept but not applied; intensities are those of the test",
            );
            Ok(Some(Tilt { geometry, factors: angles.into_iter().zip(factors).collect() }))
        }
        _ => {
            let file: String = header.tilt.chars().take(60).collect();
            notes.add(
                line,
                format!("the tilt factors in {file:?} are not read; intensities are those of the test"),
            );
            Ok(None)
        }
    }
}

fn quantities(header: &mut Header, notes: &mut Notes) -> Result<Quantities, Fault> {
    let edition = header.edition;
    let numbers = &mut header.numbers;
    let lamps = numbers.number("the number of lamps")?;
    let lumens = numbers.number("lumens per lamp")?;
    let multiplier = numbers.number("the multiplier")?;
    let verticals = numbers.whole("the count of vertical angles", 2..=MAX_INTENSITIES)?;
    let horizontals = numbers.whole("the count of horizontal angles", 1..=MAX_INTENSITIES)?;
    if verticals.checked_mul(horizontals).is_none_or(|count| count > MAX_INTENSITIES) {
        let what = format!("{verticals} × {horizontals} intensities; at most {MAX_INTENSITIES} are read");
        return Err(Fault::new(numbers.line(), what));
    }
    let kind = numbers.whole("the photometric type (1 is C, 2 is B, 3 is A)", 1..=3)?;
    let metres = [0.3048, 1.0][numbers.whole("the unit (1 is feet, 2 is metres)", 1..=2)? - 1];
    let [mut width, mut length, mut height] = [0.0; 3];
    for (size, what) in [(&mut width, "width"), (&mut length, "length"), (&mut height, "height")] {
        *size = numbers.number(&format!("the opening's {what}"))? * metres;
    }
    let opening = Opening::from_lm63(width, length, height, edition >= Edition::Of2002);
    let ballast = numbers.number("the ballast factor")?;
    let second = numbers.number("the second factor (ballast-lamp, reserved, or file generation type)")?;
    let line = numbers.line();
    let watts = numbers.number("the watts")?;
    let factor = match edition {
        Edition::Before1995 => multiplier * ballast * second,
        _ => multiplier * ballast,
    };
    if matches!(edition, Edition::Of1995 | Edition::Of2002) && second != 1.0 {
        notes.add(
            line,
            format!("{second} stands in the reserved place after the ballast factor; not applied"),
        );
    }
    let rated = (lumens >= 0.0 && lamps > 0.0).then_some(lamps * lumens);
    Ok(Quantities { rated_lumens: rated, factor, verticals, horizontals, kind, opening, watts })
}

/// The symmetry that the horizontal angles of type C tell.
fn symmetry(c: &[f32], line: usize, notes: &mut Notes) -> Result<Symmetry, Fault> {
    // Files round angles to two decimals at worst.
    let is = |angle: f32, value: f32| (angle - value).abs() < 0.01;
    let (first, last) = (c[0], c[c.len() - 1]);
    if c.len() == 1 {
        return Ok(Symmetry::Axial);
    }
    if is(first, 90.0) && is(last, 270.0) {
        return Ok(Symmetry::AcrossC90);
    }
    if is(first, 0.0) && is(last, 90.0) {
        return Ok(Symmetry::Quadrants);
    }
    if is(first, 0.0) && is(last, 180.0) {
        return Ok(Symmetry::AcrossC0);
    }
    if is(first, 0.0) && last > 180.0 {
        if !is(last, 360.0) {
            notes.add(line, format!("horizontal angles end at {last}°; linear from there to those of 0°"));
        }
        return Ok(Symmetry::None);
    }
    let what = format!(
        "horizontal angles go from {first} to {last}°; type C has 0 alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360"
    );
    Err(Fault::new(line, what))
}

/// Says where nothing was measured although the editions ask for it.
fn note_gaps(vertical: &[f32], kind: usize, line: usize, notes: &mut Notes) {
    let (first, last) = (vertical[0], vertical[vertical.len() - 1]);
    let whole = match kind {
        1 => [0.0, 90.0].contains(&first) && [90.0, 180.0].contains(&last),
        _ => first <= -90.0 && last >= 90.0,
    };
    if !whole {
        notes.add(line, format!("vertical angles go from {first} to {last}°; dark outside"));
    }
}
