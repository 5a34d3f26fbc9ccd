//! Trees in pictures and on sensors, and `keikan tree`.

mod common;

use std::fs;
use std::path::Path;

use common::{folder, keikan, text};

/// A lawn in the sun, which stands in the south-west, and lux in the shade of a tree at the origin and far from it.
const LAWN: &str = "
[sun]
altitude = 45
azimuth = 180
illuminance = 80000
diameter = 0
[sky]
model = 'uniform'
illuminance = 10000
[[model]]
plane = { size = [60, 60] }
[[camera]]
position = [0, 3, 24]
target = [0, 5, 0]
[[sensor]]
points = [[0, 0.01, -6], [25, 0.01, 0]]
";

fn write(folder: &Path, tree: &str) {
    fs::write(folder.join("a.toml"), format!("{LAWN}{tree}")).unwrap();
}

/// Runs the program, which must succeed; what it has written to stdout.
fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = keikan(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// Runs the program, which must fail; its message.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = keikan(folder, arguments);
    assert!(matches!(output.status.code(), Some(1 | 2)), "{arguments:?}: {:?}", output.status);
    text(&output.stderr)
}

/// A species of few leaves on small pictures.
fn grow(folder: &Path, name: &str) {
    done(
        folder,
        &["tree", "grow", "broadleaf", "--leaves", "3000", "--leaf", "0.4", "--rows", "64", "-o", name],
    );
}

fn render(folder: &Path, output: &str, more: &[&str]) {
    let arguments = ["render", "a.toml", "--size", "48x32", "--set", "sky.rays=8", "-o", output];
    done(folder, &[&arguments, more].concat());
}

/// Relative RMSE of two pictures.
fn difference(folder: &Path, a: &str, b: &str) -> f64 {
    let answer = done(folder, &["compare", a, b, "--json"]);
    serde_json::from_str::<serde_json::Value>(&answer).unwrap()["relative_rmse"].as_f64().unwrap()
}

/// Lux at the sensor's two points.
fn lux(folder: &Path, more: &[&str]) -> [f64; 2] {
    let csv = done(folder, &[&["lux", "a.toml"][..], more].concat());
    let mut lines = csv.lines();
    let column = lines.next().unwrap().split(',').position(|name| name == "total_lx").unwrap();
    let mut value = || lines.next().unwrap().split(',').nth(column).unwrap().parse::<f64>().unwrap();
    [value(), value()]
}

#[test]
fn a_named_tree_is_seen_and_shades_as_its_folder_does() {
    let folder = folder("named");
    write(&folder, "[[tree]]\nspecies = 'poplar'\nposition = [0, 0, 0]\n");
    render(&folder, "named.exr", &[]);
    render(&folder, "without.exr", &["--set", "trees=off"]);
    // A dark column on a bright lawn over some 4 % of the picture.
    assert!(difference(&folder, "named.exr", "without.exr") > 0.05);
    let ([shaded, open], [lawn, far]) = (lux(&folder, &[]), lux(&folder, &["--set", "trees=off"]));
    // The sun's 80 klx · sin 45° over 10 klx of the sky: most of the sun's is gone in the shade of the crown's middle.
    assert!(shaded < 0.5 * lawn, "{shaded} {lawn}");
    // Beyond the tree's shade it hides some sky at most.
    assert!(open <= far && open > 0.98 * far, "{open} {far}");

    done(&folder, &["tree", "grow", "poplar", "-o", "made"]);
    write(&folder, "[[tree]]\nspecies = './made'\nposition = [0, 0, 0]\n");
    render(&folder, "made.exr", &[]);
    // Codes of nearly clear texels are coarser in files.
    let off = difference(&folder, "made.exr", "named.exr");
    assert!(off < 1e-3, "{off}");
}

#[test]
fn a_species_that_there_is_not_names_those_that_there_are() {
    let folder = folder("unknown");
    write(&folder, "[[tree]]\nspecies = 'baobab'\nposition = [0, 0, 0]\n");
    let said = refused(&folder, &["render", "a.toml", "-o", "a.png"]);
    for word in ["baobab", "broadleaf", "zelkova", "poplar", "spruce"] {
        assert!(said.contains(word), "{said}");
    }
    assert!(!folder.join("a.png").exists());
    let said = refused(&folder, &["tree", "grow", "baobab", "-o", "made"]);
    assert!(said.contains("broadleaf") && !folder.join("made").exists(), "{said}");
}

#[test]
fn the_plan_says_what_trees_are_there() {
    let folder = folder("plan");
    write(
        &folder,
        "[[tree]]\nspecies = 'spruce'\npositions = [[0, 0, 0], [5, 0, 0]]\n[[tree]]\nspecies = 'poplar'\nposition = [9, 0, 0]\n",
    );
    let said = done(&folder, &["plan", "a.toml"]);
    assert!(said.contains("turning planes") && said.contains("3 of 2 species"), "{said}");
    let said = done(&folder, &["plan", "a.toml", "--set", "trees=off"]);
    assert!(said.contains("no trees: trees = off; 3 in the scene"), "{said}");
}

