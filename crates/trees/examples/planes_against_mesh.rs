//! Planes against the mesh they were baked from: distance × elevation × number of planes.
//!
//! `cargo run --release -p keikan-trees --example planes_against_mesh [poplar|lime|zelkova] [thesis|opaque|density] [with-eye|fixed] [OUT.csv]`
//!
//! Writes one row for each to OUT.csv (else to the standard output) and prints the means over distances or elevations as tables. Columns:
//!
//! - `luminance`: mean of what shows, planes / mesh; `hidden`: share of the view, planes / mesh;
//! - `alpha_rms`: root mean square difference of alpha over the tree's rectangle (silhouette);
//! - `shadow_lx`, `shadow_lx_mesh`: mean illuminance by the sun where the mesh takes a tenth or more of it from level ground, of 80 000 lx; the sun
//!   stands as high as the eye, 60° to its side, from 30° to 89°;
//! - `sky_lx`, `sky_lx_mesh`: by a uniform sky within the crown's radius, of 20 000 lx;
//! - `ms`, `ms_mesh`: of the processor for the picture, one ray a pixel for planes, 17 for the mesh; `bytes`: of the species.

mod common;

use common::*;
use glam::{DVec3, Vec3};
use keikan_trees::{Fade, Form, Growth, Setting, Stand, Turn, reference::Reference};
use light::sampling::lattice;
use light::{Illuminate, Occlude, Path, Place, Ray, Traverse};
use std::time::{Duration, Instant};

/// Width of a pixel \[rad\].
const PIXEL: f64 = 0.004;
/// Samples along a pixel's side in the mesh's alpha.
const FINE: u32 = 4;
const COUNTS: [u32; 5] = [0, 2, 3, 4, 5];
const DISTANCES: [f64; 4] = [10.0, 20.0, 40.0, 80.0];
const ELEVATIONS: [f64; 4] = [0.0, 30.0, 60.0, 90.0];
/// On open level ground [lx].
const SUN: f32 = 80_000.0;
const SKY: f32 = 20_000.0;

/// A view of the tree: pixel rays through a rectangle across the line of sight.
struct View {
    eye: DVec3,
    corner: DVec3,
    step: [DVec3; 2],
    size: [u32; 2],
}

impl View {
    fn new(height: f64, radius: f64, distance: f64, elevation: f64) -> Self {
        let target = DVec3::Y * (0.5 * height);
        let back = DVec3::new(0.0, elevation.sin(), elevation.cos());
        let (right, eye) = (DVec3::X, target + back * distance);
        let up = back.cross(right);
        let high = 0.5 * height * elevation.cos() + radius * elevation.sin() + 0.5;
        let pixel = PIXEL * distance;
        let size = [2.0 * radius + 1.0, 2.0 * high].map(|side| (side / pixel).ceil() as u32);
        let corner =
            target - right * (0.5 * f64::from(size[0]) * pixel) + up * (0.5 * f64::from(size[1]) * pixel);
        Self { eye, corner, step: [right * pixel, -up * pixel], size }
    }

    fn direction(&self, x: f64, y: f64) -> DVec3 {
        (self.corner + self.step[0] * x + self.step[1] * y - self.eye).normalize()
    }

    fn pixels(&self) -> impl Iterator<Item = (f64, f64)> {
        let [width, height] = self.size;
        (0..width * height).map(move |i| (f64::from(i % width), f64::from(i / width)))
    }
}

/// Time that this thread has run: on a busy machine that of the wall says little.
struct Clock(Option<Duration>, Instant);

impl Clock {
    fn start() -> Self {
        Self(Self::run(), Instant::now())
    }

    /// As Linux counts it.
    fn run() -> Option<Duration> {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        text.split(' ').next()?.parse().ok().map(Duration::from_nanos)
    }

    /// Since the start; that of the wall elsewhere.
    fn seconds(&self) -> f64 {
        let run = self.0.zip(Self::run()).map(|(before, now)| now.saturating_sub(before));
        run.unwrap_or_else(|| self.1.elapsed()).as_secs_f64()
    }
}

/// Alpha of each pixel and mean luminance of what shows.
struct Seen {
    alpha: Vec<f32>,
    luminance: f32,
    seconds: f64,
}

fn seen(alpha: Vec<f32>, light: f32, of: f32, start: Clock) -> Seen {
    Seen { alpha, luminance: light / of.max(1e-9), seconds: start.seconds() }
}

