//! Files that are broken, or mean harm.

use proptest::prelude::*;
use serde_json::{Value, json};

use crate::builder::{Builder, push, read};

/// A model with a bit of everything.
fn everything() -> Builder {
    let mut file = Builder::triangle();
    let uvs = file.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    file.attribute("TEXCOORD_0", uvs);
    let normals = file.floats(&[[0.0, 0.0, 1.0]; 3]);
    file.attribute("NORMAL", normals);
    let colours = file.floats(&[[1.0, 1.0, 1.0, 1.0]; 3]);
    file.attribute("COLOR_0", colours);
    let texture = file.texture(2, 2, &[200; 16]);
    let few = file.view(&[2]);
    let values = file.view(&[0.0f32, 0.0, 1.0].map(f32::to_le_bytes).concat());
    file.json["accessors"][normals]["sparse"] = json!({
        "count": 1, "indices": { "bufferView": few, "componentType": 5121 }, "values": { "bufferView": values }
    });
    file.json["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648 }]);
    file.json["textures"][texture]["sampler"] = json!(0);
    push(
        &mut file.json,
        "materials",
        json!({
            "alphaMode": "BLEND", "normalTexture": { "index": 0, "scale": 0.5 }, "emissiveFactor": [1, 1, 1],
            "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.5], "baseColorTexture": { "index": 0,
                "extensions": { "KHR_texture_transform": { "offset": [0.5, 0], "rotation": 1, "scale": [2, 2] } } } },
            "extensions": { "KHR_materials_ior": { "ior": 1.4 }, "KHR_materials_volume": { "thicknessFactor": 1 },
                "KHR_materials_transmission": { "transmissionFactor": 1 },
                "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 1 } }
        }),
    );
    file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let translation = file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } }]);
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({
        "KHR_lights_punctual": { "lights": [{ "type": "spot", "spot": { "outerConeAngle": 0.5 } }] },
        "EXT_lights_ies": { "lights": [{ "uri": "a.ies" }] }
    });
    file.json["nodes"] = json!([
        { "children": [1, 2], "translation": [1, 2, 3], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1] },
        { "mesh": 0, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": translation } } } },
        { "camera": 0, "extensions": { "KHR_lights_punctual": { "light": 0 } }, "children": [3] },
        { "extensions": { "EXT_lights_ies": { "light": 0 } }, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1] }
    ]);
    file.json["scenes"] = json!([{ "nodes": [0] }]);
    file.json["scene"] = json!(0);
    file
}

/// JSON pointers of every value in `json`.
fn pointers(json: &Value, at: &str, all: &mut Vec<String>) {
    all.push(at.to_owned());
    match json {
        Value::Object(map) => {
            map.iter().for_each(|(key, value)| pointers(value, &format!("{at}/{key}"), all))
        }
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, value)| pointers(value, &format!("{at}/{i}"), all));
        }
        _ => {}
    }
}

/// Whatever is said of a file, no check may have been missed (the net below all checks says "foresaw").
fn survives(bytes: &[u8]) -> Result<(), TestCaseError> {
    if let Err(error) = read(bytes) {
        prop_assert!(!error.contains("foresaw"), "panicked: {error}");
    }
    Ok(())
}

