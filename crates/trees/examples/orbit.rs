//! Whether anything jumps: an orbit of 360 frames round a tree, a rise, a day of 200 and a dusk, as planes and as mesh.
//!
//! `cargo run --release -p keikan-trees --example orbit [poplar|lime|zelkova|spruce [orbit|rise|day|dusk]]`
//!
//! For each frame the mean luminance and the mean share hidden over the picture; printed are the largest change from one
//! frame to the next, over the mean, and the largest root mean square change of a pixel's luminance.

mod common;

use common::*;
use glam::{DVec2, DVec3, Vec3};
use keikan_trees::{Setting, Shading, Turn, reference::Reference};
use light::{Path, Traverse, View};

const SIDE: u32 = 56;

/// Luminance and hidden share of each pixel.
type Frame = Vec<[f32; 2]>;

fn changes(name: &str, frames: &[Frame]) {
    let count = f64::from(SIDE * SIDE);
    let mean = |frame: &Frame, k: usize| frame.iter().map(|p| f64::from(p[k])).sum::<f64>() / count;
    let whole = [0, 1].map(|k| frames.iter().map(|f| mean(f, k)).sum::<f64>() / frames.len() as f64);
    let step = |k: usize| {
        frames.windows(2).map(|f| (mean(&f[1], k) - mean(&f[0], k)).abs() / whole[k]).fold(0.0, f64::max)
    };
    let rms = frames.windows(2).map(|f| {
        let square = f[0].iter().zip(&f[1]).map(|(a, b)| f64::from(a[0] - b[0]).powi(2)).sum::<f64>();
        (square / count).sqrt() / whole[0]
    });
    println!(
        "{name:28} luminance {:.4}  hidden {:.4}  pixel {:.3}",
        step(0),
        step(1),
        rms.fold(0.0, f64::max)
    );
}

fn main() {
    let wanted = std::env::args().nth(1).unwrap_or_else(|| "lime".to_owned());
    let some = std::env::args().nth(2);
    let (_, growth) = growths().into_iter().find(|(name, _)| *name == wanted).expect("one of the four");
    let mesh = mesh(&growth);
    let reference = Reference::new(&mesh);
    let h = f64::from(growth.height);
    let afternoon = midsummer(45.0);
    let view = |turn: f64, elevation: f64| {
        let back = DVec3::new(turn.sin() * elevation.cos(), elevation.sin(), turn.cos() * elevation.cos());
        let target = DVec3::Y * (0.5 * h);
        View::look_at(target + back * (2.2 * h), target, 30.0, SIDE, SIDE)
    };
    let orbit: Vec<(View, Vec3)> =
        (0..360).map(|i| (view(f64::from(i).to_radians(), 0.35), afternoon)).collect();
    let rise: Vec<(View, Vec3)> =
        (0..180).map(|i| (view(0.4, f64::from(i) * 0.5f64.to_radians()), afternoon)).collect();
    // From a degree above the horizon to a degree above it: the sun passes due east and due west, where it crosses the plane that faces the eye.
    let day: Vec<(View, Vec3)> =
        (0..200).map(|i| (view(0.0, 0.2), midsummer(-106.0 + 212.0 * f64::from(i) / 199.0))).collect();
    // Due west, from 3° below the horizon to 3° above it.
    let dusk: Vec<(View, Vec3)> = (0..61)
        .map(|i| (0.1 * f64::from(i) - 3.0).to_radians().sin_cos())
        .map(|(sin, cos)| (view(0.0, 0.2), DVec3::new(-cos, sin, 0.0).as_vec3()))
        .collect();
    for (name, frames) in [
        ("orbit of 1° steps", &orbit),
        ("rise by 0.5° steps", &rise),
        ("day of 200 frames", &day),
        ("dusk by 0.1° steps", &dusk),
    ] {
        if some.as_ref().is_some_and(|some| !name.starts_with(some)) {
            continue;
        }
        for turn in [Turn::WithEye, Turn::Fixed] {
            let stand = alone(species(&mesh, 4, 256), Setting { turn, ..Setting::default() });
            let stand = stand.with(Setting { turn, ..Setting::default() }, Shading::default());
            changes(
                &format!("{name}, {turn:?}"),
                &render(frames, |view, light, at, _| {
                    let path = Path { spread: view.pixel_width(1.0) as f32, ..Path::EYE };
                    let way = stand.way(&view.ray(at), path, &Around(light, &stand));
                    [way.added.luminance(), 1.0 - way.transmittance[0]]
                }),
            );
        }
        changes(
            &format!("{name}, mesh"),
            &render(frames, |view, light, at, i| {
                let mut sum = [0.0; 2];
                for k in 0..4 {
                    let aside = DVec2::new(f64::from(k % 2) - 0.5, f64::from(k / 2) - 0.5) * 0.5;
                    if let Some(radiance) = mesh_radiance(&reference, light, view.line(at + aside), 0.7, i) {
                        sum = [sum[0] + radiance.luminance() * 0.25, sum[1] + 0.25];
                    }
                }
                sum
            }),
        );
    }
}

/// Towards the sun at 35° north on the longest day, by its hour angle in degrees; south is +Z, east +X.
fn midsummer(hour: f64) -> Vec3 {
    let [(sin_lat, cos_lat), (sin, cos)] = [35.0f64, 23.44].map(|angle| angle.to_radians().sin_cos());
    let (sin_hour, cos_hour) = hour.to_radians().sin_cos();
    let up = sin_lat * sin + cos_lat * cos * cos_hour;
    DVec3::new(-cos * sin_hour, up, sin_lat * cos * cos_hour - cos_lat * sin).as_vec3()
}

/// Share of the sun's disc that is above the horizon, about.
fn risen(toward: Vec3) -> f32 {
    (toward.y.asin().to_degrees() / 0.53 + 0.5).clamp(0.0, 1.0)
}

fn render(frames: &[(View, Vec3)], pixel: impl Fn(&View, &Daylight, DVec2, u32) -> [f32; 2]) -> Vec<Frame> {
    let frame = |(view, sun): &(View, Vec3)| {
        let light = Daylight::clear(*sun, 4);
        let light = Daylight { sun: light::Spectrum::splat(risen(*sun)), ..light };
        (0..SIDE * SIDE)
            .map(|i| {
                let at = DVec2::new(f64::from(i % SIDE) + 0.5, f64::from(i / SIDE) + 0.5);
                pixel(view, &light, at, i)
            })
            .collect()
    };
    frames.iter().map(frame).collect()
}
