//! `keikan gallery`: makes again every picture of a list, such as those of the book.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Parser;
use image::{Rgb, RgbImage};
use serde::Deserialize;

use crate::Error;
use crate::args::{Cli, Command, Gallery};
use crate::command::dispatch;
use crate::output::{self, Target};

/// What pictures there are and how each is made, as the file says it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    #[serde(default)]
    picture: Vec<Picture>,
    #[serde(default)]
    sheet: Vec<Sheet>,
    #[serde(default)]
    example: Vec<Example>,
}

/// One command with `-o output` at its end.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Picture {
    output: PathBuf,
    command: Vec<String>,
    /// Commands before it, which say themselves where they write.
    #[serde(default)]
    first: Vec<Vec<String>>,
    /// How near the last try came to the picture that is there: for readers.
    #[serde(default, rename = "now")]
    _now: Option<String>,
}

/// A table of pictures: the command with each of `rows` and each of `columns`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sheet {
    output: PathBuf,
    command: Vec<String>,
    rows: Vec<Vec<String>>,
    columns: Vec<Vec<String>>,
    /// White pixels between pictures.
    gap: u8,
    #[serde(default, rename = "now")]
    _now: Option<String>,
}

/// Pictures that a program of a crate draws; only named here.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Example {
    outputs: Vec<PathBuf>,
    command: Vec<String>,
    #[serde(default, rename = "now")]
    _now: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// A list that cannot be read; what the commands say.
pub(crate) fn run(args: &Gallery) -> Result<(), Error> {
    let list = read(&args.list)?;
    let wanted = |output: &Path| {
        let name = output.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        args.only.as_ref().is_none_or(|only| name.starts_with(only.as_str()))
    };
    let mut count = 0;
    for picture in list.picture.iter().filter(|picture| wanted(&picture.output)) {
        timed(&picture.output, || {
            picture.first.iter().try_for_each(|command| keikan(command, None))?;
            keikan(&picture.command, Some(&picture.output))
        })?;
        count += 1;
    }
    for sheet in list.sheet.iter().filter(|sheet| wanted(&sheet.output)) {
        timed(&sheet.output, || sheet.make())?;
        count += 1;
    }
    for example in list.example.iter().filter(|example| example.outputs.iter().any(|output| wanted(output))) {
        eprintln!("not made here: cargo {}", example.command.join(" "));
    }
    let named = list.example.iter().any(|example| example.outputs.iter().any(|output| wanted(output)));
    if count == 0 && !named {
        let only = args.only.as_deref().unwrap_or_default();
        return Err(Error::Usage(format!(
            "{}: no picture's name begins with \"{only}\"",
            args.list.display()
        )));
    }
    eprintln!("{count} pictures made");
    Ok(())
}

fn read(path: &Path) -> Result<List, Error> {
    let wrong = |what: String| Error::Input { path: path.display().to_string(), what };
    let text = std::fs::read_to_string(path).map_err(|error| wrong(error.to_string()))?;
    toml::from_str(&text).map_err(|error| wrong(error.to_string()))
}

fn timed(output: &Path, make: impl FnOnce() -> Result<(), Error>) -> Result<(), Error> {
    let start = Instant::now();
    make().map_err(|error| match error {
        Error::Interrupted => error,
        other => Error::Content(format!("{}: {other}", output.display())),
    })?;
    eprintln!("{}: {:.1} s", output.display(), start.elapsed().as_secs_f64());
    Ok(())
}

/// Runs one command line of the program, with `-o` where its output is told.
fn keikan(command: &[String], output: Option<&Path>) -> Result<(), Error> {
    let output = output.into_iter().flat_map(|path| ["-o".into(), path.as_os_str().to_owned()]);
    let words = std::iter::once("keikan".into()).chain(command.iter().map(Into::into)).chain(output);
    let cli = Cli::try_parse_from(words)
        .map_err(|error| Error::Content(format!("keikan {}: {error}", command.join(" "))))?;
    if matches!(cli.command, Command::Gallery(_)) {
        return Err(Error::Content("a gallery in a gallery has no end".to_owned()));
    }
    dispatch(&cli.command, cli.json)
}

impl Sheet {
    fn make(&self) -> Result<(), Error> {
        let target = Target::new(&self.output)?;
        let rows = self.rows.iter().map(|row| self.row(row)).collect::<Result<Vec<_>, Error>>()?;
        let whole = self.together(&rows);
        let failed = |error: image::ImageError| Error::Output {
            path: self.output.display().to_string(),
            what: error.to_string(),
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        whole.write_to(&mut bytes, image::ImageFormat::Png).map_err(failed)?;
        output::write(&[(target, bytes.into_inner())])
    }

    /// The pictures of one row, each made beside the sheet and taken away again.
    fn row(&self, row: &[String]) -> Result<Vec<RgbImage>, Error> {
        let cell = |column: &Vec<String>| {
            let part = self.output.with_extension("part.png");
            let made = keikan(&[&self.command[..], row, column].concat(), Some(&part));
            let picture = made.and_then(|()| {
                image::open(&part).map(|picture| picture.to_rgb8()).map_err(|error| Error::Input {
                    path: part.display().to_string(),
                    what: error.to_string(),
                })
            });
            let _ = std::fs::remove_file(&part);
            picture
        };
        self.columns.iter().map(cell).collect()
    }

    fn together(&self, rows: &[Vec<RgbImage>]) -> RgbImage {
        let gap = u32::from(self.gap);
        let across = |row: &Vec<RgbImage>| row.iter().map(|cell| cell.width() + gap).sum::<u32>();
        let high = |row: &Vec<RgbImage>| row.iter().map(RgbImage::height).max().unwrap_or(0);
        let width = rows.iter().map(across).max().unwrap_or(0).saturating_sub(gap);
        let height = rows.iter().map(|row| high(row) + gap).sum::<u32>().saturating_sub(gap);
        let mut whole = RgbImage::from_pixel(width, height, Rgb([255; 3]));
        let mut y = 0;
        for row in rows {
            let mut x = 0;
            for cell in row {
                image::imageops::replace(&mut whole, cell, i64::from(x), i64::from(y));
                x += cell.width() + gap;
            }
            y += high(row) + gap;
        }
        whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sheets_have_their_pictures_in_rows() {
        let sheet = Sheet {
            output: PathBuf::new(),
            command: Vec::new(),
            rows: Vec::new(),
            columns: Vec::new(),
            gap: 2,
            _now: None,
        };
        let cell = |shade: u8| RgbImage::from_pixel(3, 4, Rgb([shade; 3]));
        let whole = sheet.together(&[vec![cell(1), cell(2)], vec![cell(3), cell(4)]]);
        assert_eq!((whole.width(), whole.height()), (8, 10));
        assert_eq!(
            [(0, 0), (5, 0), (0, 6), (7, 9), (3, 0)].map(|(x, y)| whole.get_pixel(x, y)[0]),
            [1, 2, 3, 4, 255]
        );
    }
}
