//! What will be done, with what, and why: plain data between the arguments and the pipeline.

use std::collections::BTreeSet;
use std::fmt;

use scene::{Camera, Scene, TreeSpecies};

use crate::assemble::mirrors;
use crate::knobs::{Preset, Settings};
use crate::pipeline::Region;
use crate::shadows::{Rule, Shadows};
use crate::{Error, args, assemble, caution};

/// Most pixels of all layers together: 2²⁷ spectra are 4 GiB, and developing them takes as much again.
pub(crate) const MOST_PIXELS: u64 = 1 << 27;

/// Everything decided before anything is built.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Plan {
    /// Index of the camera in the scene.
    #[serde(skip)]
    pub eye: usize,
    /// Its name.
    pub camera: String,
    /// Pixels in a row of the whole picture.
    pub width: u32,
    /// Rows of the whole picture.
    pub height: u32,
    /// Which part of it is made.
    #[serde(skip)]
    pub region: Region,
    /// Where the choices come from.
    pub preset: Preset,
    /// What the scene holds.
    pub contents: Contents,
    /// Share of the pixels that need a ray to see a curved solid, where that has been counted.
    pub share_of_rays: Option<f64>,
    /// How shadows are found.
    pub shadows: Shadows,
    /// Which stages run, in the order light takes them, and which do not.
    pub stages: Vec<Stage>,
    /// Every knob.
    pub settings: Settings,
    /// What may not be what one expects.
    pub warnings: Vec<String>,
}

/// What a scene holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Contents {
    /// Triangles in all placements together.
    pub triangles: usize,
    /// Triangles kept in memory.
    pub stored_triangles: usize,
    /// Placements.
    pub instances: usize,
    /// Materials.
    pub materials: usize,
    /// Lamps.
    pub lights: usize,
    /// Curved solids and set operations.
    pub solids: usize,
    /// Faces that are not solid: alpha textures.
    pub cut_out_triangles: usize,
}

/// One stage and the answer chosen for it.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Stage {
    /// `see`, `shade`, `illuminate`, `occlude`.
    pub question: &'static str,
    /// Who answers; empty = the stage is left out.
    pub answer: String,
    /// Why.
    pub why: String,
}

impl Plan {
    /// Decides for `scene` what `args` ask.
    ///
    /// # Errors
    /// An unknown camera, stage, knob, or a size or region that cannot be: usage errors.
    pub fn new(scene: &Scene, args: &args::View) -> Result<Self, Error> {
        let mut settings = Settings::preset(args.preset);
        for (name, value) in &scene.settings {
            settings.set(name, value, "the scene file's [settings] or [sky]").map_err(Error::in_scene)?;
        }
        for (name, value) in &args.set {
            settings.set(name, value, "--set")?;
        }
        check(scene, &settings)?;
        let eye = camera(scene, args.camera.as_deref())?;
        let camera = &scene.cameras[eye];
        let (width, height) = size(camera, args.size);
        let contents = Contents::of(scene);
        let sources = assemble::outline(scene, &settings);
        let shadows = Shadows::decide(&settings, contents.triangles, sources);
        Ok(Self {
            eye,
            camera: camera.name.clone(),
            width,
            height,
            region: region(args.region, width, height)?,
            preset: args.preset,
            share_of_rays: None,
            stages: stages(scene, &settings, contents, &shadows),
            contents,
            warnings: caution::warnings(scene, &settings, &shadows),
            shadows,
            settings,
        })
    }

    /// The same for sensors in place of a picture.
    #[must_use]
    pub fn at_sensors(self) -> Self {
        Self { settings: self.settings.at_sensors(), ..self }
    }

    /// The camera that was chosen.
    pub fn camera<'a>(&self, scene: &'a Scene) -> Option<&'a Camera> {
        scene.cameras.get(self.eye)
    }
}

