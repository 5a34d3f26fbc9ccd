//! Seconds that a pool's beams take to make and to ask: `cargo run --release -p keikan-water --example caustics_cost`.

use std::time::Instant;

use glam::{DAffine3, DVec2, DVec3, Vec3};
use keikan_water::caustics::BeamMap;
use keikan_water::flat::{FlatWater, Source};
use keikan_water::waves::{Stokes, Waves, Wind};
use keikan_water::{Water, Way};
use light::Mesh;

fn main() {
    let corners = [(-6.0, -3.0), (-6.0, 3.0), (6.0, 3.0), (6.0, -3.0)];
    let positions = corners.map(|(x, z)| Vec3::new(x, 0.0, z)).to_vec();
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    let Ok(water) = Water::named("pool") else { return };
    let pool = FlatWater::new(water, &mesh, &DAffine3::IDENTITY);
    let sun = Source::Toward(DVec3::new(10f64.to_radians().sin(), 10f64.to_radians().cos(), 0.0));
    let wave = |angle: f64| Stokes::new(0.025, 1.0, DVec2::from_angle(angle), 0.4);
    let wind = Wind { speed: 4.0, fetch: 200.0, toward: DVec2::X, depth: None, waves: 48 };
    let seas =
        [("two waves of 5 cm × 1 m", [wave(0.3), wave(1.6)].into_iter().collect()), ("wind", wind.raise(1))];
    for (name, waves) in seas {
        let Ok(waves) = waves else { continue };
        let waves = Waves::new(waves, DVec2::ZERO);
        for step in [1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0] {
            let start = Instant::now();
            let map = BeamMap::new(&pool, &waves, sun, Way::Refracted, (step, 0.00465));
            let made = start.elapsed().as_secs_f64();
            let start = Instant::now();
            let (mut beams, n) = (0u32, 100_000);
            for i in 0..n {
                let [u, v] = light::sampling::lattice(i, n, [0, 0]).map(|u| f64::from(u) - 0.5);
                let at = DVec3::new(10.0 * u, -1.8, 5.0 * v);
                map.beams(at, map.half_width(at, 0.01), &mut |_| beams += 1);
            }
            let asked = start.elapsed().as_secs_f64() / f64::from(n) * 1e6;
            println!(
                "{name}, steps of {:.1} mm: {made:.3} s; {asked:.2} µs and {:.2} beams a place",
                step * 1e3,
                f64::from(beams) / f64::from(n)
            );
        }
    }
}
