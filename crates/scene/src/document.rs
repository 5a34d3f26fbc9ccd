//! The text of a scene file, and places in it that errors can name.

use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

use crate::{Error, Warning};

/// A TOML text with the name that messages call it by.
#[derive(Debug)]
pub(crate) struct Document<'t> {
    /// The whole file.
    pub(crate) text: &'t str,
    /// For messages.
    pub(crate) path: PathBuf,
    /// Relative names in the file start here.
    pub(crate) folder: PathBuf,
}

/// One step from the root of the file to a value.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Step {
    Key(String),
    Index(usize),
}

/// A value in a scene file, named by the way to it; it need not exist (a key that is missing).
#[derive(Clone, Debug)]
pub(crate) struct Spot<'d> {
    pub(crate) document: &'d Document<'d>,
    way: Vec<Step>,
}

impl Document<'_> {
    /// The file as a whole.
    pub(crate) fn root(&self) -> Spot<'_> {
        Spot { document: self, way: Vec::new() }
    }

    /// What serde or the TOML parser found, with line, column, table and key.
    pub(crate) fn syntax(&self, error: &toml::de::Error) -> Error {
        let what = error.message().trim_end().replace('\n', "; ");
        let Some(span) = error.span() else {
            return Error::File { path: self.path.clone(), place: String::new(), what };
        };
        let mut place = self.line_column(span.start);
        if let Ok(root) = DeTable::parse(self.text) {
            let mut way = Vec::new();
            descend(root.get_ref(), span.start, &mut way);
            let name = describe(&way);
            if !name.is_empty() {
                place = format!("{place}, {name}");
            }
        }
        Error::File { path: self.path.clone(), place, what }
    }

    /// `line 3, column 7` of a byte offset, both from 1, columns in characters.
    fn line_column(&self, offset: usize) -> String {
        let before = self.text.get(..offset).unwrap_or(self.text);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |line| line.chars().count()) + 1;
        format!("line {line}, column {column}")
    }
}

impl Spot<'_> {
    /// The value under the key `name` of this table.
    pub(crate) fn key(&self, name: &str) -> Self {
        let mut way = self.way.clone();
        way.push(Step::Key(name.to_owned()));
        Self { document: self.document, way }
    }

    /// The element `index` (from 0) of this array.
    pub(crate) fn index(&self, index: usize) -> Self {
        let mut way = self.way.clone();
        way.push(Step::Index(index));
        Self { document: self.document, way }
    }

    /// An error at this place.
    pub(crate) fn error(&self, what: impl Into<String>) -> Error {
        Error::File { path: self.document.path.clone(), place: self.place(), what: what.into() }
    }

    /// A warning at this place.
    pub(crate) fn warning(&self, what: impl Into<String>) -> Warning {
        let place = self.place();
        let file = self.document.path.display();
        let place = if place.is_empty() { file.to_string() } else { format!("{file}: {place}") };
        Warning { place, what: what.into() }
    }

    /// The file that a key names, relative to the scene file's folder.
    pub(crate) fn file(&self, name: &Path) -> PathBuf {
        self.document.folder.join(name)
    }

    /// `line 12, column 1, [[light]] 2, key "file"`.
    fn place(&self) -> String {
        let name = describe(&self.way);
        match self.offset() {
            Some(offset) if !self.way.is_empty() => {
                format!("{}, {name}", self.document.line_column(offset))
            }
            _ => name,
        }
    }

    /// Byte offset of the value, or of the nearest thing around it that exists.
    fn offset(&self) -> Option<usize> {
        let root = DeTable::parse(self.document.text).ok()?;
        let mut offset = None;
        let mut table = Some(root.get_ref());
        let mut array = None;
        for step in &self.way {
            let value = match step {
                Step::Key(key) => table.and_then(|t: &DeTable| t.get(key.as_str())),
                Step::Index(index) => array.and_then(|a: &toml::de::DeArray| a.get(*index)),
            };
            let Some(value) = value else { break };
            offset = Some(value.span().start);
            table = value.get_ref().as_table();
            array = value.get_ref().as_array();
        }
        offset
    }
}

