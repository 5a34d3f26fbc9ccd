//! Lights and cameras that models bring along.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use light::Distribution;
use light::colour::LUMINANCE;

use super::lamps::{cone_distribution, isotropic_flux};
use super::site::BRIGHTEST_SUN;
use crate::gltf::{IesProfile, ModelCamera, Placement, PunctualKind, PunctualLight};
use crate::{Camera, Error, Light, LightSpectrum, SUN_DIAMETER, Site, Sun, Warning, photometry};

/// No lamp gives more flux than this \[lm\]: the strongest floodlights have 3 kW at 170 lm/W. Exporters that
/// multiply watts of radiant power by 683 do.
const STRONGEST_LAMP: f64 = 500_000.0;

/// Directional lights below this are hardly suns \[lx\]: the full moon gives 0.3 lx, an overcast noon 10,000.
/// 1 to 20 is what exporters write who mean W/m² or no unit at all.
const FAINTEST_SUN: f64 = 50.0;

/// What became of a light.
pub(crate) enum Placed {
    Lamp(Light),
    Sun(Sun),
}

/// Where `local` is when its model is placed: moved and turned, not scaled.
fn rigid(placement: &DAffine3, local: &Placement) -> Option<(DVec3, DMat3)> {
    let turned = placement.matrix3 * local.rotation;
    let back = turned.z_axis.try_normalize()?;
    let right = turned.y_axis.cross(back).try_normalize()?;
    let rotation = DMat3::from_cols(right, back.cross(right), back);
    Some((placement.transform_point3(local.position), rotation))
}

/// A light of the model `origin` (for messages); none if it gives no light.
pub(crate) fn light(
    light: &PunctualLight,
    placement: &DAffine3,
    site: &Site,
    origin: &str,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Placed>, Error> {
    let place = format!("{origin}: light {:?}", light.name);
    let mut warn = |what: String| warnings.push(Warning { place: place.clone(), what });
    // The amount is what the colour leaves of white.
    let amount = light.intensity * light.colour.as_dvec3().dot(LUMINANCE.as_dvec3());
    let Some((position, world_from_light)) = rigid(placement, &light.placement) else { return Ok(None) };
    if amount <= 0.0 {
        warn("gives no light (colour or intensity is 0); it is left out".to_owned());
        return Ok(None);
    }
    let colour = LightSpectrum::Rgb(light.colour);
    if light.kind == PunctualKind::Directional {
        if let Some(what) = doubtful_sun(amount) {
            warn(what);
        }
        return Ok(Some(Placed::Sun(sun(world_from_light.z_axis, amount, colour, site))));
    }
    let distribution = match (&light.ies, light.kind) {
        (Some(profile), _) => {
            let photometry = match profile {
                IesProfile::File(path) => photometry::read(path).map_err(|error| match error {
                    Error::Io { path, source } => Error::named_in(path, &source, &place),
                    other => other,
                })?,
                IesProfile::Embedded(bytes) => photometry::parse(bytes, place.as_ref())?,
            };
            for warning in photometry.warnings {
                warn(format!("{}: {}", warning.place, warning.what));
            }
            // A profile's candela are those of the coloured light already.
            photometry.distribution.scaled(light.intensity as f32)
        }
        (None, PunctualKind::Spot { inner, outer }) => {
            let cone = cone_distribution(amount, inner, outer);
            cone.unwrap_or_else(|| Distribution::isotropic(0.0))
        }
        (None, _) => Distribution::isotropic(amount as f32),
    };
    let flux = if light.ies.is_some() { 0.0 } else { distribution.total_flux().min(isotropic_flux(amount)) };
    if flux > STRONGEST_LAMP {
        warn(format!(
            "{amount:.0} cd are {:.0} klm, more than any lamp has: were watts exported as candela?",
            flux / 1000.0
        ));
    }
    let distribution = Arc::new(distribution);
    let name = light.name.clone();
    Ok(Some(Placed::Lamp(Light { name, position, world_from_light, distribution, spectrum: colour })))
}

fn doubtful_sun(lx: f64) -> Option<String> {
    if lx > BRIGHTEST_SUN {
        return Some(format!(
            "a sun of {lx:.0} lx is brighter than above the atmosphere (134,000 lx): was W/m² exported?"
        ));
    }
    (lx < FAINTEST_SUN)
        .then(|| format!("a sun of {lx} lx is hardly light: was W/m² exported? Clear noon has 100,000 lx"))
}

fn sun(toward: DVec3, lx: f64, colour: LightSpectrum, site: &Site) -> Sun {
    let (altitude, azimuth) = site.angles(toward);
    Sun { toward, altitude, azimuth, illuminance: Some(lx), spectrum: Some(colour), diameter: SUN_DIAMETER }
}

/// A camera of a model.
pub(crate) fn camera(camera: &ModelCamera, placement: &DAffine3, number: usize) -> Option<Camera> {
    let (position, world_from_camera) = rigid(placement, &camera.placement)?;
    let name = if camera.name.is_empty() { format!("camera-{number}") } else { camera.name.clone() };
    let near = if camera.near > 0.0 { camera.near } else { 1e-3 };
    Some(Camera {
        name,
        position,
        world_from_camera,
        projection: camera.projection,
        aspect: camera.aspect,
        near,
        path: None,
    })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn point(intensity: f64, kind: PunctualKind) -> PunctualLight {
        let placement = Placement { position: DVec3::X, rotation: DMat3::IDENTITY };
        PunctualLight { name: "a".into(), kind, colour: Vec3::ONE, intensity, placement, ies: None }
    }

    fn place(given: &PunctualLight, placement: &DAffine3) -> (Option<Placed>, Vec<Warning>) {
        let mut warnings = Vec::new();
        let placed = light(given, placement, &Site::default(), "m.glb", &mut warnings).unwrap();
        (placed, warnings)
    }

    #[test]
    fn a_placed_lamp_is_moved_and_turned_but_not_scaled() {
        let placement = DAffine3::from_scale_rotation_translation(
            DVec3::new(2.0, -3.0, 2.0),
            glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2),
            DVec3::new(10.0, 0.0, 0.0),
        );
        let (placed, warnings) = place(&point(100.0, PunctualKind::Point), &placement);
        let Some(Placed::Lamp(lamp)) = placed else { panic!("no lamp") };
        assert!(warnings.is_empty());
        // X scaled by 2 and turned to −Z; quaternions of f64 round in the last digits.
        assert!((lamp.position - DVec3::new(10.0, 0.0, -2.0)).length() < 1e-14);
        assert!((lamp.world_from_light.determinant() - 1.0).abs() < 1e-14);
        // The weights of the colours sum to 1, exactly.
        assert_eq!(lamp.distribution.peak(), 100.0);
    }

    #[test]
    fn watts_are_suspected() {
        // 1000 W exported as 683 × 1000 / 4π cd.
        let (_, warnings) = place(&point(54_351.0, PunctualKind::Point), &DAffine3::IDENTITY);
        assert!(warnings[0].what.contains("watts"));
        for lx in [1.0, 200_000.0] {
            let (_, warnings) = place(&point(lx, PunctualKind::Directional), &DAffine3::IDENTITY);
            assert_eq!(warnings.len(), 1, "{lx}");
        }
        let (sun, warnings) = place(&point(80_000.0, PunctualKind::Directional), &DAffine3::IDENTITY);
        let Some(Placed::Sun(sun)) = sun else { panic!("no sun") };
        assert!(warnings.is_empty());
        // It shines along −Z, that is from the south.
        assert_eq!((sun.toward, sun.azimuth), (DVec3::Z, 180.0));
    }
}