fn by_mesh(mesh: &Reference, light: &Daylight, view: &View) -> Seen {
    let start = Clock::start();
    let (mut alpha, mut sum, mut of) = (Vec::new(), 0.0, 0.0);
    for (i, (x, y)) in view.pixels().enumerate() {
        let fine = f64::from(FINE);
        let at = |k: u32| {
            let (u, v) = (f64::from(k % FINE) + 0.5, f64::from(k / FINE) + 0.5);
            view.direction(x + u / fine, y + v / fine)
        };
        let hidden = (0..FINE * FINE).filter(|k| mesh.first(view.eye, at(*k), 0.0).is_some()).count();
        alpha.push(hidden as f32 / (FINE * FINE) as f32);
        // One sample of light a pixel, in the middle of one of the four finest.
        if let Some(radiance) = mesh_radiance(mesh, light, (view.eye, at(5)), 0.7, i as u32) {
            sum += radiance.luminance();
            of += 1.0;
        }
    }
    seen(alpha, sum, of, start)
}

fn by_planes(stand: &Stand, light: &Daylight, view: &View) -> Seen {
    let start = Clock::start();
    let (mut alpha, mut sum, mut of) = (Vec::new(), 0.0, 0.0);
    let path = Path { spread: PIXEL as f32, ..Path::EYE };
    for (x, y) in view.pixels() {
        let ray = Ray::new(view.eye.as_vec3(), view.direction(x + 0.5, y + 0.5).as_vec3());
        let way = stand.way(&ray, path, &Around(light, stand));
        alpha.push(1.0 - way.transmittance[0]);
        sum += way.added.luminance();
        of += 1.0 - way.transmittance[0];
    }
    seen(alpha, sum, of, start)
}

/// What is left of a distant source's light on level ground, a grid that holds the whole shadow, as means over cells of 0.5 m to 1 m:
/// the mesh's shadow at points is all or nothing.
fn left(occlude: &dyn Occlude, toward: Vec3, height: f32, radius: f32) -> Vec<f32> {
    const CELLS: u32 = 20;
    const POINTS: u32 = 8;
    let reach = radius + height / toward.y.tan().max(0.4);
    let level = Vec3::new(toward.x, 0.0, toward.z) * (-0.5 * height / toward.y);
    let at = |i: u32, k: u32| {
        let of = [(i % CELLS, k % POINTS), (i / CELLS, k / POINTS)].map(|(cell, point)| {
            let share = (cell * POINTS + point) as f32 + 0.5;
            (2.0 * share / (CELLS * POINTS) as f32 - 1.0) * reach
        });
        occlude.transmittance(&Ray::new(level + Vec3::new(of[0], 0.0, of[1]), toward))[0]
    };
    let mean = |i: u32| (0..POINTS * POINTS).map(|k| at(i, k)).sum::<f32>() / (POINTS * POINTS) as f32;
    (0..CELLS * CELLS).map(mean).collect()
}

/// Mean illuminance in the mesh's shadow \[lx\]: where it takes a tenth or more.
fn shadow(left: &[f32], mesh: &[f32]) -> f32 {
    let within: Vec<f32> =
        left.iter().zip(mesh).filter(|(_, mesh)| **mesh < 0.9).map(|(left, _)| *left).collect();
    SUN * within.iter().sum::<f32>() / within.len().max(1) as f32
}

/// Share of a uniform sky that is taken from ground within the crown's radius.
fn sky_taken(occlude: &dyn Occlude, radius: f32) -> f32 {
    let sky =
        Daylight { sun: light::Spectrum::ZERO, sky: light::Spectrum::ONE, ..Daylight::clear(Vec3::Y, 64) };
    let mut sum = 0.0;
    for i in 0..300 {
        let [r, turn] = lattice(i, 300, [0; 2]);
        let (sin, cos) = (std::f32::consts::TAU * turn).sin_cos();
        // Not within the stem.
        let r = radius * (0.05 + 0.95 * r).sqrt();
        let place =
            Place { position: Vec3::new(r * cos, 0.0, r * sin), error: 1e-5, normal: Vec3::Y, seed: i };
        sum += 1.0 - sky.irradiance(&place, occlude)[0] / std::f32::consts::PI;
    }
    sum / 300.0
}

/// One of the many.
struct Row {
    species: &'static str,
    distance: f64,
    elevation: f64,
    planes: u32,
    /// In the order of [`COLUMNS`].
    values: [f32; 10],
}

const COLUMNS: [&str; 10] = [
    "luminance",
    "hidden",
    "alpha_rms",
    "shadow_lx",
    "shadow_lx_mesh",
    "sky_lx",
    "sky_lx_mesh",
    "ms",
    "ms_mesh",
    "bytes",
];

