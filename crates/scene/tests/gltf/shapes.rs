//! Geometry: positions, indices, nodes, instances.

use glam::{DAffine3, DVec3, Vec2, Vec3};
use keikan_scene::gltf::{IesProfile, PunctualKind};
use light::Projection;
use serde_json::json;

use crate::builder::{Builder, push};

#[test]
fn a_triangle_arrives_as_it_was_written() {
    let model = Builder::triangle().read().unwrap();
    assert_eq!(model.meshes.len(), 1);
    assert_eq!(model.meshes[0].positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(model.meshes[0].triangles, [[0, 1, 2]]);
    assert!(model.meshes[0].normals.is_empty() && model.meshes[0].opacity.is_none());
    assert_eq!(model.instances.len(), 1);
    assert_eq!(model.instances[0].world_from_mesh, DAffine3::IDENTITY);
    assert_eq!(&*model.instance_names[0], "first");
    // The default material was made for the primitive that has none.
    assert_eq!((model.materials.len(), model.meshes[0].material), (1, 0));
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

#[test]
fn millimetres_survive_a_million_metres() {
    let mut file = Builder::triangle();
    // Not representable in f32, whose step is 0.0625 m there.
    let at = [1_234_567.001, -0.002, 5_678_901.003];
    file.json["nodes"] = json!([
        { "translation": at, "children": [1] },
        { "mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0.004, 0, 0, 1] }
    ]);
    let model = file.read().unwrap();
    let found = model.instances[0].world_from_mesh.translation;
    // Two roundings of f64 at 6e6 and one in parsing: 3 × 2⁻⁵³ × 6e6 < 3e-9.
    assert!(found.abs_diff_eq(DVec3::from_array(at) + DVec3::X * 0.004, 3e-9), "{found}");
}

#[test]
fn only_the_default_scene_is_shown() {
    let mut file = Builder::triangle();
    file.json["nodes"] = json!([{ "mesh": 0, "name": "a" }, { "mesh": 0, "name": "b" }]);
    let names = |file: &Builder| {
        file.read().unwrap().instance_names.iter().map(|n| n.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(names(&file), ["a", "b"]);
    file.json["scenes"] = json!([{ "nodes": [1] }, { "nodes": [0] }]);
    assert_eq!(names(&file), ["b"]);
    file.json["scene"] = json!(1);
    assert_eq!(names(&file), ["a"]);
}

#[test]
fn instancing_multiplies_placements() {
    let mut file = Builder::triangle();
    let translation = file.floats(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    // Half a turn about y: (0, 1, 0, 0), as shares of i16.
    let rotation = file.data(&[0, 0, 0, 0, 0, 0, 255, 127, 0, 0, 255, 127, 0, 0, 0, 0], 5122, "VEC4", 2);
    file.json["accessors"][rotation]["normalized"] = json!(true);
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] =
        json!({ "attributes": { "TRANSLATION": translation, "ROTATION": rotation } });
    let model = file.read().unwrap();
    assert_eq!((model.meshes.len(), model.instances.len()), (1, 2));
    let at = |i: usize, p| model.instances[i].world_from_mesh.transform_point3(p);
    // Rounding of a rotation matrix in f64.
    assert!(at(0, DVec3::X).abs_diff_eq(DVec3::X * 2.0, 1e-15));
    assert!(at(1, DVec3::X).abs_diff_eq(DVec3::X, 1e-15));
}

#[test]
fn sparse_quantised_and_strided_numbers_are_understood() {
    let mut file = Builder::triangle();
    // i8 shares every 4 bytes: (127, 0, −127) → (1, 0, −1), −128 → −1 as well.
    let quantised = file.data(&[127, 0, 129, 9, 128, 0, 0, 9, 0, 127, 0, 9], 5120, "VEC3", 3);
    file.json["accessors"][quantised]["normalized"] = json!(true);
    let view = file.json["accessors"][quantised]["bufferView"].as_u64().unwrap() as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    file.attribute("POSITION", quantised);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let positions = |file: &Builder| file.read().unwrap().meshes[0].positions.clone();
    assert_eq!(positions(&file), [Vec3::new(1.0, 0.0, -1.0), -Vec3::X, Vec3::Y]);

    let mut file = Builder::triangle();
    let few = file.view(&[2]);
    let values = file.view(&[5.0f32, 6.0, 7.0].map(f32::to_le_bytes).concat());
    file.json["accessors"][0]["sparse"] = json!({
        "count": 1, "indices": { "bufferView": few, "componentType": 5121 }, "values": { "bufferView": values }
    });
    assert_eq!(positions(&file), [Vec3::ZERO, Vec3::X, Vec3::new(5.0, 6.0, 7.0)]);
}

#[test]
fn what_has_no_area_is_left_out_and_counted_once() {
    let mut file = Builder::triangle();
    let indices = file.data(&[0, 1, 2, 1, 1, 2, 0, 0, 0], 5121, "SCALAR", 9);
    file.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    file.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "attributes": { "POSITION": 0 }, "mode": 1 }));
    file.json["nodes"].as_array_mut().unwrap().push(json!({ "mesh": 0, "scale": [0, 1, 1] }));
    let model = file.read().unwrap();
    assert_eq!(model.meshes[0].triangles, [[0, 1, 2]]);
    assert_eq!(model.instances.len(), 1);
    let said: Vec<_> = model.warnings.iter().map(|w| w.what.as_str()).collect();
    assert_eq!(
        said,
        [
            "a mesh that is scaled to nothing is left out",
            "points and lines are skipped",
            "triangles without area are left out (2 times, the first here)"
        ]
    );
}

#[test]
fn normals_and_coordinates_are_made_sound() {
    let mut file = Builder::triangle();
    let normals = file.floats(&[[0.0, 0.0, 2.0], [0.0; 3], [f32::NAN; 3]]);
    let uvs = file.floats(&[[0.25, 0.5], [f32::INFINITY, 0.0], [1.0, 1.0]]);
    let colours = file.data(&[255, 0, 51, 255, 0, 0, 0, 0, 0, 0, 0, 0], 5121, "VEC4", 3);
    for (name, accessor) in [("NORMAL", normals), ("TEXCOORD_0", uvs), ("COLOR_0", colours)] {
        file.attribute(name, accessor);
    }
    let texture = file.texture(1, 1, &[255; 4]);
    push(
        &mut file.json,
        "materials",
        json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }),
    );
    file.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let model = file.read().unwrap();
    assert_eq!(model.meshes[0].normals, [Vec3::Z; 3]);
    assert_eq!(model.meshes[0].uvs, [Vec2::new(0.25, 0.5), Vec2::ZERO, Vec2::ONE]);
    assert_eq!(model.meshes[0].colours, [Vec3::new(1.0, 0.0, 0.2), Vec3::ZERO, Vec3::ZERO]);
    assert_eq!(model.warnings.len(), 3, "{:?}", model.warnings);
}

