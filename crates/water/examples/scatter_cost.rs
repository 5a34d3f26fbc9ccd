//! What light scattered from luminaires costs: error against evaluations, by the thesis' steps (3.33 to 3.35) and by quadrature
//! to a stated error.
//!
//! `cargo run --release -p keikan-water --example scatter_cost`. Eight view rays into clean and turbid water, past a lamp under
//! water (5 cm to 3 m away) and one 2 m above it, in the open and with a shadow over a fourth of the ray: found by halving, or with its
//! ends told to the quadrature. Errors are those of luminance, as a share of the reference's; the cost is the
//! mean number of points looked at per ray.

use glam::DVec3;
use keikan_water::scatter::{LAMP_TOLERANCE, Steps};
use keikan_water::{Leg, Loss, Scattering, Tolerance, ViewRay, Water};
use light::Spectrum;

fn luminance(radiance: [f64; 8]) -> f64 {
    f64::from(Spectrum(radiance.map(|band| band as f32)).luminance())
}

/// The view ray, and the stretch of it that the shadow covers \[m\].
const RAY: ViewRay = ViewRay { from: DVec3::ZERO, direction: DVec3::new(0.6, -0.8, 0.0), length: 8.0 };
const SHADOW: [f64; 2] = [2.3, 4.3];

/// 1 W/sr in every direction, or none into the shadow.
fn light(shadow: bool) -> impl Fn(&Leg, DVec3) -> Spectrum {
    move |_, point| {
        let r = (point - RAY.from).dot(RAY.direction);
        let dark = shadow && r > SHADOW[0] && r < SHADOW[1];
        if dark { Spectrum::ZERO } else { Spectrum::ONE }
    }
}

/// Largest and mean relative error, and points per ray.
fn judge(
    cases: &[(Scattering, DVec3, f64)],
    estimate: impl Fn(&Scattering, DVec3, f64) -> (f64, usize),
) -> [f64; 3] {
    let mut sums = [0.0f64; 3];
    for (scattering, lamp, truth) in cases {
        let (found, points) = estimate(scattering, *lamp, *truth);
        let error = (found / truth - 1.0).abs();
        sums = [sums[0].max(error), sums[1] + error, sums[2] + points as f64];
    }
    let count = cases.len() as f64;
    [sums[0], sums[1] / count, sums[2] / count]
}

fn main() -> Result<(), keikan_water::QualityError> {
    let exact = Tolerance { absolute: 0.0, relative: 1e-6, evaluations: 1_000_000 };
    let lamps = [
        ("under water", [0.05, 0.2, 1.0, 3.0].map(|away| DVec3::new(2.4, -3.2, away))),
        ("in air", [0.0, 1.0, 3.0, 6.0].map(|away| DVec3::new(2.0, 2.0, away))),
    ];
    for ((place, lamps), shadow) in lamps.into_iter().flat_map(|lamp| [(lamp, false), (lamp, true)]) {
        let light = light(shadow);
        let mut cases = Vec::new();
        for name in ["pool", "jerlov-7C"] {
            for lamp in lamps {
                let scattering = Scattering::new(Water::named(name)?, 0.0, Loss::Diffuse);
                let truth = luminance(scattering.lamp(lamp, &light, &RAY, &SHADOW, exact).value);
                cases.push((scattering, lamp, truth));
            }
        }
        println!("lamp {place}, {}", if shadow { "a shadow" } else { "no shadow" });
        println!("  method                          points  worst error  mean error");
        let print = |name: &str, [worst, mean, points]: [f64; 3]| {
            println!("  {name:29} {points:8.0} {:10.3} % {:10.3} %", 100.0 * worst, 100.0 * mean);
        };
        for longest in [1.0, 0.3, 0.1, 0.03, 0.01] {
            let figures = judge(&cases, |scattering, lamp, truth| {
                // The luminance per metre to which the thesis' I_ref and I_ε refer: the mean over the ray.
                let reference = truth / RAY.length;
                let negligible = 1e-3 * reference;
                let steps = Steps { longest, shortest: 0.05 * longest, reference, negligible };
                let walked = scattering.lamp_by_steps(lamp, DVec3::NEG_Y, &light, &RAY, &steps);
                (luminance(walked.radiance), walked.evaluations)
            });
            print(&format!("steps of {longest} m at most"), figures);
        }
        let told: &[(&str, &[f64])] = if shadow { &[("", &[]), (", told", &SHADOW)] } else { &[("", &[])] };
        for (how, breaks) in told {
            for relative in [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
                let figures = judge(&cases, |scattering, lamp, _| {
                    let tolerance = Tolerance { relative, ..LAMP_TOLERANCE };
                    let found = scattering.lamp(lamp, &light, &RAY, breaks, tolerance);
                    (luminance(found.value), found.evaluations)
                });
                print(&format!("quadrature to {relative:e}{how}"), figures);
            }
        }
    }
    Ok(())
}
