//! The air's sky beside that of Hošek and Wilkie (2012): ratios, as they are, nothing tuned.
//!
//! `cargo run --release -p keikan-sky --example hosek_comparison -- TABLE.csv`, a table with lines of
//! turbidity, the sun's altitude, altitude, azimuth from the sun \[degrees\] and the radiances at 400, 440, …,
//! 680 nm \[W m⁻² sr⁻¹ nm⁻¹\], for a ground of albedo 0.1. Lines that do not begin with a number are passed
//! over.
//!
//! Turbidity T is another measure than Ångström's β. Here β = 0.04 (T − 1)^1.1 stands for it (T = 2: 0.04, 3:
//! 0.09), about what equal extinction at 550 nm asks for.

use std::collections::BTreeMap;

use glam::Vec3;
use keikan_sky::{Air, AirSky, Sky};
use light::Spectrum;

fn main() {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage: hosek_comparison TABLE.csv");
        std::process::exit(2);
    };
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) => {
            eprintln!("{path}: {error}");
            std::process::exit(1);
        }
    };
    let mut groups: BTreeMap<[u64; 2], Vec<Vec<f64>>> = BTreeMap::new();
    for line in text.lines() {
        let Ok(row) = line.split(',').map(str::parse::<f64>).collect::<Result<Vec<_>, _>>() else { continue };
        if row.len() == 12 {
            groups.entry([row[0], row[1]].map(f64::to_bits)).or_default().push(row);
        }
    }
    println!("turbidity sun | luminance ours/theirs: mean, least, most | blue/red ours/theirs: mean");
    for ([turbidity, sun], rows) in groups.iter().map(|(key, rows)| (key.map(f64::from_bits), rows)) {
        let beta = 0.04 * (turbidity - 1.0).max(0.0).powf(1.1);
        let sky =
            AirSky::new(&Air { turbidity: beta, ground_albedo: 0.1, ..Air::CLEAR }, toward(sun, 0.0), 0.0);
        let (mut logs, mut least, mut most, mut colours) = (0.0, f32::MAX, 0.0f32, 0.0);
        for row in rows {
            let table: Vec<(f64, f64)> = (0..8).map(|k| (400.0 + 40.0 * k as f64, row[4 + k])).collect();
            let theirs = Spectrum::from_table(&table);
            let ours = sky.radiance(toward(row[2], row[3]));
            let ratio = ours.luminance() / theirs.luminance();
            logs += ratio.ln();
            (least, most) = (least.min(ratio), most.max(ratio));
            colours += (ours[0] / ours[7] * theirs[7] / theirs[0]).ln();
        }
        let mean = |sum: f32| (sum / rows.len() as f32).exp();
        println!(
            "{turbidity:4} {sum:4}° | {:5.2} {least:5.2} {most:5.2} | {:5.2}",
            mean(logs),
            mean(colours),
            sum = sun
        );
    }
}

/// A direction by its altitude and its azimuth from the sun, which is in the north.
fn toward(altitude: f64, azimuth: f64) -> Vec3 {
    let ((sin, cos), (s, c)) = (altitude.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    Vec3::new((cos * s) as f32, sin as f32, (-cos * c) as f32)
}