impl Contents {
    fn of(scene: &Scene) -> Self {
        let geometry = &scene.geometry;
        Self {
            triangles: geometry.triangle_count(),
            stored_triangles: geometry.meshes.iter().map(|mesh| mesh.triangles.len()).sum(),
            instances: geometry.instances.len(),
            materials: scene.materials.len(),
            lights: scene.lights.len() + scene.area_lights.len(),
            solids: scene.solids.len(),
            cut_out_triangles: geometry
                .instances
                .iter()
                .map(|instance| &geometry.meshes[instance.mesh as usize])
                .filter(|mesh| mesh.opacity.is_some())
                .map(|mesh| mesh.triangles.len())
                .sum(),
        }
    }
}

/// A camera by name, or by its number from 1; the first without either.
fn camera(scene: &Scene, wanted: Option<&str>) -> Result<usize, Error> {
    let by_number = |text: &str| text.parse::<usize>().ok()?.checked_sub(1);
    let found = match wanted {
        None => Some(0),
        Some(name) => scene.cameras.iter().position(|camera| camera.name == name).or_else(|| by_number(name)),
    };
    found.filter(|index| *index < scene.cameras.len()).ok_or_else(|| {
        let names: Vec<_> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
        Error::Usage(format!(
            "--camera {}: no such camera; there are: {}",
            wanted.unwrap_or("(none)"),
            names.join(", ")
        ))
    })
}

/// Pixels of the picture: as asked, or 1280 wide at the camera's own aspect (16:10 where it states none).
fn size(camera: &Camera, asked: Option<args::Size>) -> (u32, u32) {
    let aspect = camera.aspect.unwrap_or(1.6);
    let asked = asked.unwrap_or(args::Size { width: 1280, height: None });
    let own = || (f64::from(asked.width) / aspect).round().clamp(1.0, 65536.0) as u32;
    (asked.width, asked.height.unwrap_or_else(own))
}

/// What is possible alone may not be possible together.
fn check(scene: &Scene, settings: &Settings) -> Result<(), Error> {
    assemble::lacks(scene, settings).map_or(Ok(()), |what| Err(Error::Content(what)))
}

fn region(asked: Option<args::Rectangle>, width: u32, height: u32) -> Result<Region, Error> {
    let r = asked.unwrap_or(args::Rectangle { x: 0, y: 0, width, height });
    if u64::from(r.width) * u64::from(r.height) > MOST_PIXELS {
        return Err(Error::Usage(format!(
            "{} x {} pixels are more than {MOST_PIXELS}; render them in parts with --region",
            r.width, r.height
        )));
    }
    let (right, bottom) = (r.x.saturating_add(r.width), r.y.saturating_add(r.height));
    if right > width || bottom > height {
        return Err(Error::Usage(format!(
            "--region {},{},{},{}: reaches beyond the picture of {width}x{height}",
            r.x, r.y, r.width, r.height
        )));
    }
    Ok(Region { columns: r.x..right, rows: r.y..bottom })
}

/// Which model of the sky runs: the knob's, or the scene's own; `none` where neither names one.
pub(crate) fn sky_model<'a>(scene: &'a Scene, settings: &'a Settings) -> &'a str {
    match settings.choice("sky.model") {
        "scene" => scene.sky.as_ref().map_or("none", |sky| sky.model.as_str()),
        other => other,
    }
}

/// How much of the sky places see is found how.
fn sky_seen(settings: &Settings) -> String {
    let by = match settings.sky_visibility() {
        "cuboid" => {
            format!("a receiving cuboid of {} elements across its top", settings.choice("sky.elements"))
        }
        "bands" => format!("{} band sources", settings.choice("sky.bands")),
        "patches" => format!("{} rows of patches", settings.choice("sky.patches")),
        _ => format!("{} rays a place", settings.choice("sky.rays")),
    };
    match settings.choice("sky.map") {
        "on" => format!("{by}, kept in maps"),
        _ => by,
    }
}

