//! A scene file from arbitrary text: an error or a sound scene, never a panic.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    // Files that the text names are looked for where there are none.
    if let Ok(scene) = scene::parse(text, Path::new("/nonexistent"), Path::new("fuzz.toml")) {
        assert!(!scene.cameras.is_empty());
        assert!(scene.cameras.iter().all(|camera| camera.position.is_finite()));
        let instances = &scene.geometry.instances;
        assert!(
            instances
                .iter()
                .all(|i| i.world_from_mesh.is_finite() && (i.mesh as usize) < scene.geometry.meshes.len())
        );
        let materials = scene.materials.len();
        assert!(scene.geometry.meshes.iter().all(|mesh| (mesh.material as usize) < materials));
    }
});
