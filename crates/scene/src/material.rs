//! What a surface is made of, as files describe it.

use std::sync::Arc;

use glam::{Affine2, Vec3};
use light::{Medium, Spectrum, Texture};

/// Texture coordinates as the file gives them to those of one texture (KHR_texture_transform).
pub type UvTransform = Affine2;

/// A surface. Everything is a plain number as files state it; nothing spectral yet.
#[derive(Clone, Debug)]
pub struct Material {
    /// Its name in the file, or "".
    pub name: String,
    /// Linear sRGB reflectance factor, each within \[0, 1\].
    pub base_colour: Vec3,
    /// Factor on it over the surface (already decoded from sRGB to linear).
    pub base_texture: Option<(Arc<Texture>, UvTransform)>,
    /// 0 = dielectric, 1 = metal.
    pub metallic: f32,
    /// Perceptual roughness within \[0, 1\].
    pub roughness: f32,
    /// Factors over the surface: green = roughness, blue = metallic.
    pub metallic_roughness_texture: Option<(Arc<Texture>, UvTransform)>,
    /// Small-scale normals.
    pub normal_map: Option<NormalMap>,
    /// Emitted luminance per linear sRGB channel \[cd/m² of white\], emissiveFactor × emissive_strength.
    pub emission: Vec3,
    /// Factor on it over the surface.
    pub emission_texture: Option<(Arc<Texture>, UvTransform)>,
    /// Share of light that passes instead of being reflected diffusely, within \[0, 1\] (KHR_materials_transmission).
    pub transmission: f32,
    /// Index of refraction, ≥ 1.
    pub ior: f32,
    /// Factor on the specular reflection of a dielectric, within \[0, 1\] (KHR_materials_specular).
    pub specular: f32,
    /// Colour of that reflection at normal incidence, linear sRGB, ≥ 0.
    pub specular_colour: Vec3,
    /// What fills the body behind the surface (KHR_materials_volume); none = a thin pane, or of a solid, which is
    /// a body always, a clear inside.
    pub volume: Option<Volume>,
    /// Share of light transmitted diffusely (KHR_materials_diffuse_transmission: leaves), within \[0, 1\].
    pub diffuse_transmission: f32,
    /// Its colour, linear sRGB.
    pub diffuse_transmission_colour: Vec3,
}

impl Default for Material {
    /// glTF's default: white, matt (a dielectric of roughness 1), n = 1.5, opaque.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_colour: Vec3::ONE,
            base_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_map: None,
            emission: Vec3::ZERO,
            emission_texture: None,
            transmission: 0.0,
            ior: 1.5,
            specular: 1.0,
            specular_colour: Vec3::ONE,
            volume: None,
            diffuse_transmission: 0.0,
            diffuse_transmission_colour: Vec3::ONE,
        }
    }
}

impl Material {
    /// Share of light that the dielectric reflects at normal incidence, per linear sRGB channel:
    /// F₀ = specular · min(((n−1)/(n+1))² · specular_colour, 1) (KHR_materials_specular).
    ///
    /// ```
    /// let f0 = keikan_scene::Material::default().normal_reflectance();
    /// assert!((f0.x - 0.04).abs() < 1e-7); // (0.5/2.5)², one rounding of f32
    /// ```
    pub fn normal_reflectance(&self) -> Vec3 {
        let r = (self.ior - 1.0) / (self.ior + 1.0);
        (self.specular_colour * (r * r)).min(Vec3::ONE) * self.specular
    }

    /// What fills a body of this material, for light that passes its surface; none for an opaque one.
    ///
    /// σ = −ln(colour)/distance per band (KHR_materials_volume); without a volume it is a thin pane. That is said of
    /// triangles: for a [`crate::Solid`] of the same material `thin` means nothing, it is filled and clear. The metallic
    /// share of the surface lets nothing through. Textures do not count: a body's shadow has one tint.
    ///
    /// ```
    /// use keikan_scene::{Material, Volume};
    /// let inside = Volume { attenuation_colour: glam::Vec3::splat(0.5), attenuation_distance: 2.0 };
    /// let glass = Material { transmission: 1.0, volume: Some(inside), ..Material::default() };
    /// let left = glass.medium().unwrap().absorption.attenuate(2.0);
    /// assert!((left[0] - 0.5).abs() < 1e-6); // half is left after two metres, to rounding
    /// ```
    pub fn medium(&self) -> Option<Medium> {
        let transmission = self.transmission * (1.0 - self.metallic);
        if !transmission.is_normal() || transmission < 0.0 {
            return None;
        }
        let absorption = self.volume.map_or(Spectrum::ZERO, |volume| {
            // A band of a saturated colour may be 0: what is left of it then is a millionth.
            let left = Spectrum::reflectance(volume.attenuation_colour).map(|band| band.clamp(1e-6, 1.0));
            left.map(|band| -band.ln() / volume.attenuation_distance)
        });
        Some(Medium {
            index: self.ior,
            absorption,
            transmission: transmission.min(1.0),
            tint: Spectrum::reflectance(self.base_colour).map(|band| band.clamp(0.0, 1.0)),
            thin: self.volume.is_none(),
        })
    }
}

/// A tangent-space normal map: rgb = ½ (n + 1), not decoded from sRGB.
#[derive(Clone, Debug)]
pub struct NormalMap {
    /// The image.
    pub texture: Arc<Texture>,
    /// Texture coordinates for it.
    pub transform: UvTransform,
    /// Factor on x and y.
    pub scale: f32,
}

/// The inside of a transparent body: σ = −ln(colour)/distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume {
    /// Linear sRGB that is left of white after `attenuation_distance`, each within (0, 1\].
    pub attenuation_colour: Vec3,
    /// \[m\], > 0; infinite = clear.
    pub attenuation_distance: f32,
}
