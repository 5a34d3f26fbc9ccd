//! What an opaque surface is made of, and where its textures are read.

use std::sync::Arc;

use glam::{Affine2, Vec2, Vec3};
use light::{Hit, Texture};

use super::albedo::{Albedo, MOST_REFRACTIVE};

/// A texture and how the mesh's texture coordinates become its own.
#[derive(Clone, Debug)]
pub struct Image {
    /// The image.
    pub texture: Arc<Texture>,
    /// From the mesh's coordinates to the image's.
    pub transform: Affine2,
}

impl Image {
    /// Colour at the hit, averaged over the viewing pixel.
    pub(crate) fn colour(&self, hit: &Hit) -> Vec3 {
        // √|det| is the factor on lengths, exact where the transform keeps angles.
        let width = hit.uv_width() * self.transform.matrix2.determinant().abs().sqrt();
        self.texture.sample(self.transform.transform_point2(hit.uv), width).0
    }
}

/// Small-scale normals in the tangent frame: colour = ½ (n + 1), y upwards in the image (glTF).
#[derive(Clone, Debug)]
pub struct NormalMap {
    /// The image, not decoded from sRGB.
    pub image: Image,
    /// Factor on x and y.
    pub scale: f32,
}

/// What an opaque surface is made of: glTF's metallic-roughness terms.
///
/// The default is glTF's: a white, rough dielectric of index 1.5.
#[derive(Clone, Debug)]
pub struct Finish {
    /// Linear sRGB within \[0, 1\]: reflectance below the surface of a dielectric, or head on of a metal.
    pub base_colour: Vec3,
    /// Factor on it over the surface.
    pub base_texture: Option<Image>,
    /// 0 = dielectric, 1 = metal, between = share of the area.
    pub metallic: f32,
    /// Perceptual roughness within \[0, 1\]: √ of the microfacets' width α.
    pub roughness: f32,
    /// Factors over the surface: green on roughness, blue on metallic.
    pub metallic_roughness_texture: Option<Image>,
    /// Small-scale normals.
    pub normal_map: Option<NormalMap>,
    /// Emitted luminance per linear sRGB channel \[cd/m² of white\], ≥ 0.
    pub emission: Vec3,
    /// Factor on it over the surface.
    pub emission_texture: Option<Image>,
    /// Index of refraction of a dielectric, within \[1, 5\]; 1 = no gloss at all.
    pub ior: f32,
    /// Share of the light below the surface that leaves on the other side, matt, within \[0, 1\]: leaves, paper.
    pub diffuse_transmission: f32,
    /// Its colour, linear sRGB within \[0, 1\].
    pub diffuse_transmission_colour: Vec3,
    /// Share of the light below the surface that goes on as it is, unscattered, within \[0, 1\]. A [`Surface`]
    /// leaves it out; [`super::Glass`] follows it.
    pub transmission: f32,
}

impl Default for Finish {
    fn default() -> Self {
        Self {
            base_colour: Vec3::ONE,
            base_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_map: None,
            emission: Vec3::ZERO,
            emission_texture: None,
            ior: 1.5,
            diffuse_transmission: 0.0,
            diffuse_transmission_colour: Vec3::ONE,
            transmission: 0.0,
        }
    }
}

impl Finish {
    /// Linear sRGB reflectance at the hit, within \[0, 1\].
    pub(crate) fn base_at(&self, hit: &Hit) -> Vec3 {
        let texture = self.base_texture.as_ref().map_or(Vec3::ONE, |image| image.colour(hit));
        (self.base_colour * hit.vertex_colour * texture).clamp(Vec3::ZERO, Vec3::ONE)
    }

    /// Metallic share and roughness at the hit, each within \[0, 1\].
    pub(crate) fn metal_and_roughness_at(&self, hit: &Hit) -> Vec2 {
        let texture = self.metallic_roughness_texture.as_ref().map_or(Vec3::ONE, |image| image.colour(hit));
        Vec2::new(self.metallic * texture.z, self.roughness * texture.y).clamp(Vec2::ZERO, Vec2::ONE)
    }

    /// Emitted luminance per linear sRGB channel at the hit \[cd/m²\].
    pub(crate) fn emission_at(&self, hit: &Hit) -> Vec3 {
        if self.emission == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let texture = self.emission_texture.as_ref().map_or(Vec3::ONE, |image| image.colour(hit));
        (self.emission * texture).max(Vec3::ZERO)
    }
}

/// An opaque surface of metal, dielectric, or a mixture, ready to be asked.
///
/// A *dielectric* mirrors at its boundary (exact Fresnel of its index) and scatters below it:
///
///   f = F D G/(4 cos_i cos_o) + ρ/π · (1 − E(i)) (1 − E(o)) / (1 − Ē)
///
/// E is the share that the boundary reflects for a direction, Ē its mean: what is not mirrored reaches the
/// colour below, so that a white surface loses nothing (Kelemen and Szirmay-Kalos 2001). A *metal* mirrors
/// with its colour head on and white at grazing (Schlick), and what its facets pass among themselves is
/// given back evenly (Kulla and Conty 2017). Both are reciprocal and reflect at most what arrives.
///
/// *Extended light* and *mirror images*: see the [module](crate::surface). Surfaces of roughness below
/// 0.25 send a mirror ray, above 0.4 none, and in between both answers are blended.
///
/// *Normals.* Light is weighed at the interpolated and mapped normal (kept within 60° of the face), asked
/// for there as well, and light from behind the true face never counts. At the terminator of smooth-shaded
/// faces it fades over the last degrees (Chiang, Li and Burley 2019); that factor alone is not reciprocal.
///
/// ```
/// use glam::Vec3;
/// use keikan_raytrace::surface::{Finish, Surface};
/// use light::{Hit, Place, check::furnace};
///
/// let white = Surface::new(Finish { roughness: 0.5, ..Finish::default() });
/// let place = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 0 };
/// let hit = Hit::plain(place, Vec3::new(0.6, 0.8, 0.0), 1.0);
/// let share = furnace(&white, &hit);
/// assert!((share[0] - 1.0).abs() < 1e-3); // white: everything comes back (spectra of white are 1 to 1e-3)
/// ```
#[derive(Clone, Debug)]
pub struct Surface {
    pub(crate) finish: Finish,
    pub(crate) boundary: Arc<Albedo>,
}

impl Surface {
    /// A surface of that finish. Numbers outside their ranges are brought inside, NaN becomes the default.
    pub fn new(finish: Finish) -> Self {
        let sound = |value: f32, default: f32| if value.is_nan() { default } else { value };
        let ior = sound(finish.ior, 1.5).clamp(1.0, MOST_REFRACTIVE);
        let finish = Finish {
            metallic: sound(finish.metallic, 0.0),
            roughness: sound(finish.roughness, 1.0),
            ior,
            diffuse_transmission: sound(finish.diffuse_transmission, 0.0).clamp(0.0, 1.0),
            transmission: sound(finish.transmission, 0.0).clamp(0.0, 1.0),
            ..finish
        };
        Self { finish, boundary: Albedo::dielectric(ior) }
    }

    /// What it is made of.
    pub fn finish(&self) -> &Finish {
        &self.finish
    }
}
