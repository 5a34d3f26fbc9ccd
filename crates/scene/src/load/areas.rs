//! Lamps with an extent, from `[[light]]` tables with a rectangle or a sphere, and the face by which they are seen.

use std::f64::consts::PI;

use glam::{DAffine3, Vec3};
use light::Mesh;
use light::Spectrum;
use light::colour::{LUMINANCE, srgb_from_xyz};

use super::draft::Draft;
use super::inline::{LONGEST, SHORTEST};
use super::lamps::{STRONGEST, name, placed};
use super::materials::BRIGHTEST;
use crate::document::Spot;
use crate::file::LightTable;
use crate::{AreaLight, AreaShape, Error, LightSpectrum, Material};

/// How far the face that is seen lies behind the plane that light starts from \[m\]: rays to that plane
/// must not meet it, and they may be off by some of f32's roundings, 0.1 mm at 100 m.
const FACE: f32 = 1e-4;

/// And the back of the lamp behind it.
const BACK: f32 = 1.1e-3;

/// The lamp of a table; none if it has no extent.
pub(crate) fn lamp(spot: &Spot<'_>, number: usize, table: &LightTable) -> Result<Option<AreaLight>, Error> {
    let length = |spot: &Spot<'_>, value: f64| spot.within(value, SHORTEST, LONGEST, "m");
    let shape = match (&table.rectangle, &table.sphere) {
        (None, None) => return Ok(None),
        (Some(_), Some(_)) => {
            return Err(spot
                .key("sphere")
                .error("has a rectangle beside it, but only one of them is possible"));
        }
        (Some(rectangle), None) => {
            let spot = spot.key("rectangle").key("size");
            let [width, height] = rectangle.size;
            AreaShape::Rectangle { size: [length(&spot, width)?, length(&spot, height)?] }
        }
        (None, Some(sphere)) => {
            AreaShape::Sphere { radius: length(&spot.key("sphere").key("radius"), sphere.radius)? }
        }
    };
    for (key, given) in [
        ("intensity", table.intensity.is_some()),
        ("file", table.file.is_some()),
        ("cone", table.cone.is_some()),
    ] {
        if given {
            return Err(spot
                .key(key)
                .error("is for points: a rectangle or sphere has a luminance or a flux and is Lambertian"));
        }
    }
    let (position, world_from_light) = placed(spot, table)?;
    let spectrum = spot.spectrum(table.temperature, table.rgb, table.spectrum.as_deref())?;
    Ok(Some(AreaLight {
        name: name(table, number),
        position,
        world_from_light,
        shape,
        luminance: luminance(spot, table, shape.area())?,
        spectrum: spectrum.unwrap_or(LightSpectrum::Rgb(Vec3::ONE)),
        face: None,
    }))
}

/// As stated, or that of a Lambertian source of that flux: L = Φ / (π A).
fn luminance(spot: &Spot<'_>, table: &LightTable, area: f64) -> Result<f64, Error> {
    spot.exactly_one(&[("luminance", table.luminance.is_some()), ("flux", table.flux.is_some())])?;
    let multiplier = spot.key("multiplier").within(table.multiplier.unwrap_or(1.0), 0.0, STRONGEST, "")?;
    let (key, luminance) = match (table.luminance, table.flux) {
        (Some(luminance), _) => {
            ("luminance", spot.key("luminance").within(luminance, 0.0, BRIGHTEST, "cd/m²")?)
        }
        (None, flux) => {
            let flux = spot.key("flux").within(flux.unwrap_or_default(), 0.0, STRONGEST, "lm")?;
            ("flux", flux / (PI * area))
        }
    };
    let luminance = multiplier * luminance;
    if luminance <= BRIGHTEST {
        return Ok(luminance);
    }
    Err(spot.key(key).error(format!(
        "makes a luminance of {luminance:.3e} cd/m²; at most {BRIGHTEST:.0e} is possible (the sun has 1.6e9)"
    )))
}

/// Adds the lamp, and the faces of a rectangle: one that emits, and a grey back, for it is not seen from behind.
pub(crate) fn add(draft: &mut Draft, mut lamp: AreaLight) {
    if let AreaShape::Rectangle { size: [width, height] } = lamp.shape {
        let (x, y) = (0.5 * width as f32, 0.5 * height as f32);
        let placement = DAffine3 { matrix3: lamp.world_from_light, translation: lamp.position };
        let material = draft.materials.len() as u32;
        lamp.face = Some(material);
        draft.materials.push(Material {
            name: lamp.name.clone(),
            base_colour: Vec3::ZERO,
            specular: 0.0,
            emission: emission(&lamp),
            ..Material::default()
        });
        let grey = draft.grey();
        // Seen against +Z, i.e. from where it shines to, the first turns counter-clockwise.
        for (z, material, triangles) in
            [(FACE, material, [[0, 2, 1], [0, 3, 2]]), (BACK, grey, [[0, 1, 2], [0, 2, 3]])]
        {
            let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vec3::new(x, y, z));
            let mesh = Mesh {
                positions: corners.to_vec(),
                triangles: triangles.to_vec(),
                material,
                ..Mesh::default()
            };
            draft.add_mesh(mesh, placement);
        }
    }
    draft.area_lights.push(lamp);
}

/// Linear sRGB of the lamp's face \[cd/m² of white\], of its luminance; colours outside sRGB at its border.
fn emission(lamp: &AreaLight) -> Vec3 {
    let rgb = match &lamp.spectrum {
        LightSpectrum::Rgb(rgb) => *rgb,
        LightSpectrum::Temperature(kelvin) => srgb_from_xyz(Spectrum::light_of_temperature(*kelvin).xyz()),
        LightSpectrum::Table(table) => srgb_from_xyz(Spectrum::light_of_table(table).xyz()),
    };
    let rgb = rgb.max(Vec3::ZERO);
    let luminance = rgb.dot(LUMINANCE);
    let rgb = if luminance > 0.0 { rgb / luminance } else { Vec3::ONE };
    rgb * lamp.luminance as f32
}
