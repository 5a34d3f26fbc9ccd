//! The program as a user meets it: exit codes, streams, files whole or not at all.

mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use common::{folder, keikan, text};

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_water_that_there_is_not_names_those_that_there_are() {
    let folder = folder("water");
    let polygon = "polygon = { points = [[0, 0, 0], [0, 0, 4], [6, 0, 4]] }";
    fs::write(folder.join("sea.toml"), format!("[[water]]\nname = 'bay'\nquality = 'jerlov-4'\n{polygon}\n"))
        .unwrap();
    let done = keikan(&folder, &["render", "sea.toml", "--size", "8x8"]);
    let said = text(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{said}");
    assert!(said.contains("\"bay\"") && said.contains("jerlov-4") && said.contains("jerlov-3C"), "{said}");
    assert_eq!(files(&folder), ["sea.toml"]);
}

#[test]
fn render_without_an_argument_writes_the_park() {
    let folder = folder("park");
    let done = keikan(&folder, &["render", "--size", "64x40", "--preset", "draft"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(files(&folder), ["park.exr", "park.png"]);
    assert!(done.stdout.is_empty(), "messages go to stderr");
    assert!(text(&done.stderr).contains("UTC"), "every output states time and place");
}

#[test]
fn the_exr_says_what_it_is() {
    let folder = folder("exr");
    let done = keikan(
        &folder,
        &["render", "--size", "32x20", "--preset", "draft", "--layers", "--owner", "A. Owner", "-o", "a.exr"],
    );
    assert!(done.status.success(), "{}", text(&done.stderr));
    let image = exr::prelude::read_all_flat_layers_from_file(folder.join("a.exr")).unwrap();
    let layer = &image.layer_data[0];
    let attributes = &layer.attributes;
    assert_eq!(attributes.white_luminance, Some(1.0));
    assert_eq!(attributes.latitude, Some(35.01));
    assert_eq!(attributes.utc_offset, Some(-9.0 * 3600.0));
    assert_eq!(attributes.owner.as_ref().map(ToString::to_string), Some("A. Owner".to_owned()));
    assert_eq!(
        attributes.capture_date.as_ref().map(ToString::to_string),
        Some("2026:10:25 15:10:00".to_owned())
    );
    let comments = attributes.comments.as_ref().map(ToString::to_string).unwrap_or_default();
    assert!(comments.contains("2026-10-25 06:10:00 UTC") && comments.contains("from -Z"), "{comments}");
    assert!(attributes.other.keys().any(|name| name == "keikan"), "what made it");
    let channels: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    for name in ["R", "G", "B", "Y", "sun.R", "sky.G", "lantern.B", "emission.R"] {
        assert!(channels.contains(&name.to_owned()), "{name} is missing from {channels:?}");
    }
}

#[test]
fn threads_change_no_bit() {
    let folder = folder("threads");
    for threads in ["1", "2"] {
        let file = format!("{threads}.exr");
        let done = keikan(&folder, &["render", "--size", "96x60", "--threads", threads, "-o", &file]);
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
    let done = keikan(&folder, &["compare", "1.exr", "2.exr", "--json"]);
    let difference: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(difference["identical"], true);
    let same = fs::read(folder.join("1.exr")).unwrap() == fs::read(folder.join("2.exr")).unwrap();
    assert!(same, "the files differ, though the pictures do not");
}

#[test]
fn false_colour_has_room_for_its_legend() {
    let folder = folder("false-colour");
    let arguments =
        ["render", "--size", "64x80", "--preset", "draft", "--false-colour=1:10000", "-o", "f.png"];
    let done = keikan(&folder, &arguments);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let picture = image::open(folder.join("f.png")).unwrap();
    assert!(picture.width() > 64 && picture.height() == 80);
}

#[test]
fn usage_errors_are_2_and_list_what_is_possible() {
    let folder = folder("usage");
    for (arguments, word) in [
        (&["render", "--set", "visibilty=rays"][..], "visibility"),
        (&["render", "--set", "visibility=magic"], "scanline | rays"),
        (&["render", "--camera", "nobody"], "garden"),
        (&["render", "-o", "a.bmp"], "exr, png"),
        (&["render", "--size", "65536x65536"], "--region"),
        (&["render", "--exposure", "0"], "above 0"),
        (&["render", "--exposure", "nan"], "above 0"),
        (&["render", "--threads", "100000"], "1024"),
        (&["render", "--layers", "-o", "a.png"], "EXR"),
        (&["render", "-o", "a.png", "-o", "a.png"], "twice"),
        (&["render", "--size", "0x5"], "1 to 65536"),
        (&["render", "--region", "0,0,9999,5"], "beyond"),
        (&["frobnicate"], "Usage"),
    ] {
        let done = keikan(&folder, arguments);
        assert_eq!(done.status.code(), Some(2), "{arguments:?}: {}", text(&done.stderr));
        assert!(text(&done.stderr).contains(word), "{arguments:?}: {}", text(&done.stderr));
    }
    assert!(files(&folder).is_empty());
}

#[test]
fn broken_files_are_1_and_leave_nothing_behind() {
    let folder = folder("broken");
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).unwrap();
    write("empty.glb", b"");
    write("noise.glb", b"glTF\x02\0\0\0\xff\xff\xff\xffJSON????");
    write("open.gltf", br#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":7}}]}]}"#);
    write("bad.toml", b"[site]\nlatitude = 135\nlongitude = 35\n");
    write("lamp.toml", b"[[light]]\nfile = \"lamp.ies\"\nposition = [0, 3, 0]\n");
    write("lamp.ies", b"IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 999999999 999999999 1 2 0 0 0\n");
    let before = files(&folder);
    for name in ["empty.glb", "noise.glb", "open.gltf", "bad.toml", "lamp.toml", "absent.toml"] {
        let done = keikan(&folder, &["render", name, "--size", "8x8"]);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(1), "{name}: {said}");
        assert!(said.contains(name.trim_end_matches(".toml")), "the file is named: {said}");
        assert!(!said.contains("panicked"), "{said}");
    }
    assert_eq!(files(&folder), before);
}

#[test]
fn an_output_that_cannot_be_written_is_1() {
    let folder = folder("unwritable");
    let arguments = ["render", "--size", "8x8", "--preset", "draft", "-o", "no/such/folder/a.png"];
    let done = keikan(&folder, &arguments);
    assert_eq!(done.status.code(), Some(1), "{}", text(&done.stderr));
    assert!(files(&folder).is_empty());
}

#[cfg(unix)]
#[test]
fn control_c_is_130_and_leaves_no_half_file() {
    use std::time::Duration;
    let folder = folder("interrupted");
    let mut child = Command::new(env!("CARGO_BIN_EXE_keikan"))
        .current_dir(&folder)
        .args(["render", "--size", "4096x2560", "--preset", "reference"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    let asked = std::time::Instant::now();
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    // One piece of surface takes milliseconds at most; the rest is a generous machine's noise.
    assert!(asked.elapsed() < Duration::from_secs(10), "{:?}", asked.elapsed());
    assert!(files(&folder).is_empty());
}

#[test]
fn plan_and_schema_are_data() {
    let folder = folder("plan");
    let done = keikan(&folder, &["plan", "--json"]);
    let plan: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(plan["settings"]["visibility"], "scanline");
    assert!(text(&keikan(&folder, &["plan"]).stdout).contains("waves on 1, which do nothing to light"));
    let schema: serde_json::Value = serde_json::from_slice(&keikan(&folder, &["schema"]).stdout).unwrap();
    assert!(schema["properties"]["camera"].is_object());
}

#[test]
fn the_rule_for_shadows_and_lamps_beyond_it_are_named() {
    let folder = folder("shadow-rule");
    let lamp = |i: u32| format!("[[light]]\nposition = [{i}, 3, 0]\nintensity = 1\n");
    let dark = "[sky]\noff = true\n[sun]\noff = true\n[[model]]\nbox = { size = [1, 1, 1] }\n";
    let write = |name: &str, lamps: u32| {
        fs::write(folder.join(name), dark.to_owned() + &(0..lamps).map(lamp).collect::<String>()).unwrap();
    };
    write("few.toml", 2);
    write("many.toml", 66);
    let plan = |name: &str| text(&keikan(&folder, &["plan", name]).stdout);
    let data = |name: &str| -> serde_json::Value {
        serde_json::from_slice(&keikan(&folder, &["plan", name, "--json"]).stdout).unwrap()
    };
    let few = data("few.toml");
    assert_eq!((&few["shadows"]["rule"], &few["shadows"]["spans_from"]), (&"volumes".into(), &0.5.into()));
    assert_eq!(few["shadows"]["beyond"].as_array().map(Vec::len), Some(0));
    let said = "12 triangles are at most 100000: intervals on spans of 0.5 pixels and more for light-1, light-2; rays for the rest";
    assert!(plan("few.toml").contains(said), "{}", plan("few.toml"));
    let many = data("many.toml");
    assert_eq!(many["shadows"]["exact"].as_array().map(Vec::len), Some(64));
    assert_eq!(many["shadows"]["beyond"], serde_json::json!(["light-65", "light-66"]));
    let said = "shadows of 2 more lamps are found by rays, less sharply (light-65, light-66)";
    assert!(plan("many.toml").contains(said), "{}", plan("many.toml"));
    let render = |name: &str| {
        text(&keikan(&folder, &["render", name, "--size", "8x8", "--preset", "draft", "-o", "a.png"]).stderr)
    };
    assert!(
        render("many.toml")
            .contains(&format!("warning: shadow intervals are found for the first 64 sources only: {said}"))
    );
    assert!(!render("few.toml").contains("warning"), "{}", render("few.toml"));
}

#[test]
fn lux_are_a_table() {
    let folder = folder("lux");
    let csv = text(&keikan(&folder, &["lux"]).stdout);
    assert!(
        csv.starts_with("sensor,point,x_m,y_m,z_m,total_lx,error_lx,direct_lx,reflected_lx,through_lx,"),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 1 + 24 + 2 + 25);
    let table: serde_json::Value =
        serde_json::from_slice(&keikan(&folder, &["lux", "--json"]).stdout).unwrap();
    for row in table["rows"].as_array().unwrap() {
        let parts: f64 = row["parts"].as_array().unwrap().iter().map(|p| p.as_f64().unwrap()).sum();
        assert!((row["total"].as_f64().unwrap() - parts).abs() <= 1e-9 * parts); // a sum of 18 f64
    }
}