/// Who says how bright sun or sky are, if not their models.
fn scaled(settings: &Settings, formula: &str) -> String {
    match settings.choice("sky.scale") {
        "nagata" => format!(", as bright as {formula} says for P = {}", settings.choice("sky.transmittance")),
        _ => String::new(),
    }
}

/// How large the table of a measured sky is.
fn table(scene: &Scene, model: &str) -> String {
    let table = scene.sky.as_ref().and_then(|sky| sky.table.as_ref()).filter(|_| model == "measured");
    table.map_or(String::new(), |table| {
        format!(", by a table of {} altitudes and {} azimuths", table.altitudes.len(), table.azimuths.len())
    })
}

/// How many materials let light through.
fn transparent(scene: &Scene) -> usize {
    scene.materials.iter().filter(|material| material.medium().is_some()).count()
}

fn stages(scene: &Scene, settings: &Settings, contents: Contents, shadows: &Shadows) -> Vec<Stage> {
    let stage = |question, answer: &str, why: String| Stage { question, answer: answer.to_owned(), why };
    let see = match settings.choice("visibility") {
        "rays" => stage("see", "rays", format!("visibility = rays, {} a pixel", settings.choice("samples"))),
        _ => stage(
            "see",
            "scanline",
            format!(
                "{} triangles, {} of them cut out by alpha, {} solids by rays within their hulls; {} sub-scanlines",
                contents.triangles,
                contents.cut_out_triangles,
                contents.solids,
                settings.choice("sub-scanlines")
            ),
        ),
    };
    let traced = match (scene.materials.iter().filter(|m| mirrors(m)).count(), transparent(scene)) {
        (0, 0) => String::new(),
        (mirrors, 0) => format!("; rays from {mirrors} that mirror"),
        (mirrors, bodies) => format!("; rays from {mirrors} that mirror, {bodies} transparent"),
    };
    let shade = stage("shade", "surface", format!("{} materials{traced}", contents.materials));
    let sun = match &scene.sun {
        Some(sun) if sun.altitude > -0.5 * sun.diameter => stage(
            "illuminate",
            "sun",
            format!(
                "{:.2}° high, azimuth {:.2}°, disc of {:.3}°{}",
                sun.altitude,
                sun.azimuth,
                sun.diameter,
                scaled(settings, "Bouguer")
            ),
        ),
        Some(sun) => {
            stage("illuminate", "", format!("no sun: it is {:.2}° below the horizon", -sun.altitude))
        }
        None => stage("illuminate", "", "no sun: the scene has none".to_owned()),
    };
    let sky = match sky_model(scene, settings) {
        "none" => stage("illuminate", "", "no sky: none is asked for".to_owned()),
        model => {
            let seen = sky_seen(settings) + &table(scene, model) + &scaled(settings, "Nagata");
            stage("illuminate", &format!("sky {model}"), seen)
        }
    };
    let lamps = lamps(scene, settings);
    let faces = settings.choice("accelerate");
    let occlude = match shadows.rule {
        Rule::Off => stage("occlude", "", format!("no shadows: {shadows}")),
        Rule::Rays => stage("occlude", &format!("rays ({faces})"), shadows.to_string()),
        Rule::Volumes => stage("occlude", &format!("volumes ({faces})"), shadows.to_string()),
    };
    let mut stages = vec![see, shade, sun, sky, lamps, occlude];
    let (water, of_water) = waters(scene, settings);
    let (trees, of_trees) = trees(scene, settings);
    let whole = |answer, why| stage("all three", answer, why);
    stages.extend([whole(water, of_water), between(settings), whole(trees, of_trees)]);
    stages
}

/// Who lights from face to face.
fn between(settings: &Settings) -> Stage {
    let (answer, why) = match settings.choice("interreflection") {
        "off" => (String::new(), "no interreflected light: interreflection = off".to_owned()),
        by => {
            let orders = match settings.integer("interreflection.orders") {
                0 => "until it is used up".to_owned(),
                count => format!("{count} diffuse reflections"),
            };
            let most = settings.choice("interreflection.patches");
            (format!("interreflected ({by})"), format!("{orders}, between up to {most} patches"))
        }
    };
    Stage { question: "illuminate", answer, why }
}

