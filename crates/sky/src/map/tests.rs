use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DMat3, Vec3};
use light::{Instance, Mesh, Vacuum};
use proptest::prelude::*;

use super::*;

mod kept;
mod laws;
mod mesh;
mod sights;
mod values;

/// What the open sky gives, different in every band and by tilt.
fn open(normal: Vec3) -> Spectrum {
    Spectrum(std::array::from_fn(|band| (1.0 + band as f32) * (1.5 + 0.5 * normal.y)))
}

/// A sky of which a known share arrives, by position and normal.
struct Fake<F> {
    share: F,
    asked: AtomicUsize,
}

impl<F: Fn(Vec3, Vec3) -> f32> Fake<F> {
    fn new(share: F) -> Arc<Self> {
        Arc::new(Self { share, asked: AtomicUsize::new(0) })
    }
}

impl<F: Fn(Vec3, Vec3) -> f32 + Send + Sync> Illuminate for Fake<F> {
    fn arrivals(&self, place: &Place, _: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        self.asked.fetch_add(1, Ordering::Relaxed);
        let irradiance = open(place.normal) * (self.share)(place.position, place.normal);
        receive(Arrival::Field { irradiance });
    }
}

impl<F: Fn(Vec3, Vec3) -> f32 + Send + Sync> WholeSky for Fake<F> {
    fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        open(normal)
    }
}

fn mesh(positions: &[Vec3], triangles: &[[u32; 3]]) -> Mesh {
    Mesh { positions: positions.to_vec(), triangles: triangles.to_vec(), ..Mesh::default() }
}

fn placed(mesh: Mesh, world_from_mesh: DAffine3) -> Arc<Geometry> {
    Arc::new(Geometry { meshes: vec![mesh], instances: vec![Instance { mesh: 0, world_from_mesh }] })
}

fn still(mesh: Mesh) -> Arc<Geometry> {
    placed(mesh, DAffine3::IDENTITY)
}

/// A square lawn of this width \[m\] around the origin, of two triangles, normal +Y.
fn lawn(width: f32) -> Mesh {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    mesh(&corners.map(|(x, z)| Vec3::new(x, 0.0, z) * (0.5 * width)), &[[0, 1, 2], [0, 2, 3]])
}

/// Hills of `n` × `n` squares of 1 m, with normals.
fn hills(n: u32) -> Mesh {
    let height = |x: f32, z: f32| 0.4 * (0.9 * x).sin() * (0.7 * z + 0.3).cos();
    let at = |i: u32| ((i % (n + 1)) as f32, (i / (n + 1)) as f32);
    let count = (n + 1) * (n + 1);
    let position = |i: u32| Vec3::new(at(i).0, height(at(i).0, at(i).1), at(i).1);
    let normal = |i: u32| {
        let (x, z) = at(i);
        let slope = |dx: f32, dz: f32| (height(x + dx, z + dz) - height(x - dx, z - dz)) * 50.0;
        Vec3::new(-slope(0.01, 0.0), 1.0, -slope(0.0, 0.01)).normalize()
    };
    let squares = (0..n * n).map(|i| i / n * (n + 1) + i % n);
    Mesh {
        positions: (0..count).map(position).collect(),
        normals: (0..count).map(normal).collect(),
        triangles: squares.flat_map(|i| [[i, i + n + 1, i + 1], [i + 1, i + n + 1, i + n + 2]]).collect(),
        ..Mesh::default()
    }
}

/// Coarse cells of 2 m, fine ones of 0.1 m, points exactly where they belong.
const EXACT: Settings = Settings { coarse: 2.0, least: 0.1, tolerance: 0.02, inset: 0.0, seed: 0 };

fn mapped(inner: Arc<dyn WholeSky>, geometry: &Arc<Geometry>, settings: Settings) -> Mapped {
    Mapped::new(inner, Arc::clone(geometry), settings, &Described::default())
}

fn ask(map: &Mapped, face: [u32; 2], position: Vec3, normal: Vec3) -> Spectrum {
    let mut sum = Spectrum::ZERO;
    let place = Place { position, error: 1e-6, normal, seed: 3 };
    map.arrivals_on(face, &place, &Vacuum, &mut |arrival| sum += arrival.on_plane(normal));
    sum
}

/// V of the first band.
fn share(map: &Mapped, face: [u32; 2], position: Vec3, normal: Vec3) -> f32 {
    ask(map, face, position, normal)[0] / open(normal)[0]
}

/// A value that no simple mesh expects: waves, a step, and something dark that stands there.
fn wild(position: Vec3, _: Vec3) -> f32 {
    let p = position * 1.3;
    let wave = 0.5 + 0.3 * (1.1 * p.x + 0.4 * p.z).sin() * (0.6 * p.z - p.y).cos();
    let dark = (p.x - 2.2).abs() < 0.7 && (p.z - 1.9).abs() < 0.9;
    if dark {
        0.0
    } else if p.x + 0.4 * p.z > 1.7 {
        wave * 0.5
    } else {
        wave
    }
}
