//! Seconds and memory from 10⁴ to 10⁶ triangles of terrain at 1920 × 1080 (10⁷ with
//! `KEIKAN_BENCH_LARGE=1`, and that at 8192 × 8192 with `KEIKAN_BENCH_HUGE=1` as well).
//!
//! `once` lines are single runs, printed with the parts of the time; criterion repeats the smaller ones.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion};
use glam::{DAffine3, DVec3, Vec3};
use keikan_scanline::{Knobs, Rule, Scanline};
use light::{Geometry, Instance, Mesh, Opacity, PointSource, See, Texture, Vacuum, View, Wrap};
use rayon::prelude::*;

const SIZE: [u32; 2] = [1920, 1080];
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
    placed(mesh)
}

/// `count` triangles of about `size` metres in a box of 60 × 40 × 60 metres before the eye, in every attitude.
fn scattered(count: u32, size: f32) -> Mesh {
    let mut state = 1u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u64 << 24) as f32 - 0.5
    };
    let mut mesh = Mesh::default();
    for i in 0..count {
        let middle = Vec3::new(60.0 * random(), 260.0 + 40.0 * random(), 1840.0 + 60.0 * random());
        for _ in 0..3 {
            mesh.positions.push(middle + Vec3::new(random(), random(), random()) * size);
            mesh.uvs.push(glam::Vec2::new(random(), random()));
        }
        mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    mesh
}

/// A crown: leaves of `count` cut out of a chequered texture.
fn leaves(count: u32) -> Geometry {
    let texels: Vec<_> =
        (0..64 * 64).map(|i| [0.1, 0.4, 0.1, f32::from((i / 8 + i / 512) % 2 == 0)]).collect();
    let texture = Texture::new(64, 64, &texels, [Wrap::Repeat; 2]).map(Arc::new);
    let opacity = Opacity { texture, factor: 1.0, cutoff: Some(0.5) };
    placed(Mesh { opacity: Some(Arc::new(opacity)), ..scattered(count, 0.3) })
}

/// A town of `count` houses (boxes) on a ground, 12 triangles each.
fn town(count: u32) -> Geometry {
    let mut state = 7u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u64 << 24) as f32
    };
    let mut mesh = Mesh::default();
    let mut quad = |corners: [Vec3; 4]| {
        let base = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.triangles.extend([[base, base + 1, base + 2], [base, base + 2, base + 3]]);
    };
    let ground = |x: f32, z: f32| Vec3::new(2000.0 * x, 0.0, 2000.0 * z);
    quad([ground(-1.0, -1.0), ground(1.0, -1.0), ground(1.0, 1.0), ground(-1.0, 1.0)]);
    for _ in 0..count {
        let middle = Vec3::new(1500.0 * (random() - 0.5), 0.0, 1600.0 * random());
        let (width, depth, height) = (20.0 + 40.0 * random(), 20.0 + 40.0 * random(), 10.0 + 50.0 * random());
        let turn = 3.0 * random();
        let at = |i: usize, y: f32| {
            let (x, z) = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)][i % 4];
            let (x, z) = (x * width, z * depth);
            middle + Vec3::new(x * turn.cos() - z * turn.sin(), y, x * turn.sin() + z * turn.cos())
        };
        for i in 0..4 {
            quad([at(i, 0.0), at(i + 1, 0.0), at(i + 1, height), at(i, height)]);
        }
        quad([0, 1, 2, 3].map(|i| at(i, height)));
        quad([0, 1, 2, 3].map(|i| at(i, 0.0)));
    }
    placed(mesh)
}

fn placed(mesh: Mesh) -> Geometry {
    let instances = vec![Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY }];
    Geometry { meshes: vec![mesh], instances }
}

fn view([width, height]: [u32; 2]) -> View {
    let eye = DVec3::new(0.0, 260.0, 1900.0);
    View::look_at(eye, DVec3::new(0.0, 60.0, 0.0), 50.0, width, height)
}

