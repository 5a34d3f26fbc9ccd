//! Small photometric files of our own making, for tests that start from a file.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// A folder for the files of one test, empty of others'.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Writes a file of a test.
pub(crate) fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

/// An LM-63-2002 file of a rotationally symmetric source, `candela(γ)` at `0, step, … 180` degrees.
pub(crate) fn ies(step: usize, candela: impl Fn(f64) -> f64) -> String {
    let angles: Vec<usize> = (0..=180).step_by(step).collect();
    let mut text = format!("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} 1 1 2 0 0 0\n1 1 0\n", angles.len());
    let mut line = |values: Vec<String>| {
        for chunk in values.chunks(10) {
            writeln!(text, "{}", chunk.join(" ")).unwrap();
        }
    };
    line(angles.iter().map(usize::to_string).collect());
    line(vec!["0".to_owned()]);
    line(angles.iter().map(|&g| format!("{:.6}", candela((g as f64).to_radians()))).collect());
    text
}

/// A Lambertian source: `candela` · cos γ downwards.
pub(crate) fn lambertian(candela: f64, step: usize) -> String {
    ies(step, |gamma| (candela * gamma.cos()).max(0.0))
}