#[test]
fn a_grown_mesh_bakes_to_the_species_that_it_was() {
    let folder = folder("mesh");
    let small = ["--rows", "64", "-o"];
    let grow =
        ["tree", "grow", "broadleaf", "--leaves", "3000", "--leaf", "0.4", "--mesh", "tree.glb", "--json"];
    let grown = done(&folder, &[&grow[..], &small, &["grown"]].concat());
    let baked = done(&folder, &[&["tree", "bake", "tree.glb", "--json"][..], &small, &["baked"]].concat());
    let [grown, baked] = [grown, baked].map(|text| serde_json::from_str::<serde_json::Value>(&text).unwrap());
    for key in ["height", "width", "leaf", "extinction", "shelter"] {
        let [a, b] = [&grown, &baked].map(|answer| answer["species"][key].as_f64().unwrap());
        // The foot is found to a hundredth of the height; 64 rows see as much.
        assert!((a / b - 1.0).abs() < 0.05, "{key}: {a} {b}");
    }
    let leaves = |name: &str| {
        let materials = baked["materials"].as_array().unwrap();
        materials.iter().find(|worn| worn["material"] == name).unwrap()["leaves"].as_bool().unwrap()
    };
    assert!(leaves("leaves") && !leaves("wood"));
    let scene = done(&folder, &["plan", "tree.glb", "--json"]);
    let triangles = |of: &serde_json::Value| of["triangles"].as_u64().unwrap();
    let materials = baked["materials"].as_array().unwrap();
    let plan = serde_json::from_str::<serde_json::Value>(&scene).unwrap();
    // The ground that a model alone is given may have more.
    assert!(triangles(&plan["contents"]) >= materials.iter().map(triangles).sum());
}

#[test]
fn a_model_without_leaves_is_wood_and_what_is_no_model_is_named() {
    let folder = folder("bare");
    let bare =
        ["tree", "grow", "broadleaf", "--leaves", "0", "--rows", "64", "--mesh", "bare.glb", "-o", "bare"];
    done(&folder, &bare);
    let output = keikan(&folder, &["tree", "bake", "bare.glb", "--rows", "64", "-o", "again"]);
    assert!(output.status.success() && text(&output.stderr).contains("no material counts as leaves"));
    let large = ["tree", "bake", "bare.glb", "--rows", "4096", "--planes", "64", "-o", "none"];
    let said = refused(&folder, &large);
    assert!(
        said.contains("bare.glb") && said.contains("GB are possible") && !folder.join("none").exists(),
        "{said}"
    );
    fs::write(folder.join("text.glb"), "no model").unwrap();
    let said = refused(&folder, &["tree", "bake", "text.glb", "-o", "none"]);
    assert!(said.contains("text.glb") && !folder.join("none").exists(), "{said}");
}

/// Writes a picture of 40 × 60 texels: a disc of one alpha on another.
fn photograph(folder: &Path, name: &str, [disc, around]: [u8; 2]) {
    let alpha =
        |x: u32, y: u32| if x.abs_diff(20).pow(2) + y.abs_diff(25).pow(2) < 300 { disc } else { around };
    let stem = |x: u32, y: u32| y > 25 && x.abs_diff(20) < 2;
    let texel = |x: u32, y: u32| image::Rgba([60, 110, 40, if stem(x, y) { disc } else { alpha(x, y) }]);
    image::RgbaImage::from_fn(40, 60, texel).save(folder.join(name)).unwrap();
}

#[test]
fn photographs_need_an_alpha_and_something_to_see() {
    let folder = folder("photo");
    photograph(&folder, "good.png", [255, 0]);
    photograph(&folder, "opaque.png", [255, 255]);
    photograph(&folder, "clear.png", [0, 0]);
    for (side, top, expected) in [
        ("opaque.png", None, "wholly opaque"),
        ("clear.png", None, "wholly transparent"),
        ("good.png", Some("opaque.png"), "the view from above is wholly opaque"),
        ("good.png", Some("clear.png"), "the view from above is wholly transparent"),
        ("none.png", None, "none.png"),
    ] {
        let files: Vec<&str> = std::iter::once(side).chain(top).collect();
        let said =
            refused(&folder, &[&["tree", "photo", "--height", "7", "-o", "made"][..], &files].concat());
        assert!(said.contains(top.unwrap_or(side)) && said.contains(expected), "{said}");
        assert!(!folder.join("made").exists());
    }
    let said = refused(&folder, &["tree", "photo", "good.png", "--height", "0", "-o", "made"]);
    assert!(said.contains("above 0"), "{said}");
    let said = done(&folder, &["tree", "photo", "good.png", "--height", "7", "-o", "made"]);
    assert!(said.contains("made up"), "{said}");
    let said = done(&folder, &["tree", "photo", "good.png", "good.png", "--height", "7", "-o", "made"]);
    assert!(!said.contains("made up"), "{said}");
    write(&folder, "[[tree]]\nspecies = 'made'\nposition = [0, 0, 0]\n");
    render(&folder, "with.exr", &[]);
    render(&folder, "without.exr", &["--set", "trees=off"]);
    assert!(difference(&folder, "with.exr", "without.exr") > 0.02);
}

