//! Materials: what a surface is made of, and how its meshes must be prepared.
//!
//! A mesh has one set of texture coordinates here: that of the base colour texture (or of the first texture
//! there is), with the base colour's KHR_texture_transform already applied, because the alpha of that texture
//! is looked up with the mesh's own coordinates. Transforms of the other textures are made relative to it.

use std::sync::Arc;

use glam::{Affine2, Vec3};
use gltf::json::extensions::material::Material as Extensions;
use gltf::json::{material, texture, validation};
use light::{Opacity, Texture};
use serde::Deserialize;
use serde_json::Value;

use super::document::Document;
use super::fault::{Checked, Fault, Notes};
use super::images::{Images, texture_of};
use super::uv::TextureUse;
use crate::image_file::Encoding;
use crate::{Material, NormalMap, UvTransform, Volume};

/// A material and what it asks of the meshes that wear it.
#[derive(Clone, Debug, Default)]
pub(super) struct Surface {
    pub(super) material: Material,
    /// The set of texture coordinates to take; none = no texture.
    pub(super) uv_set: Option<u32>,
    /// To be applied to them.
    pub(super) uv_transform: Affine2,
    /// How much of the surface is there; none = all.
    pub(super) opacity: Option<Arc<Opacity>>,
}

/// What is needed to read one material.
struct Reader<'a, 'd> {
    document: &'a Document<'d>,
    images: &'a mut Images,
    notes: &'a mut Notes,
    place: String,
    surface: Surface,
    /// Undoes `surface.uv_transform`.
    mesh_from_file: Affine2,
}

/// Material `index`, which exists.
pub(super) fn surface(
    document: &Document<'_>,
    source: &material::Material,
    index: usize,
    images: &mut Images,
    notes: &mut Notes,
) -> Checked<Surface> {
    let mut reader = Reader {
        document,
        images,
        notes,
        place: format!("/materials/{index}"),
        surface: Surface::default(),
        mesh_from_file: Affine2::IDENTITY,
    };
    reader.surface.material.name = source.name.clone().unwrap_or_default();
    match source.extensions.as_ref().and_then(|e| e.others.get("KHR_materials_pbrSpecularGlossiness")) {
        Some(old) => reader.specular_glossiness(old, source)?,
        None => reader.metallic_roughness(source)?,
    }
    reader.relief_and_glow(source)?;
    if let Some(extensions) = &source.extensions {
        reader.extensions(extensions)?;
    }
    Ok(reader.surface)
}

impl Reader<'_, '_> {
    fn metallic_roughness(&mut self, source: &material::Material) -> Checked<()> {
        let pbr = &source.pbr_metallic_roughness;
        self.base(pbr.base_color_factor.0, pbr.base_color_texture.as_ref(), source)?;
        self.surface.material.metallic = self.share("metallicFactor", pbr.metallic_factor.0)?;
        self.surface.material.roughness = self.share("roughnessFactor", pbr.roughness_factor.0)?;
        let map = pbr.metallic_roughness_texture.as_ref();
        self.surface.material.metallic_roughness_texture =
            self.map(map, Encoding::Linear, "metallicRoughnessTexture")?;
        Ok(())
    }

    /// The superseded model, brought to the present one: its specular colour is F₀ itself, and what is
    /// reflected there does not reach the diffuse layer.
    fn specular_glossiness(&mut self, old: &Value, source: &material::Material) -> Checked<()> {
        #[derive(Deserialize)]
        #[serde(rename_all = "camelCase", default)]
        struct Old {
            diffuse_factor: [f32; 4],
            diffuse_texture: Option<texture::Info>,
            specular_factor: [f32; 3],
            glossiness_factor: f32,
            specular_glossiness_texture: Option<texture::Info>,
        }
        impl Default for Old {
            fn default() -> Self {
                let (diffuse_factor, specular_factor) = ([1.0; 4], [1.0; 3]);
                let (diffuse_texture, specular_glossiness_texture) = (None, None);
                Self {
                    diffuse_factor,
                    diffuse_texture,
                    specular_factor,
                    glossiness_factor: 1.0,
                    specular_glossiness_texture,
                }
            }
        }
        let old = Old::deserialize(old).map_err(|error| Fault::new(&self.place, error.to_string()))?;
        self.note("KHR_materials_pbrSpecularGlossiness is approximated by metallic-roughness");
        if old.specular_glossiness_texture.is_some() {
            self.note("specularGlossinessTexture is ignored");
        }
        let specular = self.colour("specularFactor", old.specular_factor)?;
        let [r, g, b, a] = old.diffuse_factor;
        let left = 1.0 - specular.max_element();
        self.base([r * left, g * left, b * left, a], old.diffuse_texture.as_ref(), source)?;
        let roughness = 1.0 - self.share("glossinessFactor", old.glossiness_factor)?;
        let material = &mut self.surface.material;
        (material.metallic, material.roughness) = (0.0, roughness);
        material.specular_colour = specular / 0.04; // ((1.5−1)/(1.5+1))²
        Ok(())
    }

