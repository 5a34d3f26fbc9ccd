//! PNG and JPEG from arbitrary bytes, as images of a model: an error or a sound texture, never a panic, a hang or
//! unbounded memory.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;

/// A triangle that wears the image as colour with alpha and, as plain numbers, as normals; `LENGTH` is that of the
/// image.
const JSON: &str = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
  "nodes": [{ "mesh": 0 }],
  "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
  "accessors": [{ "componentType": 5126, "count": 3, "type": "VEC3" }, { "componentType": 5126, "count": 3, "type": "VEC2" }],
  "materials": [{ "alphaMode": "BLEND", "normalTexture": { "index": 0 },
    "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }],
  "textures": [{ "source": 0 }], "images": [{ "bufferView": 0 }],
  "bufferViews": [{ "buffer": 0, "byteLength": LENGTH }], "buffers": [{ "byteLength": LENGTH }] }"#;

/// A GLB of both.
fn model(image: &[u8]) -> Vec<u8> {
    let mut text = JSON.replace("LENGTH", &image.len().to_string()).into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let padded = image.len().next_multiple_of(4);
    let word = |n: usize| (n as u32).to_le_bytes();
    let mut file = [&b"glTF"[..], &word(2), &word(12 + 8 + text.len() + 8 + padded)].concat();
    for (kind, content, length) in [(b"JSON", text.as_slice(), text.len()), (b"BIN\0", image, padded)] {
        file.extend(word(length));
        file.extend(kind);
        file.extend(content);
        file.resize(file.len().next_multiple_of(4), 0);
    }
    file
}

fuzz_target!(|image: &[u8]| {
    match scene::gltf::parse(&model(image), Path::new("/nonexistent-folder"), Path::new("fuzz.glb")) {
        Ok(model) => {
            let material = &model.materials[0];
            let (Some((colour, _)), Some(normals)) = (&material.base_texture, &material.normal_map) else {
                panic!("the textures are lost");
            };
            assert_eq!(colour.size(), normals.texture.size());
        }
        // Anything else would mean that the model around the image is wrong.
        Err(error) => assert!(error.to_string().contains("/images/0: "), "{error}"),
    }
});
