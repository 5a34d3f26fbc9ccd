//! The sky of the scene → a source of the pipeline: which model, seen how, kept in maps or not.

use std::fmt::Write;
use std::sync::Arc;

use glam::Vec3;
use light::{Bodies, Geometry, Illuminate, Spectrum};
use scene::{Scene, SkyTable};
use sky::map::{Described, Fnv, Mapped};
use sky::{
    BandSky, Conditions, CuboidSky, Description, Division, Dome, LuminanceTable, Model, PatchSky, Perez,
    Scale, WholeSky, bouguer, measured_sky,
};

use super::lights::{beam, risen};
use super::maps::Maps;
use crate::knobs::Settings;
use crate::pipeline::Source;
use crate::plan;

/// The skies that there are.
pub(crate) fn skies() -> impl Iterator<Item = &'static str> {
    Model::all().map(Model::name).chain([MEASURED])
}

/// The sky that is a table.
const MEASURED: &str = "measured";

/// A sky that was asked for and is there.
#[derive(Clone)]
pub(super) enum Asked {
    Named(Model),
    /// Azimuths from −Z.
    Measured(Arc<LuminanceTable>),
}

/// What the layer of the sky is called.
pub(super) const SKY: &str = "sky";

/// Which sky; none if none is asked for.
pub(super) fn asked(scene: &Scene, settings: &Settings) -> Option<Asked> {
    match plan::sky_model(scene, settings) {
        MEASURED => {
            let table = scene.sky.as_ref()?.table.as_deref()?;
            turned(table, scene.site.north).ok().map(|table| Asked::Measured(Arc::new(table)))
        }
        name => Model::named(name).map(Asked::Named),
    }
}

/// What keeps a sky that was asked for from being there, in words.
pub(crate) fn lacks(scene: &Scene, settings: &Settings) -> Option<String> {
    let model = plan::sky_model(scene, settings);
    if model == MEASURED {
        return match scene.sky.as_ref().and_then(|sky| sky.table.as_deref()) {
            None => Some("sky.model = measured: the scene's [sky] names no table".to_owned()),
            Some(table) => turned(table, scene.site.north).err().map(|error| format!("[sky] table: {error}")),
        };
    }
    (model != "none" && asked(scene, settings).is_none()).then(|| {
        let known: Vec<_> = skies().chain(["none"]).collect();
        format!("[sky] model = \"{model}\": no such sky; there are: {}", known.join(", "))
    })
}

pub(super) fn sky(
    scene: &Scene,
    settings: &Settings,
    bodies: Option<&dyn Bodies>,
    maps: &mut Maps,
) -> Option<Source> {
    let description = describe(scene, settings, asked(scene, settings)?);
    let seen = seen(scene, settings, &description, bodies);
    let light: Box<dyn Illuminate> = match settings.choice("sky.map") {
        "on" => Box::new(mapped(scene, settings, seen, maps)),
        _ => Box::new(seen),
    };
    let among_leaves = (!scene.trees.is_empty()).then(|| -> Box<dyn Illuminate> {
        let samples = settings.integer("trees.sky-rays");
        Box::new(Dome::new(&Description { samples, ..description }))
    });
    Some(Source { name: SKY.to_owned(), light, beam: false, point: None, among_leaves })
}

/// Where the sun stands: a sky knows it also when it does not shine, switched off or below the horizon.
pub(crate) fn place_of_sun(scene: &Scene) -> Option<scene::Sun> {
    scene.sun.clone().or_else(|| scene.site.sun())
}

/// What the sky is made for.
pub(super) fn conditions(scene: &Scene, settings: &Settings) -> Conditions {
    let sun = place_of_sun(scene);
    let stated = scene.sky.as_ref().and_then(|sky| sky.illuminance);
    Conditions {
        scale: match transmittance(settings) {
            Some(transmittance) => Scale::Nagata(transmittance),
            None => stated.map_or(Scale::Own, |lux| Scale::Horizontal(lux as f32)),
        },
        elevation_m: scene.site.elevation,
        turbidity: settings.own_or("sky.turbidity"),
        ozone: settings.own_or("sky.ozone").map(|dobson| dobson / 1000.0),
        weather: sun.as_ref().and_then(|sun| weather(scene, sun)),
        ..Conditions::new(sun.map_or(Vec3::Y, |sun| sun.toward.as_vec3()))
    }
}

