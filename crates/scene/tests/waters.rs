//! `[[water]]`: what it becomes, and what errors say.

use std::path::Path;

use keikan_scene::{Error, Scene, parse};

fn read(text: &str) -> Result<Scene, Error> {
    parse(text, Path::new(""), Path::new("a.toml"))
}

#[test]
fn a_surface_is_level_and_looks_up_whichever_way_it_is_drawn() {
    for points in [
        "[0, 1.5, 0], [0, 1.5, 4], [6, 1.5, 4], [6, 1.5, 0]",
        "[6, 1.5, 0], [6, 1.5, 4], [0, 1.5, 4], [0, 1.5, 0]",
    ] {
        let scene = read(&format!("[[water]]\npolygon = {{ points = [{points}] }}\n")).unwrap();
        let water = &scene.waters[0];
        assert_eq!((water.name.as_str(), water.quality.as_str(), water.index), ("water-1", "pool", None));
        assert_eq!(water.level(), 1.5);
        let corner = |i: u32| water.surface.positions[i as usize];
        let up = |[a, b, c]: &[u32; 3]| 0.5 * (corner(*b) - corner(*a)).cross(corner(*c) - corner(*a)).y;
        let areas: Vec<f32> = water.surface.triangles.iter().map(up).collect();
        // Whole metres: exact.
        assert!(areas.iter().all(|&area| area > 0.0) && areas.iter().sum::<f32>() == 24.0, "{areas:?}");
    }
}

#[test]
fn a_surface_that_is_none_is_named() {
    for (water, expected) in [
        (
            "polygon = { points = [[0, 0, 0], [0, 0, 4], [6, 0.2, 4]] }",
            "water is level: its surface lies at y = 0, but the corner [6, 0.2, 4]",
        ),
        ("polygon = { points = [[0, 0, 0], [0, 0, 4]] }", "polygon"),
        ("polygon = { points = [[0, 0, 0], [4, 0, 4], [4, 0, 0], [0, 0, 4]] }", "polygon"),
        ("polygon = { points = [[0, 0, 0], [0, 0, 4], [6, 0, 4]] }\nindex = 3", "[1, 2]"),
        ("level = 0", "level"),
        ("quality = 'pool'", "polygon"),
    ] {
        let message =
            read(&format!("[[water]]\n{water}\n")).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(message.starts_with("a.toml: line ") && message.contains(expected), "{water}: {message}");
    }
}
