//! EXT_mesh_gpu_instancing: one node that stands for many placements of its mesh.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};
use serde::Deserialize;
use serde_json::Value;

use super::accessor::Accessor;
use super::document::Document;
use super::fault::{Checked, Fault};
use super::nodes;

#[derive(Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, usize>,
}

/// From the mesh's coordinates to the node's, once for each placement.
pub(super) fn placements(document: &Document<'_>, extension: &Value, place: &str) -> Checked<Vec<DAffine3>> {
    let wrong = |what: String| Fault::new(place, what);
    let instancing = Instancing::deserialize(extension).map_err(|error| wrong(error.to_string()))?;
    let open = |name: &str| {
        let index = instancing.attributes.get(name);
        index.map(|&index| Accessor::open(document, index, &format!("{place}/attributes/{name}"))).transpose()
    };
    let (translations, rotations, scales) = (open("TRANSLATION")?, open("ROTATION")?, open("SCALE")?);
    let counts = [&translations, &rotations, &scales].map(|a| a.as_ref().map(|a| a.count));
    let Some(count) = counts.into_iter().flatten().next() else {
        return Err(wrong("none of the attributes TRANSLATION, ROTATION, SCALE is there".into()));
    };
    if counts.into_iter().flatten().any(|other| other != count) {
        return Err(wrong("its attributes have different counts".into()));
    }
    let translations = translations.map(|a| a.floats::<3>()).transpose()?;
    let rotations = rotations.map(|a| a.floats::<4>()).transpose()?;
    let scales = scales.map(|a| a.floats::<3>()).transpose()?;
    let at = |list: &Option<Vec<[f32; 3]>>, i: usize, default: DVec3| {
        list.as_ref().map_or(default, |list| DVec3::from_array(list[i].map(f64::from)))
    };
    let placement = |i: usize| {
        let rotation = match &rotations {
            Some(list) => nodes::rotation(list[i].map(f64::from)),
            None => Ok(glam::DQuat::IDENTITY),
        };
        let rotation = rotation.map_err(|what| wrong(format!("instance {i}: {what}")))?;
        let (scale, translation) = (at(&scales, i, DVec3::ONE), at(&translations, i, DVec3::ZERO));
        let placement = DAffine3::from_scale_rotation_translation(scale, rotation, translation);
        if placement.is_finite() { Ok(placement) } else { Err(wrong(format!("instance {i} is not finite"))) }
    };
    (0..count).map(placement).collect()
}