    /// Colour, its texture, texture coordinates and opacity.
    fn base(
        &mut self,
        factor: [f32; 4],
        map: Option<&texture::Info>,
        source: &material::Material,
    ) -> Checked<()> {
        let [r, g, b, alpha] = factor;
        self.surface.material.base_colour = self.colour("baseColorFactor", [r, g, b])?;
        let alpha = self.share("baseColorFactor", alpha)?;
        let cutoff = match source.alpha_mode {
            validation::Checked::Valid(material::AlphaMode::Opaque) => None,
            validation::Checked::Valid(material::AlphaMode::Blend) => Some(None),
            validation::Checked::Valid(material::AlphaMode::Mask) => {
                Some(Some(source.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0)))
            }
            validation::Checked::Invalid => {
                return Err(Fault::new(&self.place, "alphaMode is none of OPAQUE, MASK, BLEND"));
            }
        };
        let mut least_alpha = 1.0;
        if let Some(info) = map {
            let place = format!("{}/baseColorTexture", self.place);
            let used = TextureUse::new(info, &place)?;
            self.surface.uv_set = Some(used.set);
            let inverse = used.transform.inverse();
            if inverse.is_finite() {
                (self.surface.uv_transform, self.mesh_from_file) = (used.transform, inverse);
            } else {
                // The whole texture is one texel: nothing relative to it could be told apart.
                self.note("a KHR_texture_transform shrinks the texture to a line or point; it is ignored");
            }
            let image = self.images.texture(
                self.document,
                used.texture,
                (Encoding::Srgb, cutoff.is_some()),
                &place,
            )?;
            least_alpha = image.as_ref().map_or(1.0, |image| image.least_alpha);
            self.surface.material.base_texture = texture_of(image).map(|image| (image, Affine2::IDENTITY));
        }
        self.surface.opacity = cutoff.and_then(|cutoff| {
            // Exporters declare BLEND for whole objects that have no alpha at all: those are solid.
            let solid = alpha * least_alpha >= cutoff.unwrap_or(1.0);
            let texture = self.surface.material.base_texture.as_ref().map(|(image, _)| Arc::clone(image));
            (!solid).then(|| Arc::new(Opacity { texture, factor: alpha, cutoff }))
        });
        Ok(())
    }

    fn relief_and_glow(&mut self, source: &material::Material) -> Checked<()> {
        if let Some(normals) = &source.normal_texture {
            let place = format!("{}/normalTexture", self.place);
            let used = TextureUse::of_normals(normals, &place)?;
            let scale = normals.scale;
            if !scale.is_finite() {
                return Err(Fault::new(place, format!("scale is {scale}")));
            }
            if let Some((texture, transform)) = self.image(used, Encoding::Linear, "normalTexture")? {
                self.surface.material.normal_map = Some(NormalMap { texture, transform, scale });
            }
        }
        let strength = source.extensions.as_ref().and_then(|e| e.emissive_strength.as_ref());
        let strength = strength.map_or(1.0, |s| s.emissive_strength.0);
        let emission = Vec3::from_array(source.emissive_factor.0) * strength;
        if !(emission.is_finite() && emission.min_element() >= 0.0) {
            return Err(Fault::new(&self.place, format!("emits {emission}: finite numbers ≥ 0 are needed")));
        }
        self.surface.material.emission = emission;
        let map = source.emissive_texture.as_ref();
        self.surface.material.emission_texture = self.map(map, Encoding::Srgb, "emissiveTexture")?;
        Ok(())
    }

    fn extensions(&mut self, extensions: &Extensions) -> Checked<()> {
        if let Some(transmission) = &extensions.transmission {
            let share = self.share("transmissionFactor", transmission.transmission_factor.0)?;
            self.surface.material.transmission = share;
            self.ignore(transmission.transmission_texture.is_some(), "transmissionTexture");
        }
        if let Some(ior) = &extensions.ior {
            // 0 stands for "infinite" (KHR_materials_ior): all light is reflected.
            self.surface.material.ior = match ior.ior.0 {
                0.0 => f32::MAX,
                n if n >= 1.0 && n.is_finite() => n,
                n => {
                    return Err(Fault::new(
                        &self.place,
                        format!("ior is {n}, but must be at least 1 (or 0)"),
                    ));
                }
            };
        }
        if let Some(specular) = &extensions.specular {
            let colour = Vec3::from_array(specular.specular_color_factor.0);
            if !(colour.is_finite() && colour.min_element() >= 0.0) {
                return Err(Fault::new(&self.place, format!("specularColorFactor is {colour}")));
            }
            self.surface.material.specular = self.share("specularFactor", specular.specular_factor.0)?;
            self.surface.material.specular_colour = colour;
            self.ignore(specular.specular_texture.is_some(), "specularTexture");
            self.ignore(specular.specular_color_texture.is_some(), "specularColorTexture");
        }
        if let Some(volume) = &extensions.volume {
            self.volume(volume)?;
        }
        if let Some(leaf) = extensions.others.get("KHR_materials_diffuse_transmission") {
            self.diffuse_transmission(leaf)?;
        }
        if extensions.others.contains_key("KHR_materials_unlit") {
            self.note("KHR_materials_unlit has no meaning under physical light; the surface is lit");
        }
        Ok(())
    }

    fn volume(&mut self, volume: &gltf::json::extensions::material::Volume) -> Checked<()> {
        self.ignore(volume.thickness_texture.is_some(), "thicknessTexture");
        let distance = volume.attenuation_distance.0;
        if distance.is_nan() || distance <= 0.0 {
            return Err(Fault::new(
                &self.place,
                format!("attenuationDistance is {distance}, but must be positive"),
            ));
        }
        let colour = self.colour("attenuationColor", volume.attenuation_color.0)?;
        if volume.thickness_factor.0.is_nan() || volume.thickness_factor.0 <= 0.0 {
            return Ok(()); // thin-walled, says the extension
        }
        // −ln 0 is no number; 1e-6 over the distance is as dark as anything drawn.
        let attenuation_colour = colour.max(Vec3::splat(1e-6));
        self.surface.material.volume = Some(Volume { attenuation_colour, attenuation_distance: distance });
        Ok(())
    }

    fn diffuse_transmission(&mut self, extension: &Value) -> Checked<()> {
        #[derive(Deserialize)]
        #[serde(rename_all = "camelCase")]
        struct Leaf {
            diffuse_transmission_factor: Option<f32>,
            diffuse_transmission_texture: Option<Value>,
            diffuse_transmission_color_factor: Option<[f32; 3]>,
            diffuse_transmission_color_texture: Option<Value>,
        }
        let leaf =
            Leaf::deserialize(extension).map_err(|error| Fault::new(&self.place, error.to_string()))?;
        let share = leaf.diffuse_transmission_factor.unwrap_or(0.0);
        self.surface.material.diffuse_transmission = self.share("diffuseTransmissionFactor", share)?;
        let colour = leaf.diffuse_transmission_color_factor.unwrap_or([1.0; 3]);
        self.surface.material.diffuse_transmission_colour =
            self.colour("diffuseTransmissionColorFactor", colour)?;
        self.ignore(leaf.diffuse_transmission_texture.is_some(), "diffuseTransmissionTexture");
        self.ignore(leaf.diffuse_transmission_color_texture.is_some(), "diffuseTransmissionColorTexture");
        Ok(())
    }

    /// A texture other than the base colour's.
    fn map(
        &mut self,
        info: Option<&texture::Info>,
        encoding: Encoding,
        name: &str,
    ) -> Checked<Option<(Arc<Texture>, UvTransform)>> {
        let Some(info) = info else { return Ok(None) };
        let used = TextureUse::new(info, &format!("{}/{name}", self.place))?;
        self.image(used, encoding, name)
    }

    fn image(
        &mut self,
        used: TextureUse,
        encoding: Encoding,
        name: &str,
    ) -> Checked<Option<(Arc<Texture>, UvTransform)>> {
        let place = format!("{}/{name}", self.place);
        let set = *self.surface.uv_set.get_or_insert(used.set);
        let decoded = self.images.texture(self.document, used.texture, (encoding, false), &place)?;
        if used.set != set {
            self.note("textures of one material use different sets of texture coordinates; those that differ from the base colour's are left out");
            return Ok(None);
        }
        Ok(texture_of(decoded).map(|texture| (texture, used.transform * self.mesh_from_file)))
    }

    /// A finite number, brought into \[0, 1\].
    fn share(&mut self, name: &str, value: f32) -> Checked<f32> {
        Ok(self.colour(name, [value; 3])?.x)
    }

    /// Finite numbers, brought into \[0, 1\].
    fn colour(&mut self, name: &str, value: [f32; 3]) -> Checked<Vec3> {
        let value = Vec3::from_array(value);
        if !value.is_finite() {
            return Err(Fault::new(&self.place, format!("{name} is not finite")));
        }
        let inside = value.clamp(Vec3::ZERO, Vec3::ONE);
        if inside != value {
            self.note(&format!("{name} lies outside 0 … 1 and is clamped"));
        }
        Ok(inside)
    }

    fn ignore(&mut self, present: bool, name: &str) {
        if present {
            self.note(&format!("{name} is ignored; only its factor counts"));
        }
    }

    fn note(&mut self, sentence: &str) {
        self.notes.add(sentence, 1, &self.place);
    }
}
