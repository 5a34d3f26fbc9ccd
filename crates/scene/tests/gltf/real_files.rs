//! The models of the assets folder, where it is at hand (environment variable KEIKAN_ASSETS).

use std::path::PathBuf;

use light::Geometry;

#[test]
fn real_models_are_read() {
    let Some(assets) = std::env::var_os("KEIKAN_ASSETS").map(PathBuf::from) else {
        println!("skipped: KEIKAN_ASSETS is not set");
        return;
    };
    for name in ["garden", "temple", "pine"] {
        let start = std::time::Instant::now();
        let model = keikan_scene::gltf::read(&assets.join(name).join(format!("{name}.glb"))).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        let geometry = Geometry { meshes: model.meshes, instances: model.instances };
        assert!(geometry.triangle_count() > 0 && geometry.bounds().is_some());
        let textures: Vec<_> =
            model.materials.iter().filter_map(|m| Some(m.base_texture.as_ref()?.0.size())).collect();
        println!(
            "{name}: {} meshes, {} instances, {} triangles, {} materials, {} with opacity, base textures {textures:?}, \
             {} cameras, {} lights, box {:.3?}, {seconds:.3} s",
            geometry.meshes.len(),
            geometry.instances.len(),
            geometry.triangle_count(),
            model.materials.len(),
            geometry.meshes.iter().filter(|mesh| mesh.opacity.is_some()).count(),
            model.cameras.len(),
            model.lights.len(),
            geometry.bounds(),
        );
        for warning in &model.warnings {
            println!("  {}: {}", warning.place, warning.what);
        }
    }
}

#[test]
#[ignore = "needs 1 GB and some seconds; run with --ignored --nocapture for the figure"]
fn ten_million_triangles() {
    let side = 2237u32; // 2236² cells × 2 = 9 999 392 triangles
    let positions: Vec<[f32; 3]> = (0..side * side)
        .map(|i| [(i % side) as f32, ((i * 7) % 13) as f32 * 0.1, (i / side) as f32])
        .collect();
    let cells = (0..side - 1).flat_map(|z| (0..side - 1).map(move |x| z * side + x));
    let indices: Vec<u32> = cells.flat_map(|a| [a, a + side, a + 1, a + 1, a + side, a + side + 1]).collect();
    let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
    let mut file = crate::builder::Builder::triangle();
    let (positions, indices) = (file.floats(&positions), file.data(&bytes, 5125, "SCALAR", indices.len()));
    file.attribute("POSITION", positions);
    file.json["meshes"][0]["primitives"][0]["indices"] = serde_json::json!(indices);
    let glb = file.glb();
    let start = std::time::Instant::now();
    let model = crate::builder::read(&glb).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(model.meshes[0].triangles.len(), 9_999_392);
    println!(
        "{} MB of GLB, {} triangles: {seconds:.2} s",
        glb.len() / 1_000_000,
        model.meshes[0].triangles.len()
    );
}
