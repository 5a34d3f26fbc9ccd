//! `[[water]]`: what it becomes, and what errors say.

use std::path::Path;

use keikan_scene::{Error, MeasuredWater, Scene, WaterPhase, WaterQuality, parse};

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
        assert_eq!((water.name.as_str(), water.scattering_times, water.index), ("water-1", 1.0, None));
        assert_eq!(water.quality, WaterQuality::Named("pool".to_owned()));
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

/// A square of 4 m at y = 0 with its quality.
fn pond(quality: &str) -> Result<Scene, Error> {
    read(&format!(
        "[[water]]\npolygon = {{ points = [[0, 0, 0], [4, 0, 0], [4, 0, 4], [0, 0, 4]] }}\n{quality}\n"
    ))
}

#[test]
fn a_water_is_given_by_what_is_known_of_it() {
    let measured = |phase| {
        WaterQuality::Measured(MeasuredWater {
            absorption: Some(vec![(450.0, 0.1), (650.0, 0.4)]),
            scattering: Some(vec![(550.0, 0.2)]),
            extinction: None,
            phase,
        })
    };
    let numbers = "absorption = [[450, 0.1], [650, 0.4]]\nscattering = [[550, 0.2]]";
    for (text, expected) in [
        ("quality = 'sea'", WaterQuality::Named("sea".to_owned())),
        ("secchi = 3", WaterQuality::Secchi(3.0)),
        ("chlorophyll = 0.5", WaterQuality::Chlorophyll(0.5)),
        (numbers, measured(WaterPhase::Petzold)),
        (&format!("{numbers}\nphase = 'molecular'"), measured(WaterPhase::Molecular)),
        (
            &format!("{numbers}\nphase = {{ forward = 0.9, backward = 0.57 }}"),
            measured(WaterPhase::BeardsleyZaneveld([0.9, 0.57])),
        ),
        (
            &format!("{numbers}\nphase = {{ index = 1.1, slope = 3.6 }}"),
            measured(WaterPhase::FournierForand([1.1, 3.6])),
        ),
        (
            &format!("{numbers}\nphase = [[0, 2], [180, 1]]"),
            measured(WaterPhase::Table(vec![(0.0, 2.0), (180.0, 1.0)])),
        ),
    ] {
        assert_eq!(pond(text).unwrap().waters[0].quality, expected, "{text}");
    }
    assert_eq!(pond("scattering_times = 200").unwrap().waters[0].scattering_times, 200.0);
}

#[test]
fn a_water_that_is_none_is_named() {
    for (text, expected) in [
        ("quality = 'sea'\nsecchi = 3", "quality and secchi at once"),
        ("absorption = [[550, 1]]", "two are needed"),
        ("absorption = []\nscattering = [[550, 1]]", "0 rows"),
        ("phase = 'petzold'", "is for water that is measured"),
        ("scattering = [[550, 1]]\nextinction = [[550, 1]]\nphase = 'milk'", "\"milk\" is unknown"),
        ("scattering_times = -1", "scattering_times"),
        ("model = 'garden'", "names none"),
    ] {
        let message = pond(text).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(message.starts_with("a.toml: line ") && message.contains(expected), "{text}: {message}");
    }
}

/// One triangle of 1 m, lying as node `pond` 0.5 m high and standing as node `bank`.
const MODEL: &str = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1] }],
  "nodes": [ { "mesh": 0, "name": "pond", "rotation": [-0.70710678118, 0, 0, 0.70710678118], "translation": [0, 0.5, 0] },
    { "mesh": 0, "name": "bank" } ],
  "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }], "materials": [{ "name": "Slime" }],
  "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }],
  "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
  "buffers": [{ "byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }] }"#;

/// What `text` is beside `garden.gltf`.
fn garden(test: &str, text: &str) -> Result<Scene, Error> {
    beside(MODEL, test, text)
}

/// What `text` is beside a `model` in `garden.gltf`.
fn beside(model: &str, test: &str, text: &str) -> Result<Scene, Error> {
    let folder = std::env::temp_dir().join(format!("keikan-waters-{}-{test}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("garden.gltf"), model).unwrap();
    let scene = parse(text, &folder, Path::new("a.toml"));
    std::fs::remove_dir_all(&folder).unwrap();
    scene
}

fn is_the_pond(scene: &Scene) {
    assert_eq!(scene.geometry.instances.len(), 1, "the bank alone");
    let water = &scene.waters[0];
    // f32 corners and a quaternion of eleven digits.
    assert!((water.level() + scene.origin.y - 1.5).abs() < 1e-6, "{}", water.level());
    let corners = |i: u32| water.surface.positions[i as usize];
    let [a, b, c] = water.surface.triangles[0].map(corners);
    let area = 0.5 * (b - a).cross(c - a).y;
    assert!((area - 0.5).abs() < 1e-6, "{area}");
    let lowest = [a, b, c].map(|corner| f64::from(corner.x) + water.place.translation.x + scene.origin.x);
    assert!(lowest.iter().all(|x| (10.0 - 1e-6..=11.0 + 1e-6).contains(x)), "{lowest:?}");
}

#[test]
fn a_node_of_a_model_becomes_a_surface_and_is_not_drawn() {
    let model = "[[model]]\nname = 'garden'\nfile = 'garden.gltf'\nposition = [10, 1, 0]\n";
    // Of the material, the bank stands on: nothing of it is level at the top.
    for wanted in ["node = 'pond'\nmodel = 'garden'", "material = 'Slime'"] {
        is_the_pond(&garden("node", &format!("{model}[[water]]\n{wanted}\n")).unwrap());
    }
    for (text, expected) in [
        ("node = 'bank'", "is 1.000 m off that"),
        ("node = 'lake'", "no model shows a node of that name; there are \"bank\", \"pond\""),
        ("node = 'pond'\nmodel = 'park'", "no model shows a node"),
        ("material = 'slime'", "no model shows a material of that name; there are"),
        ("node = 'pond'\npolygon = { points = [] }", "polygon and node at once"),
        (
            "node = 'pond'\n[[water]]\nname = 'basin'\nnode = 'pond'\nmodel = 'garden'",
            "the waters \"water-1\" and \"basin\" claim the same faces",
        ),
        (
            "material = 'Slime'\n[[water]]\nmaterial = 'Slime'",
            "\"water-1\" and \"water-2\" claim the same faces",
        ),
    ] {
        let message = garden("fault", &format!("{model}[[water]]\n{text}\n")).err().map(|e| e.to_string());
        let message = message.unwrap_or_default();
        assert!(message.starts_with("a.toml: line ") && message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn triangles_of_a_model_share_their_corners() {
    // A square of two triangles, each with three corners of its own.
    let square = MODEL.replace("\"count\": 3", "\"count\": 6").replace("36", "72").replace(
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAA",
    );
    let scene =
        beside(&square, "weld", "[[model]]\nfile = 'garden.gltf'\n[[water]]\nnode = 'pond'\n").unwrap();
    let surface = &scene.waters[0].surface;
    assert_eq!((surface.positions.len(), surface.triangles.len()), (4, 2));
    let [a, b] = [surface.triangles[0], surface.triangles[1]];
    assert_eq!(a.iter().filter(|corner| b.contains(corner)).count(), 2, "they share an edge: {a:?} {b:?}");
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
