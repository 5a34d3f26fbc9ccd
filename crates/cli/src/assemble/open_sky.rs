//! Sun and sky with nothing in the way: what `keikan sky` shows.

use std::sync::Arc;

use glam::Vec3;
use light::{Place, Spectrum, Vacuum};
use scene::Scene;
use sky::{Dome, Sky};

use super::heavens::{self, Asked};
use super::lights;
use crate::plan::Plan;

/// The lights of a scene that come from above, with nothing in the way.
pub(crate) struct OpenSky {
    sky: Arc<dyn Sky>,
    /// Irradiance of the sky on the horizontal \[W m⁻² nm⁻¹\].
    pub(crate) diffuse: Spectrum,
    /// Irradiance of the sun on a plane that faces it; zero if it does not shine.
    pub(crate) sun_facing: Spectrum,
    /// Irradiance of the sun on the horizontal.
    pub(crate) sun_horizontal: Spectrum,
    /// Numbers that the model is made of, with their names.
    pub(crate) traits: Vec<(&'static str, f64)>,
}

impl OpenSky {
    /// Those of the scene; none if no sky is asked for.
    pub(crate) fn of(plan: &Plan, scene: &Scene) -> Option<Self> {
        let settings = &plan.settings;
        let asked = heavens::asked(scene, settings)?;
        let traits = traits(plan, scene, &asked);
        let description = heavens::describe(scene, settings, asked);
        let facing = |normal: Vec3| {
            let place = Place { position: Vec3::ZERO, error: 0.0, normal, seed: 0 };
            lights::sun(scene, settings).map_or(Spectrum::ZERO, |sun| sun.light.irradiance(&place, &Vacuum))
        };
        let toward_sun = scene.sun.as_ref().map_or(Vec3::Y, |sun| sun.toward.as_vec3());
        Some(Self {
            // The ground does not light what lies on it.
            diffuse: Dome::new(&description).open_irradiance(Vec3::Y),
            sky: description.sky,
            sun_facing: facing(toward_sun),
            sun_horizontal: facing(Vec3::Y),
            traits,
        })
    }

    /// Radiance of the sky, without the sun's disc, from the unit vector `direction` \[W m⁻² sr⁻¹ nm⁻¹\].
    pub(crate) fn radiance(&self, direction: Vec3) -> Spectrum {
        self.sky.radiance(direction)
    }

    /// Unit vector towards its brightest part.
    pub(crate) fn brightest(&self) -> Vec3 {
        self.sky.brightest()
    }
}

fn traits(plan: &Plan, scene: &Scene, asked: &Asked) -> Vec<(&'static str, f64)> {
    let settings = &plan.settings;
    let mut traits = Vec::new();
    match asked {
        Asked::Named(sky::Model::Perez) => {
            let perez = heavens::conditions(scene, settings).perez();
            traits.extend([("clearness ε", perez.clearness()), ("brightness Δ", perez.brightness())]);
        }
        Asked::Named(model) => {
            if let Some(air) = model.air() {
                let turbidity = settings.own_or("sky.turbidity").unwrap_or(air.turbidity);
                let ozone = settings.own_or("sky.ozone").unwrap_or(1000.0 * air.ozone);
                traits.extend([("turbidity β (Ångström)", turbidity), ("ozone [DU]", ozone)]);
            }
        }
        Asked::Measured(_) => traits.push(("share of clear air's colour", settings.number("sky.clear"))),
    }
    if settings.choice("sky.scale") == "nagata" {
        traits.push(("transmittance P (Bouguer, Nagata)", settings.number("sky.transmittance")));
    }
    traits
}
