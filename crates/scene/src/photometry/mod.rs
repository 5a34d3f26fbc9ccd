//! Photometric files of luminaires: IES LM-63 and EULUMDAT.
//!
//! **Answers.** [`read`] and [`parse`] turn a file into one [`Photometry`]: absolute candela in the frame of
//! [`light::Distribution`] with every multiplier applied, the flux that they integrate to, and what the file
//! says of lamp and luminaire. Which of the two formats it is, the content tells.
//!
//! | | IES LM-63 (1986, 1991, 1995, 2002, 2019) | EULUMDAT (Stockmar 1990) |
//! | --- | --- | --- |
//! | intensities | cd for the rated lumens, × multiplier × ballast factor | cd/klm × lamp flux × conversion factor |
//! | planes | types C, B, A; symmetry told by the last angle | C planes, symmetry told by Isym |
//! | C = 0 | along the length | across the length, turned here |
//!
//! **Leaves out.** Near-field data, the change of a lamp's flux with its tilt (kept as [`Tilt`], not
//! applied), EULUMDAT's utilisation factors.
//!
//! ```
//! let file = b"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 -0.1 -0.1 0\n1 1 15\n0 45 90\n0\n100 80 0\n";
//! let lamp = keikan_scene::photometry::parse(file, "lamp.ies".as_ref())?;
//! assert_eq!(lamp.distribution.peak(), 100.0);
//! assert_eq!(lamp.watts, Some(15.0));
//! # Ok::<(), keikan_scene::Error>(())
//! ```

mod colour_temperature;
mod eulumdat;
mod goniometer;
mod ies;
mod numbers;
mod opening;
mod planes;

use std::path::Path;

use crate::{Error, Warning, regular_file};
pub use ies::Tilt;
pub use opening::{Opening, Shape};

/// The longest file that is read \[bytes\]: [`MAX_INTENSITIES`] numbers of sixteen characters.
pub const MAX_BYTES: u64 = 64 << 20;

/// The most intensities that a file may hold; a full sphere in steps of 0.15° has less.
pub const MAX_INTENSITIES: usize = 4 << 20;

/// What a photometric file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Photometry {
    /// The luminaire's name; empty if the file gives none.
    pub name: String,
    /// Who makes it; empty if the file does not say.
    pub manufacturer: String,
    /// Intensity \[cd\] over direction, absolute: every multiplier of the file is applied.
    pub distribution: light::Distribution,
    /// Luminous flux of the luminaire \[lm\]: the integral of `distribution`.
    pub flux: f64,
    /// Rated flux of all lamps together \[lm\]; None for absolute photometry, where no lamp can be told from
    /// its luminaire.
    pub rated_lumens: Option<f64>,
    /// Electric power, ballast included \[W\].
    pub watts: Option<f64>,
    /// The luminous opening.
    pub opening: Opening,
    /// Correlated colour temperature \[K\], if the file states one.
    pub colour_temperature: Option<f64>,
    /// How the lamp's flux changes with the luminaire's tilt. Not applied.
    pub tilt: Option<Tilt>,
    /// What was repaired, assumed or left out.
    pub warnings: Vec<Warning>,
}

/// Reads the IES LM-63 or EULUMDAT file at `path`.
pub fn read(path: &Path) -> Result<Photometry, Error> {
    let io = |source| Error::Io { path: path.to_path_buf(), source };
    // One byte more than allowed, so that `parse` sees that there is too much.
    parse(&regular_file::read(path, MAX_BYTES + 1).map_err(io)?, path)
}

/// Reads the IES LM-63 or EULUMDAT text in `bytes`; `path` is for messages, its extension decides only if the
/// content does not.
pub fn parse(bytes: &[u8], path: &Path) -> Result<Photometry, Error> {
    let fault = |fault: Fault| Error::File {
        path: path.to_path_buf(),
        place: if fault.line > 0 { format!("line {}", fault.line) } else { String::new() },
        what: fault.what,
    };
    if bytes.len() as u64 > MAX_BYTES {
        return Err(fault(Fault::new(
            0,
            format!("more than {} MiB; photometric files are small", MAX_BYTES >> 20),
        )));
    }
    let text = decoded(bytes);
    let mut notes = Notes::default();
    let photometry = match format_of(&text, path) {
        Some(Format::Ies) => ies::parse(&text, &mut notes),
        Some(Format::Eulumdat) => eulumdat::parse(&text, &mut notes),
        None => Err(Fault::new(
            0,
            "neither IES LM-63 (which has a line TILT=) nor EULUMDAT (whose lines 2 to 4 are whole numbers: \
             type 0 to 3, symmetry 0 to 4, number of C planes)",
        )),
    };
    let mut photometry = photometry.map_err(fault)?;
    let place = |line| format!("{}: line {line}", path.display());
    photometry.warnings =
        notes.0.into_iter().map(|(line, what)| Warning { place: place(line), what }).collect();
    Ok(photometry)
}

/// What is wrong with a file, and in which line; 0 for the whole of it.
#[derive(Debug)]
struct Fault {
    line: usize,
    what: String,
}

impl Fault {
    fn new(line: usize, what: impl Into<String>) -> Self {
        Self { line, what: what.into() }
    }
}

/// Warnings on the way: line and what.
#[derive(Default)]
struct Notes(Vec<(usize, String)>);

impl Notes {
    fn add(&mut self, line: usize, what: impl Into<String>) {
        self.0.push((line, what.into()));
    }
}

enum Format {
    Ies,
    Eulumdat,
}

/// The content tells; where it does not, the extension decides whose error message is shown.
fn format_of(text: &str, path: &Path) -> Option<Format> {
    if text.starts_with("IESNA") || text.starts_with("IES:") || text.lines().any(ies::is_tilt_line) {
        return Some(Format::Ies);
    }
    let whole = |line: Option<&str>, max: u32| {
        line.and_then(|line| line.trim().parse::<u32>().ok()).is_some_and(|number| number <= max)
    };
    let mut lines = text.lines().skip(1);
    if whole(lines.next(), 3) && whole(lines.next(), 4) && whole(lines.next(), u32::MAX) {
        return Some(Format::Eulumdat);
    }
    match path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("ies") => Some(Format::Ies),
        Some("ldt") => Some(Format::Eulumdat),
        _ => None,
    }
}

/// UTF-8, with or without its mark, or else Latin-1; line ends of all three systems become `\n`, and the
/// end-of-file character of DOS goes.
fn decoded(bytes: &[u8]) -> String {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    };
    let text = if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n") } else { text };
    text.trim_end_matches(['\u{1a}', '\0']).to_owned()
}
