//! Which extensions of glTF are understood.

use gltf::json::Root;

use super::fault::{Checked, Fault, Notes};

/// Extensions whose data are read (or whose absence changes nothing that can be seen here).
pub(super) const SUPPORTED: &[&str] = &[
    "EXT_lights_ies",
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// What to do about extensions that are met often and not understood.
fn advice(name: &str) -> &'static str {
    match name {
        "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "; export without mesh compression, or unpack it: npx @gltf-transform/cli copy in.glb out.glb"
        }
        "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" | "MSFT_texture_dds" => {
            "; export with PNG or JPEG textures, or convert them: npx @gltf-transform/cli png in.glb out.glb"
        }
        _ => "",
    }
}

/// An unknown extension that the model cannot do without is an error, any other a warning.
pub(super) fn check(root: &Root, notes: &mut Notes) -> Checked<()> {
    for (i, name) in root.extensions_required.iter().enumerate() {
        if !SUPPORTED.contains(&name.as_str()) {
            let what = format!(
                "requires the extension {name}, which is not supported{}. Supported: {}",
                advice(name),
                SUPPORTED.join(", ")
            );
            return Err(Fault::new(format!("/extensionsRequired/{i}"), what));
        }
    }
    for (i, name) in root.extensions_used.iter().enumerate() {
        if !SUPPORTED.contains(&name.as_str()) {
            let sentence = format!("uses the extension {name}, which is ignored{}", advice(name));
            notes.add(sentence, 1, &format!("/extensionsUsed/{i}"));
        }
    }
    Ok(())
}
