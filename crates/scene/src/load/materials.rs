//! Materials from their tables, and changes to those of models.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use crate::document::Spot;
use crate::file::{Colour, MaterialTable, OneOrThree};
use crate::{Error, Material, Volume};

/// Brightest luminance that a surface may be given \[cd/m²\]: the sun's disc has 1.6e9.
pub(crate) const BRIGHTEST: f64 = 1e10;

/// What inline geometry is made of unless it says so: a matt grey that reflects half of all light.
pub(crate) fn grey() -> Material {
    Material { base_colour: Vec3::splat(0.5), specular: 0.0, ..Material::default() }
}

/// Whether `table` speaks of gloss. One that does not is matt: its colour is all that it reflects, as those
/// who calculate with reflectances expect.
fn glossy(table: &MaterialTable) -> bool {
    let above_zero = |share: Option<f64>| share.is_some_and(|share| share > 0.0);
    table.ior.is_some()
        || table.roughness.is_some_and(|roughness| roughness < 1.0)
        || above_zero(table.metallic)
        || above_zero(table.transmission)
}

/// Index of a named material.
pub(crate) type Names = BTreeMap<String, u32>;

/// Named materials of the file, in order; names are unique and not empty.
pub(crate) fn named(root: &Spot<'_>, tables: &[MaterialTable]) -> Result<(Vec<Material>, Names), Error> {
    let mut materials = Vec::with_capacity(tables.len());
    let mut names = Names::new();
    for (i, table) in tables.iter().enumerate() {
        let spot = root.key("material").index(i);
        let name = spot.key("name").required(table.name.clone())?;
        if name.is_empty() || names.insert(name.clone(), i as u32).is_some() {
            return Err(spot.key("name").error(format!("{name:?} is empty or taken: names must differ")));
        }
        let specular = if glossy(table) { 1.0 } else { 0.0 };
        let mut material = Material { name, specular, ..grey() };
        change(&spot, table, &mut material)?;
        materials.push(material);
    }
    Ok((materials, names))
}

/// Sets whatever `table` says in `material`; a number given replaces the texture that would vary it.
pub(crate) fn change(spot: &Spot<'_>, table: &MaterialTable, material: &mut Material) -> Result<(), Error> {
    let share = |key: &str, value: Option<f64>| -> Result<Option<f32>, Error> {
        value.map(|v| Ok(spot.key(key).within(v, 0.0, 1.0, "")? as f32)).transpose()
    };
    let colour = |key: &str, value: &Option<Colour>| -> Result<Option<Vec3>, Error> {
        value.as_ref().map(|v| spot.key(key).colour(v)).transpose()
    };
    if let Some(value) = colour("colour", &table.colour)? {
        material.base_colour = value;
        material.base_texture = None;
    }
    let (metallic, roughness) = (share("metallic", table.metallic)?, share("roughness", table.roughness)?);
    if metallic.is_some() || roughness.is_some() {
        material.metallic_roughness_texture = None;
    }
    set(&mut material.metallic, metallic);
    set(&mut material.roughness, roughness);
    set(&mut material.transmission, share("transmission", table.transmission)?);
    set(&mut material.diffuse_transmission, share("diffuse_transmission", table.diffuse_transmission)?);
    set(
        &mut material.diffuse_transmission_colour,
        colour("diffuse_transmission_colour", &table.diffuse_transmission_colour)?,
    );
    if let Some(ior) = table.ior {
        material.ior = spot.key("ior").within(ior, 1.0, 10.0, "")? as f32;
    }
    if let Some(value) = table.emission {
        material.emission = emission(&spot.key("emission"), value)?;
        material.emission_texture = None;
    }
    volume(spot, table, material)
}

fn set<T>(target: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *target = value;
    }
}

fn emission(spot: &Spot<'_>, value: OneOrThree) -> Result<Vec3, Error> {
    let channels = match value {
        OneOrThree::One(luminance) => [luminance; 3],
        OneOrThree::Three(rgb) => rgb,
    };
    for channel in channels {
        spot.within(channel, 0.0, BRIGHTEST, "cd/m²")?;
    }
    Ok(DVec3::from_array(channels).as_vec3())
}

/// The inside, from `attenuation_colour` and `attenuation_distance`; either may change what a file says.
fn volume(spot: &Spot<'_>, table: &MaterialTable, material: &mut Material) -> Result<(), Error> {
    if table.attenuation_colour.is_none() && table.attenuation_distance.is_none() {
        return Ok(());
    }
    let mut volume = material
        .volume
        .unwrap_or(Volume { attenuation_colour: Vec3::ONE, attenuation_distance: f32::INFINITY });
    if let Some(colour) = &table.attenuation_colour {
        let spot = spot.key("attenuation_colour");
        let colour = spot.colour(colour)?;
        if colour.min_element() <= 0.0 {
            return Err(spot.error("each channel must be above 0: no distance is enough to take all light"));
        }
        volume.attenuation_colour = colour;
    }
    if let Some(distance) = table.attenuation_distance {
        volume.attenuation_distance = spot.key("attenuation_distance").positive(distance, 1e9, "m")? as f32;
    }
    if volume.attenuation_colour != Vec3::ONE && volume.attenuation_distance.is_infinite() {
        return Err(spot.key("attenuation_distance").error("is required where attenuation_colour is given"));
    }
    material.volume = Some(volume);
    Ok(())
}
