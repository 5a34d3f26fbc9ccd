//! `keikan sky`, skies from tables, and skies under a sun that is down, as a user meets them.

mod common;

use std::fs;
use std::path::Path;
use std::process::Output;

use common::{folder, keikan, text};
use exr::prelude::{FlatSamples, read_all_flat_layers_from_file};

fn done(folder: &Path, arguments: &[&str]) -> Output {
    let done = keikan(folder, arguments);
    assert!(done.status.success(), "{arguments:?}: {}", text(&done.stderr));
    done
}

fn json(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    serde_json::from_slice(&done(folder, arguments).stdout).unwrap()
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn files(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

/// Width and the luminances of an EXR, its comments and its white.
fn luminances(file: &Path) -> (usize, Vec<f32>, String, f32) {
    let image = read_all_flat_layers_from_file(file).unwrap();
    let layer = &image.layer_data[0];
    let y = layer.channel_data.list.iter().find(|channel| channel.name.to_string() == "Y").unwrap();
    let FlatSamples::F32(values) = &y.sample_data else { panic!("Y is f32") };
    let comments = layer.attributes.comments.as_ref().unwrap().to_string();
    (layer.size.0, values.clone(), comments, layer.attributes.white_luminance.unwrap())
}

#[test]
fn a_place_and_a_time_are_enough() {
    let folder = folder("place");
    let asked =
        ["sky", "--place", "35.68,139.77", "--time", "2026-06-21T10:00:00+09:00", "--model", "cie-12"];
    let said = text(&done(&folder, &asked).stdout);
    for word in ["2026-06-21 01:00:00 UTC", "latitude 35.6800°", "sky cie-12", "zenith", "lx"] {
        assert!(said.contains(word), "{word} is missing from {said}");
    }
    let report = json(&folder, &[&asked[..], &["--json"]].concat());
    // The same moment by hand in crates/scene: declination 23.44°, hour angle −25.7°.
    assert!((number(&report["sun"]["altitude"]) - 64.7).abs() < 0.05);
    assert_eq!(
        (report["time"]["zone"].as_str(), report["sky"]["model"].as_str()),
        (Some("+09"), Some("cie-12"))
    );
    let [sky, direct, facing, global] = [
        &report["sky"]["horizontal_lux"],
        &report["sun"]["horizontal_lux"],
        &report["sun"]["normal_lux"],
        &report["global_lux"],
    ]
    .map(number);
    // By the IES' clear sky, 800 + 15 500 √sin h, found once more by the quadrature of the open sky (1e-3).
    let sin = number(&report["sun"]["altitude"]).to_radians().sin();
    assert!((sky / (800.0 + 15_500.0 * sin.sqrt()) - 1.0).abs() < 2e-3, "{sky}");
    // Products of f32.
    assert!((direct / (facing * sin) - 1.0).abs() < 1e-5 && (global / (sky + direct) - 1.0).abs() < 1e-6);
    // Skies are bluer than their sun.
    let x = |of: &serde_json::Value| number(&of[0]);
    assert!(x(&report["sky"]["zenith_chromaticity"]) < x(&report["sun"]["chromaticity"]));
    assert!(x(&report["sky"]["diffuse_chromaticity"]) < x(&report["sun"]["chromaticity"]));
    assert_eq!(files(&folder), 0);
}

#[test]
fn a_scene_is_asked_for_its_own_sky_and_others() {
    let folder = folder("scene");
    let own = json(&folder, &["sky", "--json"]);
    assert_eq!(own["sky"]["model"], "physical");
    let noon = json(&folder, &["sky", "--json", "--time", "12:00", "--set", "sky.model=thesis"]);
    assert!(number(&noon["sun"]["altitude"]) > number(&own["sun"]["altitude"]));
    assert_eq!(noon["sky"]["traits"]["turbidity β (Ångström)"], 0.09);
    let perez = json(&folder, &["sky", "--json", "--sun", "40,180", "--model", "perez"]);
    assert!(number(&perez["sky"]["traits"]["clearness ε"]) > 4.5, "a clear day by default");
    assert!(perez["time"].is_null());
}

#[test]
fn pictures_have_north_up_and_east_left() {
    let folder = folder("picture");
    // Half-way up in the east.
    done(&folder, &["sky", "--sun", "45,90", "--size", "65", "-o", "a.exr", "-o", "a.png"]);
    done(&folder, &["sky", "--sun", "45,90", "--size", "65", "--projection", "horizontal", "-o", "h.exr"]);
    let brightest = |name: &str| {
        let (width, y, comments, white) = luminances(&folder.join(name));
        assert!(comments.contains("north up, east left") && white == 1.0, "{comments}");
        let at = (0..y.len()).max_by(|&a, &b| y[a].total_cmp(&y[b])).unwrap();
        assert_eq!([y[0], y[width - 1], y[y.len() - 1]], [0.0; 3], "corners are beyond the horizon");
        [at % width, at / width]
    };
    // Columns of 2/65; the middle one is 32: half the radius, and cos 45°, to the left of it.
    assert_eq!(brightest("a.exr"), [16, 32]);
    assert_eq!(brightest("h.exr"), [9, 32]);
    assert_eq!(image::open(folder.join("a.png")).unwrap().width(), 65);
}

#[test]
fn relative_luminances_are_shares_of_the_largest() {
    let folder = folder("relative");
    let asked = ["sky", "--sun", "40,180", "--model", "thesis", "--size", "181"];
    done(&folder, &[&asked[..], &["-o", "a.exr"]].concat());
    let report = json(&folder, &[&asked[..], &["-o", "r.exr", "--relative", "--json"]].concat());
    let largest = number(&report["sky"]["largest_above_10_deg"]) as f32;
    let ((_, a, ..), (width, r, _, white)) =
        (luminances(&folder.join("a.exr")), luminances(&folder.join("r.exr")));
    assert_eq!(white, largest);
    // One product each.
    assert!(a.iter().zip(&r).all(|(a, r)| (a - r * white).abs() <= 4.0 * f32::EPSILON * a));
    let above = (0..r.len()).filter(|i| {
        let [x, y] = [i % width, i / width].map(|k| (k as f64 + 0.5) * 2.0 / width as f64 - 1.0);
        x.hypot(y) <= 80.0 / 90.0
    });
    let most = above.map(|i| r[i]).fold(0.0, f32::max);
    // This sky is brightest at 10° itself, below the sun, and falls by 1.6 % a degree; pixels are a degree apart.
    assert!((0.984..=1.0).contains(&most), "{most}");
}

/// A lawn with sensors that face up and the four quarters, turned: north lies 30° clockwise from −Z.
const LAWN: &str = "[site]\nlatitude = 35\nlongitude = 139\nnorth = 30\n\
    [sun]\naltitude = 40\nazimuth = 140\n[[model]]\nplane = { size = [1, 1] }\nposition = [0, -1, 0]\n\
    [[sensor]]\npoints = [[0, 0, 0]]\n[[sensor]]\npoints = [[0, 0, 0]]\nnormal = [1, 0, 0]\n\
    [[sensor]]\npoints = [[0, 0, 0]]\nnormal = [-1, 0, 0]\n[[sensor]]\npoints = [[0, 0, 0]]\nnormal = [0, 0, 1]\n\
    [[sensor]]\npoints = [[0, 0, 0]]\nnormal = [0, 0, -1]\n";

/// Lux of the sky on each sensor, without light from the ground.
fn sky_lux(folder: &Path, scene: &str) -> Vec<f64> {
    let table = json(folder, &["lux", scene, "--json", "--set", "sky.albedo=0"]);
    let sky = table["columns"].as_array().unwrap().iter().position(|c| c["source"] == "sky").unwrap();
    table["rows"].as_array().unwrap().iter().map(|row| number(&row["parts"][sky])).collect()
}

#[test]
fn a_sky_written_as_a_table_gives_nearly_the_same_light() {
    let folder = folder("table");
    let write =
        |name: &str, sky: &str| fs::write(folder.join(name), format!("{LAWN}[sky]\n{sky}\n")).unwrap();
    for (model, bounds) in BOUNDS {
        write("model.toml", &format!("model = \"{model}\""));
        write("table.toml", "table = \"sky.csv\"");
        let own = sky_lux(&folder, "model.toml");
        assert!(own.iter().all(|&lux| lux > 100.0), "{own:?}");
        for (step, bound) in ["5", "2.5"].into_iter().zip(bounds) {
            done(&folder, &["sky", "model.toml", "--table", "sky.csv", "--step", step]);
            let measured = sky_lux(&folder, "table.toml");
            for (own, measured) in own.iter().zip(&measured) {
                println!("{model} {step}: {:.5}", measured / own);
                assert!(
                    (measured / own - 1.0).abs() < bound,
                    "{model}, step {step}: {own} became {measured}"
                );
            }
        }
    }
    // Scaled as any sky is.
    write("table.toml", "table = \"sky.csv\"\nilluminance = 5000");
    let measured = sky_lux(&folder, "table.toml")[0];
    assert!((measured / 5000.0 - 1.0).abs() < 1e-3, "{measured}: two quadratures of 1.5°");
    let plan = text(&done(&folder, &["plan", "table.toml"]).stdout);
    assert!(
        plan.contains("sky measured") && plan.contains("a table of 37 altitudes and 144 azimuths"),
        "{plan}"
    );
    done(
        &folder,
        &[
            "render",
            "table.toml",
            "--size",
            "8x8",
            "--preset",
            "draft",
            "-o",
            "a.png",
            "--set",
            "sky.clear=1",
        ],
    );
}

/// Of the light on any plane, at steps h of 5 and 2.5°. Straight lines lie below a curve by h²/12 of its second derivative
/// on the average. For the overcast sky that is at most h²/12 of the luminance (the part with sin of the altitude), 6.4e-4
/// at 5°. The others bend more, towards the horizon and about the sun; their bounds are what was measured and a tenth, there to
/// tell when it grows.
const BOUNDS: [(&str, [f64; 2]); 3] =
    [("overcast", [6.4e-4, 1.6e-4]), ("clear", [1.6e-3, 4.5e-4]), ("physical", [4.6e-3, 1.15e-3])];

#[test]
fn a_table_may_go_to_stdout() {
    let folder = folder("stdout");
    let run = done(&folder, &["sky", "--sun", "30,90", "--model", "uniform", "--table", "-", "--step", "45"]);
    let table = text(&run.stdout);
    let rows: Vec<&str> = table.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!(rows[0], "altitude,0,45,90,135,180,225,270,315");
    assert_eq!(rows.len(), 1 + 3);
    assert!(rows[3].starts_with("90,"), "{table}");
    // 300 + 21 000 sin 30° = 10 800 lx over π; the quadrature that scales it is off by 1e-4.
    let luminance: f64 = rows[1].split(',').nth(3).unwrap().parse().unwrap();
    assert!((luminance * std::f64::consts::PI / 10_800.0 - 1.0).abs() < 1e-3, "{luminance}");
    assert!(text(&run.stderr).contains("sky uniform"), "the report goes where messages go");
    assert_eq!(files(&folder), 0);
}

#[test]
fn wrong_arguments_are_2_and_write_nothing() {
    let folder = folder("usage");
    for (arguments, word) in [
        (
            &["--place", "95,0", "--time", "2026-06-21T10:00:00+09:00"][..],
            "latitude 95 is not within [-90, 90]",
        ),
        (&["--place", "35,139", "--time", "2026-02-30T10:00:00+09:00"], "2026-02-30"),
        (&["--place", "35,139", "--time", "2026-06-21T10:00:00"], "offset from UTC is missing"),
        (&["--place", "35,139", "--time", "10:00"], "the date and the offset"),
        (&["--place", "35,139"], "--time"),
        (&["a.toml", "--sun", "40,180"], "cannot be used with"),
        (&["--sun", "140,180"], "altitude 140"),
        (&["--model", "purple"], "cie-15"),
        (&["--model", "measured"], "names no table"),
        (&["--step", "7", "--table", "a.csv"], "multiple"),
        (&["--table", "-", "--json"], "stdout"),
        (&["--layers", "-o", "a.exr"], "one layer"),
        (&["-o", "a.bmp"], "exr, png"),
        (&["-o", "a.exr", "--table", "a.exr"], ".csv"),
    ] {
        let run = keikan(&folder, &[&["sky"], arguments].concat());
        let said = text(&run.stderr);
        let code = if arguments.contains(&"measured") { 1 } else { 2 };
        assert_eq!(run.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(said.contains(word), "{arguments:?}: {said}");
    }
    // All or none: the table could be written, the picture not.
    let run = keikan(&folder, &["sky", "--table", "a.csv", "-o", "no/such/folder/a.exr"]);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let run = keikan(&folder, &["sky", "--model", "none"]);
    assert!(run.status.code() == Some(1) && text(&run.stderr).contains("no sky to show"));
    assert_eq!(files(&folder), 0);
}

#[test]
fn bouguer_and_nagata_share_the_light() {
    let folder = folder("nagata");
    // (P, h, I_DN sin h, I_SH) [W/m²] of the printed formulas with I_0 = 1367 W/m² and m = 1/sin h, as Japanese
    // building-energy programs that cite Nagata 1978 compute them; here the ratio counts.
    for (p, altitude, direct, diffuse, bound) in [
        // Kasten and Young's m is below 1/sin h by 0.7 % at 20° (times m ln P: 1.3 % of the ratio), 0.3 % at 30°.
        ("0.6", "20", 105.00, 114.82, 0.015),
        ("0.7", "30", 334.91, 103.70, 0.005),
        ("0.65", "50", 596.76, 122.78, 0.003),
        ("0.7", "60", 784.21, 101.68, 0.003),
        ("0.8", "80", 1073.28, 61.90, 0.003),
        ("0.7", "90", 956.90, 96.21, 0.003),
    ] {
        for model in ["clear", "thesis"] {
            let sun = format!("{altitude},180");
            let set = format!("sky.transmittance={p}");
            let asked = [
                "sky",
                "--json",
                "--sun",
                &sun,
                "--model",
                model,
                "--set",
                "sky.scale=nagata",
                "--set",
                &set,
            ];
            let report = json(&folder, &asked);
            let ratio = number(&report["sky"]["horizontal_lux"]) / number(&report["sun"]["horizontal_lux"]);
            assert!((ratio / (diffuse / direct) - 1.0).abs() < bound, "{model} {p} {altitude}: {ratio}");
        }
    }
    let scene =
        LAWN.replace("azimuth = 140", "azimuth = 140\nilluminance = 9") + "[sky]\nscale = \"nagata\"\n";
    fs::write(folder.join("a.toml"), scene).unwrap();
    let plan = done(&folder, &["plan", "a.toml"]);
    assert!(text(&plan.stdout).contains("as bright as Nagata says for P = 0.7"), "{}", text(&plan.stdout));
    let said = text(&plan.stderr);
    assert!(said.contains("the formulas say how bright sun and sky are, not [sun] illuminance"), "{said}");
}

/// What a command says on stderr about a scene of this sun and sky.
fn said(folder: &Path, altitude: f64, sky: &str, command: &str) -> String {
    let text_of_scene = format!(
        "[sun]\naltitude = {altitude}\nazimuth = 200\n[sky]\n{sky}\n[[model]]\nplane = {{ size = [1, 1] }}\n[[sensor]]\npoints = [[0, 1, 0]]\n"
    );
    fs::write(folder.join("dusk.toml"), text_of_scene).unwrap();
    let more: &[&str] = match command {
        "render" => &["--size", "8x8", "--preset", "draft", "-o", "a.png"],
        _ => &[],
    };
    text(&done(folder, &[&[command, "dusk.toml"], more].concat()).stderr)
}

#[test]
fn a_sky_of_the_day_says_when_the_sun_is_down() {
    let folder = folder("dusk");
    for command in ["render", "plan", "lux", "sky"] {
        let words = said(&folder, -3.25, "model = \"cie-12\"", command);
        assert!(
            words.contains("warning: the sun is 3.25° below the horizon, and the model cie-12"),
            "{command}: {words}"
        );
        let words = said(&folder, 3.25, "model = \"cie-12\"", command);
        assert!(!words.contains("warning"), "{command}: {words}");
    }
    for model in ["clear", "overcast", "thesis", "perez", "uniform", "cie-1", "cie-7", "cie-15"] {
        let words = said(&folder, -3.25, &format!("model = \"{model}\""), "plan");
        assert!(words.contains("3.25° below the horizon"), "{model}: {words}");
    }
    assert!(!said(&folder, -3.25, "model = \"physical\"", "plan").contains("warning"), "it knows twilight");
    for (sky, altitude, word) in [
        ("model = \"physical\"", -30.0, "the sky is black"),
        ("model = \"clear\"", -30.0, "it is black"),
        ("model = \"clear\"\nilluminance = 900", -30.0, "as bright as stated"),
        ("model = \"thesis\"\nilluminance = 900", -30.0, "black, whatever its illuminance"),
        ("model = \"physical\"\nilluminance = 900", -8.0, "as bright as stated"),
        ("scale = \"nagata\"", -3.0, "by Nagata's formula it gives no light"),
    ] {
        let words = said(&folder, altitude, sky, "plan");
        assert!(words.contains(word), "{sky}: {words}");
        // The words are true: a millionth of a lux is a thousandth of a starlit night.
        let report = json(&folder, &["sky", "dusk.toml", "--json"]);
        let black = number(&report["sky"]["horizontal_lux"]) < 1e-6;
        assert_eq!(black, !word.contains("stated"), "{sky}: {report}");
    }
}

#[test]
fn broken_skies_are_1_and_name_their_fault() {
    let folder = folder("broken");
    let site = "[site]\nlatitude = 52.3\nlongitude = 4.77\ntime = 2026-08-01T11:30:00Z\n";
    let lawn = "[[model]]\nplane = { size = [1, 1] }\n";
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    let hour = |irradiance: &str| {
        let blank = "0,".repeat(6);
        format!(
            "1990,8,1,12,60,x,20,9,50,101000,0,0,300,{irradiance},100,{blank}0\n1990,8,1,13,60,x,20,9,50,101000,0,0,300,{irradiance},100,{blank}0\n"
        )
    };
    let epw = |records: u32, irradiance: &str| {
        format!(
            "LOCATION,Here,-,NLD,IWEC,0,52.30,4.77,1.0,-2.0\nDATA PERIODS,1,{records},Data,Sunday,1/1,12/31\n{}",
            hour(irradiance)
        )
    };
    write("half.epw", &epw(2, "500,100"));
    write("missing.epw", &epw(1, "9999,9999"));
    write("short.csv", "altitude,0,90,180,270\n0,1,2,3,4\n45,1,2,x,4\n90,1,1,1,1\n");
    write("empty.csv", "");
    for (scene, words) in [
        (site.replace("52.3", "95"), "95 is not within [-90, 90] degrees"),
        (site.replace("2026-08-01", "2026-02-30"), "line "),
        (format!("{site}[sky]\nweather = \"half.epw\"\n"), "half.epw: line 2: \"2\" records an hour"),
        (
            format!("{site}[sky]\nweather = \"missing.epw\"\n"),
            "missing.epw: the weather file has no direct normal irradiance",
        ),
        (format!("{site}[sky]\nweather = \"none.epw\"\n"), "none.epw"),
        (
            format!("{site}[sky]\ntable = \"short.csv\"\n"),
            "short.csv: line 3, column 4: luminance at altitude 45°, azimuth 180°: \"x\"",
        ),
        (format!("{site}[sky]\ntable = \"empty.csv\"\n"), "empty.csv: has no line of azimuths"),
        (format!("{site}[sky]\nmodel = \"purple\"\n"), "no such sky; there are: clear"),
    ] {
        write("a.toml", &format!("{scene}{lawn}"));
        let before = files(&folder);
        for command in ["render", "plan", "sky"] {
            let more: &[&str] = if command == "render" { &["-o", "a.png"] } else { &[] };
            let run = keikan(&folder, &[&[command, "a.toml"], more].concat());
            let said = text(&run.stderr);
            assert_eq!(run.status.code(), Some(1), "{command}: {said}");
            assert!(said.contains(words) && !said.contains("panicked"), "{command}: {said}");
        }
        assert_eq!(files(&folder), before);
    }
}

#[test]
fn differences_are_drawn() {
    let folder = folder("difference");
    for model in ["clear", "uniform"] {
        let file = format!("{model}.exr");
        done(
            &folder,
            &["sky", "--sun", "40,180", "--model", model, "--relative", "--size", "33", "-o", &file],
        );
    }
    done(
        &folder,
        &[
            "compare",
            "clear.exr",
            "uniform.exr",
            "-o",
            "d.exr",
            "-o",
            "d.png",
            "--false-colour=0:1",
            "--linear",
        ],
    );
    let [(_, a, ..), (_, b, ..), (_, d, ..)] =
        ["clear.exr", "uniform.exr", "d.exr"].map(|name| luminances(&folder.join(name)));
    for ((a, b), d) in a.iter().zip(&b).zip(&d) {
        // Luminance once by the observer, once from linear sRGB: matrices of f32.
        assert!(((a - b).abs() - d).abs() <= 1e-5 * a.max(*b), "{a} {b} {d}");
    }
    assert!(d.iter().any(|&d| d > 0.1));
}
