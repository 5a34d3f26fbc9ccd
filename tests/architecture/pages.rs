//! What the pages in `docs/` lead to is there: links, pictures, chapters of the book, commands of the gallery.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::root;

/// Every page below `folder`.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(pages(&path));
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
    found
}

/// Where the links and pictures of a page lead, code left out.
fn targets(page: &str) -> Vec<&str> {
    let prose = page.split("```").step_by(2);
    let plain = prose.flat_map(|part| part.split('`').step_by(2));
    let links = plain.flat_map(|part| part.split("](").skip(1).filter_map(|rest| rest.split(')').next()));
    links.filter(|target| !target.is_empty() && !target.contains("://") && !target.starts_with('#')).collect()
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

#[test]
fn links_lead_somewhere() {
    assert_eq!(
        targets("[a](b.md#c) `[d](e)` ![](f.png)\n```\n[g](h)\n```\n[i](https://j)"),
        ["b.md#c", "f.png"]
    );
    let readme = root().join("README.md");
    for page in pages(&root().join("docs")).into_iter().chain([readme]) {
        let text = fs::read_to_string(&page).unwrap();
        assert!(text.matches('`').count() % 2 == 0, "{}: code that does not end hides links", page.display());
        for target in targets(&text) {
            let file = target.split('#').next().unwrap();
            let there = page.parent().unwrap().join(file).exists();
            assert!(there, "{} leads to {target}, which is not there", page.display());
        }
    }
}

#[test]
fn no_page_is_left_out_of_the_book() {
    let docs = root().join("docs");
    let summary = fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
    let listed: BTreeSet<PathBuf> = targets(&summary).iter().map(|target| docs.join(target)).collect();
    let there = pages(&docs).into_iter().filter(|page| name(page) != "SUMMARY.md");
    assert_eq!(listed, there.collect(), "docs/SUMMARY.md and the pages below docs");
}

/// What a page leads to must be in the book's folder: mdBook takes nothing from outside.
#[test]
fn pages_stay_within_the_book() {
    let docs = root().join("docs");
    for page in pages(&docs) {
        let text = fs::read_to_string(&page).unwrap();
        let depth = page.strip_prefix(&docs).unwrap().components().count() - 1;
        for target in targets(&text) {
            let up = target.split('/').take_while(|part| *part == "..").count();
            assert!(up <= depth, "{} leads out of docs: {target}", page.display());
        }
    }
}

#[test]
fn every_picture_has_its_command() {
    let text = fs::read_to_string(root().join("docs/gallery.toml")).unwrap();
    let gallery: toml::Table = text.parse().unwrap();
    let mut outputs = BTreeSet::new();
    for entry in gallery.values().flat_map(|entries| entries.as_array().unwrap()) {
        let command: Vec<&str> =
            entry["command"].as_array().unwrap().iter().map(|word| word.as_str().unwrap()).collect();
        for scene in command.iter().filter(|word| word.starts_with("scenes/")) {
            assert!(root().join(scene).is_file(), "{scene} is not there");
        }
        let several = entry.get("outputs").and_then(|outputs| outputs.as_array());
        for output in several.into_iter().flatten().chain(entry.get("output")) {
            assert!(outputs.insert(output.as_str().unwrap().to_owned()), "{output} is made twice");
        }
    }
    let pictures = fs::read_dir(root().join("docs/pictures")).unwrap();
    let there = pictures.map(|entry| format!("docs/pictures/{}", name(&entry.unwrap().path())));
    assert_eq!(outputs, there.collect());
}
