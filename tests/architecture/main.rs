//! The invariants of `docs/architecture.md`: mostly about what is absent; and that the pages hold together.

mod pages;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const CHAPTERS: &[&str] = &["scanline", "raytrace", "radiosity", "water", "sky", "trees", "reference"];
const OURS: &[&str] =
    &["light", "scene", "scanline", "raytrace", "radiosity", "water", "sky", "trees", "reference", "keikan"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Our own crates that the manifest of `krate` names as normal dependencies.
fn own_dependencies(krate: &str) -> BTreeSet<String> {
    let manifest = fs::read_to_string(root().join("crates").join(krate).join("Cargo.toml")).unwrap();
    let manifest: toml::Table = manifest.parse().unwrap();
    let dependencies = manifest["dependencies"].as_table().unwrap();
    dependencies.keys().filter(|name| OURS.contains(&name.as_str())).cloned().collect()
}

fn crates() -> Vec<String> {
    let folders = fs::read_dir(root().join("crates")).unwrap();
    folders.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

/// Every Rust source below `folder` but test modules, with its text.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        let is_test = path.file_stem().and_then(|s| s.to_str()).is_some_and(|s| s.ends_with("tests"));
        if is_test {
            continue;
        }
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            found.push((path, text));
        }
    }
    found
}

/// Code without comments and without what stands in `#[cfg(test)]` modules at the end of a file.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod ").next().unwrap_or(text);
    text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

#[test]
fn light_depends_on_none_of_ours() {
    assert_eq!(own_dependencies("light"), BTreeSet::new());
}

#[test]
fn chapters_and_scene_know_only_light() {
    for krate in crates().iter().filter(|k| CHAPTERS.contains(&k.as_str()) || *k == "scene") {
        assert_eq!(own_dependencies(krate), BTreeSet::from(["light".to_owned()]), "{krate}");
    }
}

#[test]
fn only_scene_and_cli_touch_the_file_system() {
    for krate in crates().iter().filter(|k| *k != "scene" && *k != "cli") {
        for (path, text) in sources(&root().join("crates").join(krate).join("src")) {
            for word in ["std::fs", "std::env", "std::net", "std::process", "File::"] {
                assert!(!code(&text).contains(word), "{} uses {word}", path.display());
            }
        }
    }
}

#[test]
fn only_assemble_names_chapters() {
    for (path, text) in sources(&root().join("crates/cli/src")) {
        if path.components().any(|part| part.as_os_str() == "assemble") {
            continue;
        }
        for chapter in CHAPTERS {
            let named = format!("{chapter}::");
            assert!(!code(&text).contains(&named), "{} names {named}", path.display());
        }
    }
}

#[test]
fn libraries_never_print_and_never_ask_the_clock() {
    for krate in crates().iter().filter(|k| *k != "cli") {
        for (path, text) in sources(&root().join("crates").join(krate).join("src")) {
            for word in ["println!", "eprintln!", "print!(", "SystemTime", "thread_rng"] {
                assert!(!code(&text).contains(word), "{} uses {word}", path.display());
            }
        }
    }
}

#[test]
fn every_crate_is_one_of_the_house() {
    for krate in crates() {
        assert!(krate == "cli" || OURS.contains(&krate.as_str()), "{krate} is not in the plan of the house");
    }
}
