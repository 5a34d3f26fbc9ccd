//! Every triangle asked, in f64, one after the other: `accelerate = none`, and what the fast way is tested by.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use light::{Geometry, Hit, Nearest, Occlude, Ray, Spectrum, Triangle};

use crate::query::{Ask, First, Met, line};
use crate::shadow::Shadow;

/// All triangles in world coordinates, in f64. Answers in time proportional to their number.
#[derive(Clone, Debug)]
pub struct BruteForce {
    geometry: Arc<Geometry>,
    /// Instance, triangle, corners.
    faces: Vec<(u32, u32, Triangle)>,
}

impl BruteForce {
    /// Takes all triangles; those without area are never met.
    pub fn new(geometry: Arc<Geometry>) -> Self {
        let mut faces = Vec::with_capacity(geometry.triangle_count());
        for (i, instance) in geometry.instances.iter().enumerate() {
            for t in 0..geometry.meshes[instance.mesh as usize].triangles.len() as u32 {
                let face = geometry.triangle(i as u32, t);
                if face.cross().is_finite() && face.cross() != DVec3::ZERO {
                    faces.push((i as u32, t, face));
                }
            }
        }
        Self { geometry, faces }
    }

    fn ask(&self, ray: &Ray, ask: &mut impl Ask) {
        let (origin, direction) = line(ray);
        let mut reach = ray.length;
        for &(instance, triangle, face) in &self.faces {
            let Some(weights) = inside(&face, origin, direction) else { continue };
            let normal = face.cross();
            let t = normal.dot(face.0[0] - origin) / normal.dot(direction);
            if !(t > 0.0 && t < f64::from(ray.length)) {
                continue;
            }
            let mesh = &self.geometry.meshes[self.geometry.instances[instance as usize].mesh as usize];
            let met = Met {
                t,
                instance,
                triangle,
                weights,
                alpha: mesh.opacity.is_some() || mesh.medium.is_some(),
            };
            if ask.meet(met, &self.geometry, &mut reach) {
                return;
            }
        }
    }
}

/// The weights of the second and third corner where the line passes within the triangle, edges included.
fn inside(face: &Triangle, origin: DVec3, direction: DVec3) -> Option<DVec2> {
    let at = face.meet(origin, direction)?;
    (at.x >= 0.0 && at.y >= 0.0 && at.x + at.y <= 1.0).then_some(at)
}

impl Nearest for BruteForce {
    fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut first = First::new(0.5);
        self.ask(ray, &mut first);
        let met = first.found?;
        Some(self.geometry.hit(met.instance, met.triangle, met.weights, ray, 0.0))
    }
}

impl Occlude for BruteForce {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let mut shadow = Shadow::new(line(segment).1);
        self.ask(segment, &mut shadow);
        shadow.through(&self.geometry, segment)
    }
}