/// That of the atmosphere at the zenith, where Bouguer and Nagata say how bright sun and sky are.
fn transmittance(settings: &Settings) -> Option<f64> {
    (settings.choice("sky.scale") == "nagata").then(|| settings.number("sky.transmittance"))
}

/// Illuminance by the sun on a plane that faces it, by Bouguer's formula where that is asked for \[lx\].
pub(super) fn formula_sun(settings: &Settings, altitude: f64) -> Option<f64> {
    transmittance(settings).map(|transmittance| bouguer::sun_illuminance(transmittance, altitude))
}

pub(super) fn describe(scene: &Scene, settings: &Settings, asked: Asked) -> Description {
    let conditions = conditions(scene, settings);
    let shining = scene.sun.as_ref().filter(|sun| risen(sun));
    let sun_horizontal =
        shining.map_or(Spectrum::ZERO, |sun| beam(scene, settings, sun) * conditions.toward_sun.y.max(0.0));
    let sky = match asked {
        Asked::Named(model) => model.sky(&conditions),
        Asked::Measured(table) => measured_sky(table, settings.number("sky.clear"), &conditions),
    };
    Description {
        sun_horizontal,
        albedo: settings.number("sky.albedo") as f32,
        ground_height: match settings.choice("sky.ground") {
            // Where surfaces light each other, the scene's own ground does so itself.
            "open" if !super::interreflection::asked(settings) => ground_height(&scene.geometry),
            _ => None,
        },
        samples: settings.integer("sky.rays"),
        ..Description::new(sky)
    }
}

/// The table with its azimuths from −Z instead of true north.
fn turned(table: &SkyTable, north: f64) -> Result<LuminanceTable, sky::TableError> {
    let from_ahead = |azimuth: f64| match (azimuth + north).rem_euclid(360.0) as f32 {
        // What rounds up to the full circle is its beginning.
        turn if turn >= 360.0 => 0.0,
        turn => turn,
    };
    let mut columns: Vec<(f32, usize)> =
        table.azimuths.iter().map(|&azimuth| from_ahead(azimuth)).zip(0..).collect();
    columns.sort_by(|a, b| a.0.total_cmp(&b.0));
    let rows = table.luminances.chunks(columns.len().max(1));
    let luminances = rows.flat_map(|row| columns.iter().map(|&(_, column)| row[column])).collect();
    let altitudes = table.altitudes.iter().map(|&altitude| altitude as f32).collect();
    LuminanceTable::new(altitudes, columns.iter().map(|&(azimuth, _)| azimuth).collect(), luminances)
}

/// The observed state of the sky, as Perez' model takes it.
fn weather(scene: &Scene, sun: &scene::Sun) -> Option<Perez> {
    let observed = scene.sky.as_ref()?.weather.as_ref()?;
    Some(Perez::new(observed.direct_normal, observed.diffuse_horizontal, sun.altitude, None))
}

/// Illuminance by the observed sun on a plane that faces it \[lx\].
pub(super) fn observed_sun(scene: &Scene, sun: &scene::Sun) -> Option<f32> {
    let dew_point = scene.sky.as_ref()?.weather.as_ref()?.dew_point;
    // Water vapour above the ground by the dew point, as Perez' efficacies take it.
    let water = dew_point.map_or(PRECIPITABLE_WATER, |celsius| (0.07 * celsius - 0.075).exp());
    let [_, direct] = weather(scene, sun)?.illuminances(water);
    Some(direct as f32)
}

/// Water vapour above the ground where nothing is known of it \[cm\]: it changes luminous efficacies by some per cent.
const PRECIPITABLE_WATER: f64 = 2.0;

