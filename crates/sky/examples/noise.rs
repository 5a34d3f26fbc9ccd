//! Noise and bias of the dome's irradiance behind screens, by number of directions: the figures quoted in the
//! documentation of `Description::samples`.
//!
//! Root mean square over 400 seeds, per cent of the true irradiance of the case, which an independent
//! quadrature in f64 gives. `cargo run --release -p keikan-sky --example noise`

use std::f64::consts::{FRAC_PI_2, PI};

use glam::Vec3;
use keikan_sky::{Conditions, Description, Dome, Model};
use light::{Illuminate, Occlude, Place, Ray, Spectrum};

const SAMPLES: [u32; 4] = [16, 48, 64, 256];
const SEEDS: u32 = 400;
/// Bands of altitude of the quadrature over the sphere; 4 times as many columns (the slit is narrow).
const BANDS: usize = 1200;

/// Which directions are open.
#[derive(Clone, Copy)]
struct Screen {
    name: &'static str,
    open: fn(Vec3, Vec3) -> bool,
    /// Unit horizontal vector the screen is set up around.
    around: Vec3,
}

impl Occlude for Screen {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        Spectrum::splat(f32::from((self.open)(segment.direction, self.around)))
    }
}

/// The horizontal vector turned by an angle about the vertical.
fn turned(v: Vec3, degrees: f32) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vec3::new(v.x * cos - v.z * sin, 0.0, v.x * sin + v.z * cos)
}

/// The screens for a plane: the sun is in the north, at −Z.
fn screens(normal: Vec3) -> [Screen; 5] {
    let facing = Vec3::new(normal.x, 0.0, normal.z).try_normalize().unwrap_or(Vec3::NEG_Z);
    let side = turned(Vec3::NEG_Z, 60.0);
    [
        Screen { name: "sun side hidden", open: |d, k| d.dot(k) <= 0.0, around: side },
        Screen { name: "other side hidden", open: |d, k| d.dot(k) > 0.0, around: side },
        Screen { name: "roof above 33°", open: |d, _| d.y < 0.55, around: side },
        Screen { name: "slanted eaves", open: |d, k| d.dot(k) + 0.6 * d.y <= 0.3, around: side },
        Screen {
            name: "slit of 16°",
            open: |d, k| d.x * k.x + d.z * k.z > 0.990_268 * d.x.hypot(d.z),
            around: turned(facing, 25.0),
        },
    ]
}

/// L/L_z of the sky in f64; angles from their cosines.
fn luminance(model: Model, direction: [f64; 3], sun: [f64; 3]) -> f64 {
    let cos = (0..3).map(|k| direction[k] * sun[k]).sum::<f64>().clamp(-1.0, 1.0);
    let clear = |cos: f64, height: f64| {
        (0.91 + 10.0 * (-3.0 * cos.acos()).exp() + 0.45 * cos * cos) * (1.0 - (-0.32 / height).exp())
    };
    match model {
        Model::Uniform => 1.0,
        Model::Overcast => (1.0 + 2.0 * direction[1]) / 3.0,
        _ => clear(cos, direction[1]) / clear(sun[1], 1.0),
    }
}

/// ∫ L/L_z T cos⁺ over the sky, and ∫ T cos⁺ over the ground: \[open, behind the screens\].
fn integrals(model: Model, sun: Vec3, normal: Vec3, screens: &[Screen]) -> Vec<[f64; 2]> {
    let [sun, n] = [sun, normal].map(|v| v.as_dvec3().normalize().to_array());
    let mut sums = vec![[0.0; 2]; screens.len() + 1];
    let [step, turn] = [PI / BANDS as f64, 2.0 * PI / (4 * BANDS) as f64];
    for band in 0..BANDS {
        let (sin, cos) = ((band as f64 + 0.5) * step - FRAC_PI_2).sin_cos();
        for column in 0..4 * BANDS {
            let (s, c) = ((column as f64 + 0.5) * turn).sin_cos();
            let d = [cos * c, sin, cos * s];
            let cosine = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
            if cosine <= 0.0 {
                continue;
            }
            let part = usize::from(sin < 0.0);
            let value = if part == 0 { luminance(model, d, sun) } else { 1.0 } * cosine * cos * step * turn;
            let direction = Vec3::new(d[0] as f32, d[1] as f32, d[2] as f32);
            sums[0][part] += value;
            for (sum, screen) in sums[1..].iter_mut().zip(screens) {
                sum[part] += value * f64::from((screen.open)(direction, screen.around));
            }
        }
    }
    sums
}

/// Root mean square of the relative error, and its mean.
fn noise(dome: &Dome, normal: Vec3, screen: &Screen, exact: f64) -> [f64; 2] {
    let (mut square, mut mean) = (0.0, 0.0);
    for seed in 0..SEEDS {
        let place = Place { position: Vec3::new(3.0, 2.0, 1.0), error: 1e-6, normal, seed };
        let error = f64::from(dome.irradiance(&place, screen).luminance()) / exact - 1.0;
        square += error * error;
        mean += error;
    }
    [(square / f64::from(SEEDS)).sqrt(), mean / f64::from(SEEDS)]
}

fn main() {
    println!("sky sun normal screen | open share | noise by samples {SAMPLES:?} | bias, per cent");
    let mut logs = [0.0; SAMPLES.len()];
    let mut cases = 0;
    for (model, altitudes) in [(Model::Clear, &[5.0f32, 20.0, 60.0][..]), (Model::Overcast, &[40.0])] {
        for &altitude in altitudes {
            let (sin, cos) = altitude.to_radians().sin_cos();
            let sun = Vec3::new(0.0, sin, -cos);
            let sun_horizontal = Spectrum::splat(if altitude > 10.0 { 0.9 * sin } else { 0.02 });
            let domes = SAMPLES.map(|samples| {
                let sky = model.sky(&Conditions::new(sun));
                Dome::new(&Description { samples, sun_horizontal, ..Description::new(sky) })
            });
            let tilt = (PI / 6.0).sin_cos();
            let tilted = turned(Vec3::NEG_Z, 120.0) * tilt.0 as f32 + Vec3::Y * tilt.1 as f32;
            for (name, normal) in
                [("up", Vec3::Y), ("to sun", Vec3::NEG_Z), ("away", Vec3::Z), ("tilted", tilted)]
            {
                let screens = screens(normal);
                let sums = integrals(model, sun, normal, &screens);
                let light = [domes[0].zenith_radiance(), domes[0].ground_radiance()]
                    .map(|radiance| f64::from(radiance.luminance()));
                let whole = |sum: [f64; 2]| light[0] * sum[0] + light[1] * sum[1];
                for (screen, &sum) in screens.iter().zip(&sums[1..]) {
                    let exact = whole(sum);
                    let share = exact / whole(sums[0]);
                    let measured = domes.each_ref().map(|dome| noise(dome, normal, screen, exact));
                    print!("{:8} {altitude:2}° {name:6} {:17} | {share:5.3} |", model.name(), screen.name);
                    measured.iter().for_each(|[rms, _]| print!(" {:6.2}", 100.0 * rms));
                    print!(" |");
                    measured.iter().for_each(|[_, bias]| print!(" {:6.2}", 100.0 * bias));
                    println!();
                    cases += 1;
                    logs.iter_mut().zip(&measured).for_each(|(log, [rms, _])| *log += rms.ln());
                }
            }
        }
    }
    let means = logs.map(|log| 100.0 * (log / f64::from(cases)).exp());
    println!("geometric mean over {cases} cases: {means:.2?} %");
}
