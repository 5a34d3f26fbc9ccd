//! Table 2.1 of the thesis remade: what scanline localisation and bounding volumes save, and what is left of
//! error for the time.

use std::path::Path;
use std::time::Instant;

use keikan::pipeline::{Monitor, Pipeline, Region};
use keikan_tests::{build, luminances};

const SIZE: (u32, u32) = (512, 384);

/// Where errors are measured: the middle quarter, so that a converged picture can be waited for.
const MIDDLE: Region = Region { columns: 128..384, rows: 96..288 };

/// Rays a pixel of the converged picture.
const CONVERGED: &str = "400";

type Knobs = [(&'static str, &'static str)];

/// Case I shades every ray; four of them a pixel, as II to IV have four lines.
const CASES: [(&str, &Knobs); 5] = [
    (
        "I rays only",
        &[
            ("visibility", "rays"),
            ("shading", "span"),
            ("samples", "4"),
            ("accelerate", "none"),
            ("shadows", "rays"),
        ],
    ),
    ("II + scanline", &[("accelerate", "none"), ("shadows", "rays")]),
    ("III + boxes, view", &[("accelerate", "view"), ("shadows", "rays")]),
    ("IV + boxes, shadows", &[("shadows", "rays")]),
    ("default", &[]),
];

/// The thesis' times relative to its case II, by case I to IV, for 1, 2 and 3 lights.
const THESIS: [[f64; 4]; 3] = [[2.50, 1.0, 0.65, 0.18], [2.51, 1.0, 0.85, 0.16], [2.36, 1.0, 0.89, 0.12]];

fn scene(lights: usize) -> scene::Scene {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/thesis");
    scene::load(&root.join(format!("fig-2-8d-{lights}.toml"))).expect("the thesis' scene")
}

/// Seconds of one picture, the least of `runs`.
fn seconds(pipeline: &Pipeline, runs: usize) -> f64 {
    let whole = Region { columns: 0..SIZE.0, rows: 0..SIZE.1 };
    let once = || {
        let start = Instant::now();
        pipeline.render(&whole, false, &Monitor::default()).expect("nobody interrupts");
        start.elapsed().as_secs_f64()
    };
    (0..runs).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn picture(pipeline: &Pipeline) -> Vec<f32> {
    luminances(&pipeline.render(&MIDDLE, false, &Monitor::default()).expect("nobody interrupts"))
}

/// √mean (a − b)², relative to the 99th percentile of b, which is shown as white.
fn rmse(a: &[f32], b: &[f32]) -> f64 {
    let mut sorted = b.to_vec();
    sorted.sort_unstable_by(f32::total_cmp);
    let white = f64::from(sorted[sorted.len() * 99 / 100]);
    // As shown: what is brighter than white is white. A lamp's highlight on a mirror is thousands of times
    // brighter, and one pixel of it would be all that is measured.
    let shown = |luminance: f32| (f64::from(luminance) / white).min(1.0);
    let squares: f64 = a.iter().zip(b).map(|(&a, &b)| (shown(a) - shown(b)).powi(2)).sum();
    (squares / a.len() as f64).sqrt()
}

pub(crate) fn table() {
    println!("\ntable 2.1: four mirror spheres and 64 prisms, {} x {}, ray depth 5", SIZE.0, SIZE.1);
    println!("(RMSE against {CONVERGED} rays a pixel in the middle quarter; white = 1)");
    println!(
        "{:<7} {:<20} {:>9} {:>10} {:>8} {:>9}",
        "lights", "case", "seconds", "/ case II", "thesis", "RMSE"
    );
    for lights in [3, 2, 1] {
        let scene = scene(lights);
        let make = |knobs: &Knobs| build(&scene, SIZE, knobs).1;
        let converged =
            picture(&make(&[("visibility", "rays"), ("shading", "span"), ("samples", CONVERGED)]));
        let second = seconds(&make(CASES[1].1), 2);
        let mut shown = Vec::new();
        for (i, (name, knobs)) in CASES.iter().enumerate() {
            let pipeline = make(knobs);
            let took = if i == 1 { second } else { seconds(&pipeline, 2) };
            let seen = picture(&pipeline);
            let thesis = THESIS[lights - 1].get(i).map_or("-".to_owned(), |ratio| format!("{ratio:.2}"));
            let error = rmse(&seen, &converged);
            println!("{lights:<7} {name:<20} {took:>9.3} {:>10.3} {thesis:>8} {error:>9.5}", took / second);
            shown.push(seen);
        }
        let same = shown[1] == shown[2] && shown[2] == shown[3];
        println!("        II, III and IV are {} to the bit", if same { "the same" } else { "NOT the same" });
        for n in ["1", "2", "8", "16"] {
            report(lights, &format!("scanline {n}"), &make(&[("sub-scanlines", n)]), &converged);
        }
        for n in ["1", "4", "16", "64"] {
            let rays = make(&[("visibility", "rays"), ("shading", "span"), ("samples", n)]);
            report(lights, &format!("rays {n}"), &rays, &converged);
        }
    }
}

fn report(lights: usize, name: &str, pipeline: &Pipeline, converged: &[f32]) {
    let error = rmse(&picture(pipeline), converged);
    println!("{lights:<7} {name:<20} {:>9.3} {:>10} {:>8} {error:>9.5}", seconds(pipeline, 2), "", "");
}