/// How much of the sky a place sees: by the cuboid, bands, patches, or rays.
fn seen(
    scene: &Scene,
    settings: &Settings,
    description: &Description,
    bodies: Option<&dyn Bodies>,
) -> Arc<dyn WholeSky> {
    match settings.sky_visibility() {
        "cuboid" => {
            let division =
                Division { elements: settings.integer("sky.elements"), parts: settings.integer("sky.parts") };
            Arc::new(CuboidSky::new(description, &scene.geometry, bodies, division))
        }
        "bands" => {
            let bands = settings.integer("sky.bands");
            Arc::new(BandSky::new(description, &scene.geometry, bodies, bands))
        }
        "patches" => Arc::new(PatchSky::new(description, settings.integer("sky.patches"))),
        _ => Arc::new(Dome::new(description)),
    }
}

/// Kept at points of every face.
fn mapped(scene: &Scene, settings: &Settings, seen: Arc<dyn WholeSky>, maps: &mut Maps) -> Arc<Mapped> {
    let fineness = sky::map::Settings {
        coarse: settings.number("sky.map.coarse") as f32,
        least: settings.number("sky.map.least") as f32,
        tolerance: settings.number("sky.map.tolerance") as f32,
        ..sky::map::Settings::default()
    };
    let [hiding, sky] = [hiding(scene, settings), light_of_the_sky(scene, settings)];
    let described = Described { hiding: hiding.as_bytes(), sky: sky.as_bytes() };
    maps.map(seen, &scene.geometry, fineness, &described)
}

/// What hides the sky besides the geometry, and how it is looked at, in words that differ where these do.
fn hiding(scene: &Scene, settings: &Settings) -> String {
    let media: Vec<_> = scene.materials.iter().map(scene::Material::medium).collect();
    let stages = ["shadows", "sky.patches", "sky.ground"].map(|name| settings.choice(name));
    let trees = settings.of("trees").collect::<Vec<_>>();
    format!("{:?}{media:?}{stages:?}{:x}{trees:?}", scene.solids, number_of_trees(scene))
}

/// A number for all trees: in words, as text, a million would be 100 MB.
fn number_of_trees(scene: &Scene) -> u128 {
    let mut fnv = Fnv::new();
    for trees in &scene.trees {
        let scene::Trees { species, placed, height, on_ground } = trees;
        // Trees on the ground keep away from waters. Writing to a number cannot fail.
        let waters = on_ground.then_some(&scene.waters);
        let _ = write!(fnv, "{species:?}{height:?}{}{waters:?}", placed.len());
        for scene::PlacedTree { position, scale, rotation } in placed {
            position.to_array().iter().for_each(|x| {
                fnv.bytes(&x.to_le_bytes());
            });
            fnv.bytes(&scale.to_le_bytes()).bytes(&rotation.to_le_bytes());
        }
    }
    fnv.number()
}

/// The sky's light, likewise. More may be in it than matters: then something is found anew in vain.
fn light_of_the_sky(scene: &Scene, settings: &Settings) -> String {
    let knobs: Vec<_> = settings.of("sky.").collect();
    format!("{:?}{:?}{:?}{:?}{knobs:?}", scene.sky, scene.sun, scene.site, env!("CARGO_PKG_VERSION"))
}

