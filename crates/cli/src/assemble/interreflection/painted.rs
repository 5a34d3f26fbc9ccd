//! What patches reflect and emit, by the materials of the scene.

use glam::DVec2;
use light::{Geometry, Hit, Ray, Spectrum};
use radiosity::{Patch, Side, Surfaces};
use raytrace::surface::Surface;

use super::sides::Sides;
use super::still::Still;

/// How far off a patch \[m\] tells which water it is lit in.
const OFF: f64 = 1e-3;

/// Faces, what they are made of, and which of their sides take part.
pub(super) struct Painted<'a> {
    pub(super) geometry: &'a Geometry,
    /// By material; none where light passes, which nothing reflects diffusely.
    pub(super) surfaces: &'a [Option<Surface>],
    pub(super) still: Option<&'a Still>,
    /// Materials whose faces show lamps, which shine by themselves.
    pub(super) lamps: &'a [u32],
    /// None = all.
    pub(super) sides: Option<&'a Sides>,
}

impl Painted<'_> {
    fn material(&self, instance: u32) -> u32 {
        self.geometry.meshes[self.geometry.instances[instance as usize].mesh as usize].material
    }

    fn surface(&self, instance: u32) -> Option<&Surface> {
        self.surfaces.get(self.material(instance) as usize)?.as_ref()
    }

    /// The mean of `of` over three points of a patch, textures read about each of them; times how much of the face is there.
    fn mean(&self, patch: &Patch, of: impl Fn(&Surface, &Hit) -> Spectrum) -> Spectrum {
        let Some(surface) = self.surface(patch.face[0]) else { return Spectrum::ZERO };
        let world = self.geometry.triangle(patch.face[0], patch.face[1]);
        let toward = Ray::new(glam::Vec3::ZERO, -patch.normal().as_vec3());
        let width = (patch.area() / 3.0).sqrt() as f32;
        let opacity =
            &self.geometry.meshes[self.geometry.instances[patch.face[0] as usize].mesh as usize].opacity;
        let mut sum = Spectrum::ZERO;
        for k in 0..3 {
            // Inner points of a rule of the second degree.
            let at = (patch.corners[k] * 4.0 + patch.corners[(k + 1) % 3] + patch.corners[(k + 2) % 3]) / 6.0;
            let weights = world.meet(at, world.cross()).unwrap_or(DVec2::splat(1.0 / 3.0));
            let hit = self.geometry.hit_on(&world, patch.face, weights, &toward, width);
            let there = opacity.as_ref().map_or(1.0, |opacity| opacity.at(hit.uv, hit.uv_width()));
            sum += of(surface, &hit) * there;
        }
        sum * (1.0 / 3.0)
    }

    /// Exitance of its own \[W m⁻² nm⁻¹\], that of lamps left out.
    pub(super) fn emitted(&self, patch: &Patch) -> Spectrum {
        if self.lamps.contains(&self.material(patch.face[0])) {
            return Spectrum::ZERO;
        }
        self.mean(patch, |surface, hit| surface.emitted(hit)) * std::f32::consts::PI
    }
}

impl Surfaces for Painted<'_> {
    fn takes_part(&self, face: [u32; 2], side: Side) -> bool {
        self.surface(face[0]).is_some() && self.sides.is_none_or(|sides| sides.lit(face, side))
    }

    fn reflectance(&self, patch: &Patch) -> Spectrum {
        self.mean(patch, Surface::even_reflectance)
    }

    /// 0 in air, and a number for every water.
    fn part(&self, patch: &Patch) -> u32 {
        let holds = |still: &Still| still.holds(patch.centre() + patch.normal() * OFF);
        self.still.and_then(holds).map_or(0, |water| water as u32 + 1)
    }
}
