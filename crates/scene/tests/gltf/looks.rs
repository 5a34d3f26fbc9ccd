//! Materials, textures and opacity.

use glam::{Vec2, Vec3};
use keikan_scene::Material;
use serde_json::{Value, json};

use crate::builder::{Builder, encode, push};

/// A triangle with texture coordinates and this material.
fn dressed(material: Value) -> Builder {
    let mut file = Builder::triangle();
    let uvs = file.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    file.attribute("TEXCOORD_0", uvs);
    file.json["materials"] = json!([material]);
    file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    file
}

#[test]
fn colours_are_decoded_and_other_numbers_are_not() {
    let mut file = dressed(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0 } }
    }));
    file.texture(1, 1, &[128, 0, 255, 0]);
    let material = &file.read().unwrap().materials[0];
    let sample = |texture: &Option<(std::sync::Arc<light::Texture>, keikan_scene::UvTransform)>| {
        texture.as_ref().unwrap().0.sample(Vec2::ZERO, 0.0)
    };
    // IEC 61966-2-1: ((128/255 + 0.055)/1.055)^2.4 = 0.215861; 16 bits leave ½/65535.
    let half = Vec3::splat(1.0 / 65535.0);
    assert!(sample(&material.base_texture).0.abs_diff_eq(Vec3::new(0.215_861, 0.0, 1.0), half.x));
    assert!(
        sample(&material.metallic_roughness_texture)
            .0
            .abs_diff_eq(Vec3::new(128.0 / 255.0, 0.0, 1.0), half.x)
    );
    // Opaque materials ignore alpha, even 0.
    assert_eq!(sample(&material.base_texture).1, 1.0);
}

#[test]
fn deep_grey_and_palette_images_are_read() {
    let grey = image::DynamicImage::ImageLuma16(image::ImageBuffer::from_raw(1, 1, vec![32768]).unwrap());
    let rgb = image::DynamicImage::ImageRgb8(image::ImageBuffer::from_raw(1, 1, vec![188; 3]).unwrap());
    // Both are about one half of white light, sRGB-encoded or not.
    for (image, name) in [(&grey, "metallicRoughnessTexture"), (&rgb, "baseColorTexture")] {
        let mut file = dressed(json!({ "pbrMetallicRoughness": { name: { "index": 0 } } }));
        let view = file.view(&encode(image));
        file.json["images"] = json!([{ "bufferView": view }]);
        file.json["textures"] = json!([{ "source": 0 }]);
        let material = &file.read().unwrap().materials[0];
        let texture = material.base_texture.as_ref().or(material.metallic_roughness_texture.as_ref());
        let (colour, _) = texture.unwrap().0.sample(Vec2::ZERO, 0.0);
        // sRGB code 188 is 0.50289 by IEC 61966-2-1.
        assert!(colour.abs_diff_eq(Vec3::splat(0.5), 0.003), "{name}: {colour}");
    }
}

#[test]
fn alpha_makes_opacity_only_where_there_is_some() {
    let opacity = |alpha: u8, mode: Value, factor: f32| {
        let mut material = mode;
        material["pbrMetallicRoughness"] =
            json!({ "baseColorTexture": { "index": 0 }, "baseColorFactor": [1, 1, 1, factor] });
        let mut file = dressed(material);
        file.texture(1, 1, &[255, 255, 255, alpha]);
        let opacity = file.read().unwrap().meshes[0].opacity.clone();
        opacity.map(|opacity| opacity.at(Vec2::ZERO, 0.0))
    };
    let (blend, mask) = (json!({ "alphaMode": "BLEND" }), json!({ "alphaMode": "MASK", "alphaCutoff": 0.5 }));
    assert_eq!(opacity(0, json!({}), 0.5), None);
    assert_eq!(opacity(255, blend.clone(), 1.0), None);
    assert_eq!(opacity(255, blend.clone(), 0.5), Some(0.5));
    assert_eq!(opacity(51, blend, 1.0), Some(0.2));
    assert_eq!(opacity(200, mask.clone(), 1.0), None);
    assert_eq!(opacity(100, mask.clone(), 1.0), Some(0.0));
    assert_eq!(opacity(200, mask, 0.5), Some(0.0));
}

