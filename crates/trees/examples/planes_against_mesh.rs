//! Planes against the mesh they were baked from: distance × elevation × number of planes.
//!
//! `cargo run --release -p keikan-trees --example planes_against_mesh [thesis|opaque|density] [with-eye|fixed]`
//!
//! Columns: mean luminance of what shows (planes / mesh); share of the view hidden (planes / mesh) and root mean square
//! of the difference of alpha over the tree's rectangle; light of a sun at this elevation that the tree takes from the ground
//! (planes / mesh); light of a uniform sky that it takes from the ground within its crown's radius (planes / mesh).

mod common;

use common::*;
use glam::{DVec3, Vec3};
use keikan_trees::{Fade, Form, Setting, Stand, Turn, reference::Reference};
use light::sampling::lattice;
use light::{Illuminate, Occlude, Path, Place, Ray, Traverse};
use std::time::Instant;

/// Width of a pixel \[rad\].
const PIXEL: f64 = 0.004;
/// Samples along a pixel's side in the mesh's alpha.
const FINE: u32 = 4;
const COUNTS: [u32; 5] = [0, 2, 3, 4, 5];

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

/// Alpha of each pixel and mean luminance of what shows.
struct Seen {
    alpha: Vec<f32>,
    luminance: f32,
    seconds: f64,
}

fn seen(alpha: Vec<f32>, light: f32, of: f32, start: Instant) -> Seen {
    Seen { alpha, luminance: light / of.max(1e-9), seconds: start.elapsed().as_secs_f64() }
}

fn by_mesh(mesh: &Reference, light: &Daylight, view: &View) -> Seen {
    let start = Instant::now();
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
    let start = Instant::now();
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

/// Light of a distant source that is taken from level ground, summed over a grid that holds the whole shadow.
fn taken(occlude: &dyn Occlude, toward: Vec3, height: f32, radius: f32) -> f32 {
    const GRID: u32 = 160;
    let reach = radius + height / toward.y.tan().max(0.4);
    let mut sum = 0.0;
    for i in 0..GRID * GRID {
        let at = [i % GRID, i / GRID].map(|k| (2.0 * (k as f32 + 0.5) / GRID as f32 - 1.0) * reach);
        let ground = Vec3::new(at[0], 0.0, at[1] - 0.5 * height * toward.z / toward.y);
        sum += 1.0 - occlude.transmittance(&Ray::new(ground, toward))[0];
    }
    sum
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

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| words.iter().any(|w| w == word);
    let fade = if has("thesis") {
        Fade::Thesis
    } else if has("opaque") {
        Fade::Opaque
    } else {
        Fade::Density
    };
    let turn = if has("with-eye") { Turn::WithEye } else { Turn::Fixed };
    let setting = Setting { fade, turn };
    println!("{setting:?}, pixels of {PIXEL} rad; ratios planes / mesh");
    println!("species  dist elev | planes lum  area  rms  sun   sky  | ms/view MB");
    for (name, growth) in growths().into_iter().filter(|(_, growth)| growth.form != Form::Conifer) {
        if words.iter().any(|w| ["poplar", "lime", "zelkova"].contains(&w.as_str())) && !has(name) {
            continue;
        }
        let mesh = mesh(&growth);
        let reference = Reference::new(&mesh);
        let stands = COUNTS.map(|planes| alone(species(&mesh, planes, 512), setting));
        let radius = stands[0].species()[0].description().half_width;
        let sky = sky_taken(&reference, growth.spread);
        let skies: Vec<f32> = stands.iter().map(|stand| sky_taken(stand, growth.spread) / sky).collect();
        for distance in [15.0, 60.0] {
            for elevation in [0.0f64, 30.0, 60.0, 90.0] {
                let view = View::new(growth.height.into(), radius.into(), distance, elevation.to_radians());
                // The sun stands 60° to the side of the eye.
                let altitude = (elevation as f32).clamp(30.0, 89.0).to_radians();
                let azimuth = 60f32.to_radians();
                let level = Vec3::new(azimuth.sin(), 0.0, azimuth.cos());
                let light = Daylight::clear(level * altitude.cos() + Vec3::Y * altitude.sin(), 8);
                let truth = by_mesh(&reference, &light, &view);
                let shade = taken(&reference, light.toward_sun, growth.height, radius);
                let area: f32 = truth.alpha.iter().sum();
                for ((stand, planes), sky) in stands.iter().zip(COUNTS).zip(&skies) {
                    let found = by_planes(stand, &light, &view);
                    let square: f32 =
                        truth.alpha.iter().zip(&found.alpha).map(|(a, b)| (a - b) * (a - b)).sum();
                    println!(
                        "{name:8} {distance:4} {elevation:4} | {planes:6} {:.2}  {:.2}  {:.2}  {:.2}  {:.2}  | {:5.0} ({:.0}) {:.1}",
                        found.luminance / truth.luminance,
                        found.alpha.iter().sum::<f32>() / area,
                        (square / truth.alpha.len() as f32).sqrt(),
                        taken(stand, light.toward_sun, growth.height, radius) / shade,
                        sky,
                        found.seconds * 1e3,
                        truth.seconds * 1e3,
                        stand.species()[0].bytes() as f64 / 1e6
                    );
                }
            }
        }
    }
}