#[test]
fn the_model_with_everything_is_sound() {
    let model = everything().read().unwrap();
    assert_eq!((model.instances.len(), model.cameras.len(), model.lights.len()), (2, 1, 2));
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

#[test]
fn every_single_field_may_be_wrong() {
    let whole = everything();
    let mut all = Vec::new();
    pointers(&whole.json, "", &mut all);
    let wrong = [
        json!(null),
        json!(-1),
        json!(0),
        json!(1),
        json!(7),
        json!(4294967295u32),
        json!(u64::MAX),
        json!(0.5),
        json!(1e300),
        json!("x"),
        json!("../../etc/passwd"),
        json!("data:,"),
        json!([]),
        json!({}),
        json!([0]),
        json!([1e38, 1e38, 1e38]),
        json!(true),
        json!("MAT4"),
        json!(5125),
    ];
    for pointer in all.iter().skip(1) {
        for value in &wrong {
            let mut file = whole.clone();
            *file.json.pointer_mut(pointer).unwrap() = value.clone();
            survives(&file.glb()).unwrap_or_else(|error| panic!("{pointer} = {value}: {error}"));
        }
        let mut file = whole.clone();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match file.json.pointer_mut(parent).unwrap() {
            Value::Object(map) => drop(map.remove(key)),
            Value::Array(list) => drop(list.remove(key.parse().unwrap())),
            _ => {}
        }
        survives(&file.glb()).unwrap_or_else(|error| panic!("{pointer} missing: {error}"));
    }
}

proptest! {
    #[test]
    fn broken_bytes_never_panic(flips in prop::collection::vec((any::<prop::sample::Index>(), 0u8..8), 0..12), cut in any::<Option<prop::sample::Index>>()) {
        let mut bytes = everything().glb();
        for (at, bit) in flips {
            let at = at.index(bytes.len());
            bytes[at] ^= 1 << bit;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        survives(&bytes)?;
    }

    #[test]
    fn any_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        survives(&bytes)?;
    }
}

#[test]
fn errors_say_where_and_what_would_be_right() {
    let file = everything();
    for (pointer, value, expected) in [
        ("/meshes/0/primitives/0/attributes/POSITION", json!(99), "index 99 into accessors: valid are 0 to"),
        (
            "/meshes/0/primitives/0/material",
            json!(9),
            "/meshes/0/primitives/0/material: index 9 into materials",
        ),
        ("/accessors/0/count", json!(1000), "/accessors/0/bufferView: 1000 elements"),
        ("/accessors/0/type", json!("VEC2"), "has 2 numbers per element where 3 are needed"),
        ("/accessors/1/componentType", json!(5126), "/accessors/1"),
        ("/nodes/3/children", json!([0]), "it has two parents, or is its own ancestor"),
        ("/extensionsRequired", json!(["KHR_draco_mesh_compression"]), "export without mesh compression"),
        (
            "/extensionsRequired",
            json!(["XYZ_unheard"]),
            "XYZ_unheard, which is not supported. Supported: EXT_lights_ies",
        ),
        ("/asset/version", json!("1.0"), "only glTF 2"),
        ("/images/0", json!({ "uri": "../secret.png" }), "/images/0/uri: URI \"../secret.png\" is refused"),
        ("/images/0", json!({ "uri": "data:,hello" }), "/images/0: is neither PNG nor JPEG"),
        ("/buffers/0/uri", json!("file:///etc/passwd"), "is refused"),
        ("/nodes/0/rotation", json!([0, 0, 0, 0]), "is no rotation"),
        ("/cameras/0/perspective/yfov", json!(4), "must be below π"),
    ] {
        let error = file.with(pointer, value).unwrap_err();
        assert!(error.starts_with("test.glb: ") && error.contains(expected), "{pointer}: {error}");
    }
    let model = file.with("/extensionsUsed", json!(["XYZ_unheard"])).unwrap();
    assert!(model.warnings[0].what.contains("XYZ_unheard"));
}

#[test]
fn vertices_must_be_finite_and_indices_in_range() {
    let mut file = Builder::triangle();
    let nan = file.floats(&[[0.0, f32::NAN, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    file.attribute("POSITION", nan);
    assert!(file.read().unwrap_err().contains("vertex 0 is at [0, NaN, 0]"));
    let mut file = Builder::triangle();
    let indices = file.data(&[0, 1, 3], 5121, "SCALAR", 3);
    file.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    assert!(file.read().unwrap_err().contains("names vertex 3, but there are 3"));
}

/// The check sum of PNG (ISO 3309), bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    let step = |sum: u32, _| if sum & 1 == 1 { 0xEDB8_8320 ^ (sum >> 1) } else { sum >> 1 };
    !bytes.iter().fold(!0, |sum, byte| (0..8).fold(sum ^ u32::from(*byte), step))
}

#[test]
fn a_small_file_cannot_ask_for_much() {
    // 4 thousand million zeros, which need no bytes in the file.
    let mut file = Builder::triangle();
    file.json["accessors"][0] = json!({ "componentType": 5126, "type": "VEC3", "count": 4_000_000_000u32 });
    assert!(file.read().unwrap_err().contains("out of all proportion"));
    // A thousand nodes that each place a thousand primitives ten times.
    let mut file = Builder::triangle();
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    file.json["meshes"][0]["primitives"] = json!(vec![primitive; 1000]);
    let many = file.floats(&[[0.0; 3]; 1000]);
    let node = json!({ "mesh": 0, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": many } } } });
    file.json["nodes"] = json!(vec![node; 1000]);
    assert!(file.read().unwrap_err().contains("out of all proportion"));
    // Pictures that are hundreds of millions of times the same dot, in a few bytes.
    for (side, what) in
        [(65_536u32, "a side of 1 to 16384 texels is allowed"), (16_384, "67108864 are allowed in one image")]
    {
        let mut file = everything();
        let mut png = crate::builder::png(1, 1, &[0; 4]);
        png[16..20].copy_from_slice(&side.to_be_bytes());
        png[20..24].copy_from_slice(&side.to_be_bytes());
        // The check sum of the header, over its name and content.
        let sum = crc(&png[12..29]).to_be_bytes();
        png[29..33].copy_from_slice(&sum);
        let view = file.view(&png);
        file.json["images"][0]["bufferView"] = json!(view);
        let error = file.read().unwrap_err();
        assert!(error.starts_with("test.glb: /images/0: ") && error.contains(what), "{error}");
    }
}

#[test]
fn deep_chains_of_nodes_do_not_overflow_the_stack() {
    let mut file = Builder::triangle();
    let count = 200_000;
    let mut nodes: Vec<Value> = (1..count).map(|i| json!({ "children": [i] })).collect();
    nodes.push(json!({ "mesh": 0, "translation": [1, 0, 0] }));
    file.json["nodes"] = json!(nodes);
    file.json["scenes"] = json!([{ "nodes": [0] }]);
    assert_eq!(file.read().unwrap().instances.len(), 1);
    // And a ring.
    file.json["nodes"][count - 1]["children"] = json!([0]);
    assert!(file.read().unwrap_err().contains("its own ancestor"));
}
