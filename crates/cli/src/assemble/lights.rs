//! Lights of the scene → sources of the pipeline.

use light::{Luminaire, Spectrum};
use scene::{LightSpectrum, Scene};

use crate::Error;
use crate::knobs::Settings;
use crate::pipeline::Source;
use crate::plan;

/// Sun, sky and luminaires, in this order; what the scene lacks is left out.
pub(super) fn sources(scene: &Scene, settings: &Settings) -> Result<Vec<Source>, Error> {
    let mut sources = Vec::new();
    sources.extend(sun(scene, settings));
    sources.extend(sky(scene, settings)?);
    sources.extend(scene.lights.iter().map(|light| Source {
        name: light.name.clone(),
        light: Box::new(Luminaire {
            position: light.position.as_vec3(),
            world_from_luminaire: light.world_from_light.as_mat3(),
            distribution: (*light.distribution).clone(),
            spectrum: colour(&light.spectrum),
        }),
    }));
    Ok(sources)
}

/// A spectrum of luminance 1.
fn colour(spectrum: &LightSpectrum) -> Spectrum {
    match spectrum {
        LightSpectrum::Temperature(kelvin) => Spectrum::light_of_temperature(*kelvin),
        LightSpectrum::Rgb(rgb) => Spectrum::light_of_colour(*rgb),
        LightSpectrum::Table(table) => Spectrum::from_table(table).of_luminance(1.0),
    }
}
