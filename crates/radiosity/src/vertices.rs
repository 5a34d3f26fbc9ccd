//! Values at the corners of patches, between which light varies without a step.

use std::collections::HashMap;

use glam::{DVec3, Vec3};
use light::{Geometry, Ray, Spectrum};

use crate::Patches;
use crate::patch::{Patch, weights};

/// Corners go on into each other where their normals agree: to 1.4·10⁻³ rad, some hundred times what f32 corners leave of the
/// flatness of a well-shaped quadrilateral.
const SMOOTH: f32 = 1.0 - 1e-6;

/// Rounds of taking what patches' means miss back to their corners.
const ROUNDS: usize = 8;

/// By patch, which vertices its corners are; and what the vertices have.
pub(crate) struct Vertices {
    corners: Vec<[u32; 3]>,
    values: Vec<Spectrum>,
}

impl Vertices {
    /// Vertices for `irradiance` by patch.
    ///
    /// A vertex begins with the mean, by area, of the patches around it, which bends everything towards flat where a face ends. What the
    /// mean over each patch is then off by is handed to its corners, again and again (Landweber): light that varies evenly
    /// comes out as it is, up to the edge.
    pub(crate) fn new(geometry: &Geometry, patches: &Patches, irradiance: &[Spectrum]) -> Self {
        let (corners, count) = joined(geometry, patches);
        let mut around = vec![0.0f32; count];
        for (patch, corners) in corners.iter().enumerate() {
            for &corner in corners {
                around[corner as usize] += patches.node(patch).area as f32;
            }
        }
        let mut vertices = Self { corners, values: vec![Spectrum::ZERO; count] };
        for _ in 0..=ROUNDS {
            let mut more = vec![Spectrum::ZERO; count];
            for (patch, corners) in vertices.corners.iter().enumerate() {
                let missed = irradiance[patch] - vertices.at(patch, [1.0 / 3.0; 3]);
                for &corner in corners {
                    let corner = corner as usize;
                    more[corner] += missed * (patches.node(patch).area as f32 / around[corner]);
                }
            }
            for (value, more) in vertices.values.iter_mut().zip(more) {
                *value = (*value + more).map(|band| band.max(0.0));
            }
        }
        vertices
    }

    /// The value at weights of a patch's corners.
    pub(crate) fn at(&self, patch: usize, weights: [f64; 3]) -> Spectrum {
        let [a, b, c] = self.corners[patch].map(|corner| self.values[corner as usize]);
        let [u, v, w] = weights.map(|weight| weight as f32);
        a * u + b * v + c * w
    }

    pub(crate) fn len(&self) -> usize {
        self.values.len()
    }
}

/// A position's bits, and a part of space.
type Spot = ([u64; 3], u32);

/// Numbers of the vertices at the corners of every patch, and how many there are.
fn joined(geometry: &Geometry, patches: &Patches) -> (Vec<[u32; 3]>, usize) {
    // What meets at a position in one part of space: normal of the face, normal for shading, and the vertex.
    let mut met: HashMap<Spot, Vec<(Vec3, Vec3, u32)>> = HashMap::new();
    let mut count = 0;
    let mut corners = Vec::with_capacity(patches.len());
    for (patch, &part) in patches.iter().zip(&patches.parts) {
        let flat = patch.normal().as_vec3();
        corners.push(patch.corners.map(|at| {
            let smooth = shading_normal(geometry, &patch, at);
            // 0 and −0 are one place.
            let position = (at + DVec3::ZERO).to_array().map(f64::to_bits);
            let here = met.entry((position, part)).or_default();
            let same =
                |&&(other, bent, _): &&(Vec3, Vec3, u32)| bent.dot(smooth) >= SMOOTH && other.dot(flat) > 0.0;
            if let Some(&(_, _, vertex)) = here.iter().find(same) {
                return vertex;
            }
            here.push((flat, smooth, count));
            count += 1;
            count - 1
        }));
    }
    (corners, count as usize)
}

/// Interpolated normal at a point of a patch, on its side.
fn shading_normal(geometry: &Geometry, patch: &Patch, at: DVec3) -> Vec3 {
    let world = geometry.triangle(patch.face[0], patch.face[1]);
    let flat = patch.normal().as_vec3();
    let Some([_, v, w]) = weights(&world.0, at) else { return flat };
    let toward = Ray::new(Vec3::ZERO, -flat);
    geometry.hit_on(&world, patch.face, glam::DVec2::new(v, w), &toward, 0.0).shading_normal
}
