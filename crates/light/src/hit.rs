//! Where light is asked for: a place on a surface, and a hit that shading looks at.

use glam::{Vec2, Vec3};

use crate::{Ray, rounding::gamma};

/// A place that receives light: a point of a surface (or of a volume, with any normal).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where \[m\].
    pub position: Vec3,
    /// Bound on the distance between `position` and the true surface \[m\].
    pub error: f32,
    /// Unit normal of the true (flat) face, on the side that is lit.
    pub normal: Vec3,
    /// Decides every random choice made for this place; belongs to the thing (pixel, patch, sensor).
    pub seed: u32,
}

impl Place {
    /// The ray that leaves this place along the unit vector `direction`, for `length` metres.
    ///
    /// Its origin is moved along the normal, to the side the ray goes to, by as much as the position may
    /// be wrong, plus the rounding of the move itself: it starts beyond the surface, never before it.
    pub fn leave(&self, direction: Vec3, length: f32) -> Ray {
        let side = if direction.dot(self.normal) < 0.0 { -self.normal } else { self.normal };
        let offset = self.error * side.abs().element_sum();
        let origin = self.position + side * offset;
        // The addition rounds once per coordinate: step on to the next number away from the surface.
        let next = |value: f32, toward: f32| match toward {
            t if t > 0.0 => value.next_up(),
            t if t < 0.0 => value.next_down(),
            _ => value,
        };
        let origin = Vec3::new(next(origin.x, side.x), next(origin.y, side.y), next(origin.z, side.z));
        Ray { origin, direction, length: (length - offset).max(0.0) }
    }

    /// The segment from this place to `target`, both ends excluded: `target` may lie on a surface too, as a
    /// lamp in a ceiling does, and that surface is not in its way.
    pub fn toward(&self, target: Vec3) -> Ray {
        let to = Ray::between(self.position, target);
        let left = self.leave(to.direction, to.length);
        // Aim again from the moved origin, so that the segment ends at the target, but for what the target's
        // coordinates, the direction and the length may be off by: a few roundings of the largest of them.
        let exact = Ray::between(left.origin, target);
        let reach = target.abs().max_element().max(left.origin.abs().max_element()) + exact.length;
        Ray { length: (exact.length - gamma(16) * reach).max(0.0), ..exact }
    }

    /// The same place seen from its other side.
    pub fn flipped(self) -> Self {
        Self { normal: -self.normal, ..self }
    }
}

/// How a ray came here from the eye: how often it was turned and what of it is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Mirror reflections and refractions so far.
    pub depth: u8,
    /// Largest share, over the bands, that this ray still has in the eye's radiance; within \[0, 1\].
    pub share: f32,
    /// Width of the bundle that the ray stands for, where it begins \[m\], ≥ 0.
    pub width: f32,
    /// What the bundle's width grows by per metre \[rad\], ≥ 0.
    pub spread: f32,
}

impl Path {
    /// Straight from the eye.
    pub const EYE: Self = Self { depth: 0, share: 1.0, width: 0.0, spread: 0.0 };

    /// The path after one more turn at `hit`, which lets `share` through and widens the bundle by `bend` for each
    /// radian by which the normal turns across it: 2 for a mirror, |1 − n₁/n₂| for refraction.
    ///
    /// A bundle of width w that meets a surface of curvature κ under the cosine c spreads by `bend` κ w/√c more (c = 1
    /// in one direction, 1/c in the other: the geometric mean), whichever way the surface is bent: as if no mirror
    /// gathered. After Amanatides 1984.
    pub fn then(self, share: f32, hit: &Hit, bend: f32) -> Self {
        Self {
            depth: self.depth.saturating_add(1),
            share: self.share * share,
            width: hit.width,
            spread: (self.spread + bend * hit.turn()).min(WIDEST),
        }
    }

    /// The bundle's width \[m\] at a distance along the ray.
    pub fn width_at(&self, distance: f32) -> f32 {
        self.width + self.spread * distance
    }
}

/// Bundles spread no wider than this \[rad\]: beyond a quarter turn it means nothing any more.
const WIDEST: f32 = 1.5;

/// Cosine below which a bundle counts as no more grazing: from there on a face curved by no more than the bundle is
/// wide has turned away, and its silhouette ends the bundle before its normal can turn farther.
const GRAZING: f32 = 0.05;

/// A visible point of a surface, with all that shading may want to know about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where, how exactly, and the unit normal of the flat face *on the viewer's side*.
    pub place: Place,
    /// Unit normal for shading (interpolated), on the viewer's side as far as the mesh allows.
    pub shading_normal: Vec3,
    /// Unit vector back along the viewing ray.
    pub toward_eye: Vec3,
    /// Distance along the viewing ray \[m\].
    pub distance: f32,
    /// Texture coordinates.
    pub uv: Vec2,
    /// ∂position/∂u, the direction in which u grows on the surface \[m per unit u\]; zero without uv.
    pub tangent: Vec3,
    /// Width, across the ray, of the bundle that this hit stands for \[m\]: a pixel's, or a sample's; 0 = a line.
    pub width: f32,
    /// How fast `shading_normal` turns along the surface, at most \[rad/m\]; 0 = flat.
    pub curvature: f32,
    /// Texture coordinates per metre of the surface, √(uv area/area) \[1/m\]; 0 = sample without filtering.
    pub uv_density: f32,
    /// Linear vertex colour, a factor on the base colour; (1,1,1) without.
    pub vertex_colour: Vec3,
    /// Index into [`crate::Geometry::instances`].
    pub instance: u32,
    /// Index of the triangle within its mesh.
    pub triangle: u32,
    /// Which [`crate::Shade`] answers for this surface.
    pub material: u32,
    /// True when the ray meets the side the triangle is wound for (counter-clockwise), i.e. comes from outside.
    pub front: bool,
    /// How the ray came here.
    pub path: Path,
}

impl Hit {
    /// A hit at `place` on the front of a plain flat face (no texture, number 0 of everything), seen by a line straight from the eye that is
    /// `distance` \[m\] away along the unit vector `toward_eye`.
    pub fn plain(place: Place, toward_eye: Vec3, distance: f32) -> Self {
        Self {
            place,
            shading_normal: place.normal,
            toward_eye,
            distance,
            uv: Vec2::ZERO,
            tangent: Vec3::ZERO,
            width: 0.0,
            curvature: 0.0,
            uv_density: 0.0,
            vertex_colour: Vec3::ONE,
            instance: 0,
            triangle: 0,
            material: 0,
            front: true,
            path: Path::EYE,
        }
    }

    /// Angle by which the normal turns across the bundle that this hit stands for \[rad\], at most a little less than a
    /// quarter turn.
    pub fn turn(&self) -> f32 {
        let cos = self.place.normal.dot(self.toward_eye).abs().max(GRAZING);
        (self.curvature * self.width / cos.sqrt()).min(WIDEST)
    }

    /// Width of the bundle in texture coordinates; 0 = sample without filtering.
    pub fn uv_width(&self) -> f32 {
        self.width * self.uv_density
    }

    /// The same hit at the end of a further ray on `path`, with the bundle's width there.
    #[must_use]
    pub fn on(self, path: Path) -> Self {
        Self { width: path.width_at(self.distance), path, ..self }
    }
}
