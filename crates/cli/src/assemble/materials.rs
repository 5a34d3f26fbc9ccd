//! Materials of files → shaders.

use std::sync::Arc;

use light::{Medium, Shade, Texture};
use raytrace::surface::{Finish, Glass, Image, NO_MIRROR, NormalMap, Surface};
use scene::{Material, UvTransform};

/// The shader of a material: a surface, or where light passes it, that of a transparent body.
pub(super) fn shade(material: &Material) -> Box<dyn Shade> {
    shade_with(material, material.medium())
}

/// The same, filled with `medium` whatever the material itself says.
pub(super) fn shade_with(material: &Material, medium: Option<Medium>) -> Box<dyn Shade> {
    match medium {
        Some(medium) => Box::new(Glass::new(finish(material), medium)),
        None => Box::new(Surface::new(finish(material))),
    }
}

/// The surface of a material that light does not pass; none of one that it does.
pub(super) fn matt(material: &Material) -> Option<Surface> {
    material.medium().is_none().then(|| Surface::new(finish(material)))
}

/// Whether a material is smooth enough for mirror rays, all or some of the way.
pub(crate) fn mirrors(material: &Material) -> bool {
    let reflects = material.metallic > 0.0 || material.normal_reflectance().max_element() > 0.0;
    reflects && material.roughness < NO_MIRROR
}

fn finish(material: &Material) -> Finish {
    Finish {
        base_colour: material.base_colour,
        base_texture: material.base_texture.as_ref().map(image),
        metallic: material.metallic,
        roughness: material.roughness,
        metallic_roughness_texture: material.metallic_roughness_texture.as_ref().map(image),
        normal_map: material.normal_map.as_ref().map(|map| NormalMap {
            image: image(&(Arc::clone(&map.texture), map.transform)),
            scale: map.scale,
        }),
        emission: material.emission,
        emission_texture: material.emission_texture.as_ref().map(image),
        ior: index(material.normal_reflectance().element_sum() / 3.0),
        diffuse_transmission: material.diffuse_transmission,
        diffuse_transmission_colour: material.diffuse_transmission_colour,
        // The medium says how much passes.
        transmission: 0.0,
    }
}

/// The index whose interface reflects `f0` head on: files state both, and the reflectance wins
/// (KHR_materials_specular). n = (1 + √F₀)/(1 − √F₀).
pub(super) fn index(f0: f32) -> f32 {
    let r = f0.clamp(0.0, 0.99).sqrt();
    (1.0 + r) / (1.0 - r)
}

fn image((texture, transform): &(Arc<Texture>, UvTransform)) -> Image {
    Image { texture: Arc::clone(texture), transform: *transform }
}