#[test]
fn a_shared_vertex_list_is_not_copied_whole() {
    let mut file = Builder::triangle();
    let many: Vec<[f32; 3]> = (0..100).map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
    let many = file.floats(&many);
    file.attribute("POSITION", many);
    let indices = file.data(&[90, 7, 50], 5121, "SCALAR", 3);
    file.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let mesh = &file.read().unwrap().meshes[0];
    let at = |i: f32| Vec3::new(i, i * i, 0.0);
    assert_eq!(
        (&mesh.positions[..], &mesh.triangles[..]),
        (&[at(90.0), at(7.0), at(50.0)][..], &[[0, 1, 2]][..])
    );
}

#[test]
fn cameras_keep_their_lens_and_lose_their_scale() {
    let mut file = Builder::triangle();
    file.json["cameras"] = json!([
        { "type": "perspective", "perspective": { "yfov": std::f64::consts::FRAC_PI_2, "znear": 0.5, "aspectRatio": 1.5 } },
        { "type": "orthographic", "orthographic": { "xmag": 4, "ymag": 2, "znear": 0, "zfar": 9 } }
    ]);
    // A quarter turn about y: −Z then points to −X.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    file.json["nodes"] = json!([
        { "camera": 0, "name": "eye", "rotation": [0, half, 0, half], "scale": [2, 3, 4], "translation": [1, 2, 3] },
        { "camera": 1 }
    ]);
    let cameras = file.read().unwrap().cameras;
    let eye = &cameras[0];
    assert_eq!(
        (eye.name.as_str(), eye.placement.position, eye.near),
        ("eye", DVec3::new(1.0, 2.0, 3.0), 0.5)
    );
    // Rounding of a rotation in f64.
    assert!(eye.placement.rotation.z_axis.abs_diff_eq(DVec3::X, 1e-15));
    assert!(eye.placement.rotation.y_axis.abs_diff_eq(DVec3::Y, 1e-15));
    // The file's π/2 went through f32, off by at most 2⁻²⁴; d tan(x/2) = dx at π/4.
    let Projection::Perspective { tan_half_height } = eye.projection else { panic!() };
    assert!((tan_half_height - 1.0).abs() < 1.2e-7);
    assert_eq!(cameras[1].projection, Projection::Orthographic { half_height: 2.0 });
    assert_eq!((eye.aspect, cameras[1].aspect), (Some(1.5), Some(2.0)));
}

#[test]
fn lights_are_passed_on_as_they_are() {
    let mut file = Builder::triangle();
    file.json["extensions"] = json!({
        "KHR_lights_punctual": { "lights": [
            { "type": "spot", "intensity": 800, "color": [1, 0.5, 0.25], "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
            { "type": "directional", "intensity": 100000, "name": "sun" }
        ] },
        "EXT_lights_ies": { "lights": [{ "uri": "lamps/a%20b.ies" }, { "uri": "data:text/plain,IESNA" }] }
    });
    file.json["nodes"] = json!([
        { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [0, 5, 0] },
        { "extensions": { "KHR_lights_punctual": { "light": 1 } } },
        { "extensions": { "KHR_lights_punctual": { "light": 1 }, "EXT_lights_ies": { "light": 0, "multiplier": 2 } } },
        { "extensions": { "EXT_lights_ies": { "light": 1 } } }
    ]);
    let lights = file.read().unwrap().lights;
    assert_eq!(lights[0].kind, PunctualKind::Spot { inner: 0.25, outer: 0.5 });
    assert_eq!((lights[0].intensity, lights[0].colour), (800.0, Vec3::new(1.0, 0.5, 0.25)));
    assert_eq!(lights[0].placement.position, DVec3::Y * 5.0);
    assert_eq!((lights[1].kind, lights[1].name.as_str()), (PunctualKind::Directional, "sun"));
    assert_eq!(lights[2].ies, Some(IesProfile::File("/nonexistent-folder/lamps/a b.ies".into())));
    assert_eq!((lights[2].intensity, lights[2].kind), (2.0, PunctualKind::Point));
    assert_eq!(lights[3].ies, Some(IesProfile::Embedded(b"IESNA".to_vec())));
}
