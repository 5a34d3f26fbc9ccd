//! Lux by the ways that light takes, their errors, and sensors and waters that cannot be meant.

mod common;

use common::{folder, keikan, text};

/// A pool of 8 by 6 m, 2 m deep, in a box of stone, with a lamp above and one below.
const POOL: &str = "
[[material]]
name = 'stone'
colour = 0.5
[[model]]
material = 'stone'
plane = { size = [8, 6] }
position = [0, -2, 0]
[[model]]
material = 'stone'
box = { size = [1, 2.2, 6] }
position = [-4.5, -2, 0]
[[model]]
material = 'stone'
box = { size = [1, 2.2, 6] }
position = [4.5, -2, 0]
[[model]]
material = 'stone'
box = { size = [10, 2.2, 1] }
position = [0, -2, -3.5]
[[model]]
material = 'stone'
box = { size = [10, 2.2, 1] }
position = [0, -2, 3.5]
[[light]]
name = 'above'
position = [1, 3, 0]
intensity = 500
[[light]]
name = 'below'
position = [-3, -1, 0]
intensity = 200
[[sensor]]
name = 'floor'
points = [[0, -2, 0], [2, -2, 1]]
[[sensor]]
name = 'air'
points = [[0, 1, 0]]
normal = [0, -1, 0]
";

const WATER: &str =
    "[[water]]\npolygon = { points = [[-4.2, 0, -3.2], [4.2, 0, -3.2], [4.2, 0, 3.2], [-4.2, 0, 3.2]] }\n";

/// Rows of a CSV without quotes: by column name.
fn rows(csv: &str) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().unwrap();
    lines.map(|line| header.iter().cloned().zip(line).collect()).collect()
}

#[test]
fn light_is_told_apart_by_its_ways() {
    let folder = folder("lux-ways");
    let scene =
        format!("{POOL}{WATER}[settings]\ninterreflection = 'patches'\n\"interreflection.patches\" = 600\n");
    std::fs::write(folder.join("pool.toml"), scene).unwrap();
    let output = keikan(&folder, &["lux", "pool.toml"]);
    let (csv, said) = (text(&output.stdout), text(&output.stderr));
    assert!(!said.contains("warning"), "{said}");
    for row in rows(&csv) {
        let lux = |name: &str| row[name].parse::<f64>().unwrap();
        let ways = ["direct_lx", "reflected_lx", "through_lx", "interreflected_lx"];
        let sources = ["above", "below"]
            .map(|lamp| ["direct", "reflected", "through"].map(|way| lux(&format!("{lamp}_{way}_lx"))));
        let parts: f64 = sources.iter().flatten().sum::<f64>() + lux("interreflected_lx");
        // Six decimals of up to eleven numbers.
        assert!((lux("total_lx") - parts).abs() < 1e-5, "{csv}");
        assert!((ways.map(lux).iter().sum::<f64>() - lux("total_lx")).abs() < 1e-5, "{csv}");
        let [above, below] = sources;
        // Each lamp gets straight to its own side, and through the surface to the other.
        match row["sensor"].as_str() {
            "floor" => assert!(
                above[0] == 0.0 && above[1] == 0.0 && above[2] > 1.0 && below[0] > 0.5 && below[2] == 0.0
            ),
            _ => assert!(above[0] == 0.0 && above[1] > 0.01 && below[0] == 0.0 && below[2] > 0.1, "{csv}"),
        }
        assert!(lux("interreflected_lx") > 0.1);
        // Patches four times fewer leave some error, and not all of the light.
        assert!(lux("error_lx") > 0.0 && lux("error_lx") < 0.3 * lux("total_lx"), "{csv}");
    }
    let table: serde_json::Value =
        serde_json::from_slice(&keikan(&folder, &["lux", "pool.toml", "--json"]).stdout).unwrap();
    assert_eq!(table["ways"], serde_json::json!(["direct", "reflected", "through", "interreflected"]));
    assert_eq!(table["columns"][1], serde_json::json!({ "source": "above", "way": "reflected" }));
    assert_eq!(table["uniformity"][0]["sensor"], "floor");
}

#[test]
fn ways_are_all_of_the_light_with_beams_and_without() {
    let folder = folder("lux-all");
    let waves = "waves = [{ amplitude = 0.02, wavelength = 1 }]\n";
    for (name, water) in [("flat.toml", WATER.to_owned()), ("wavy.toml", format!("{WATER}{waves}"))] {
        let file = format!("{POOL}{water}[sun]\naltitude = 70\nazimuth = 100\ndiameter = 0\n");
        std::fs::write(folder.join(name), &file).unwrap();
        let csv = text(&keikan(&folder, &["lux", name]).stdout);
        let scene = scene::parse(&file, std::path::Path::new("."), std::path::Path::new(name)).unwrap();
        let view = keikan::args::View::default();
        let plan = keikan::plan::Plan::new(&scene, &view).unwrap();
        let whole = keikan::lux::table(&scene, &keikan::assemble::assemble(&plan, &scene).unwrap());
        for (by_ways, whole) in rows(&csv).iter().zip(&whole.rows) {
            let total = by_ways["total_lx"].parse::<f64>().unwrap();
            // Point sources alone: f32 sums in another order, and six decimals.
            assert!(
                (total - whole.total).abs() < 1e-5 * whole.total + 1e-5,
                "{name}: {total} {}",
                whole.total
            );
        }
    }
}