#[test]
fn the_base_transform_goes_into_the_mesh_and_the_others_follow() {
    let transform = |scale: f32, offset: f32| json!({ "index": 0, "extensions": { "KHR_texture_transform": { "scale": [scale, scale], "offset": [offset, 0] } } });
    let mut file = dressed(json!({
        "pbrMetallicRoughness": { "baseColorTexture": transform(2.0, 0.5) },
        "normalTexture": transform(4.0, 0.0), "emissiveTexture": { "index": 0 }
    }));
    file.texture(1, 1, &[255; 4]);
    let model = file.read().unwrap();
    assert_eq!(model.meshes[0].uvs, [Vec2::new(0.5, 0.0), Vec2::new(2.5, 0.0), Vec2::new(0.5, 2.0)]);
    let material = &model.materials[0];
    let written = [Vec2::ZERO, Vec2::X, Vec2::Y];
    for (uv, file_uv) in model.meshes[0].uvs.iter().zip(written) {
        // All numbers are small multiples of powers of two: exact.
        assert_eq!(material.base_texture.as_ref().unwrap().1.transform_point2(*uv), *uv);
        assert_eq!(material.normal_map.as_ref().unwrap().transform.transform_point2(*uv), file_uv * 4.0);
        assert_eq!(material.emission_texture.as_ref().unwrap().1.transform_point2(*uv), file_uv);
    }
}

#[test]
fn extensions_reach_the_material() {
    let material = |extensions: Value| -> Material {
        let file = dressed(json!({ "emissiveFactor": [1, 0.5, 0], "extensions": extensions }));
        file.read().unwrap().materials.remove(0)
    };
    let glass = material(json!({
        "KHR_materials_transmission": { "transmissionFactor": 0.9 }, "KHR_materials_ior": { "ior": 1.25 },
        "KHR_materials_volume": { "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [0.5, 1, 0] },
        "KHR_materials_emissive_strength": { "emissiveStrength": 100 }
    }));
    assert_eq!((glass.transmission, glass.ior, glass.emission), (0.9, 1.25, Vec3::new(100.0, 50.0, 0.0)));
    let volume = glass.volume.unwrap();
    assert_eq!((volume.attenuation_distance, volume.attenuation_colour), (2.0, Vec3::new(0.5, 1.0, 1e-6)));
    assert!(material(json!({ "KHR_materials_volume": { "thicknessFactor": 0 } })).volume.is_none());
    let leaf = material(json!({ "KHR_materials_diffuse_transmission": {
        "diffuseTransmissionFactor": 0.25, "diffuseTransmissionColorFactor": [0, 1, 0] } }));
    assert_eq!((leaf.diffuse_transmission, leaf.diffuse_transmission_colour), (0.25, Vec3::Y));
    // n = 1000 without specular colour: how one exporter says "matt".
    let matt = material(json!({
        "KHR_materials_ior": { "ior": 1000 }, "KHR_materials_specular": { "specularColorFactor": [0, 0, 0] } }));
    assert_eq!(matt.normal_reflectance(), Vec3::ZERO);
    let old = material(json!({ "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.5, 1, 1, 1], "specularFactor": [0.25, 0.5, 0.5], "glossinessFactor": 0.75 } }));
    assert_eq!((old.base_colour, old.roughness), (Vec3::new(0.25, 0.5, 0.5), 0.25));
    // Division and multiplication by ((n−1)/(n+1))²: three roundings of f32.
    assert!(old.normal_reflectance().abs_diff_eq(Vec3::new(0.25, 0.5, 0.5), 2e-7));
}

#[test]
fn an_image_is_decoded_once_for_each_use() {
    let textured = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } });
    let mut file = dressed(textured.clone());
    push(&mut file.json, "materials", textured);
    file.texture(1, 1, &[255; 4]);
    let mut second = file.json["meshes"][0]["primitives"][0].clone();
    second["material"] = json!(1);
    file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(second);
    let materials = file.read().unwrap().materials;
    let texture = |i: usize| &materials[i].base_texture.as_ref().unwrap().0;
    assert!(std::sync::Arc::ptr_eq(texture(0), texture(1)));
}
