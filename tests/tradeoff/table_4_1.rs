//! Table 4.1 of the thesis remade: a town of some 800 objects, its sky light by bands, cuboid, patches and rays, with maps and
//! without.

use std::path::Path;

use keikan::pipeline::Pipeline;
use keikan_tests::{build, luminances};

use crate::clock::{Took, shot};

type Knobs = [(&'static str, &'static str)];

/// Size of pictures without maps, which take long.
const SMALL: (u32, u32) = (96, 54);
/// Size of pictures with maps.
const LARGE: (u32, u32) = (1920, 1080);

/// Rays a place of the picture that the others are judged by.
const CONVERGED: &str = "2048";

/// Who asks how much of the sky is seen, coarse and fine.
const STAGES: [(&str, &Knobs); 13] = [
    ("bands 10", &[BANDS, ("sky.bands", "10")]),
    ("bands 20", &[BANDS, ("sky.bands", "20")]),
    ("bands 40", &[BANDS, ("sky.bands", "40")]),
    ("cuboid 10", &[CUBOID, ("sky.elements", "10")]),
    ("cuboid 20", &[CUBOID, ("sky.elements", "20")]),
    ("cuboid 40", &[CUBOID, ("sky.elements", "40")]),
    ("cuboid 80", &[CUBOID, ("sky.elements", "80")]),
    ("patches 7", &[PATCHES, ("sky.patches", "7")]),
    ("patches 10", &[PATCHES, ("sky.patches", "10")]),
    ("patches 28", &[PATCHES, ("sky.patches", "28")]),
    ("rays 64", &[RAYS, ("sky.rays", "64")]),
    ("rays 256", &[RAYS, ("sky.rays", "256")]),
    ("rays 1024", &[RAYS, ("sky.rays", "1024")]),
];

const BANDS: (&str, &str) = ("sky.visibility", "bands");
const CUBOID: (&str, &str) = ("sky.visibility", "cuboid");
const PATCHES: (&str, &str) = ("sky.visibility", "patches");
const RAYS: (&str, &str) = ("sky.visibility", "rays");

fn town(figure: &str) -> scene::Scene {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/thesis");
    scene::load(&root.join(format!("fig-{figure}.toml"))).expect("the thesis' scene")
}

/// 4.22: grey levels of 255, white = the 99th percentile of `truth`.
fn rms(seen: &[f32], truth: &[f32]) -> f64 {
    let mut sorted = truth.to_vec();
    sorted.sort_unstable_by(f32::total_cmp);
    let white = f64::from(sorted[sorted.len() * 99 / 100]);
    let squares: f64 =
        seen.iter().zip(truth).map(|(&a, &b)| (255.0 * f64::from(a - b) / white).powi(2)).sum();
    (squares / truth.len() as f64).sqrt()
}

pub(crate) fn table() {
    for (figure, sky) in [("4-15", "overcast"), ("4-16a", "clear, sun 60\u{b0}")] {
        let scene = town(figure);
        without_maps(&scene, sky);
        with_maps(&scene, sky);
    }
}

/// Error and time of each stage asked for each place of a picture.
fn without_maps(scene: &scene::Scene, sky: &str) {
    println!(
        "\ntable 4.1, {sky}: {} x {} without maps, RMS in grey levels against {CONVERGED} rays",
        SMALL.0, SMALL.1
    );
    println!("{:<12} {:>8} {:>9}", "stage", "RMS", "cpu s");
    let make = |knobs: &Knobs| build(scene, SMALL, knobs).1;
    let (truth, _) = picture(&make(&[RAYS, ("sky.rays", CONVERGED)]), SMALL);
    for (name, knobs) in STAGES {
        let (seen, took) = picture(&make(knobs), SMALL);
        println!("{name:<12} {:>8.3} {:>9.2}", rms(&seen, &truth), took.processor);
    }
}

/// What the first picture of a map costs, the further ones, and those without: of cuboid and bands, which take a thousand
/// times as long as it takes to look at a map, the latter alone and small.
fn with_maps(scene: &scene::Scene, sky: &str) {
    println!(
        "\ntable 4.1, {sky}: {} x {} with maps; seconds of the clock and of the processor",
        LARGE.0, LARGE.1
    );
    println!(
        "{:<12} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}",
        "stage", "first", "cpu", "further", "cpu", "no map", "cpu"
    );
    for (name, knobs) in STAGES.iter().filter(|(name, _)| ["patches 10", "rays 64"].contains(name)) {
        let pipeline = build(scene, LARGE, &[knobs, &[("sky.map", "on")][..]].concat()).1;
        let [first, further] = [shot(&pipeline, LARGE).1, shot(&pipeline, LARGE).1];
        let without = shot(&build(scene, LARGE, knobs).1, LARGE).1;
        print!("{name:<12}");
        for took in [first, further, without] {
            print!(" {:>8.2} {:>8.2}", took.wall, took.processor);
        }
        println!("; without a map {:.1} times as long", without.processor / further.processor);
    }
}

fn picture(pipeline: &Pipeline, size: (u32, u32)) -> (Vec<f32>, Took) {
    let (film, took) = shot(pipeline, size);
    (luminances(&film), took)
}