/// Who lights from lamps.
fn lamps(scene: &Scene, settings: &Settings) -> Stage {
    let (answer, why) = match (scene.lights.len(), scene.area_lights.len()) {
        (0, 0) => ("", "no luminaires: the scene has none".to_owned()),
        (n, 0) => ("luminaires", format!("{n} in the scene")),
        (n, areas) => {
            let rays = settings.choice("lamp.samples");
            (
                "luminaires",
                format!("{n} points and {areas} areas in the scene; {rays} shadow rays to each area"),
            )
        }
    };
    Stage { question: "illuminate", answer: answer.to_owned(), why }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "camera {}, {} x {} pixels, preset {:?}",
            self.camera, self.width, self.height, self.preset
        )?;
        let c = &self.contents;
        writeln!(
            f,
            "{} triangles ({} stored) in {} placements, {} materials, {} lights",
            c.triangles, c.stored_triangles, c.instances, c.materials, c.lights
        )?;
        if (self.region.columns.len(), self.region.rows.len()) != (self.width as usize, self.height as usize)
        {
            writeln!(f, "columns {:?} and rows {:?} of them", self.region.columns, self.region.rows)?;
        }
        if let Some(share) = self.share_of_rays {
            writeln!(f, "{:.2} % of the pixels need a ray to see a solid", 100.0 * share)?;
        }
        writeln!(f, "\nstages")?;
        for stage in &self.stages {
            let answer = if stage.answer.is_empty() { "-" } else { &stage.answer };
            writeln!(f, "  {:<11} {:<16} {}", stage.question, answer, stage.why)?;
        }
        writeln!(f, "\nknobs")?;
        for knob in crate::knobs::KNOBS {
            writeln!(f, "  {:<14} {:<10} {}", knob.name, self.settings.choice(knob.name), knob.doc)?;
            writeln!(f, "  {:<25} may be {}", "", knob.domain)?;
        }
        Ok(())
    }
}

/// What is done about water and about its waves, and why.
fn waters(scene: &Scene, settings: &Settings) -> (&'static str, String) {
    let wavy = scene.waters.iter().filter(|water| !water.waves.is_calm()).count();
    match (scene.waters.len(), wavy) {
        (0, _) => ("", "no water: the scene has no [[water]]".to_owned()),
        (n, 0) => ("flat water", format!("{n} in the scene")),
        (n, wavy) => {
            let caustics = match settings.choice("water.caustics") {
                "beams" => "gather the light of what shines on them",
                _ => "do nothing to light, only to what is seen (water.caustics = off)",
            };
            ("water", format!("{n} in the scene; waves on {wavy}, which {caustics}"))
        }
    }
}

/// What is done about trees, and why.
fn trees(scene: &Scene, settings: &Settings) -> (&'static str, String) {
    let count: usize = scene.trees.iter().map(|trees| trees.placed.len()).sum();
    match (count, settings.choice("trees")) {
        (0, _) => ("", "no trees: the scene has no [[tree]]".to_owned()),
        (n, "off") => ("", format!("no trees: trees = off; {n} in the scene")),
        (n, _) => {
            let name = |trees: &scene::Trees| match &trees.species {
                TreeSpecies::Named(name) => name.clone(),
                TreeSpecies::Pictured(pictured) => pictured.name.clone(),
            };
            let species: BTreeSet<String> = scene.trees.iter().map(name).collect();
            let [planes, fade] = ["trees.planes", "trees.fade"].map(|knob| settings.choice(knob));
            let what =
                format!("{n} of {} species; a vertical plane and up to {planes} level ones", species.len());
            ("turning planes", format!("{what}, which fade by {fade}"))
        }
    }
}
