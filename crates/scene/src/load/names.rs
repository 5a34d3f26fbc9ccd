//! Names by which the user asks for one camera, reads one sensor's row or one light's layer: all different.

use std::collections::{BTreeMap, BTreeSet};

use crate::Warning;

/// Layers of a picture beside those of the lamps: a lamp may not be called so.
pub(crate) const LAYERS: [&str; 4] = ["emission", "interreflected", "sky", "sun"];

/// Changes that a warning shows.
const SHOWN: usize = 4;

/// Renames whatever has the name of an earlier one or one of `reserved`: " 2", " 3", … is appended, the first
/// that no other one has. Who came first keeps the name, so the same file always gives the same names.
///
/// `kind` is the plural that the warning speaks of, `place` where the names come from.
pub(crate) fn make_unique<'n>(
    names: impl Iterator<Item = &'n mut String>,
    reserved: &[&str],
    (kind, place): (&str, &str),
) -> Option<Warning> {
    let names: Vec<&mut String> = names.collect();
    let mut taken: BTreeSet<String> = reserved.iter().map(|name| (*name).to_owned()).collect();
    // A name that was given counts before one that is made here.
    let given: BTreeSet<String> = names.iter().map(|name| (**name).clone()).collect();
    // Where to go on counting: ten thousand lamps of one name must not be tried one by one.
    let mut next: BTreeMap<String, u64> = BTreeMap::new();
    let (mut changes, mut count) = (Vec::new(), 0);
    for name in names {
        if taken.insert(name.clone()) {
            continue;
        }
        let number = next.entry(name.clone()).or_insert(2);
        let free = loop {
            let candidate = format!("{name} {number}");
            *number += 1;
            if !given.contains(&candidate) && taken.insert(candidate.clone()) {
                break candidate;
            }
        };
        count += 1;
        if changes.len() < SHOWN {
            changes.push(format!("{name:?} → {free:?}"));
        }
        *name = free;
    }
    let more = if count > SHOWN { ", …" } else { "" };
    (count > 0).then(|| Warning {
        place: place.to_owned(),
        what: format!("{kind} whose names are taken got a number ({count}): {}{more}", changes.join(", ")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unique(names: &[&str], reserved: &[&str]) -> (Vec<String>, Option<Warning>) {
        let mut names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let warning = make_unique(names.iter_mut(), reserved, ("lights", "a.toml"));
        (names, warning)
    }

    #[test]
    fn the_first_keeps_its_name_and_given_names_stay() {
        let (names, warning) = unique(&["a", "b", "a", "a", "a 2", "a"], &[]);
        assert_eq!(names, ["a", "b", "a 3", "a 4", "a 2", "a 5"]);
        let what = "lights whose names are taken got a number (3): \"a\" → \"a 3\", \"a\" → \"a 4\", \"a\" → \"a 5\"";
        assert_eq!(warning, Some(Warning { place: "a.toml".into(), what: what.into() }));
        assert_eq!(unique(&["a", "a 2", "a 2"], &[]).0, ["a", "a 2", "a 2 2"]);
    }

    #[test]
    fn reserved_names_are_never_free() {
        assert_eq!(unique(&["sun", "sky", "sun"], &LAYERS).0, ["sun 2", "sky 2", "sun 3"]);
        assert_eq!(unique(&["sun 2", "sun"], &LAYERS).0, ["sun 2", "sun 3"]);
    }

    #[test]
    fn different_names_are_left_alone() {
        assert_eq!(unique(&["a", "b", ""], &LAYERS), (vec!["a".into(), "b".into(), String::new()], None));
    }
}
