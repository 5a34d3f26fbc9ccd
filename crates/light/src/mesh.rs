//! What the world is made of: triangle meshes, placed once or many times.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3, Vec2, Vec3};

use crate::{Hit, Medium, Path, Place, Ray, Texture, rounding};

/// How much of a face is there: alpha of a texture times a factor.
#[derive(Clone, Debug)]
pub struct Opacity {
    /// Where the alpha comes from; none = 1 everywhere.
    pub texture: Option<Arc<Texture>>,
    /// Factor on the alpha, within \[0, 1\].
    pub factor: f32,
    /// Alpha at and above which the face is wholly there, below which it is not (glTF MASK);
    /// none = the alpha itself is the opacity (glTF BLEND).
    pub cutoff: Option<f32>,
}

impl Opacity {
    /// Opacity at `uv`, averaged over a footprint of `width` in texture coordinates; within \[0, 1\].
    ///
    /// A cut-out (`cutoff`) averages *coverage*, not alpha: with the footprint below a texel it is 0 or 1.
    pub fn at(&self, uv: Vec2, width: f32) -> f32 {
        let alpha = |uv| self.texture.as_ref().map_or(1.0, |texture| texture.alpha(uv, width)) * self.factor;
        match self.cutoff {
            None => alpha(uv).clamp(0.0, 1.0),
            // A ramp of one footprint around the cutoff would need the gradient; the threshold on the
            // filtered alpha is what every glTF viewer does.
            Some(cutoff) => f32::from(alpha(uv) >= cutoff),
        }
    }
}

/// Triangles of one material, in coordinates of their own.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Corner positions \[m\], finite.
    pub positions: Vec<Vec3>,
    /// Unit normals for shading, one per position, or empty for flat faces.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one per position, or empty.
    pub uvs: Vec<Vec2>,
    /// Linear vertex colours, one per position, or empty.
    pub colours: Vec<Vec3>,
    /// Corners of each triangle, counter-clockwise seen from outside; every index is in range.
    pub triangles: Vec<[u32; 3]>,
    /// Which [`crate::Shade`] answers for the surface.
    pub material: u32,
    /// None = solid.
    pub opacity: Option<Arc<Opacity>>,
    /// What the body is filled with where light passes its surface; none = no light gets inside.
    pub medium: Option<Arc<Medium>>,
}

/// One placement of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index into [`Geometry::meshes`].
    pub mesh: u32,
    /// From the mesh's coordinates to the world \[m\]; invertible, finite.
    pub world_from_mesh: DAffine3,
}

/// All surfaces of a scene. World coordinates are recentred: the scene lies around (0, 0, 0).
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    /// The meshes.
    pub meshes: Vec<Mesh>,
    /// Their placements.
    pub instances: Vec<Instance>,
}

/// The corners of one triangle, in the world, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle(pub [DVec3; 3]);

impl Triangle {
    /// Twice the area times the unit normal (counter-clockwise side) \[m²\].
    pub fn cross(&self) -> DVec3 {
        let [a, b, c] = self.0;
        (b - a).cross(c - a)
    }

    /// Barycentric weights (of the second and third corner) where the line meets the triangle's plane;
    /// none when it is parallel to the plane. Not clamped: slightly outside when the line passes outside.
    pub fn meet(&self, origin: DVec3, direction: DVec3) -> Option<DVec2> {
        let [a, b, c] = self.0;
        let (e1, e2) = (b - a, c - a);
        let p = direction.cross(e2);
        let determinant = e1.dot(p);
        let s = origin - a;
        let q = s.cross(e1);
        let at = DVec2::new(s.dot(p), direction.dot(q)) / determinant;
        at.is_finite().then_some(at)
    }
}

impl Geometry {
    /// Triangles in all placements together.
    pub fn triangle_count(&self) -> usize {
        self.instances.iter().map(|i| self.meshes[i.mesh as usize].triangles.len()).sum()
    }

