//! Lights of the scene → sources of the pipeline.

use light::{AreaLight, AreaShape, Bodies, Illuminate, Luminaire, PointSource, Spectrum};
use scene::{LightSpectrum, Scene};
use sky::{Air, Sun, atmosphere};

use super::heavens::{self, SKY};
use super::interreflection;
use super::maps::Maps;
use crate::knobs::Settings;
use crate::pipeline::Source;

/// What the layer of the sun is called.
pub(super) const SUN: &str = "sun";

/// Sun, sky, luminaires and luminous areas, in this order; what the scene lacks is left out. `bodies` hide the sky, as
/// meshes do; `maps` have what is known of its light.
pub(super) fn sources(
    scene: &Scene,
    settings: &Settings,
    bodies: Option<&dyn Bodies>,
    maps: &mut Maps,
) -> Vec<Source> {
    let mut sources = Vec::new();
    sources.extend(sun(scene, settings));
    sources.extend(heavens::sky(scene, settings, bodies, maps));
    sources.extend(scene.lights.iter().map(|light| Source {
        name: light.name.clone(),
        light: Box::new(Luminaire {
            position: light.position.as_vec3(),
            world_from_luminaire: light.world_from_light.as_mat3(),
            distribution: (*light.distribution).clone(),
            spectrum: colour(&light.spectrum),
            glints: settings.choice("lamp.glints") == "shown",
        }),
        beam: true,
        point: Some(PointSource::At(light.position)),
        among_leaves: None,
    }));
    sources.extend(scene.area_lights.iter().map(|lamp| Source {
        name: lamp.name.clone(),
        light: Box::new(area(lamp, settings)),
        beam: true,
        point: None,
        among_leaves: None,
    }));
    sources
}

/// The name of each of [`sources`] in their order, interreflected light after them, and whether it is a point that casts sharp shadows; no sky is
/// built for it.
pub(crate) fn outline(scene: &Scene, settings: &Settings) -> Vec<(String, bool)> {
    let sun = sun(scene, settings).map(|sun| (sun.name, sun.point.is_some() && scene.waters.is_empty()));
    let sky = heavens::asked(scene, settings).map(|_| (SKY.to_owned(), false));
    // Water bends what its lamps send.
    let dry = scene.waters.is_empty();
    let points = scene.lights.iter().map(|light| (light.name.clone(), dry));
    let areas = scene.area_lights.iter().map(|lamp| (lamp.name.clone(), false));
    let between = interreflection::asked(settings).then(|| (interreflection::NAME.to_owned(), false));
    sun.into_iter().chain(sky).chain(points).chain(areas).chain(between).collect()
}

/// A lamp with an extent.
pub(super) fn area(lamp: &scene::AreaLight, settings: &Settings) -> AreaLight {
    let shape = match lamp.shape {
        scene::AreaShape::Rectangle { size: [width, height] } => {
            // u × v = Y × X = −Z: it shines along the axis.
            let frame = lamp.world_from_light;
            AreaShape::Rectangle {
                half_u: (frame.y_axis * (0.5 * height)).as_vec3(),
                half_v: (frame.x_axis * (0.5 * width)).as_vec3(),
            }
        }
        scene::AreaShape::Sphere { radius } => AreaShape::Sphere { radius: radius as f32 },
    };
    AreaLight {
        shape,
        centre: lamp.position.as_vec3(),
        radiance: colour(&lamp.spectrum) * lamp.luminance as f32,
        samples: settings.integer("lamp.samples"),
    }
}

/// A spectrum of luminance 1.
pub(super) fn colour(spectrum: &LightSpectrum) -> Spectrum {
    match spectrum {
        LightSpectrum::Temperature(kelvin) => Spectrum::light_of_temperature(*kelvin),
        LightSpectrum::Rgb(rgb) => Spectrum::light_of_colour(*rgb),
        LightSpectrum::Table(table) => Spectrum::light_of_table(table).of_luminance(1.0),
    }
}

/// The sun's beam facing it \[W m⁻² nm⁻¹\]: by Bouguer's formula if that is asked for, as stated, or what clear air lets
/// through.
pub(super) fn beam(scene: &Scene, settings: &Settings, sun: &scene::Sun) -> Spectrum {
    let air = Air {
        turbidity: settings.own_or("sky.turbidity").unwrap_or(Air::CLEAR.turbidity),
        ozone: settings.own_or("sky.ozone").map_or(Air::CLEAR.ozone, |dobson| dobson / 1000.0),
        ..Air::CLEAR
    };
    let own = atmosphere::beam(&air, sun.altitude, scene.site.elevation);
    let coloured = match &sun.spectrum {
        Some(spectrum) => colour(spectrum).of_luminance(own.luminance()),
        None => own,
    };
    let formula = heavens::formula_sun(settings, sun.altitude);
    match formula.or(sun.illuminance).or(heavens::observed_sun(scene, sun).map(f64::from)) {
        // A stated illuminance of a sun whose own beam has faded away is white.
        Some(lux) if coloured.is_zero() => Spectrum::ONE.of_luminance(lux as f32),
        Some(lux) => coloured.of_luminance(lux as f32),
        None => coloured,
    }
}

/// Whether any of the sun's disc is above the horizon.
pub(super) fn risen(sun: &scene::Sun) -> bool {
    sun.altitude > -0.5 * sun.diameter
}

pub(super) fn sun(scene: &Scene, settings: &Settings) -> Option<Source> {
    let sun = scene.sun.as_ref()?;
    let light = Sun {
        toward: sun.toward.as_vec3(),
        irradiance: beam(scene, settings, sun),
        angular_diameter_deg: sun.diameter as f32,
        samples: settings.integer("sun.samples"),
    };
    // One ray to the middle of the disc is a point's sharp shadow.
    let point = (light.samples == 1 || sun.diameter == 0.0).then_some(PointSource::Toward(sun.toward));
    // Leaves lie at depths of their own: one ray each is soft enough.
    let among_leaves =
        (!scene.trees.is_empty()).then(|| -> Box<dyn Illuminate> { Box::new(Sun { samples: 1, ..light }) });
    (risen(sun) && !light.irradiance.is_zero()).then(|| Source {
        name: SUN.to_owned(),
        light: Box::new(light),
        beam: true,
        point,
        among_leaves,
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::knobs::Preset;

    #[test]
    fn the_outline_is_that_of_the_sources() {
        let lamps = "[[light]]\nposition = [0, 3, 0]\nintensity = 1\n\
            [[light]]\nposition = [0, 3, 1]\nsphere = { radius = 0.1 }\nflux = 1\n";
        for (sky, preset) in [
            ("[sky]\noff = true\n", Preset::Normal),
            ("[sky]\nmodel = 'uniform'\n[sun]\naltitude = 30\nazimuth = 9\n", Preset::Draft),
            ("[sky]\nmodel = 'clear'\n[sun]\naltitude = 30\nazimuth = 9\n", Preset::Normal),
            ("[sky]\nmodel = 'clear'\n[sun]\naltitude = -30\nazimuth = 9\n", Preset::Normal),
        ] {
            let scene = scene::parse(&format!("{sky}{lamps}"), Path::new(""), Path::new("a.toml")).unwrap();
            let settings = Settings::preset(preset);
            let built: Vec<_> = sources(&scene, &settings, None, &mut Maps::default())
                .into_iter()
                .map(|source| (source.name, source.point.is_some()))
                .collect();
            assert_eq!(outline(&scene, &settings), built, "{sky}");
        }
    }
}