#[test]
fn the_error_of_a_sky_is_what_other_directions_find() {
    let folder = folder("lux-error");
    // Half the sky is hidden; the uniform one has no noise of its own.
    let scene = "[sun]\noff = true\n[sky]\nmodel = 'uniform'\nilluminance = 10000\n[[model]]\nbox = { size = [0.2, 30, 40] }\nposition = [3, 0, 0]\n\
                 [[sensor]]\npoints = [[0, 0, 0]]\n";
    std::fs::write(folder.join("wall.toml"), scene).unwrap();
    let row = |more: &[&str]| {
        let csv = text(&keikan(&folder, &[&["lux", "wall.toml"], more].concat()).stdout);
        let rows = rows(&csv);
        ["total_lx", "error_lx"].map(|name| rows[0][name].parse::<f64>().unwrap())
    };
    let [few, error] = row(&["--set", "sky.sensor-rays=256"]);
    let [many, _] = row(&["--set", "sky.sensor-rays=262144"]);
    // Four answers tell a standard error within a factor of about two: eight of them are a bound.
    assert!(error > 0.0 && (few - many).abs() < 8.0 * error, "{few} {error} {many}");
    assert!(error < 0.05 * few, "{few} {error}");
}

#[test]
fn sensors_in_walls_and_waters_without_banks_are_named() {
    let folder = folder("lux-wrong");
    let buried = "[[sensor]]\nname = 'lost'\npoints = [[4.5, -1, 0], [0, 1, 0]]\n";
    std::fs::write(folder.join("buried.toml"), format!("{POOL}{WATER}{buried}")).unwrap();
    let said = text(&keikan(&folder, &["lux", "buried.toml"]).stderr);
    assert!(said.contains("\"lost\": 1 of its 2 points") && said.contains("[4.5, -1.0, 0.0]"), "{said}");
    let open = WATER.replace("-4.2", "-9");
    std::fs::write(folder.join("open.toml"), format!("{POOL}{open}")).unwrap();
    let said = text(&keikan(&folder, &["lux", "open.toml"]).stderr);
    assert!(said.contains("[[water]] \"water-1\" is not closed") && !said.contains("lost"), "{said}");
    // A roof is no bank; a solid is.
    let roof = "[[model]]\nmaterial = 'stone'\nbox = { size = [40, 0.3, 40] }\nposition = [0, 4, 0]\n";
    std::fs::write(folder.join("hall.toml"), format!("{POOL}{roof}{open}")).unwrap();
    let said = text(&keikan(&folder, &["lux", "hall.toml"]).stderr);
    assert!(said.contains("[[water]] \"water-1\" is not closed"), "{said}");
    let solid = "[[solid]]\nmaterial = 'stone'\nbox = { size = [1, 4, 8] }\nposition = [-9.6, -2, 0]\n";
    let front = |z: f32| {
        format!("[[solid]]\nmaterial = 'stone'\nbox = {{ size = [6, 4, 1] }}\nposition = [-7, -2, {z}]\n")
    };
    let banks = [solid.to_owned(), front(-3.7), front(3.7)].concat();
    std::fs::write(folder.join("solid.toml"), format!("{POOL}{banks}{open}")).unwrap();
    let said = text(&keikan(&folder, &["lux", "solid.toml"]).stderr);
    assert!(!said.contains("is not closed"), "{said}");
    // Deep under ink: dark, but in no wall.
    let ink = "absorption = [[400, 200], [700, 200]]\nscattering = [[400, 0], [700, 0]]\n";
    let deep = "[[sensor]]\nname = 'deep'\npoints = [[0, -1.9, 0]]\n";
    std::fs::write(folder.join("ink.toml"), format!("{POOL}{WATER}{ink}{deep}")).unwrap();
    let said = text(&keikan(&folder, &["lux", "ink.toml"]).stderr);
    assert!(!said.contains("\"deep\""), "{said}");
    let impossible = format!("{POOL}{WATER}scattering = [[550, 2]]\nextinction = [[550, 1]]\n");
    std::fs::write(folder.join("b.toml"), impossible).unwrap();
    let output = keikan(&folder, &["lux", "b.toml"]);
    let said = text(&output.stderr);
    assert!(
        said.contains("[[water]] \"water-1\": at 550 nm scattering b (2 1/m) exceeds the extinction"),
        "{said}"
    );
    assert_eq!(output.status.code(), Some(1));
}
