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
