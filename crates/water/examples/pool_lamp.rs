//! Lux at the bottom of a pool under a lamp in the air, and on the ceiling over a lamp under water, one bundle of light exactly
//! and as the thesis prints it (3.11, 3.12).
//!
//! `cargo run --release -p keikan-water --example pool_lamp -- [WATER] [DEPTH]`, for instance `jerlov-3C 2`; without arguments a
//! pool 2 m deep. 1000 cd in every direction; nothing is in the way, and nothing reflects but the surface.

use glam::DVec3;
use keikan_water::{Loss, Paths, Surface, Water};
use light::Spectrum;

/// Above and below the surface \[m\].
const LAMP_HEIGHT: f64 = 3.0;
/// Depth of the other lamp \[m\].
const LAMP_DEPTH: f64 = 0.6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "pool".to_owned());
    let depth: f64 = arguments.next().map_or(Ok(2.0), |text| text.parse())?;
    let water = Water::named(&name)?;
    let surface = Surface::of(&water, 0.0);
    let thousand = Spectrum::ONE.of_luminance(1000.0);

    // Lux on a horizontal plane at `to`, by the straight way or through the surface, and off its mirror.
    let lux = |from: DVec3, to: DVec3, paths: Paths| {
        let legs = surface.legs(from, to, paths).into_iter().flatten();
        let on_plane = legs.map(|leg| {
            let facing = leg.irradiance(thousand, water.loss(Loss::Diffuse));
            facing.luminance() * leg.toward.y.abs() as f32
        });
        on_plane.sum::<f32>()
    };
    println!("{name}, n = {}: critical angle {:.1}°", water.index(), water.critical_angle().to_degrees());
    println!(
        "lamp {LAMP_HEIGHT} m above the surface, bottom {depth} m below; lamp {LAMP_DEPTH} m below, ceiling {LAMP_HEIGHT} m above"
    );
    println!("   off the lamp [m] | bottom: exact  as in 3.11   dry | ceiling: exact  as in 3.12");
    for across in [0.0, 1.0, 2.0, 4.0, 8.0] {
        let [high, deep] = [LAMP_HEIGHT, -LAMP_DEPTH].map(|y| DVec3::new(0.0, y, 0.0));
        let [bottom, ceiling] = [-depth, LAMP_HEIGHT].map(|y| DVec3::new(across, y, 0.0));
        let away = bottom - high;
        let dry = 1000.0 * (LAMP_HEIGHT + depth) / away.length().powi(3);
        println!(
            "{across:19.0} | {:13.2} {:11.2} {dry:6.2} | {:14.2} {:11.2}",
            lux(high, bottom, Paths::Exact),
            lux(high, bottom, Paths::Thesis),
            lux(deep, ceiling, Paths::Exact),
            lux(deep, ceiling, Paths::Thesis),
        );
    }
    Ok(())
}
