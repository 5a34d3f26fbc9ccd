//! What is left of edges: scanlines against jittered rays.

use std::time::Instant;

use keikan::pipeline::Monitor;
use keikan_tests::{luminances, pipeline};

const PARK: &str = include_str!("../../crates/cli/scenes/park.toml");
const SIZE: (u32, u32) = (320, 200);

/// Light without shadows, so that the only edges are those of what is seen.
const LIGHT: [(&str, &str); 3] = [("shadows", "off"), ("sky.model", "none"), ("sun.samples", "1")];

struct Run {
    name: String,
    seconds: f64,
    picture: Vec<f32>,
}

/// Median of three renders; assembling is not counted, since it is the same for all.
fn run(name: String, knobs: &[(&str, &str)]) -> Run {
    let (plan, pipeline) = pipeline(PARK, SIZE, &[&LIGHT, knobs].concat());
    let mut times = Vec::new();
    let mut picture = Vec::new();
    for _ in 0..if name.contains("4096") { 1 } else { 3 } {
        let start = Instant::now();
        let film = pipeline.render(&plan.region, false, &Monitor::default()).expect("nobody interrupts");
        times.push(start.elapsed().as_secs_f64());
        picture = luminances(&film);
    }
    times.sort_unstable_by(f64::total_cmp);
    Run { name, seconds: times[times.len() / 2], picture }
}

/// √mean (a − b)² over the pixels that are `edges`, relative to the mean of b over all.
fn rmse(a: &[f32], b: &[f32], edges: &[bool]) -> f64 {
    let mean = b.iter().map(|&b| f64::from(b)).sum::<f64>() / b.len() as f64;
    let squares: Vec<f64> =
        (0..a.len()).filter(|&i| edges[i]).map(|i| f64::from(a[i] - b[i]).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt() / mean
}

/// Pixels in which more than one face, or a face and the background, show.
fn edges() -> Vec<bool> {
    let (_, pipeline) = pipeline(PARK, SIZE, &[&LIGHT[..], &[("sub-scanlines", "16")]].concat());
    let mut edges = vec![false; (SIZE.0 * SIZE.1) as usize];
    pipeline.see.see(0..SIZE.1, 0..SIZE.0, &mut |row, pieces| {
        let row = &mut edges[(row * SIZE.0) as usize..][..SIZE.0 as usize];
        let mut shares = vec![(0u32, 0.0f32); row.len()];
        for piece in pieces.iter() {
            let (count, largest) = &mut shares[piece.column as usize];
            *count += 1;
            *largest = largest.max(piece.share);
        }
        for (edge, (count, largest)) in row.iter_mut().zip(shares) {
            *edge = count > 1 || (count == 1 && largest < 0.999);
        }
    });
    edges
}

pub(crate) fn table() {
    let edges = edges();
    let reference = run("rays 4096".to_owned(), &[("visibility", "rays"), ("samples", "4096")]);
    let mut runs = Vec::new();
    for rule in ["exact", "midpoint", "trapezoid"] {
        for n in ["1", "2", "4", "8"] {
            runs.push(run(format!("scanline {n} {rule}"), &[("sub-scanlines", n), ("scan-rule", rule)]));
        }
    }
    for n in ["1", "4", "16", "64"] {
        runs.push(run(format!("rays {n}"), &[("visibility", "rays"), ("samples", n)]));
    }
    let share = edges.iter().filter(|&&e| e).count() as f64 / edges.len() as f64;
    println!("\nedges of the park, {} x {}, {:.0} % of pixels are edges", SIZE.0, SIZE.1, 100.0 * share);
    println!(
        "(reference: 4096 rays a pixel, {:.1} s; its own noise at edges is about 1/4096^0.75 = 0.2 %)",
        reference.seconds
    );
    println!("{:<22} {:>9} {:>16} {:>16}", "method", "seconds", "RMSE at edges", "RMSE everywhere");
    let all = vec![true; edges.len()];
    for run in runs {
        let (at_edges, everywhere) =
            (rmse(&run.picture, &reference.picture, &edges), rmse(&run.picture, &reference.picture, &all));
        println!("{:<22} {:>9.3} {at_edges:>16.5} {everywhere:>16.5}", run.name, run.seconds);
    }
}