#[test]
fn a_folder_of_other_things_is_left_alone() {
    let folder = folder("others");
    fs::create_dir(folder.join("letters")).unwrap();
    fs::write(folder.join("letters/a.txt"), "dear").unwrap();
    let said = refused(&folder, &["tree", "grow", "poplar", "-o", "letters"]);
    assert!(said.contains("letters") && said.contains("of its own"), "{said}");
    assert_eq!(fs::read_dir(folder.join("letters")).unwrap().count(), 1);
    let said = refused(&folder, &["tree", "grow", "poplar", "-o", "letters/a.txt"]);
    assert!(said.contains("no folder"), "{said}");
    let said = refused(&folder, &["tree", "grow", "poplar", "-o", "none/poplar"]);
    assert!(said.contains("none"), "{said}");
}

#[test]
fn a_million_trees_at_one_point_are_one() {
    let folder = folder("million");
    grow(&folder, "small");
    fs::write(folder.join("points.csv"), "0,0,0\n".repeat(1_000_000)).unwrap();
    write(&folder, "[[tree]]\nspecies = 'small'\nrotation = 0\nfile = 'points.csv'\n");
    let output =
        keikan(&folder, &["render", "a.toml", "--size", "48x32", "--set", "sky.rays=8", "-o", "many.exr"]);
    assert!(
        output.status.success() && text(&output.stderr).contains("999999 trees"),
        "{}",
        text(&output.stderr)
    );
    write(&folder, "[[tree]]\nspecies = 'small'\nrotation = 0\nposition = [0, 0, 0]\n");
    render(&folder, "one.exr", &[]);
    assert_eq!(difference(&folder, "many.exr", "one.exr"), 0.0);
}

#[test]
fn a_million_trees_within_a_centimetre_are_one_and_a_row_stays_a_row() {
    let folder = folder("crowd");
    grow(&folder, "small");
    let points: String = (0..1_000_000u32)
        .map(|i| format!("{:.5},{:.5},0\n", f64::from(i % 1000) * 1e-5, f64::from(i / 1000) * 1e-5))
        .collect();
    fs::write(folder.join("points.csv"), points).unwrap();
    let row = "[[tree]]\nspecies = 'small'\npositions = [[8, 0, 0], [8.5, 0, 0], [9, 0, 0]]\n";
    write(&folder, &format!("{row}[[tree]]\nspecies = 'small'\nrotation = 0\nfile = 'points.csv'\n"));
    let start = std::time::Instant::now();
    let output =
        keikan(&folder, &["render", "a.toml", "--size", "48x32", "--set", "sky.rays=8", "-o", "many.exr"]);
    let said = text(&output.stderr);
    assert!(output.status.success() && said.contains("999999 trees stand where another"), "{said}");
    // A second or two; one by one, every ray would cross a million trees: hours.
    assert!(start.elapsed().as_secs() < 60);
}

/// A pond of 8 by 8 m and 2 m deep in the middle of land at y = 0, on which `trees` are put by `more`.
fn pond(folder: &Path, trees: &str) {
    let land = "
[sun]
altitude = 45
azimuth = 180
[sky]
model = 'uniform'
illuminance = 10000
[[model]]
plane = { size = [8, 8] }
position = [0, -2, 0]
[[model]]
polygon = { points = [[-20, 0, 20], [20, 0, 20], [20, 0, -20], [-20, 0, -20]], holes = [[[-4, 0, 4], [4, 0, 4], [4, 0, -4], [-4, 0, -4]]] }
[[model]]
box = { size = [8, 2, 0.1] }
position = [0, -2, -4.05]
[[model]]
box = { size = [8, 2, 0.1] }
position = [0, -2, 4.05]
[[model]]
box = { size = [0.1, 2, 8] }
position = [-4.05, -2, 0]
[[model]]
box = { size = [0.1, 2, 8] }
position = [4.05, -2, 0]
[[water]]
polygon = { points = [[-4, -0.2, 4], [4, -0.2, 4], [4, -0.2, -4], [-4, -0.2, -4]] }
[[camera]]
position = [0, 3, 24]
target = [0, 2, 0]
";
    fs::write(folder.join("a.toml"), format!("{land}{trees}")).unwrap();
}

