//! Every sun from +90° to −18°: is the sky finite everywhere, and without a step?
//!
//! `cargo run --release -p keikan-sky --example sky_sweep -- [STEP_DEG] [--single] [--from DEG] [--to DEG]
//! [--turbidity β,β,…] [--elevation M,M,…]`; 0.01° takes some 30 minutes of a processor for each of six kinds of air, 1° some
//! 20 seconds. `--single` leaves multiple scattering out. Prints for each air the largest relative change from one sun to
//! the next, of the horizontal illuminance and of single directions.

use glam::Vec3;
use keikan_sky::{Air, AirSky, Sky, horizontal_illuminance};

/// The numbers after `name`, separated by commas, or else `default`.
fn numbers(arguments: &[String], name: &str, default: &[f64]) -> Vec<f64> {
    let list = arguments.iter().skip_while(|a| *a != name).nth(1);
    list.map_or(default.to_vec(), |list| list.split(',').filter_map(|x| x.parse().ok()).collect())
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let step: f64 = arguments.first().and_then(|a| a.parse().ok()).filter(|step| *step > 0.0).unwrap_or(1.0);
    let multiple = !arguments.iter().any(|a| a == "--single");
    let end = |name, default| numbers(&arguments, name, &[default]).first().copied().unwrap_or(default);
    let (from, to) = (end("--from", 90.0), end("--to", -18.0));
    let directions =
        [Vec3::Y, Vec3::Z, Vec3::NEG_Z, Vec3::new(0.6, 0.8, 0.0), Vec3::new(0.0, 0.1, -0.995).normalize()];
    println!(
        "turbidity observer | largest change per {step}°: of lx (at), of a direction's luminance (at) | all finite"
    );
    for &turbidity in &numbers(&arguments, "--turbidity", &[0.0, 0.06, 1.0]) {
        for &elevation in &numbers(&arguments, "--elevation", &[0.0, 8000.0]) {
            let air = Air { turbidity, multiple, ..Air::CLEAR };
            let (mut steepest, mut finite) = ([(0.0f64, 0.0f64); 2], true);
            let mut before: Option<Vec<f64>> = None;
            for i in 0..=((from - to) / step).round() as u32 {
                let altitude = from - step * f64::from(i);
                let (sin, cos) = altitude.to_radians().sin_cos();
                let sky = AirSky::new(&air, Vec3::new(0.0, sin as f32, -cos as f32), elevation);
                let mut now = vec![horizontal_illuminance(&sky)];
                now.extend(directions.map(|d| f64::from(sky.radiance(d).luminance())));
                finite &= now.iter().all(|x| x.is_finite() && *x >= 0.0);
                for (k, (a, b)) in before.iter().flatten().zip(&now).enumerate() {
                    // A direction's: as a share of it and of a thousandth of the whole sky's.
                    let change =
                        (a - b).abs() / a.max(*b).max(if k == 0 { 1e-12 } else { 1e-3 * now[0] }).max(1e-12);
                    let slot = &mut steepest[k.min(1)];
                    if change > slot.0 {
                        *slot = (change, altitude);
                    }
                }
                before = Some(now);
            }
            let [lux, direction] = steepest.map(|(change, at)| format!("{:.2} % ({at:.2}°)", 100.0 * change));
            println!("{turbidity:4} {elevation:5} m | {lux}, {direction} | {finite}");
        }
    }
}
