//! Scattered points from a text file: XYZ or CSV.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use glam::DVec3;

use crate::{Error, regular_file};

/// Points that a file may have: 2.4 GB of them.
pub const MAX_POINTS: usize = 100_000_000;
/// Characters that a line may have.
const MAX_LINE: u64 = 10_000;

/// Reads a text file of one point per line: three numbers (more are ignored), separated by blanks, tabs,
/// commas or semicolons; lines that begin with `#` or `//`, empty lines, and a first line of headings are
/// skipped.
///
/// As surveys have it, the numbers are east, north and *height*; they become x, height, −north (+Y up,
/// north is −Z).
pub fn read_points(path: &Path) -> Result<Vec<DVec3>, Error> {
    let opened = regular_file::open(path);
    let (file, _) = opened.map_err(|source| Error::Io { path: path.to_path_buf(), source })?;
    parse_points(BufReader::new(file), path)
}

/// [`read_points`] from memory or anything else; `path` is what errors call it.
///
/// ```
/// let points = keikan_scene::triangulate::parse_points("4 5 6".as_bytes(), "a.xyz".as_ref())?;
/// assert_eq!(points, [glam::DVec3::new(4.0, 6.0, -5.0)]); // east, height, −north
/// # Ok::<(), keikan_scene::Error>(())
/// ```
pub fn parse_points(mut text: impl BufRead, path: &Path) -> Result<Vec<DVec3>, Error> {
    let mut points = Vec::new();
    let mut line = Vec::new();
    for number in 1.. {
        let wrong =
            |what: String| Error::File { path: path.to_path_buf(), place: format!("line {number}"), what };
        line.clear();
        let length = (&mut text).take(MAX_LINE).read_until(b'\n', &mut line);
        let length = length.map_err(|source| Error::Io { path: path.to_path_buf(), source })?;
        if length == 0 {
            break;
        }
        if length as u64 == MAX_LINE {
            return Err(wrong(format!("is longer than {MAX_LINE} characters: this is no list of points")));
        }
        let content = String::from_utf8_lossy(&line);
        let content = content.trim_start_matches('\u{feff}').trim();
        if content.is_empty() || content.starts_with('#') || content.starts_with("//") {
            continue;
        }
        match point(content) {
            Some(point) => points.push(point),
            None if number == 1 => {}
            None => {
                let shown: String = content.chars().take(60).collect();
                return Err(wrong(format!("\"{shown}\" does not begin with three finite numbers")));
            }
        }
        if points.len() > MAX_POINTS {
            return Err(wrong(format!("more than {MAX_POINTS} points")));
        }
    }
    Ok(points)
}

fn point(line: &str) -> Option<DVec3> {
    let mut words =
        line.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|word| !word.is_empty());
    let mut number = || words.next()?.trim_matches('"').parse::<f64>().ok().filter(|x| x.is_finite());
    let (east, north, height) = (number()?, number()?, number()?);
    Some(DVec3::new(east, height, -north))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_comments_and_separators() {
        let text = "\u{feff}x;y;z\r\n# note\r\n\r\n1 2 3\n4,5, 6,extra\n\"7\";8;9e1\t\n";
        let points = parse_points(text.as_bytes(), Path::new("a.xyz")).unwrap();
        assert_eq!(
            points,
            [DVec3::new(1.0, 3.0, -2.0), DVec3::new(4.0, 6.0, -5.0), DVec3::new(7.0, 90.0, -8.0)]
        );
    }

    #[test]
    fn errors_name_the_line() {
        for text in ["1 2 3\n1 2\n", "1 2 3\nnan 0 0\n", "1 2 3\na b c"] {
            let error = parse_points(text.as_bytes(), Path::new("a.xyz")).unwrap_err().to_string();
            assert!(error.starts_with("a.xyz: line 2: "), "{error}");
        }
        let long = vec![b'1'; 20_000];
        assert!(parse_points(&long[..], Path::new("a")).is_err());
    }
}
