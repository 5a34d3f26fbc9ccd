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

const SQUARE: &str =
    "[[water]]\nname = 'pond'\npolygon = { points = [[0, 0, 0], [0, 0, 4], [4, 0, 4], [4, 0, 0]] }\n";

#[test]
fn waves_run_where_they_are_sent_and_winds_come_from_where_they_blow() {
    let text = format!(
        "[site]\nlatitude = 0\nlongitude = 0\nnorth = 30\n{SQUARE}moment = 2.5\nwaves = [{{ amplitude = 0.1, wavelength = 3, direction = 60, phase = 90 }}]\n\
         wind = {{ speed = 5, fetch = 300, direction = 60, depth = 2 }}\n"
    );
    let water = read(&text).unwrap().waters[0].clone();
    let [wave] = water.waves.each[..] else { panic!("{:?}", water.waves) };
    let wind = water.waves.wind.unwrap();
    // North is 30° clockwise of −z: 60° from it is +x.
    assert!(
        (wave.toward - glam::DVec2::X).length() < 1e-15 && (wind.toward + glam::DVec2::X).length() < 1e-15
    );
    assert!((wave.phase - std::f64::consts::FRAC_PI_2).abs() < 1e-15 && water.waves.moment == 2.5);
    assert_eq!((wind.depth, wind.waves), (Some(2.0), 48));
    // Another name, another sea; the same one, the same.
    let seed = |text: &str| read(text).unwrap().waters[0].waves.wind.unwrap().seed;
    assert_eq!(seed(&text), wind.seed);
    assert_ne!(seed(&text.replace("pond", "lake")), wind.seed);
    assert_eq!(seed(&text.replace("depth = 2", "seed = 7")), 7);
    assert!(read(SQUARE).unwrap().waters[0].waves.is_calm());
}

#[test]
fn waves_that_are_none_are_named() {
    for (waves, expected) in [
        (
            "waves = [{ amplitude = -0.1, wavelength = 1 }]",
            "waves.1.amplitude\": -0.1 is not within [0, 100] m",
        ),
        (
            "waves = [{ amplitude = 0.1, wavelength = 0 }]",
            "waves.1.wavelength\": 0 is not within (0, 1000000] m",
        ),
        ("waves = [{ amplitude = 0.1, wavelength = nan }]", "wavelength"),
        ("waves = [{ amplitude = 0.1, wavelength = 1, direction = 400 }]", "[-360, 360] degrees"),
        ("waves = [{ amplitude = 0.1 }]", "wavelength"),
        ("waves = [{ amplitude = 0.1, wavelength = 1, speed = 3 }]", "speed"),
        ("wind = { speed = 0, fetch = 100 }", "wind.speed\": 0 is not within (0, 100] m/s"),
        ("wind = { speed = 5, fetch = -1 }", "wind.fetch"),
        ("wind = { speed = 5, fetch = 100, depth = 0 }", "wind.depth"),
        ("wind = { speed = 5, fetch = 100, waves = 5000 }", "wind.waves\": 5000 is not within [1, 1024]"),
        ("wind = { fetch = 100 }", "speed"),
        ("moment = inf", "moment"),
    ] {
        let message =
            read(&format!("{SQUARE}{waves}\n")).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(message.starts_with("a.toml: line ") && message.contains(expected), "{waves}: {message}");
    }
}
