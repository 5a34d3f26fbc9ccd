//! Measured skies: what is read, and what is wrong with what is not.

use std::path::{Path, PathBuf};

use keikan_scene::sky_table::{SkyTable, parse};
use keikan_scene::{Error, Scene};
use proptest::prelude::*;

const WHOLE: &str = "# a note\n\nalt,0,90,180,270\n0,1,2,3,4\n45,5,6,7,8\n90,9,9,9,9\n";

fn read(text: &str) -> Result<SkyTable, Error> {
    parse(text.as_bytes(), Path::new("a.csv"))
}

#[test]
fn commas_semicolons_tabs_and_blanks_separate() {
    let table = read(WHOLE).unwrap();
    assert_eq!(table.altitudes, [0.0, 45.0, 90.0]);
    assert_eq!(table.azimuths, [0.0, 90.0, 180.0, 270.0]);
    assert_eq!(table.luminances, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 9.0, 9.0, 9.0]);
    for separator in [";", "\t", " ", "  ", " ; ", ", "] {
        assert_eq!(read(&WHOLE.replace(',', separator)).unwrap(), table, "{separator:?}");
    }
    assert_eq!(read(&format!("\u{feff}{}", WHOLE.replace('\n', "\r\n"))).unwrap(), table);
    assert_eq!(read(&WHOLE.replace("45,5", "45,\"5\"")).unwrap(), table);
}

#[test]
fn errors_name_line_and_column() {
    for (from, to, expected) in [
        (
            "45,5,6",
            "45,5,x",
            "a.csv: line 5, column 3: luminance at altitude 45°, azimuth 90°: \"x\" is not a number",
        ),
        (
            "45,5,6",
            "45,5,-6",
            "line 5, column 3: luminance at altitude 45°, azimuth 90°: -6 is not within [0, ",
        ),
        ("45,5,6", "45,5,", "line 5, column 3: luminance at altitude 45°, azimuth 90°: \"\" is not a number"),
        ("45,5,6", "45,nan,6", "line 5, column 2: luminance at altitude 45°, azimuth 0°: \"nan\" is not"),
        ("45,5,6", "45,1e99,6", "line 5, column 2: luminance"),
        ("45,5,6", "45,5", "line 5, column 5: 3 luminances stand beside 4 azimuths"),
        ("45,5,6", "45,5,6,6", "line 5, column 6: 5 luminances stand beside 4 azimuths"),
        ("45,", "0,", "line 5, column 1: altitude: 0 does not rise"),
        ("45,", "50,", "line 5, column 1: altitude: too few rows: 50 is more than 45° above 0"),
        ("90,9", "91,9", "line 6, column 1: altitude: 91 is not within [0, 90]"),
        ("90,9", "up,9", "line 6, column 1: altitude: \"up\" is not a number"),
        ("90,9,9,9,9\n", "", "line 5, column 1: too few rows: 2 altitudes do not reach"),
        ("0,1,2,3,4\n45,5,6,7,8\n90,9,9,9,9\n", "", "line 3, column 1: too few rows: 0 altitudes"),
        ("180,270", "180,180", "line 3, column 5: azimuth: 180 does not rise"),
        ("180,270", "180,360", "line 3, column 5: azimuth: 360° is 0° once more"),
        ("180,270", "180,north", "line 3, column 5: azimuth: \"north\" is not a number"),
        ("0,90,180,270", "0,90,180,210", "line 3: 4 azimuths do not cover the circle: 150° lie between"),
        ("alt,0,90,180,270", "alt", "line 3: 0 azimuths do not cover the circle: 360°"),
        (WHOLE, "", "a.csv: has no line of azimuths"),
        (WHOLE, "alt,0,90,180,270\n0,0,0,0,0\n45,0,0,0,0\n90,0,0,0,0", "a.csv: is a sky without any light"),
    ] {
        let said = read(&WHOLE.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(said.contains(expected), "{said}\n  expected {expected}");
    }
    let said = parse(b"alt,0\n\xff\xff", Path::new("a.csv")).unwrap_err().to_string();
    assert!(said.starts_with("a.csv: line 2: is not UTF-8"), "{said}");
}

/// A folder of this test's own, gone when it ends.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("keikan-sky-{}-{test}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// A scene beside a table.
    fn scene(&self, table: &str, text: &str) -> Result<Scene, Error> {
        std::fs::write(self.0.join("sky.csv"), table).unwrap();
        keikan_scene::parse(text, &self.0, Path::new("a.toml"))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_scene_takes_its_sky_from_a_table() {
    let folder = Folder::new("table");
    let sky = folder.scene(WHOLE, "[sky]\ntable = 'sky.csv'\nilluminance = 5000\n").unwrap().sky.unwrap();
    assert_eq!((sky.model.as_str(), sky.illuminance), ("measured", Some(5000.0)));
    assert_eq!(*sky.table.unwrap(), read(WHOLE).unwrap());
    let named = folder.scene(WHOLE, "[sky]\nmodel = 'measured'\ntable = 'sky.csv'\n").unwrap();
    assert!(named.sky.is_some_and(|sky| sky.table.is_some()));
    for (text, expected) in [
        ("table = 'no.csv'", "named in a.toml: line 2, column 9, [sky], key \"table\""),
        (
            "table = 'sky.csv'\nmodel = 'clear'",
            "line 3, column 9, [sky], key \"model\": \"clear\" is not possible beside table",
        ),
        (
            "table = 'sky.csv'\nweather = 'a.epw'",
            "line 3, column 11, [sky], key \"weather\": is not possible beside table",
        ),
        ("model = 'measured'", "line 2, column 9, [sky], key \"model\": \"measured\" needs a table"),
    ] {
        let said = folder.scene(WHOLE, &format!("[sky]\n{text}\n")).unwrap_err().to_string();
        assert!(said.contains(expected), "{said}\n  expected {expected}");
    }
    let said =
        folder.scene(&WHOLE.replace("45,5", "45,?"), "[sky]\ntable = 'sky.csv'").unwrap_err().to_string();
    assert!(said.contains("sky.csv: line 5, column 2: "), "{said}");
    let huge = "#".repeat((16 << 20) + 1);
    let said = folder.scene(&huge, "[sky]\ntable = 'sky.csv'").unwrap_err().to_string();
    assert!(said.ends_with("sky.csv: is longer than 16 MiB"), "{said}");
}

proptest! {
    /// Mutated tables are read or refused, never a panic; what is read is sound.
    #[test]
    fn mutations_never_panic(at in 0..WHOLE.len(), cut in 0usize..9, insert in "[-0-9,;\t e.\n#\"äx]{0,4}") {
        let end = (at + cut).min(WHOLE.len());
        if let Ok(table) = read(&format!("{}{insert}{}", &WHOLE[..at], &WHOLE[end..])) {
            prop_assert_eq!(table.luminances.len(), table.altitudes.len() * table.azimuths.len());
            prop_assert!(table.luminances.iter().all(|l| l.is_finite() && *l >= 0.0));
            prop_assert!(table.altitudes.windows(2).all(|pair| pair[0] < pair[1]));
            prop_assert!(table.azimuths.iter().all(|a| (0.0..360.0).contains(a)));
        }
    }
}
