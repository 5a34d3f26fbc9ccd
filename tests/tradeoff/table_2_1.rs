//! Table 2.1 of the thesis remade: what scanline localisation and bounding volumes save, and what is left of
//! error for the time.
//!
//! Direct light and mirrors only: glints of lamps are hidden in all cases, as in eq. 2.1. A few pixels of them, a thousand
//! times as bright as white, would be all that an error measures.

use std::path::Path;

use keikan::pipeline::Pipeline;
use keikan_tests::{build, luminances};

use crate::clock;

const SIZE: (u32, u32) = (512, 384);

/// Rays a pixel of the converged picture.
const CONVERGED: &str = "256";

type Knobs = [(&'static str, &'static str)];

/// Four samples a pixel in all of them: rays in case I, lines and places on bodies in the others.
const CASES: [(&str, &Knobs); 6] = [
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
    ("II + scanline", &[("accelerate", "none"), ("shadows", "rays"), FOUR_LINES, FOUR_PLACES]),
    ("III + boxes, view", &[("accelerate", "view"), ("shadows", "rays"), FOUR_LINES, FOUR_PLACES]),
    ("IV + boxes, shadows", &[("shadows", "rays"), FOUR_LINES, FOUR_PLACES]),
    ("IV + intervals", &[FOUR_LINES, FOUR_PLACES]),
    ("default", &[]),
];

const FOUR_LINES: (&str, &str) = ("sub-scanlines", "4");
const FOUR_PLACES: (&str, &str) = ("body.samples", "4");

/// The thesis' times relative to its case II, by case I to IV, for 1, 2 and 3 lights.
const THESIS: [[f64; 4]; 3] = [[2.50, 1.0, 0.65, 0.18], [2.51, 1.0, 0.85, 0.16], [2.36, 1.0, 0.89, 0.12]];

fn scene(lights: usize) -> scene::Scene {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/thesis");
    scene::load(&root.join(format!("fig-2-8d-{lights}.toml"))).expect("the thesis' scene")
}

/// A picture, and the processor seconds it took: the least of `runs`.
fn shot(pipeline: &Pipeline, runs: usize) -> (Vec<f32>, f64) {
    let shots = (0..runs).map(|_| clock::shot(pipeline, SIZE));
    let (film, took) =
        shots.min_by(|a, b| a.1.processor.total_cmp(&b.1.processor)).expect("at least one run");
    (luminances(&film), took.processor)
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
    println!("(RMSE of the whole picture against {CONVERGED} rays a pixel; white = 1)");
    println!(
        "{:<7} {:<20} {:>9} {:>10} {:>8} {:>9}",
        "lights", "case", "cpu s", "/ case II", "thesis", "RMSE"
    );
    for lights in [3, 2, 1] {
        let scene = scene(lights);
        let make = |knobs: &Knobs| build(&scene, SIZE, &[knobs, &[("lamp.glints", "hidden")]].concat()).1;
        let (converged, _) = shot(&make(&rays(CONVERGED)), 1);
        let shots: Vec<_> = CASES.iter().map(|(_, knobs)| shot(&make(knobs), 2)).collect();
        let second = shots[1].1;
        for (i, ((name, _), (seen, took))) in CASES.iter().zip(&shots).enumerate() {
            let thesis = THESIS[lights - 1].get(i).map_or("-".to_owned(), |ratio| format!("{ratio:.2}"));
            let error = rmse(seen, &converged);
            println!("{lights:<7} {name:<20} {took:>9.3} {:>10.3} {thesis:>8} {error:>9.5}", took / second);
        }
        println!("        I / IV {:.1}, I / default {:.1}", shots[0].1 / shots[3].1, shots[0].1 / shots[5].1);
        let same = shots[1].0 == shots[2].0 && shots[2].0 == shots[3].0;
        println!("        II, III and IV are {} to the bit", if same { "the same" } else { "NOT the same" });
        if lights == 3 {
            trade(lights, shots[0].1, &make, &converged);
        }
    }
}

/// Jittered supersampling by our own rays.
fn rays(samples: &'static str) -> [(&'static str, &'static str); 3] {
    [("visibility", "rays"), ("shading", "span"), ("samples", samples)]
}

/// Error against time of the defaults and of rays, and the two verdicts.
fn trade(lights: usize, first: f64, make: &dyn Fn(&Knobs) -> Pipeline, converged: &[f32]) {
    let measure = |name: String, knobs: &Knobs| {
        let (seen, took) = shot(&make(knobs), 2);
        let error = rmse(&seen, converged);
        println!("{lights:<7} {name:<20} {took:>9.3} {:>10} {:>8} {error:>9.5}", "", "");
        (took, error)
    };
    let by_rays = ["4", "16", "36", "64"].map(|n| measure(format!("rays {n}"), &rays(n)));
    for (name, knobs) in DEFAULTS {
        let (took, error) = measure(name.to_owned(), knobs);
        let equal = seconds_at(error, &by_rays);
        println!(
            "        case I takes {:.1} times as long, rays at equal error {:.1} times",
            first / took,
            equal / took
        );
    }
}

/// The presets' lines and places on bodies.
const DEFAULTS: [(&str, &Knobs); 4] = [
    ("4 lines, 4 places", &[FOUR_LINES, FOUR_PLACES]),
    ("4 lines, 16 places", &[FOUR_LINES, ("body.samples", "16")]),
    ("default", &[]),
    ("16 lines, 64 places", &[("sub-scanlines", "16"), ("body.samples", "64"), ("body.tolerance", "0")]),
];

/// When rays reach an error: straight between (and beyond) what was measured, in logarithms.
fn seconds_at(error: f64, measured: &[(f64, f64)]) -> f64 {
    let next = measured.iter().position(|(_, e)| *e < error).unwrap_or(measured.len() - 1).max(1);
    let [a, b] = [measured[next - 1], measured[next]].map(|(seconds, error)| (seconds.ln(), error.ln()));
    (a.0 + (error.ln() - a.1) * (b.0 - a.0) / (b.1 - a.1)).exp()
}
