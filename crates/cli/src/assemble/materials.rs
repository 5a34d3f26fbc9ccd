//! Materials of files → shaders.

use std::sync::Arc;

use light::{Shade, Texture};
use raytrace::surface::{Finish, Image, NormalMap, Surface};
use scene::{Material, UvTransform};

/// The shader of a material.
///
/// Transparent bodies (transmission) are shaded by their surface alone until local ray tracing is there.
pub(super) fn shade(material: &Material) -> Box<dyn Shade> {
    Box::new(Surface::new(Finish {
        base_colour: material.base_colour,
        base_texture: material.base_texture.as_ref().map(image),
        metallic: material.metallic,
        roughness: material.roughness,
        metallic_roughness_texture: material.metallic_roughness_texture.as_ref().map(image),
        normal_map: material
            .normal_map
            .as_ref()
            .map(|map| NormalMap { image: image(&(Arc::clone(&map.texture), map.transform)), scale: map.scale }),
        emission: material.emission,
        emission_texture: material.emission_texture.as_ref().map(image),
        ior: index(material.normal_reflectance().element_sum() / 3.0),
        diffuse_transmission: material.diffuse_transmission,
        diffuse_transmission_colour: material.diffuse_transmission_colour,
    }))
}

/// The index whose interface reflects `f0` head on: files state both, and the reflectance wins
/// (KHR_materials_specular). n = (1 + √F₀)/(1 − √F₀).
fn index(f0: f32) -> f32 {
    let r = f0.clamp(0.0, 0.99).sqrt();
    (1.0 + r) / (1.0 - r)
}

fn image((texture, transform): &(Arc<Texture>, UvTransform)) -> Image {
    Image { texture: Arc::clone(texture), transform: *transform }
}