/// The way to the deepest value of `table` whose key or text contains the byte at `offset`.
fn descend(table: &DeTable<'_>, offset: usize, way: &mut Vec<Step>) {
    // The header of a table stands before its body, so the last child that starts at or before the
    // offset is the one that contains it, if any does.
    let candidate = table
        .iter()
        .filter_map(|(key, value)| {
            Some((start_before(key.span().start, value.get_ref(), offset)?, key, value))
        })
        .max_by_key(|(start, ..)| *start);
    let Some((_, key, value)) = candidate else { return };
    way.push(Step::Key(key.get_ref().to_string()));
    match value.get_ref() {
        DeValue::Table(table) => descend(table, offset, way),
        DeValue::Array(array) => {
            let element = array.iter().enumerate().rfind(|(_, element)| element.span().start <= offset);
            if let Some((index, element)) = element
                && let DeValue::Table(table) = element.get_ref()
            {
                way.push(Step::Index(index));
                descend(table, offset, way);
            }
        }
        _ => {}
    }
}

/// Where the last part of a value begins that begins at or before `offset`: tables may be continued
/// further down, so their children count.
fn start_before(key: usize, value: &DeValue<'_>, offset: usize) -> Option<usize> {
    let own = (key <= offset).then_some(key);
    let children = match value {
        DeValue::Table(table) => table
            .iter()
            .filter_map(|(key, value)| start_before(key.span().start, value.get_ref(), offset))
            .max(),
        DeValue::Array(array) => array
            .iter()
            .filter(|element| element.get_ref().is_table())
            .filter_map(|element| start_before(element.span().start, element.get_ref(), offset))
            .max(),
        _ => None,
    };
    own.max(children)
}

/// `[[light]] 2, key "spectrum.3"`: counted from 1, as people do.
fn describe(way: &[Step]) -> String {
    let rest = |steps: &[Step]| {
        let names = steps.iter().map(|step| match step {
            Step::Key(key) => key.clone(),
            Step::Index(index) => (index + 1).to_string(),
        });
        let key = names.collect::<Vec<_>>().join(".");
        if key.is_empty() { key } else { format!(", key {key:?}") }
    };
    match way {
        [] => String::new(),
        [Step::Key(table), Step::Index(index), steps @ ..] => {
            format!("[[{table}]] {}{}", index + 1, rest(steps))
        }
        [Step::Key(table), steps @ ..] => format!("[{table}]{}", rest(steps)),
        [Step::Index(_), ..] => rest(way),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str =
        "[site]\nlatitude = 1\n\n[[light]]\nname = \"ä\"\n\n[[light]]\n  spectrum = [[1, 2],\n [3, 4]]\n";

    fn document() -> Document<'static> {
        Document { text: TEXT, path: "a.toml".into(), folder: "".into() }
    }

    #[test]
    fn places_have_line_column_table_and_key() {
        let document = document();
        let light = document.root().key("light").index(1);
        let error = light.key("spectrum").index(1).error("falls");
        assert_eq!(error.to_string(), "a.toml: line 9, column 2, [[light]] 2, key \"spectrum.2\": falls");
        let missing = light.key("position").error("is missing");
        assert_eq!(
            missing.to_string(),
            "a.toml: line 7, column 1, [[light]] 2, key \"position\": is missing"
        );
        assert_eq!(document.root().error("is empty").to_string(), "a.toml: is empty");
    }

    #[test]
    fn the_way_to_an_offset_is_found_back() {
        let root = DeTable::parse(TEXT).unwrap();
        let way_at = |needle: &str| {
            let mut way = Vec::new();
            descend(root.get_ref(), TEXT.find(needle).unwrap(), &mut way);
            describe(&way)
        };
        assert_eq!(way_at("latitude"), "[site], key \"latitude\"");
        assert_eq!(way_at("name"), "[[light]] 1, key \"name\"");
        assert_eq!(way_at("3, 4"), "[[light]] 2, key \"spectrum\"");
    }
}
