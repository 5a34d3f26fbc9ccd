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
        ior: material.ior,
        diffuse_transmission: material.diffuse_transmission,
        diffuse_transmission_colour: material.diffuse_transmission_colour,
    }))
}

fn image((texture, transform): &(Arc<Texture>, UvTransform)) -> Image {
    Image { texture: Arc::clone(texture), transform: *transform }
}
