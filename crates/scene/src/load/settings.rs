//! `[settings]` as a flat list of texts.

use std::collections::BTreeMap;

use crate::Error;
use crate::document::Spot;
use crate::file::{SceneFile, Setting};

/// All settings, nested tables joined with dots, and what `[sky]` has for its model as `sky.KEY`.
pub(crate) fn settings(root: &Spot<'_>, file: &SceneFile) -> Result<BTreeMap<String, String>, Error> {
    let mut flat = BTreeMap::new();
    for (key, value) in &file.settings {
        flatten(&root.key("settings").key(key), key, value, &mut flat)?;
    }
    for (key, value) in file.sky.iter().flat_map(|sky| &sky.more) {
        flatten(&root.key("sky").key(key), &format!("sky.{key}"), value, &mut flat)?;
    }
    Ok(flat)
}

fn flatten(
    spot: &Spot<'_>,
    name: &str,
    value: &Setting,
    flat: &mut BTreeMap<String, String>,
) -> Result<(), Error> {
    let text = match value {
        Setting::Table(table) => {
            return table
                .iter()
                .try_for_each(|(key, value)| flatten(&spot.key(key), &format!("{name}.{key}"), value, flat));
        }
        Setting::Switch(on) => on.to_string(),
        Setting::Whole(number) => number.to_string(),
        Setting::Number(number) if !number.is_finite() => {
            return Err(spot.error(format!("{number} is not possible: a number must be finite")));
        }
        Setting::Number(number) => number.to_string(),
        Setting::Text(text) => text.clone(),
    };
    if flat.insert(name.to_owned(), text).is_some() {
        return Err(spot.error(format!("{name} is given twice")));
    }
    Ok(())
}
