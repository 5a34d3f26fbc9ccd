//! Small worlds, and what counts as agreement.

use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use keikan_reference::{Bands, Effort, Estimate, Parts, Sky, Surface};
use light::{Geometry, Instance, Mesh, Spectrum};

/// Walks for each number, without limit.
pub(crate) fn effort(samples: u32, seed: u64) -> Effort {
    Effort { samples, faces: None, seed }
}

/// A light of luminance 1.
pub(crate) fn white() -> Bands {
    Bands::from(Spectrum::ONE.of_luminance(1.0))
}

/// The same radiance from everywhere, of this luminance.
pub(crate) fn even(luminance: f64) -> Sky {
    Box::new(move |_| white() * luminance)
}

/// Quadrilaterals, corners counter-clockwise seen from outside, with their materials.
pub(crate) fn geometry(faces: &[([[f32; 3]; 4], u32)]) -> Arc<Geometry> {
    let mesh = |(corners, material): &([[f32; 3]; 4], u32)| Mesh {
        positions: corners.map(Vec3::from).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material: *material,
        ..Mesh::default()
    };
    let instance = |i: usize| Instance { mesh: i as u32, world_from_mesh: DAffine3::IDENTITY };
    Arc::new(Geometry {
        meshes: faces.iter().map(mesh).collect(),
        instances: (0..faces.len()).map(instance).collect(),
    })
}

/// The six faces of a box from `low` to `high`, outwards.
pub(crate) fn block(low: [f32; 3], high: [f32; 3], material: u32) -> Vec<([[f32; 3]; 4], u32)> {
    let ([a, b, c], [d, e, f]) = (low, high);
    [
        [[a, b, c], [d, b, c], [d, b, f], [a, b, f]],
        [[a, e, c], [a, e, f], [d, e, f], [d, e, c]],
        [[a, b, c], [a, e, c], [d, e, c], [d, b, c]],
        [[a, b, f], [d, b, f], [d, e, f], [a, e, f]],
        [[a, b, c], [a, b, f], [a, e, f], [a, e, c]],
        [[d, b, c], [d, e, c], [d, e, f], [d, b, f]],
    ]
    .map(|corners| (corners, material))
    .to_vec()
}

/// A level square about the middle, seen from above.
pub(crate) fn level(y: f32, half: f32, material: u32) -> ([[f32; 3]; 4], u32) {
    ([[-half, y, -half], [-half, y, half], [half, y, half], [half, y, -half]], material)
}

/// Nothing but a sky and surfaces.
pub(crate) fn parts(faces: &[([[f32; 3]; 4], u32)], surfaces: Vec<Surface>) -> Parts {
    Parts { geometry: geometry(faces), surfaces, ..Parts::default() }
}

/// Fails beyond four standard errors (and what `known` the truth, or a table, may be off by).
pub(crate) fn agrees(what: &str, found: &Estimate, truth: f64, known: f64) {
    let z = (found.luminance - truth) / found.luminance_error;
    println!("{what}: {:.6} ± {:.6}, truth {truth:.6}, z = {z:.2}", found.luminance, found.luminance_error);
    let far = (found.luminance - truth).abs();
    assert!(far <= 4.0 * found.luminance_error + known, "{what}: {found:?}, {truth}");
    assert!(found.luminance_error < 0.05 * truth, "{what}: too coarse to say anything");
}

pub(crate) const UP: DVec3 = DVec3::Y;