    /// Box of everything in the world, lower and upper corner \[m\]; none when there is nothing.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let corners = self.instances.iter().flat_map(|instance| {
            let mesh = &self.meshes[instance.mesh as usize];
            mesh.positions.iter().map(|p| instance.world_from_mesh.transform_point3(p.as_dvec3()))
        });
        corners.fold(None, |bounds, p| match bounds {
            None => Some((p, p)),
            Some((low, high)) => Some((low.min(p), high.max(p))),
        })
    }

    /// The corners of a triangle in the world.
    pub fn triangle(&self, instance: u32, triangle: u32) -> Triangle {
        let instance = &self.instances[instance as usize];
        let mesh = &self.meshes[instance.mesh as usize];
        let corner =
            |i: u32| instance.world_from_mesh.transform_point3(mesh.positions[i as usize].as_dvec3());
        Triangle(mesh.triangles[triangle as usize].map(corner))
    }

    /// The hit at barycentric weights `at` (of the second and third corner) of a triangle.
    ///
    /// `ray` is the viewing ray, `pixel_width` the width of its footprint across the ray at the hit \[m\]
    /// (0 = sample textures without filtering). Weights a little outside the triangle are brought inside.
    pub fn hit(&self, instance: u32, triangle: u32, at: DVec2, ray: &Ray, pixel_width: f32) -> Hit {
        self.hit_on(&self.triangle(instance, triangle), [instance, triangle], at, ray, pixel_width)
    }

    /// The same for one who has the corners `world` of triangle \[instance, triangle\] already.
    pub fn hit_on(
        &self,
        world: &Triangle,
        [instance, triangle]: [u32; 2],
        at: DVec2,
        ray: &Ray,
        pixel_width: f32,
    ) -> Hit {
        let placed = &self.instances[instance as usize];
        let mesh = &self.meshes[placed.mesh as usize];
        let corners = mesh.triangles[triangle as usize].map(|i| i as usize);
        let v = at.x.clamp(0.0, 1.0);
        let w = at.y.clamp(0.0, 1.0 - v);
        let weights = [1.0 - v - w, v, w];
        let position = mix(world.0, weights, |corner, weight| corner * weight);

        let mut outward = world.cross().normalize_or_zero().as_vec3();
        if placed.world_from_mesh.matrix3.determinant() < 0.0 {
            outward = -outward;
        }
        let front = outward.dot(ray.direction) <= 0.0;
        let normal = if front { outward } else { -outward };
        let position_f32 = position.as_vec3();
        // In f64 the corners are exact and the sum is far better than f32: what is left is the rounding
        // to f32 (½ ulp a coordinate) and that of corners that were rounded to f32 where others (a BVH)
        // look at them: another ½ ulp of the largest coordinate of the triangle.
        let reach = world.0.iter().fold(0.0f64, |reach, c| reach.max(c.abs().max_element())) as f32;
        let place = Place { position: position_f32, error: 4.0 * rounding::UNIT * reach, normal, seed: 0 };
        let (tangent, uv_density) = uv_frame(mesh, corners, world);
        Hit {
            place,
            shading_normal: shading_normal(mesh, placed, corners, weights, normal, front),
            toward_eye: -ray.direction,
            distance: (position_f32 - ray.origin).length(),
            uv: if mesh.uvs.is_empty() {
                Vec2::ZERO
            } else {
                mix(corners, weights, |i, weight| mesh.uvs[i].as_dvec2() * weight).as_vec2()
            },
            tangent,
            width: pixel_width,
            curvature: curvature(mesh, placed, corners),
            uv_density,
            vertex_colour: if mesh.colours.is_empty() {
                Vec3::ONE
            } else {
                mix(corners, weights, |i, weight| mesh.colours[i].as_dvec3() * weight).as_vec3()
            },
            instance,
            triangle,
            material: mesh.material,
            front,
            path: Path::EYE,
        }
    }
}

/// Σ part(corner, weight).
fn mix<C: Copy, T: std::ops::Add<Output = T>>(
    corners: [C; 3],
    weights: [f64; 3],
    part: impl Fn(C, f64) -> T,
) -> T {
    part(corners[0], weights[0]) + part(corners[1], weights[1]) + part(corners[2], weights[2])
}

/// Interpolated normal in the world, turned to the viewer's side; the flat one where the mesh has none or
/// where interpolation gives nothing usable.
fn shading_normal(
    mesh: &Mesh,
    placed: &Instance,
    corners: [usize; 3],
    weights: [f64; 3],
    flat: Vec3,
    front: bool,
) -> Vec3 {
    if mesh.normals.is_empty() {
        return flat;
    }
    let local = mix(corners, weights, |i, weight| mesh.normals[i].as_dvec3() * weight);
    // Normals transform by the inverse transpose, i.e. by the cofactors, which need no inverse.
    let m = placed.world_from_mesh.matrix3;
    let cofactors =
        glam::DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    let mut smooth = (cofactors * local).normalize_or_zero().as_vec3();
    if m.determinant() < 0.0 {
        smooth = -smooth;
    }
    if !front {
        smooth = -smooth;
    }
    // A mesh wound against its own normals (it happens) is taken at the word of its faces.
    match smooth.dot(flat) {
        d if d > 0.0 => smooth,
        d if d < 0.0 => -smooth,
        _ => flat,
    }
}

/// How fast the interpolated normal of a triangle turns, at most \[rad/m\]: the largest difference of two corners'
/// normals over their distance. Placements count by their mean scale.
fn curvature(mesh: &Mesh, placed: &Instance, corners: [usize; 3]) -> f32 {
    if mesh.normals.is_empty() {
        return 0.0;
    }
    let scale = placed.world_from_mesh.matrix3.determinant().abs().cbrt() as f32;
    let [a, b, c] = corners;
    let along = |(i, j): (usize, usize)| {
        let turned = mesh.normals[i].distance(mesh.normals[j]);
        let apart = mesh.positions[i].distance(mesh.positions[j]) * scale;
        if turned > 0.0 && apart > 0.0 { turned / apart } else { 0.0 }
    };
    [(a, b), (b, c), (c, a)].into_iter().map(along).fold(0.0, f32::max)
}

/// ∂position/∂u and √(uv area per area) of a triangle; zeros without usable texture coordinates.
fn uv_frame(mesh: &Mesh, corners: [usize; 3], world: &Triangle) -> (Vec3, f32) {
    if mesh.uvs.is_empty() {
        return (Vec3::ZERO, 0.0);
    }
    let [a, b, c] = corners.map(|i| mesh.uvs[i].as_dvec2());
    let (d1, d2) = (b - a, c - a);
    let determinant = d1.perp_dot(d2);
    let tangent = ((world.0[1] - world.0[0]) * d2.y - (world.0[2] - world.0[0]) * d1.y) / determinant;
    let area = world.cross().length();
    if !tangent.is_finite() || area <= 0.0 {
        return (Vec3::ZERO, 0.0);
    }
    (tangent.as_vec3(), (determinant.abs() / area).sqrt() as f32)
}
