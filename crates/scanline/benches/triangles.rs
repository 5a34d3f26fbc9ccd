//! Seconds and memory from 10⁴ to 10⁶ triangles of terrain at 1920 × 1080 (10⁷ with `KEIKAN_BENCH_LARGE=1`).
//!
//! `once` lines are single runs, printed with the parts of the time; criterion repeats the smaller ones.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion};
use glam::{DAffine3, DVec3, Vec3};
use keikan_scanline::{Knobs, Scanline};
use light::{Geometry, Instance, Mesh, See, View};
use rayon::prelude::*;

const WIDTH: u32 = 1920;
const HEIGHT: u32 = 1080;
/// Rows that a task looks at, as the program does it.
const BAND: u32 = 16;

/// Hills of many sizes, 4 km wide, of about `count` triangles.
fn terrain(count: u32) -> Geometry {
    let n = f64::from(count / 2).sqrt() as u32;
    let height = |x: f32, z: f32| {
        let octave = |k: i32| {
            let f = 0.002 * 2f32.powi(k);
            (f * x + 1.3 * k as f32).sin() * (f * z - 0.7 * k as f32).cos() * 120.0 * 0.45f32.powi(k)
        };
        (0..8).map(octave).sum::<f32>()
    };
    let at = |i: u32| (i as f32 / n as f32 - 0.5) * 4000.0;
    let mut mesh = Mesh::default();
    for j in 0..=n {
        mesh.positions.extend((0..=n).map(|i| Vec3::new(at(i), height(at(i), at(j)), at(j))));
    }
    for j in 0..n {
        for i in 0..n {
            let a = j * (n + 1) + i;
            let c = a + n + 1;
            mesh.triangles.extend([[a, c, a + 1], [a + 1, c, c + 1]]);
        }
    }
    let instances = vec![Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY }];
    Geometry { meshes: vec![mesh], instances }
}

fn view() -> View {
    let eye = DVec3::new(0.0, 260.0, 1900.0);
    View::look_at(eye, DVec3::new(0.0, 60.0, 0.0), 50.0, WIDTH, HEIGHT)
}

/// Pieces in the picture, found in bands on all threads.
fn look(stage: &Scanline) -> u64 {
    let pieces = AtomicU64::new(0);
    (0..HEIGHT.div_ceil(BAND)).into_par_iter().for_each(|band| {
        stage.see(band * BAND..(band + 1) * BAND, 0..WIDTH, &mut |_, row| {
            pieces.fetch_add(row.len() as u64, Ordering::Relaxed);
        });
    });
    pieces.into_inner()
}

/// Largest memory of this process so far [MiB]; 0 where the system does not tell.
fn peak_mebibytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<u64>().ok()).unwrap_or(0) / 1024
}

fn once(count: u32) -> Arc<Geometry> {
    let geometry = Arc::new(terrain(count));
    let before = peak_mebibytes();
    let start = Instant::now();
    let stage = Scanline::new(geometry.clone(), view(), Knobs::default());
    let ready = start.elapsed();
    let pieces = look(&stage);
    let all = start.elapsed();
    println!(
        "once {:>9} triangles: set-up {:.3} s, picture {:.3} s, {pieces} pieces, peak {} MiB (scene alone {before})",
        geometry.triangle_count(),
        ready.as_secs_f64(),
        (all - ready).as_secs_f64(),
        peak_mebibytes(),
    );
    geometry
}

fn main() {
    let mut criterion = Criterion::default()
        .configure_from_args()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(4));
    let mut group = criterion.benchmark_group("terrain");
    for count in [10_000, 100_000, 1_000_000] {
        let geometry = once(count);
        if std::env::var_os("KEIKAN_BENCH_ONCE").is_none() {
            group.bench_function(BenchmarkId::from_parameter(count), |b| {
                b.iter(|| look(&Scanline::new(geometry.clone(), view(), Knobs::default())));
            });
        }
    }
    group.finish();
    if std::env::var_os("KEIKAN_BENCH_LARGE").is_some() {
        once(10_000_000);
    }
    criterion.final_summary();
}