/// Height of the scene's own ground \[m\]: below a tenth of the area of its level faces there is no ground
/// yet (pits, undersides); a per mille of the scene's height above it, so that the ground itself does not
/// hide the ground's light.
fn ground_height(geometry: &Geometry) -> Option<f32> {
    let (low, high) = geometry.bounds()?;
    let mut level: Vec<(f64, f64)> = Vec::new();
    for (i, instance) in geometry.instances.iter().enumerate() {
        for t in 0..geometry.meshes[instance.mesh as usize].triangles.len() {
            let triangle = geometry.triangle(i as u32, t as u32);
            let cross = triangle.cross();
            // Steeper than 45° is a wall, not ground.
            if cross.y.abs() > 0.7 * cross.length() {
                let [a, b, c] = triangle.0;
                level.push(((a.y + b.y + c.y) / 3.0, cross.length()));
            }
        }
    }
    level.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let tenth = 0.1 * level.iter().map(|(_, area)| area).sum::<f64>();
    let mut sum = 0.0;
    let ground = level.iter().find(|(_, area)| {
        sum += area;
        sum >= tenth
    });
    ground.map(|(height, _)| (height + 1e-3 * (high.y - low.y)) as f32)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::knobs::Preset;

    const SCENE: &str = "[site]\nlatitude = 35\nlongitude = 139\ntime = 2026-06-21T10:00:00+09:00\n\
        [sky]\nmodel = 'clear'\n[[material]]\nname = 'glass'\ntransmission = 0.9\n\
        [[solid]]\nsphere = { radius = 1.0 }\nmaterial = 'glass'\n";

    /// What hides the sky, and its light, in words.
    fn words(text: &str, set: &[(&str, &str)]) -> [String; 2] {
        let scene = scene::parse(text, Path::new(""), Path::new("a.toml")).unwrap();
        let mut settings = Settings::preset(Preset::Normal);
        for (name, value) in &scene.settings {
            settings.set(name, value, "the scene").unwrap();
        }
        for (name, value) in set {
            settings.set(name, value, "--set").unwrap();
        }
        [hiding(&scene, &settings), light_of_the_sky(&scene, &settings)]
    }

    #[test]
    fn maps_are_told_apart_by_their_trees_in_few_words() {
        let few = "[[water]]\npolygon = { points = [[8, 0, 8], [8, 0, 9], [9, 0, 9]] }\n[[tree]]\nspecies = 'spruce'\npositions = [[1, 0, 0], [4, 0, 0]]\n";
        let [of_few, _] = words(few, &[]);
        for (from, to) in [
            ("spruce", "poplar"),
            ("[4, 0, 0]", "[4, 0, 0.001]"),
            (", [4, 0, 0]", ""),
            ("\n[[tree]]", "\n[[tree]]\nground = true"),
            ("\n[[tree]]", "\n[[tree]]\nrotation = 3"),
            ("\n[[tree]]", "\n[[tree]]\nheight = 3"),
            ("\n[[tree]]", "\n[[tree]]\nvariation = 0.1"),
        ] {
            assert_ne!(words(&few.replace(from, to), &[])[0], of_few, "{to}");
        }
        let ground = few.replace("[[tree]]", "[[tree]]\nground = true");
        assert_ne!(words(&ground.replace("[8, 0, 9]", "[8, 0, 12]"), &[]), words(&ground, &[]));
        let corners = "[[0, 0, 0], [3000, 0, 0], [3000, 0, 3000], [0, 0, 3000]]";
        let many = format!("[[tree]]\nspecies = 'spruce'\npolygon = {{ points = {corners} }}\n");
        assert!(words(&many, &[])[0].len() < of_few.len() + 100);
    }

    #[test]
    fn maps_are_told_apart_by_all_that_changes_their_light() {
        let [hiding, light] = words(SCENE, &[]);
        for (from, to) in [("radius = 1.0", "radius = 1.5"), ("transmission = 0.9", "transmission = 0.8")] {
            assert_ne!(words(&SCENE.replace(from, to), &[])[0], hiding, "{to}");
        }
        for knob in [("shadows", "off"), ("sky.patches", "12"), ("sky.ground", "hidden")] {
            assert_ne!(words(SCENE, &[knob])[0], hiding, "{knob:?}");
        }
        for (from, to) in [
            ("'clear'", "'overcast'"),
            ("T10:00", "T11:00"),
            ("'clear'", "'clear'\nilluminance = 5000"),
            ("'clear'", "'clear'\nscale = 'nagata'"),
            ("latitude = 35", "latitude = 36"),
            ("[sky]", "elevation = 900\n[sky]"),
            ("[sky]", "[sun]\nilluminance = 9000\n[sky]"),
        ] {
            assert_ne!(words(&SCENE.replace(from, to), &[])[1], light, "{to}");
        }
        for knob in
            [("sky.albedo", "0.5"), ("sky.turbidity", "0.2"), ("sky.visibility", "rays"), ("sky.rays", "9")]
        {
            assert_ne!(words(SCENE, &[knob])[1], light, "{knob:?}");
        }
    }
}
