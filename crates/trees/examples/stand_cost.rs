//! Time and memory of stands of 10² to 10⁶ trees: shadow rays from the ground to the sun and to the sky, and viewing rays.
//!
//! `cargo run --release -p keikan-trees --example stand_cost`

use std::time::Instant;

use glam::Vec3;
use keikan_trees::{Bake, Form, Growth, Placed, Species, Stand, bake, grow};
use light::sampling::{lattice, shift};
use light::{Arrival, Occlude, Path, Place, Ray, Spectrum, Surroundings, Traverse};

const RAYS: u32 = 100_000;
const SPACING: f32 = 8.0;

/// Light from everywhere that costs nothing.
struct Even;

impl Surroundings for Even {
    fn arrivals(&self, _: &Place, receive: &mut dyn FnMut(Arrival)) {
        receive(Arrival::Field { irradiance: Spectrum::ONE });
    }

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        Spectrum::ONE
    }
}

fn stand(count: u32, species: &Species) -> (Stand, f32) {
    let columns = f64::from(count).sqrt().ceil() as u32;
    let side = columns as f32 * SPACING;
    let tree = |i: u32| {
        let [dx, dz] = lattice(i, count, shift(i, 1));
        let at = [(i % columns) as f32 + dx, (i / columns) as f32 + dz].map(|k| k * SPACING - 0.5 * side);
        let height = 8.0 + 6.0 * dx;
        Placed { species: 0, position: Vec3::new(at[0], 0.0, at[1]), height, rotation: 6.0 * dz }
    };
    let trees = (0..count).map(tree).collect();
    (Stand::new(vec![species.clone()], trees).expect("a forest"), side)
}

fn ground(i: u32, side: f32) -> Vec3 {
    let [x, z] = lattice(i, RAYS, shift(7, 7));
    Vec3::new((x - 0.5) * side, 0.0, (z - 0.5) * side)
}

/// Nanoseconds for one of [`RAYS`] calls, and the mean of what they answer.
fn time(one: impl Fn(u32) -> f32) -> (f64, f32) {
    let start = Instant::now();
    let sum: f32 = (0..RAYS).map(&one).sum();
    (start.elapsed().as_nanos() as f64 / f64::from(RAYS), sum / RAYS as f32)
}

fn main() {
    let mesh = grow(&Growth::usual(Form::Spreading, 10.0, 2)).expect("a lime");
    let lime = bake(&mesh, &Bake::default()).expect("a species");
    println!("trees    build s  B/tree  sun ns (open)  sky ns (open)  view ns (open)");
    for count in [1, 100, 10_000, 1_000_000] {
        let start = Instant::now();
        let (stand, side) = stand(count, &lime);
        let built = start.elapsed().as_secs_f64();
        let toward = Vec3::new(0.5, 0.64, 0.58).normalize();
        let sun = time(|i| stand.transmittance(&Ray::new(ground(i, side), toward))[0]);
        let sky = time(|i| {
            let [u, v] = lattice(i, RAYS, shift(1, 1));
            let (sin, cos) = (std::f32::consts::TAU * v).sin_cos();
            let up = Vec3::new(u.sqrt() * cos, (1.0 - u).sqrt(), u.sqrt() * sin);
            stand.transmittance(&Ray::new(ground(i.wrapping_mul(7919) % RAYS, side), up))[0]
        });
        let path = Path { spread: 0.001, ..Path::EYE };
        let view = time(|i| {
            let eye = Vec3::new(0.0, 30.0, 0.0);
            let ray = Ray::between(eye, ground(i, side));
            stand.way(&ray, path, &Even).transmittance[0]
        });
        let bytes = stand.bytes()[0] as f64 / f64::from(count);
        println!(
            "{count:7}  {built:7.2}  {bytes:6.1}  {:6.0} ({:.2})  {:6.0} ({:.2})  {:7.0} ({:.2})",
            sun.0, sun.1, sky.0, sky.1, view.0, view.1
        );
    }
    println!("pictures of the species: {:.1} MB", lime.bytes() as f64 / 1e6);
}