/// All rows of one species.
fn rows(name: &'static str, growth: &Growth, setting: Setting) -> Vec<Row> {
    let mesh = mesh(growth);
    let reference = Reference::new(&mesh);
    let stands = COUNTS.map(|planes| alone(species(&mesh, planes, 512), setting));
    let radius = stands[0].species()[0].description().half_width;
    let sky = |occlude: &dyn Occlude| SKY * (1.0 - sky_taken(occlude, growth.spread));
    let (sky_mesh, skies) = (sky(&reference), stands.each_ref().map(|stand| sky(stand)));
    let mut rows = Vec::new();
    for elevation in ELEVATIONS {
        // The sun stands 60° to the side of the eye.
        let (up, level) = (elevation as f32).clamp(30.0, 89.0).to_radians().sin_cos();
        let (aside, ahead) = 60f32.to_radians().sin_cos();
        let light = Daylight::clear(Vec3::new(aside * level, up, ahead * level), 8);
        let ground = |occlude: &dyn Occlude| left(occlude, light.toward_sun, growth.height, radius);
        let (mesh_left, lefts) = (ground(&reference), stands.each_ref().map(|stand| ground(stand)));
        for distance in DISTANCES {
            let view = View::new(growth.height.into(), radius.into(), distance, elevation.to_radians());
            let truth = by_mesh(&reference, &light, &view);
            for (i, stand) in stands.iter().enumerate() {
                let found = by_planes(stand, &light, &view);
                let pairs = || truth.alpha.iter().zip(&found.alpha);
                let square: f32 = pairs().map(|(a, b)| (a - b) * (a - b)).sum();
                let [area, seen] = [&truth, &found].map(|seen| seen.alpha.iter().sum::<f32>());
                let values = [
                    found.luminance / truth.luminance,
                    seen / area,
                    (square / truth.alpha.len() as f32).sqrt(),
                    shadow(&lefts[i], &mesh_left),
                    shadow(&mesh_left, &mesh_left),
                    skies[i],
                    sky_mesh,
                    (found.seconds * 1e3) as f32,
                    (truth.seconds * 1e3) as f32,
                    stand.species()[0].bytes() as f32,
                ];
                rows.push(Row { species: name, distance, elevation, planes: COUNTS[i], values });
            }
        }
    }
    rows
}

fn csv(rows: &[Row]) -> String {
    let mut text = format!("species,distance_m,elevation_deg,planes,{}\n", COLUMNS.join(","));
    for Row { species, distance, elevation, planes, values } in rows {
        let values =
            values.map(|value| if value > 1e4 { format!("{value:.0}") } else { format!("{value:.3}") });
        text += &format!("{species},{distance},{elevation},{planes},{}\n", values.join(","));
    }
    text
}

/// A table of means over what `key` does not tell apart, for each species and number of planes.
fn means(rows: &[Row], what: &str, keys: &[f64], key: impl Fn(&Row) -> f64) {
    let of_all = |column: usize, of: &dyn Fn(&&Row) -> bool| {
        let all: Vec<f32> = rows.iter().filter(of).map(|row| row.values[column]).collect();
        all.iter().sum::<f32>() / all.len().max(1) as f32
    };
    println!(
        "\n| {what} | planes | luminance | hidden | alpha rms | shadow, planes − mesh | ms, planes (mesh) |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for wanted in keys {
        for planes in COUNTS {
            let of = |row: &&Row| row.planes == planes && key(row) == *wanted;
            let [luminance, hidden, rms, lx, lx_mesh, _, _, ms, ms_mesh, _] =
                std::array::from_fn(|column| of_all(column, &of));
            println!(
                "| {wanted} | {planes} | {luminance:.2} | {hidden:.2} | {rms:.2} | {:+.1} klx of {:.1} | {ms:.0} ({ms_mesh:.0}) |",
                (lx - lx_mesh) / 1e3,
                lx_mesh / 1e3
            );
        }
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| words.iter().any(|w| w == word);
    let fade = match () {
        () if has("thesis") => Fade::Thesis,
        () if has("opaque") => Fade::Opaque,
        () => Fade::Density,
    };
    let setting = Setting { fade, turn: if has("with-eye") { Turn::WithEye } else { Turn::Fixed } };
    let some = ["poplar", "lime", "zelkova"].into_iter().any(has);
    let wanted =
        growths().into_iter().filter(|(name, growth)| growth.form != Form::Conifer && (!some || has(name)));
    let rows: Vec<Row> = wanted.flat_map(|(name, growth)| rows(name, &growth, setting)).collect();
    match words.iter().find(|word| word.ends_with(".csv")) {
        Some(path) => std::fs::write(path, csv(&rows)).expect("a file that can be written"),
        None => print!("{}", csv(&rows)),
    }
    println!("\n{setting:?}, pixels of {PIXEL} rad");
    means(&rows, "distance, m", &DISTANCES, |row| row.distance);
    means(&rows, "elevation, °", &ELEVATIONS, |row| row.elevation);
}
