//! What is written elsewhere about scene files holds: `docs/scene-file.md`, the examples, real models.

use std::path::Path;

use keikan_scene::{Error, load, parse, schema};

/// Every TOML block of the page is a scene file that loads (those that name files only up to the files).
#[test]
fn the_page_tells_the_truth() {
    let page = include_str!("../../../docs/scene-file.md");
    let blocks: Vec<&str> =
        page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert!(blocks.len() >= 8, "{} blocks", blocks.len());
    for block in blocks {
        match parse(block, Path::new(""), Path::new("page.toml")) {
            Ok(_) | Err(Error::Io { .. }) => {}
            Err(error) => panic!("{error}\n{block}"),
        }
    }
}

/// Every key of the schema stands on the page.
#[test]
fn the_page_names_every_key() {
    fn keys(value: &serde_json::Value, found: &mut Vec<String>) {
        if let Some(properties) = value.get("properties").and_then(|p| p.as_object()) {
            found.extend(properties.keys().cloned());
        }
        if let Some(object) = value.as_object() {
            object.values().for_each(|v| keys(v, found));
        }
    }
    let page = include_str!("../../../docs/scene-file.md");
    let mut found = Vec::new();
    keys(&schema(), &mut found);
    assert!(found.len() > 60, "{found:?}");
    let missing: Vec<_> = found.iter().filter(|key| !page.contains(key.as_str())).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Example scenes of the repository; none needs a file from elsewhere.
#[test]
fn the_examples_load_without_a_warning() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut seen = 0;
    for path in walk(&folder) {
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let scene = load(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.warnings, [], "{}", path.display());
        assert!(scene.geometry.triangle_count() + scene.solids.len() >= 4, "{}", path.display());
        seen += 1;
    }
    assert!(seen >= 10, "{seen}");
}

/// Real files, where they are to be had.
#[test]
fn models_are_scenes_of_their_own() {
    let Some(assets) = std::env::var_os("KEIKAN_ASSETS") else {
        println!("skipped: KEIKAN_ASSETS is not set");
        return;
    };
    let mut seen = 0;
    for entry in walk(Path::new(&assets)) {
        if entry.extension().is_some_and(|e| e == "glb" || e == "gltf") {
            let scene = load(&entry).unwrap_or_else(|error| panic!("{error}"));
            assert!(!scene.cameras.is_empty() && scene.sun.is_some() && scene.sky.is_some());
            println!(
                "{}: {} triangles, {:?}",
                entry.display(),
                scene.geometry.triangle_count(),
                scene.cameras[0]
            );
            seen += 1;
        }
    }
    println!("{seen} models");
}

fn walk(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.flat_map(|e| if e.path().is_dir() { walk(&e.path()) } else { vec![e.path()] }).collect()
}
