//! A ground for models that come alone: without one they would float, and cast no shadow.

use glam::{DAffine3, DVec3, Vec3};
use light::Mesh;

use super::draft::Draft;
use crate::{Material, Warning};

/// Reflectance of ordinary ground, grass and soil.
const REFLECTANCE: f32 = 0.2;

/// Side of the ground as a multiple of the model's largest extent, and its limit \[m\].
const SPREAD: f64 = 60.0;
const MOST: f64 = 16_000.0;

/// Puts a level square below everything; nothing when there is nothing, or no finite place for it.
pub(crate) fn add(draft: &mut Draft, place: &str) {
    let Some((low, high)) = draft.geometry.bounds() else { return };
    let extent = (high - low).max_element();
    // Clear of the model's own underside, which would otherwise fight with it for visibility.
    let level = low.y - 1e-4 * extent.max(1e-3);
    let half = (0.5 * SPREAD * extent).min(MOST).max(extent) as f32;
    let material = draft.materials.len() as u32;
    draft.materials.push(Material {
        name: "ground".to_owned(),
        base_colour: Vec3::splat(REFLECTANCE),
        specular: 0.0,
        ..Material::default()
    });
    let corner = |x: f32, z: f32| Vec3::new(x * half, 0.0, z * half);
    let mesh = Mesh {
        positions: vec![corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Mesh::default()
    };
    let middle = 0.5 * (low + high);
    draft.add_mesh(mesh, DAffine3::from_translation(DVec3::new(middle.x, level, middle.z)));
    draft.warnings.push(Warning {
        place: place.to_owned(),
        what: format!(
            "a model alone stands on an added ground of reflectance {REFLECTANCE}, at y = {level:.3} m; a scene file has only what it names"
        ),
    });
}
