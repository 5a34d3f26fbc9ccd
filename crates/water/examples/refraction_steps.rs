//! How many steps find the point where light crosses the surface: Newton's on the tangent, or the thesis' linear
//! interpolation, of which it says that once or twice is enough.
//!
//! `cargo run --release -p keikan-water --example refraction_steps`. Heights, depths and distances from 10⁻³ to 10³ m; the
//! error is that of the way in air, as a share of the distance.

use keikan_water::path::{crossing, crossing_thesis};

fn main() {
    let lengths: Vec<f64> = (-12..=12).map(|i| 10f64.powf(f64::from(i) / 4.0)).collect();
    let each = |f: &mut dyn FnMut(f64, f64, f64)| {
        for &h in &lengths {
            for &d in &lengths {
                for &r in &lengths {
                    f(h, d, r);
                }
            }
        }
    };
    let (mut sum, mut count, mut most) = (0, 0, 0);
    each(&mut |h, d, r| {
        let steps = crossing(1.34, h, d, r).steps;
        (sum, count, most) = (sum + steps, count + 1, most.max(steps));
    });
    println!(
        "Newton: {most} steps at most, {:.2} on average, to rounding",
        f64::from(sum) / f64::from(count)
    );
    println!("thesis: steps, worst error, share of paths that err by more than 1 %");
    for steps in [1, 2, 3, 5, 10, 20, 50, 100, 1000] {
        let (mut worst, mut bad) = (0.0f64, 0);
        each(&mut |h, d, r| {
            let error = (crossing_thesis(1.34, h, d, r, steps) - crossing(1.34, h, d, r).run_air).abs() / r;
            worst = worst.max(error);
            bad += u32::from(error > 0.01);
        });
        println!("{steps:13} {worst:11.1e} {:8.1} %", 100.0 * f64::from(bad) / f64::from(count));
    }
}
