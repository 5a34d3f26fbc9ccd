//! What the receiving cuboid and band sources cost and leave: the thesis' figures 4.12 and 4.13.
//!
//! `cargo bench -p keikan-sky --bench cuboid` (some minutes). *Figure 4.13*: time for a place against the number of boxes, which
//! stand 12 m apart, each 3 to 9 m wide and 3 to 30 m high, turned anyhow; the more there are, the farther they reach. *Figure 4.12*: error
//! among 400 of them, as the root mean square over places of E in grey levels, 255 = the open horizontal (4.22), against the cuboid
//! with n = 100 as in the thesis, and against n = 160 in 3 × 3 parts, whose own error is far less. Places lie on the ground and,
//! looking four ways, up to 12 m over it, in the streets of the middle. One thread; the time is the mean over places of the quickest of four passes, which
//! a machine that does other work besides disturbs least.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use glam::{DAffine3, DVec3, Vec3};
use keikan_sky::{BandSky, CuboidSky, Description, Distribution, Division, Luminous};
use light::{Geometry, Illuminate, Instance, Mesh, Place, Vacuum};

const APART: f64 = 12.0;
const PASSES: usize = 4;

/// A reproducible number in [0, 1) (splitmix64).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

fn cube() -> Mesh {
    let corner = |i: u32| Vec3::new((i & 1) as f32 - 0.5, (i >> 1 & 1) as f32, (i >> 2) as f32 - 0.5);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        ..Mesh::default()
    }
}

/// `side` × `side` boxes on the ground.
fn town(side: u32) -> Geometry {
    let mut state = 1;
    let middle = 0.5 * f64::from(side - 1);
    let house = |i: u32| {
        let at = |n: u32| (f64::from(n) - middle) * APART;
        let mut size = || 3.0 + 3.0 * random(&mut state);
        let size = DVec3::new(size(), 9.0 * size() - 24.0, size());
        let turn = 3.0 * random(&mut state);
        DAffine3::from_translation(DVec3::new(at(i % side), 0.0, at(i / side)))
            * DAffine3::from_rotation_y(turn)
            * DAffine3::from_scale(size)
    };
    let ground = DAffine3::from_translation(DVec3::new(0.0, -1.0, 0.0))
        * DAffine3::from_scale(DVec3::new(1e5, 1.0, 1e5));
    let placed = (0..side * side).map(house).chain([ground]);
    let instances = placed.map(|world_from_mesh| Instance { mesh: 0, world_from_mesh }).collect();
    Geometry { meshes: vec![cube()], instances }
}

/// Places in the streets of the middle, for a town with an even number of boxes a side.
fn places(count: u32) -> Vec<Place> {
    let mut state = 7;
    let place = |i: u32| {
        let street = APART * (4.0 * random(&mut state) - 2.0).round();
        let along = APART * 4.0 * (random(&mut state) - 0.5);
        let height = 12.0 * random(&mut state);
        let normal = [Vec3::Y, Vec3::X, Vec3::NEG_Z, Vec3::NEG_X, Vec3::Y, Vec3::Z][i as usize % 6];
        let y = if normal == Vec3::Y { 0.0 } else { height };
        Place { position: DVec3::new(along, y, street).as_vec3(), error: 1e-5, normal, seed: i }
    };
    (0..count).map(place).collect()
}

fn sky(name: &str) -> Description {
    let (sin, cos) = 40f32.to_radians().sin_cos();
    let distribution = if name == "clear" { Distribution::CIE_CLEAR } else { Distribution::MoonSpencer };
    Description::new(Arc::new(Luminous::new(distribution, Vec3::new(0.6 * cos, sin, -0.8 * cos))))
}

/// Microseconds a place, and what each receives.
fn measure(stage: &dyn Illuminate, places: &[Place]) -> (f64, Vec<f32>) {
    let (mut quickest, mut received) = (vec![f64::INFINITY; places.len()], vec![0.0; places.len()]);
    for _ in 0..PASSES {
        for (i, place) in places.iter().enumerate() {
            let start = Instant::now();
            received[i] = black_box(stage.irradiance(place, &Vacuum)).luminance();
            quickest[i] = start.elapsed().as_secs_f64().min(quickest[i]);
        }
    }
    (quickest.iter().sum::<f64>() * 1e6 / places.len() as f64, received)
}

/// 4.22 in grey levels.
fn rms(a: &[f32], b: &[f32], white: f32) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| f64::from(255.0 * (a - b) / white).powi(2));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

fn cuboid(description: &Description, geometry: &Geometry, elements: u32, parts: u32) -> CuboidSky {
    CuboidSky::new(description, geometry, None, Division { elements, parts })
}

fn figure_4_13() {
    println!("figure 4.13: microseconds a place");
    let places = places(60);
    for name in ["overcast", "clear"] {
        let description = sky(name);
        println!("{name:>9}  boxes  cuboid 40  cuboid 80  bands 40");
        for side in [10, 32, 100, 316] {
            let geometry = town(side);
            let [a, b] = [40, 80].map(|n| measure(&cuboid(&description, &geometry, n, 1), &places).0);
            let c = measure(&BandSky::new(&description, &geometry, None, 40), &places).0;
            println!("{:16} {a:10.1} {b:10.1} {c:9.1}", side * side);
        }
    }
}

fn figure_4_12() {
    let geometry = town(20);
    let places = places(240);
    for name in ["overcast", "clear"] {
        let description = sky(name);
        let reference = measure(&cuboid(&description, &geometry, 100, 1), &places).1;
        let finest = cuboid(&description, &geometry, 160, 3);
        let white = finest.open_irradiance(Vec3::Y).luminance();
        let finest =
            places.iter().map(|place| finest.irradiance(place, &Vacuum).luminance()).collect::<Vec<_>>();
        println!(
            "figure 4.12, {name}: RMS against n = 100, and against n = 160 in 3 × 3 parts; microseconds a place"
        );
        println!("n = 100 against n = 160: {:.3}", rms(&reference, &finest, white));
        let report = |what: &str, stage: &dyn Illuminate| {
            let (time, received) = measure(stage, &places);
            let [a, b] = [&reference, &finest].map(|truth| rms(&received, truth, white));
            println!("{what:16} {a:7.3} {b:7.3} {time:9.1}");
        };
        for n in (10..=80).step_by(10) {
            report(&format!("cuboid {n}"), &cuboid(&description, &geometry, n, 1));
        }
        for (n, k) in [(10, 2), (20, 2), (30, 2), (40, 2), (20, 4)] {
            report(&format!("cuboid {n}, {k} × {k}"), &cuboid(&description, &geometry, n, k));
        }
        for count in (10..=80).step_by(10).chain([160]) {
            report(&format!("bands {count}"), &BandSky::new(&description, &geometry, None, count));
        }
    }
}

fn main() {
    figure_4_13();
    figure_4_12();
}