/// Pieces in the picture, found in bands on all threads.
fn look(stage: &Scanline, [width, height]: [u32; 2]) -> u64 {
    let pieces = AtomicU64::new(0);
    (0..height.div_ceil(BAND)).into_par_iter().for_each(|band| {
        stage.see(band * BAND..(band + 1) * BAND, 0..width, &mut |_, row| {
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

/// Processor time of all threads so far \[s\], which a busy machine does not lengthen.
fn processor_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // After the name in brackets; fields 14 and 15 of the whole, in hundredths.
    let fields = stat.rsplit(')').next().unwrap_or("").split_whitespace().skip(11);
    fields.take(2).filter_map(|field| field.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// One run by each of two rules, with its parts; returns the geometry.
fn once(name: &str, geometry: Geometry, size: [u32; 2]) -> Arc<Geometry> {
    let geometry = Arc::new(geometry);
    for rule in [Rule::Midpoint, Rule::Exact] {
        by(rule, name, &geometry, size);
    }
    geometry
}

fn by(rule: Rule, name: &str, geometry: &Arc<Geometry>, size: [u32; 2]) {
    let before = peak_mebibytes();
    let (start, begun) = (Instant::now(), processor_seconds());
    let stage = Scanline::new(geometry.clone(), view(size), Knobs { rule, ..Knobs::default() });
    let (ready, set_up) = (start.elapsed(), processor_seconds());
    let pieces = look(&stage, size);
    let (all, done) = (start.elapsed(), processor_seconds());
    println!(
        "once {name} {:>9} triangles, {rule:?}, {} lines: set-up {:.3} s ({:.2} processor), picture {:.3} s ({:.2} processor), {pieces} pieces, \
         peak {} MiB (scene alone {before})",
        geometry.triangle_count(),
        stage.line_count(),
        ready.as_secs_f64(),
        set_up - begun,
        (all - ready).as_secs_f64(),
        done - set_up,
        peak_mebibytes(),
    );
}

/// What it takes to cut spans, beside what an occluder takes that has nothing to say.
fn shadows() {
    let (geometry, size) = (Arc::new(town(50)), [512, 384]);
    let lamp = |i: u32| (i, PointSource::At(DVec3::new(100.0 - 200.0 * f64::from(i), 300.0, 900.0)));
    for count in [0, 1, 3] {
        let stage = Scanline::new(geometry.clone(), view(size), Knobs::default())
            .with_shadows((0..count).map(lamp).collect(), Arc::new(Vacuum));
        let begun = processor_seconds();
        let pieces = (0..20).map(|_| look(&stage, size)).sum::<u64>() / 20;
        let each = (processor_seconds() - begun) / 20.0;
        println!("once town of 602 triangles, {count} sources: {each:.4} processor seconds, {pieces} pieces");
    }
}

fn main() {
    let mut criterion = Criterion::default()
        .configure_from_args()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(4));
    let mut group = criterion.benchmark_group("terrain");
    for count in [10_000, 100_000, 1_000_000] {
        let geometry = once("terrain", terrain(count), SIZE);
        if std::env::var_os("KEIKAN_BENCH_ONCE").is_none() {
            group.bench_function(BenchmarkId::from_parameter(count), |b| {
                b.iter(|| look(&Scanline::new(geometry.clone(), view(SIZE), Knobs::default()), SIZE));
            });
        }
    }
    group.finish();
    // Deep: large faces that pass through one another, and leaves that let others through.
    once("town", town(100), SIZE);
    once("town", town(1000), SIZE);
    shadows();
    once("soup", placed(scattered(300, 60.0)), SIZE);
    once("soup", placed(scattered(3_000, 60.0)), SIZE);
    once("soup", placed(scattered(30_000, 60.0)), SIZE);
    once("leaves", leaves(100_000), SIZE);
    once("leaves", leaves(1_000_000), SIZE);
    if std::env::var_os("KEIKAN_BENCH_LARGE").is_some() {
        let size = if std::env::var_os("KEIKAN_BENCH_HUGE").is_some() { [8192, 8192] } else { SIZE };
        once("terrain", terrain(10_000_000), size);
    }
    criterion.final_summary();
}
