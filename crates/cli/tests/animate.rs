//! `keikan animate` as a user meets it: which files, what is skipped, what is said.

mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use common::{folder, text};
use serde_json::Value;

/// Small and rough: what is looked at is the program, not the picture.
fn keikan(folder: &Path, arguments: &str) -> Output {
    let arguments = arguments.split_whitespace().chain(["--size", "16x10", "--preset", "draft"]);
    common::keikan(folder, &["animate"].into_iter().chain(arguments).collect::<Vec<_>>())
}

fn said(done: &Output) -> String {
    text(&done.stderr)
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

const WALK: &str = "[site]\nlatitude = 52\nlongitude = 5\ntime = 2026-06-21T12:00:00+02:00\n\
    [[model]]\nbox = { size = [2, 2, 2] }\n[[model]]\nplane = { size = [40, 40] }\n\
    [[camera]]\ntarget = [0, 1, 0]\npath = [\n{ time = 0, position = [9, 2, 0] }, { time = 1, position = [0, 2, 9] }]\n";

#[test]
fn a_path_becomes_frames_that_are_not_made_twice() {
    let folder = folder("walk");
    fs::write(folder.join("walk.toml"), WALK).unwrap();
    let line = "walk.toml -o f##.exr -o f##.png --fps 2 --json";
    let done = keikan(&folder, line);
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    let pictures = ["f01.exr", "f01.png", "f02.exr", "f02.png", "f03.exr", "f03.png"];
    assert_eq!(files(&folder)[..6], pictures);
    let summary: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!((&summary["written"], &summary["skipped"]), (&3.into(), &0.into()));
    assert!(summary["frames"][2]["seconds"].as_f64().unwrap() > 0.0);
    assert!(summary["frames"][0]["site"].as_str().unwrap().contains("2026-06-21 10:00:00 UTC"));
    let frame = |name: &str| fs::read(folder.join(name)).unwrap();
    assert!(frame("f01.png") != frame("f02.png") && frame("f02.png") != frame("f03.png"), "the camera moves");

    // Once more: one frame lacks a file, one has an empty one.
    let before = frame("f02.exr");
    fs::remove_file(folder.join("f02.exr")).unwrap();
    fs::write(folder.join("f03.png"), b"").unwrap();
    let done = keikan(&folder, line);
    let summary: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!((&summary["written"], &summary["skipped"]), (&2.into(), &1.into()));
    assert!(said(&done).contains("frame 1 (1 of 3): skipped"), "{}", said(&done));
    assert_eq!(frame("f02.exr"), before, "a frame is the same whenever it is made");
    assert!(!frame("f03.png").is_empty());
    let done = keikan(&folder, &format!("{line} --overwrite"));
    let summary: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(summary["written"], 3);

    // The first frame shows where the path begins, as a picture of the scene does.
    let mut still = Command::new(env!("CARGO_BIN_EXE_keikan"));
    let arguments = ["render", "walk.toml", "-o", "still.exr", "--size", "16x10", "--preset", "draft"];
    assert!(still.current_dir(&folder).args(arguments).output().unwrap().status.success());
    assert_eq!(frame("still.exr"), frame("f01.exr"));
}

#[test]
fn a_day_moves_the_sun() {
    let folder = folder("day");
    let done = keikan(&folder, "-o day-###.exr --time 06:00..18:00/6h --json");
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    assert_eq!(files(&folder), ["day-001.exr", "day-002.exr", "day-003.exr"]);
    let summary: Value = serde_json::from_slice(&done.stdout).unwrap();
    let site = |i: usize| summary["frames"][i]["site"].as_str().unwrap().to_owned();
    // The park's day is 25 October by a clock 9 hours ahead.
    assert!(site(0).starts_with("2026-10-24 21:00:00 UTC") && site(2).starts_with("2026-10-25 09:00:00 UTC"));
    assert!(site(2).contains("below the horizon"), "{}", site(2));
    let header = |name: &str| {
        let image = exr::prelude::read_all_flat_layers_from_file(folder.join(name)).unwrap();
        image.layer_data[0].attributes.capture_date.as_ref().map(ToString::to_string)
    };
    assert_eq!(header("day-002.exr"), Some("2026:10:25 12:00:00".to_owned()));
    // A part of the same day, with numbers of its own, is the same pictures.
    let done = keikan(&folder, "-o part-##.exr --time 06:00..18:00/6h --first -1 --frames 0-1");
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    for (part, whole) in [("part-00.exr", "day-002.exr"), ("part-01.exr", "day-003.exr")] {
        assert_eq!(fs::read(folder.join(part)).unwrap(), fs::read(folder.join(whole)).unwrap(), "{part}");
    }
}

/// The pictures of one morning, by frame.
fn morning(folder: &Path, more: &str) -> (Output, Vec<Vec<u8>>) {
    let line = format!("walk.toml -o m#.exr --time 08:00..10:00/1h --overwrite --set sky.map=on {more}");
    let done = keikan(folder, &line);
    let frames = (1..=3).map(|i| fs::read(folder.join(format!("m{i}.exr"))).unwrap_or_default()).collect();
    (done, frames)
}

#[test]
fn maps_change_no_picture_and_serve_the_next_run() {
    let folder = folder("maps");
    fs::write(folder.join("walk.toml"), WALK).unwrap();
    let (_, without) = morning(&folder, "");
    let (first, with) = morning(&folder, "--maps sky.maps");
    assert_eq!(first.status.code(), Some(0), "{}", said(&first));
    assert!(with == without && !with[0].is_empty() && !said(&first).contains("--maps"));
    let kept = fs::read(folder.join("sky.maps")).unwrap();
    let (second, again) = morning(&folder, "--maps sky.maps");
    assert!(again == without, "{}", said(&second));
    // The file has the map of ten o'clock, and what all points see of the sky.
    assert!(said(&second).contains("of another sky; what") && said(&second).contains("is used again"));
    assert!(fs::read(folder.join("sky.maps")).unwrap() == kept);
    fs::remove_file(folder.join("m3.exr")).unwrap();
    let (last, third) = morning(&folder, "--maps sky.maps --frames 3");
    assert!(said(&last).contains("mapped sides of faces are used again"), "{}", said(&last));
    assert!(third[2] == without[2], "recalled values are those that were kept");
    let (clash, _) = morning(&folder, "--maps m1.exr");
    assert_eq!(clash.status.code(), Some(2), "{}", said(&clash));
    // Another scene.
    fs::write(folder.join("walk.toml"), WALK.replace("[2, 2, 2]", "[2, 3, 2]")).unwrap();
    let (other, _) = morning(&folder, "--maps sky.maps");
    assert_eq!(other.status.code(), Some(0));
    assert!(said(&other).contains("made anew: the illuminance map is of another scene"), "{}", said(&other));
}

#[test]
fn a_file_that_is_no_map_stays_as_it_is() {
    let folder = folder("no-maps");
    fs::write(folder.join("walk.toml"), WALK).unwrap();
    for content in [&b"my diary"[..], b"keikanMS\xff\0\0\0\0\0\0\0short", b""] {
        fs::write(folder.join("sky.maps"), content).unwrap();
        let (done, _) = morning(&folder, "--maps sky.maps");
        assert_eq!(done.status.code(), Some(2), "{}", said(&done));
        assert!(said(&done).contains("--maps sky.maps"), "{}", said(&done));
        assert_eq!(fs::read(folder.join("sky.maps")).unwrap(), content);
    }
    let done =
        keikan(&folder, "walk.toml -o m#.exr --time 08:00..09:00/1h --maps new.maps --set sky.map=off");
    assert_eq!(done.status.code(), Some(2));
    assert!(said(&done).contains("sky.map is off") && !folder.join("new.maps").exists());
}

#[test]
fn usage_errors_are_2_and_say_what_is_possible() {
    let folder = folder("usage");
    fs::write(folder.join("walk.toml"), WALK).unwrap();
    fs::write(folder.join("put.toml"), "[sun]\naltitude = 30\nazimuth = 90\n").unwrap();
    for (arguments, word) in [
        ("walk.toml", "--output"),
        ("walk.toml -o a.png", "name-####.exr"),
        ("walk.toml -o a#.bmp", "exr, png"),
        ("walk.toml -o a#.png -o a#.png", "twice"),
        ("walk.toml -o a#.png --frames 5-1", "5-1:-1"),
        ("walk.toml -o a#.png --fps 0", "0.001"),
        ("walk.toml -o a#.png --time 5..6/1h", "05:30"),
        ("walk.toml -o a#.png --time 05:00..06:00/1h --frames 3", "frames 1 to 2"),
        ("walk.toml -o a#.png --layers", "EXR"),
        ("put.toml -o a#.png --time 05:00..06:00/1h", "nothing changes with the time"),
        ("-o a#.png --frames 1-3", "has no path"),
    ] {
        let done = keikan(&folder, arguments);
        assert_eq!(done.status.code(), Some(2), "{arguments}: {}", said(&done));
        assert!(said(&done).contains(word), "{arguments}: {}", said(&done));
    }
    let done = keikan(&folder, "walk.toml -o no/such/folder/a#.png");
    assert_eq!(done.status.code(), Some(1), "{}", said(&done));
    assert_eq!(files(&folder), ["put.toml", "walk.toml"]);
}

#[cfg(unix)]
#[test]
fn control_c_is_130_and_leaves_whole_frames() {
    let folder = folder("interrupted");
    fs::write(folder.join("walk.toml"), WALK).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_keikan"))
        .current_dir(&folder)
        .args(["animate", "walk.toml", "-o", "f####.exr", "--frames", "1-9999", "--size", "64x40"])
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while !folder.join("f0002.exr").exists() {
        std::thread::sleep(std::time::Duration::from_millis(20));
        assert_eq!(child.try_wait().unwrap(), None, "it ended by itself");
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let done = child.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(130));
    let count = files(&folder).len() - 1;
    let end = said(&done).lines().last().map(str::to_owned).unwrap_or_default();
    assert_eq!(
        end,
        format!(
            "keikan: interrupted; {count} frames were written before, each whole, and are skipped when it is run again"
        )
    );
    for name in files(&folder).iter().filter(|name| *name != "walk.toml") {
        assert!(
            name.starts_with('f') && exr::prelude::read_all_flat_layers_from_file(folder.join(name)).is_ok(),
            "{name}"
        );
    }
}
