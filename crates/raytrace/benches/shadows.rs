//! What a segment costs that is cut into shadow intervals, in shadow rays of the same place.
//!
//! `cargo bench -p keikan-raytrace --bench shadows`. Three scenes under a sun and a lamp: *prisms*, 24 prisms on
//! a floor (some 500 triangles), *columns*, a hall of 100 columns (20 k triangles), and *terrain*, a million
//! triangles. The segments lie on what vertical rays from above meet, 4 cm to 1 m long (a pixel to a whole span)
//! or a quarter of the scene; the rays go from the middles of the same segments. One thread; the median of five
//! passes.

use std::{f64::consts::TAU, hint::black_box, sync::Arc, time::Instant};

use glam::{DAffine3, DVec3, Vec3};
use keikan_raytrace::{Quality, World};
use light::{Geometry, Instance, Mesh, Nearest, Occlude, Place, PointSource, Ray, Stretch};

/// A reproducible number in [0, 1) (splitmix64).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Hills of three waves, `cells` × `cells`.
fn hills(cells: u32, side: f32, height: f32) -> Mesh {
    let row = cells + 1;
    let position = |i: u32| {
        let at = |n: u32| (n as f32 / cells as f32 - 0.5) * side;
        let (x, z) = (at(i % row), at(i / row));
        let wave = |scale: f32| ((x / side * scale).sin() + (z / side * scale * 1.3).cos()) / scale;
        Vec3::new(x, height * (wave(9.0) + wave(40.0) + wave(170.0)), z)
    };
    let cell = |i: u32| {
        let a = i / cells * row + i % cells;
        [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]
    };
    Mesh {
        positions: (0..row * row).map(position).collect(),
        triangles: (0..cells * cells).flat_map(cell).collect(),
        ..Mesh::default()
    }
}

/// Upright prisms of `sides` sides and `rings` storeys in a square of `side` metres.
fn prisms(count: u32, sides: u32, rings: u32, side: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let across = f64::from(count).sqrt().ceil();
    for n in 0..count {
        let at = |n: f64| ((n + 0.5) / across - 0.5) * side;
        let middle = DVec3::new(at(f64::from(n) % across), 0.0, at((f64::from(n) / across).floor()));
        let base = mesh.positions.len() as u32;
        for ring in 0..=rings {
            for i in 0..sides {
                let (sin, cos) = (TAU * f64::from(i) / f64::from(sides) + f64::from(n)).sin_cos();
                let up = 4.0 * f64::from(ring) / f64::from(rings);
                mesh.positions.push((middle + DVec3::new(0.4 * cos, up, 0.4 * sin)).as_vec3());
            }
        }
        let at = |ring: u32, i: u32| base + ring * sides + i % sides;
        for i in 0..sides {
            for ring in 0..rings {
                mesh.triangles.push([at(ring, i), at(ring + 1, i), at(ring, i + 1)]);
                mesh.triangles.push([at(ring, i + 1), at(ring + 1, i), at(ring + 1, i + 1)]);
            }
            if i > 1 {
                mesh.triangles.push([at(rings, 0), at(rings, i), at(rings, i - 1)]);
            }
        }
    }
    mesh
}

fn world(meshes: Vec<Mesh>) -> World {
    let once = |mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY };
    let instances = (0..meshes.len() as u32).map(once).collect();
    World::build(Arc::new(Geometry { meshes, instances }), Quality::Medium)
}

/// Segments on faces, each with the place in its middle.
fn segments(world: &World, side: f64, long: f64) -> Vec<(DVec3, DVec3, Place)> {
    let mut state = 3;
    let mut out = Vec::new();
    while out.len() < 20_000 {
        let at = DVec3::new(random(&mut state) - 0.5, 0.0, random(&mut state) - 0.5) * side * 0.9;
        let from = Vec3::new(at.x as f32, 3000.0, at.z as f32);
        let Some(hit) = world.nearest(&Ray::new(from, Vec3::NEG_Y)) else { continue };
        let normal = hit.place.normal.as_dvec3();
        let turn = DVec3::new(random(&mut state) - 0.5, random(&mut state) - 0.5, random(&mut state) - 0.5);
        let half = normal.cross(turn).normalize_or_zero() * long * 0.5;
        let middle = hit.place.position.as_dvec3();
        out.push((middle - half, middle + half, hit.place));
    }
    out
}

/// Median seconds of five passes, and what the last one counted.
fn seconds(mut pass: impl FnMut() -> usize) -> (f64, usize) {
    let mut took = [0.0; 5];
    let mut count = 0;
    for took in &mut took {
        let start = Instant::now();
        count = black_box(pass());
        *took = start.elapsed().as_secs_f64();
    }
    took.sort_by(f64::total_cmp);
    (took[2], count)
}

fn row(name: &str, world: &World, side: f64, long: f64, source: PointSource) {
    let segments = segments(world, side, long);
    let mut out: Vec<Stretch> = Vec::new();
    let (fan, dark) = seconds(|| {
        let count = |&(a, b, _): &(DVec3, DVec3, Place)| {
            out.clear();
            world.shadows(&source, a, b, &mut out);
            out.len()
        };
        segments.iter().map(count).sum()
    });
    let mut asked = 0;
    for &(a, b, _) in &segments {
        out.clear();
        world.shadows(&source, a, b, &mut out);
        asked += usize::from(out.iter().any(|stretch| !stretch.dark));
    }
    let (rays, blocked) = seconds(|| {
        let blocked = |(_, _, place): &&(DVec3, DVec3, Place)| {
            let ray = match source {
                PointSource::At(at) => place.toward(at.as_vec3()),
                PointSource::Toward(toward) | PointSource::Below { toward, .. } => {
                    place.leave(toward.as_vec3(), f32::INFINITY)
                }
            };
            world.transmittance(&ray).is_zero()
        };
        segments.iter().filter(blocked).count()
    });
    let each = 1e6 / segments.len() as f64;
    println!(
        "{name:28}{:9}{:8.2} m{:9.2} µs{:9.2} µs{:8.1}{:10}{:8}{:8}",
        world.stats().triangles,
        long,
        fan * each,
        rays * each,
        fan / rays,
        dark,
        blocked,
        asked
    );
}

fn main() {
    println!(
        "{:28}{:>9}{:>10}{:>12}{:>12}{:>8}{:>10}{:>8}{:>8}",
        "", "triangles", "segment", "fan", "ray", "rays", "stretches", "blocked", "asked"
    );
    let floor = hills(1, 20.0, 0.0);
    let small = world(vec![floor.clone(), prisms(24, 8, 1, 18.0)]);
    let columns = world(vec![floor, prisms(100, 20, 5, 18.0)]);
    let terrain = world(vec![hills(708, 4000.0, 1500.0)]);
    let toward = PointSource::Toward(DVec3::new(0.6, 0.5, 0.62).normalize());
    for (name, world, side, lamp) in [
        ("prisms", &small, 18.0, 6.0),
        ("columns", &columns, 18.0, 6.0),
        ("terrain", &terrain, 4000.0, 900.0),
    ] {
        for long in [0.04, 1.0, side / 4.0] {
            row(&format!("{name}, sun"), world, side, long, toward);
            row(&format!("{name}, lamp"), world, side, long, PointSource::At(DVec3::new(1.3, lamp, -2.1)));
        }
    }
}
