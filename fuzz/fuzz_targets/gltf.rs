//! glTF and GLB from arbitrary bytes: an error or a sound model, never a panic, a hang or unbounded memory.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // A folder that is not there: no file may be reached.
    match scene::gltf::parse(bytes, Path::new("/nonexistent-folder"), Path::new("fuzz.glb")) {
        Ok(model) => {
            assert_eq!(model.instances.len(), model.instance_names.len());
            for mesh in &model.meshes {
                assert!((mesh.material as usize) < model.materials.len());
                assert!(mesh.positions.iter().all(|p| p.is_finite()));
                assert!(mesh.triangles.as_flattened().iter().all(|&i| (i as usize) < mesh.positions.len()));
            }
            for instance in &model.instances {
                assert!((instance.mesh as usize) < model.meshes.len() && instance.world_from_mesh.is_finite());
            }
        }
        // What the net below all checks says; a panic in it would be caught and lost.
        Err(error) => assert!(!error.to_string().contains("no check foresaw")),
    }
});
