//! Lux of whole scenes against the judge, which shares no stage with the pipeline.

use std::path::Path;
use std::time::Instant;

use keikan::args::View;
use keikan::assemble::{Judge, Judged, Measuring, Walks};
use keikan::lux;
use keikan::plan::Plan;
use scene::Scene;

/// Illuminance and its estimated error as `keikan lux` says it, and the judge's, at each sensor point.
fn both(scene: &Scene, set: &[(&str, &str)], samples: u32) -> Vec<([f64; 2], Judged)> {
    let set = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let plan = Plan::new(scene, &View { set, ..View::default() }).expect("a sound plan").at_sensors();
    let start = Instant::now();
    let table = lux::measure(scene, &Measuring::new(&plan, scene).expect("stages that exist"));
    let ours = start.elapsed().as_secs_f64();
    let judge = Judge::new(&plan, scene).expect("a world that can be");
    let judged = judge.lux(scene, &Walks { samples, seed: 1 });
    let theirs = start.elapsed().as_secs_f64() - ours;
    println!("{ours:.2} s here, {theirs:.2} s by the judge, who leaves out {:?}", judge.omitted);
    table.rows.iter().map(|row| [row.total, row.error.unwrap_or(0.0)]).zip(judged).collect()
}

fn show(what: &str, all: &[([f64; 2], Judged)]) {
    println!("{what}: lux here, of the judge, difference, and in standard errors of both");
    for ([value, error], judged) in all {
        println!(
            "{value:10.3} ± {error:7.3} {:10.3} ± {:7.3}   {:+.2} %  {:+.2}",
            judged.value,
            judged.error,
            100.0 * (value / judged.value - 1.0),
            (value - judged.value) / judged.error.hypot(*error)
        );
    }
}

/// A scene of `scenes/` with no more than `most` sensor points, spread over all.
fn thinned(text: &str, most: usize) -> Scene {
    let mut scene =
        scene::parse(text, Path::new("../scenes"), Path::new("test.toml")).expect("a sound scene");
    let count: usize = scene.sensors.iter().map(|sensor| sensor.points.len()).sum();
    let step = count.div_ceil(most);
    let mut number = 0;
    for sensor in &mut scene.sensors {
        sensor.points.retain(|_| {
            number += 1;
            number % step == step / 2
        });
    }
    scene
}

const OFF: (&str, &str) = ("interreflection", "off");
const ON: [(&str, &str); 2] = [("interreflection", "patches"), ("interreflection.patches", "3000")];

#[test]
#[ignore = "minutes: a look at all scenes, for who changes something"]
fn every_scene_beside_the_judge() {
    let open = "[site]\nlatitude = 35.68\nlongitude = 139.77\ntime = 2026-10-12T15:30:00+09:00\n[sky]\nmodel = 'clear'\n\
        [[sensor]]\npoints = [[0, 0, 0], [1, 0, 0]]\n[[sensor]]\npoints = [[0, 0, 0]]\nnormal = [0, 0, 1]\n";
    for (name, text) in [
        ("open", open),
        ("courtyard", include_str!("../../scenes/courtyard.toml")),
        ("lamps", include_str!("../../scenes/lamps.toml")),
        ("plaza", include_str!("../../scenes/plaza-at-night.toml")),
        ("slope", include_str!("../../scenes/slope.toml")),
        ("pool", include_str!("../../scenes/pool.toml")),
    ] {
        for set in [&[OFF][..], &ON] {
            let all = both(&thinned(text, 12), set, 40_000);
            show(&format!("{name}, {set:?}"), &all);
        }
    }
}
