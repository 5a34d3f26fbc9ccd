//! Time and memory of the main job against the number of triangles.

use std::sync::Arc;
use std::time::Instant;

use glam::{DAffine3, Vec3};
use keikan::pipeline::Monitor;
use keikan::report::peak_memory_mib;
use keikan_tests::build;
use light::{Geometry, Instance, Mesh};

/// Terrain 4 km wide from above at a slant, sun at 32° without a disc, no sky.
const VIEW: &str = r#"
    [sun]
    altitude = 32
    azimuth = 140
    diameter = 0
    [sky]
    off = true
    [[model]]
    plane = { size = [1, 1] }
    [[camera]]
    position = [0, 1200, 2600]
    target = [0, 0, 0]
    field_of_view = 45
"#;

/// Sum of five octaves of sines: hills and ridges, the same everywhere and every time.
fn height(x: f32, z: f32) -> f32 {
    let octave = |i: i32| {
        let f = 2f32.powi(i) / 900.0;
        let ridge = ((x * f + 1.7 * i as f32).sin() * (z * f * 1.13 - 0.6 * i as f32).cos()).abs();
        (1.0 - ridge) * 180.0 * 0.5f32.powi(i)
    };
    (0..5).map(octave).sum()
}

fn terrain(triangles: usize) -> Geometry {
    let cells = ((triangles as f64 / 2.0).sqrt().round() as u32).max(1);
    let step = 4000.0 / cells as f32;
    let corner = |i: u32, j: u32| {
        let (x, z) = (i as f32 * step - 2000.0, j as f32 * step - 2000.0);
        Vec3::new(x, height(x, z), z)
    };
    let positions = (0..=cells).flat_map(|j| (0..=cells).map(move |i| corner(i, j))).collect();
    let quad = |i: u32, j: u32| {
        let (a, c) = (j * (cells + 1) + i, (j + 1) * (cells + 1) + i);
        [[a, c, a + 1], [a + 1, c, c + 1]]
    };
    let triangles = (0..cells).flat_map(|j| (0..cells).flat_map(move |i| quad(i, j))).collect();
    let mesh = Mesh { positions, triangles, ..Mesh::default() };
    Geometry {
        meshes: vec![mesh],
        instances: vec![Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY }],
    }
}

pub(crate) fn table() {
    let mut sizes = vec![10_000, 100_000, 1_000_000];
    if std::env::var_os("KEIKAN_BENCH_LARGE").is_some() {
        sizes.push(10_000_000);
    }
    println!(
        "\nterrain, 1920 x 1080, normal preset: 8 lines, shadow intervals on long spans, else a ray a piece"
    );
    println!(
        "{:>10} {:>10} {:>10} {:>12} {:>10}",
        "triangles", "assemble s", "render s", "pieces", "peak MiB"
    );
    for size in sizes {
        let folder = std::path::Path::new(".");
        let mut scene = scene::parse(VIEW, folder, std::path::Path::new("terrain")).expect("a sound scene");
        scene.geometry = Arc::new(terrain(size));
        let start = Instant::now();
        let (plan, pipeline) = build(&scene, (1920, 1080), &[]);
        let assembled = start.elapsed().as_secs_f64();
        let monitor = Monitor::default();
        let start = Instant::now();
        let film = pipeline.render(&plan.region, false, &monitor).expect("nobody interrupts");
        let rendered = start.elapsed().as_secs_f64();
        assert!(film.layers[0].pixels.iter().all(|pixel| pixel.is_finite()));
        println!(
            "{:>10} {assembled:>10.2} {rendered:>10.2} {:>12} {:>10.0}",
            scene.geometry.triangle_count(),
            monitor.pieces.load(std::sync::atomic::Ordering::Relaxed),
            peak_memory_mib().unwrap_or(f64::NAN),
        );
    }
}