#[test]
fn trees_on_the_ground_keep_out_of_a_pond_and_stay_where_there_is_no_ground() {
    let folder = folder("pond");
    grow(&folder, "small");
    let said = |trees: &str| {
        pond(&folder, trees);
        let output =
            keikan(&folder, &["render", "a.toml", "--size", "24x16", "--set", "sky.rays=4", "-o", "a.exr"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    let places = "positions = [[-9, 5, 0], [3, 5, 1], [1, 5, 1], [60, 5, 0]]\n";
    let on_ground = said(&format!("[[tree]]\nspecies = 'small'\nground = true\n{places}"));
    assert!(
        on_ground.contains("2 would stand in a [[water]]")
            && on_ground.contains("the first at [3.00, -2.00, 1.00]"),
        "{on_ground}"
    );
    assert!(
        on_ground.contains("1 have nothing below") && on_ground.contains("the first at [60.00, 5.00, 0.00]"),
        "{on_ground}"
    );
    // Two stay: the picture is that of these two, each where it belongs.
    let two = "[[tree]]\nspecies = 'small'\nrotation = 7\npositions = [[-9, 0, 0], [60, 5, 0]]\n";
    let four = format!("[[tree]]\nspecies = 'small'\nrotation = 7\nground = true\n{places}");
    said(&four);
    fs::rename(folder.join("a.exr"), folder.join("four.exr")).unwrap();
    let dry = said(two);
    assert!(!dry.contains("[[tree]]"), "{dry}");
    assert_eq!(difference(&folder, "a.exr", "four.exr"), 0.0);
    // Who puts trees into water by their own heights may.
    let wading = said("[[tree]]\nspecies = 'small'\npositions = [[3, -2, 1], [1, -2, 1]]\n");
    assert!(!wading.contains("[[tree]]"), "{wading}");
    // None at all is no error.
    let none = said("[[tree]]\nspecies = 'small'\nground = true\nposition = [0, 0, 0]\n");
    assert!(none.contains("1 would stand in a [[water]]"), "{none}");
}

#[test]
fn skies_that_know_nothing_of_trees_say_so() {
    let folder = folder("blind");
    write(&folder, "[[tree]]\nspecies = 'poplar'\nposition = [0, 0, 0]\n");
    let warned = |set: &[&str]| {
        let set: Vec<_> = set.iter().flat_map(|knob| ["--set", knob]).collect();
        let output = keikan(&folder, &[&["plan", "a.toml"][..], &set].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stderr).contains("knows nothing of trees")
    };
    assert!(warned(&["sky.visibility=cuboid"]) && warned(&["sky.visibility=bands"]));
    assert!(!warned(&[]) && !warned(&["sky.visibility=patches"]) && !warned(&["sky.map=on"]));
    assert!(!warned(&["sky.visibility=bands", "trees=off"]));
    assert!(!warned(&["sky.visibility=bands", "sky.model=none"]));
    write(&folder, "");
    assert!(!warned(&["sky.visibility=bands"]));
}

#[test]
fn a_crown_may_be_named_by_its_shape() {
    let folder = folder("shape");
    grow(&folder, "small");
    let table = folder.join("small/tree.toml");
    let text = fs::read_to_string(&table).unwrap();
    let line = text.lines().find(|line| line.starts_with("envelope")).unwrap();
    let shape = |shape: &str| fs::write(&table, text.replace(line, &format!("envelope = {shape}"))).unwrap();
    write(&folder, "[[tree]]\nspecies = 'small'\nposition = [0, 0, 0]\n");
    render(&folder, "fitted.exr", &[]);
    shape("{ shape = 'ellipsoid', base = 3, radius = 4 }");
    render(&folder, "ellipsoid.exr", &[]);
    // Leaves face otherwise and stand at other depths; silhouette and colours are the same.
    let off = difference(&folder, "fitted.exr", "ellipsoid.exr");
    assert!(off > 1e-4 && off < 0.1, "{off}");
    for (text, expected) in [
        ("{ shape = 'pencil', base = 3, top = 2, radius = 4 }", "base below top"),
        ("{ shape = 'inverted-cone', base = 3, radius = 0 }", "above 0"),
        ("{ shape = 'cube', base = 3, radius = 1 }", "inverted-cone"),
        ("{ shape = 'ellipsoid', base = 3, top = 300, radius = 1 }", "envelope"),
    ] {
        shape(text);
        let said = refused(&folder, &["render", "a.toml", "-o", "a.png"]);
        assert!(said.contains("small") && said.contains(expected), "{text}: {said}");
    }
}
