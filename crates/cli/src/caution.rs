//! What may not be what one expects, in words: of a plan, before anything is built.

use scene::Scene;

use crate::assemble;
use crate::knobs::Settings;
use crate::plan::sky_model;
use crate::shadows::Shadows;

/// The sun's altitude from which on a sky is black \[degrees\]: the tables of daylight end with twilight; light scattered by air
/// of height H, where neither what looks nor what is lit is farther than the horizon: −2 acos(R/(R + H)).
fn night(model: &str) -> f64 {
    match model {
        "physical" => -20.2,
        "thesis" | "repaired" => -11.1,
        _ => -18.0,
    }
}

/// All of them.
pub(crate) fn warnings(scene: &Scene, settings: &Settings, shadows: &Shadows) -> Vec<String> {
    let all =
        [low_sun(scene, settings), overruled(scene, settings), unshaded(scene, settings), shadows.warning()];
    all.into_iter().flatten().collect()
}

/// A sky that trees do not hide.
fn unshaded(scene: &Scene, settings: &Settings) -> Option<String> {
    let there = scene.trees.iter().any(|trees| !trees.placed.is_empty());
    let visibility = settings.sky_visibility();
    let blind = matches!(visibility, "cuboid" | "bands") && sky_model(scene, settings) != "none";
    (there && blind && settings.choice("trees") != "off" && settings.choice("shadows") != "off").then(|| {
        format!(
            "sky.visibility = {visibility} knows nothing of trees, which take none of the sky's light then: rays and patches know of them"
        )
    })
}

/// A sky of the day while the sun is down.
fn low_sun(scene: &Scene, settings: &Settings) -> Option<String> {
    let model = sky_model(scene, settings);
    let stated = scene.sky.as_ref().is_some_and(|sky| sky.illuminance.is_some());
    let weather = scene.sky.as_ref().is_some_and(|sky| sky.weather.is_some());
    let formula = settings.choice("sky.scale") == "nagata";
    let altitude = assemble::place_of_sun(scene)?.altitude;
    // A table is what it is, and of the night of a weather file its own warning tells.
    if altitude >= 0.0 || matches!(model, "none" | "measured") || (model == "perez" && weather && !formula) {
        return None;
    }
    let night = altitude <= night(model);
    let what = match model {
        _ if formula => "by Nagata's formula it gives no light: it is black",
        "thesis" | "repaired" if night => {
            "nothing lights the air: the sky is black, whatever its illuminance"
        }
        // Scattering knows where the sun is.
        "physical" | "thesis" | "repaired" if stated => {
            "it is as bright as stated, spread and coloured as the last of twilight"
        }
        "physical" if night => "next to nothing lights the air: the sky is black",
        "physical" => return None,
        "thesis" | "repaired" => {
            "light is scattered once only, in air up to 30 km: too dark a twilight, and next to none from 6° on"
        }
        _ if stated => "it is as bright as stated, spread as with the sun on the horizon",
        _ if night => "by the tables of daylight it gives no light below -18°: it is black",
        _ => {
            "it is spread as with the sun on the horizon, and as dark as twilight: a factor of 2.6 for each degree"
        }
    };
    Some(format!(
        "the sun is {:.2}° below the horizon, and the model {model} describes a sky of the day: {what}",
        -altitude
    ))
}

/// What the scene states and the formulas overrule.
fn overruled(scene: &Scene, settings: &Settings) -> Option<String> {
    let sky = scene.sky.as_ref();
    let stated = [
        (scene.sun.as_ref().is_some_and(|sun| sun.illuminance.is_some()), "[sun] illuminance"),
        (sky.is_some_and(|sky| sky.illuminance.is_some()), "[sky] illuminance"),
        (sky.is_some_and(|sky| sky.weather.is_some()), "the weather's irradiances"),
        (sky.is_some_and(|sky| sky.table.is_some()), "the measured sky's own luminance"),
    ];
    let names: Vec<_> = stated.into_iter().filter_map(|(is, name)| is.then_some(name)).collect();
    (settings.choice("sky.scale") == "nagata" && !names.is_empty()).then(|| {
        format!("sky.scale = nagata: the formulas say how bright sun and sky are, not {}", names.join(", "))
    })
}
