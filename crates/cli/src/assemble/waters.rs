//! Waters of the scene → their surfaces among what is seen, what fills them, and what their surfaces do to lights.

use std::sync::Arc;

use glam::{DVec2, Vec3};
use light::{Geometry, Illuminate, Instance, Nearest, PointSource, Ray, Shade};
use scene::Scene;
use water::caustics::{Beams, Setting};
use water::flat::{Along, Fill, FlatWater, Lit, Part, Rules, Scattered, Source as Kind, SurfaceShade};
use water::scatter::{Bed, LAMP_TOLERANCE};
use water::waves::{Stokes, WaveError, Waves, WavyShade, Wind};
use water::{Paths, Tolerance};

use super::heavens::SKY;
use super::lights::{SUN, area};
use super::measuring::Way;
use super::qualities::of_scene as quality;
use crate::Error;
use crate::knobs::Settings;
use crate::pipeline::Source;

/// Places along and across a water at which one looks how deep it is.
const PLACES: usize = 33;
/// From how far below its level \[m\]: the surface itself is no bed.
const BELOW: f64 = 1e-3;

/// All waters of a scene; none without any.
pub(super) struct Waters {
    waters: Arc<[FlatWater]>,
    rules: Rules,
    /// On each of them.
    waves: Vec<Arc<Waves>>,
    /// How finely waves gather light; none = they do not.
    beams: Option<Setting>,
}

impl Waters {
    /// # Errors
    /// A water that there is not, with those that there are; waves that cannot be.
    pub(super) fn of(scene: &Scene, settings: &Settings) -> Result<Option<Self>, Error> {
        let flat = |water: &scene::Water| Ok(FlatWater::new(quality(water)?, &water.surface, &water.place));
        let waters = scene.waters.iter().map(flat).collect::<Result<Arc<[_]>, Error>>()?;
        let waves = scene.waters.iter().map(|water| Ok(Arc::new(waves(water, scene)?)));
        let waves = waves.collect::<Result<_, Error>>()?;
        let beams = (settings.choice("water.caustics") == "beams").then(|| Setting {
            cells: settings.number("water.caustics.cells"),
            width: settings.number("water.caustics.width"),
            disc: 0.0,
        });
        let rules = rules(settings);
        Ok((!waters.is_empty()).then_some(Self { waters, rules, waves, beams }))
    }

    /// The same over the beds that are met below their surfaces.
    pub(super) fn over_beds(self, nearest: &dyn Nearest) -> Self {
        let over = |water: &FlatWater| {
            let depth = |at: DVec2| {
                if !water.covers(at) {
                    return Some(0.0);
                }
                let from = Vec3::new(at.x as f32, (water.surface.level - BELOW) as f32, at.y as f32);
                match nearest.nearest(&Ray::new(from, Vec3::NEG_Y)) {
                    Some(hit) => Some(f64::from(hit.distance) + BELOW),
                    // Within a bank that the surface is drawn into.
                    None => nearest.nearest(&Ray::new(from, Vec3::Y)).filter(|hit| !hit.front).map(|_| 0.0),
                }
            };
            water.clone().over(Bed::new(water.extent(), PLACES, depth))
        };
        Self { waters: self.waters.iter().map(over).collect(), ..self }
    }

    /// A warning for each water whose beams are fewer than those asked for.
    pub(super) fn warnings(&self, scene: &Scene) -> Vec<String> {
        let of = |((water, flat), waves): ((&scene::Water, &FlatWater), &Arc<Waves>)| {
            let asked = self.beams?;
            let possible = asked.cells_over(flat, waves).filter(|possible| *possible < asked.cells)?;
            Some(format!(
                "[[water]] {:?} is too large for water.caustics.cells = {}: its beams are cut {possible:.2} to the length of its shortest \
                 wave ({:.3} m), no more than 4,194,304 of them; a smaller outline has finer lines of light",
                water.name,
                asked.cells,
                waves.shortest()?
            ))
        };
        scene.waters.iter().zip(&*self.waters).zip(&self.waves).filter_map(of).collect()
    }

    /// All of them.
    pub(super) fn flat(&self) -> &Arc<[FlatWater]> {
        &self.waters
    }

    /// The scene's geometry with the surfaces after it, whose materials begin with number `first`: what is seen, but hides
    /// no light.
    pub(super) fn seen(scene: &Scene, first: u32) -> Arc<Geometry> {
        let mut geometry = Geometry::clone(&scene.geometry);
        for (i, water) in scene.waters.iter().enumerate() {
            let mesh = light::Mesh { material: first + i as u32, ..water.surface.clone() };
            let index = geometry.meshes.len() as u32;
            geometry.meshes.push(mesh);
            geometry.instances.push(Instance { mesh: index, world_from_mesh: water.place });
        }
        Arc::new(geometry)
    }

    /// A shader for each surface.
    pub(super) fn shaders(&self) -> impl Iterator<Item = Box<dyn Shade>> {
        self.waves.iter().enumerate().map(|(i, waves)| -> Box<dyn Shade> {
            match waves.is_calm() {
                true => Box::new(SurfaceShade::new(Arc::clone(&self.waters), i)),
                false => Box::new(WavyShade::new(self.waters[i].surface, Arc::clone(waves))),
            }
        })
    }

    /// What fills them.
    pub(super) fn fill(&self) -> Fill {
        Fill::new(Arc::clone(&self.waters))
    }

    /// A source as it arrives above and below; its shadows are no straight lines any more.
    pub(super) fn lit(&self, scene: &Scene, settings: &Settings, source: Source) -> Source {
        let Some(kind) = kind(scene, settings, &source) else { return source };
        let light = self.bring(scene, (&source.name, kind), source.light.into(), Part::All);
        // Leaves see what water does to the sky; of beams there would be all the maps once more.
        let around = source.among_leaves.filter(|_| kind == Kind::Around);
        let among_leaves =
            around.map(|inner| self.bring(scene, (&source.name, kind), inner.into(), Part::All));
        Source { light, point: None, among_leaves, ..source }
    }

    /// A part of a source's light.
    fn bring(
        &self,
        scene: &Scene,
        (name, kind): (&str, Kind),
        inner: Arc<dyn Illuminate>,
        part: Part,
    ) -> Box<dyn Illuminate> {
        let waters = Arc::clone(&self.waters);
        let wavy = self.waves.iter().any(|waves| !waves.is_calm());
        match self.beams.filter(|_| kind != Kind::Around && wavy) {
            Some(setting) => {
                let sun = scene.sun.as_ref().filter(|_| name == SUN);
                let disc = sun.map_or(0.0, |sun| 0.5 * sun.diameter.to_radians());
                let how = (self.rules, Setting { disc, ..setting }, part);
                Box::new(Beams::new(inner, kind, waters, &self.waves, how))
            }
            None => Box::new(Lit::new(Box::new(inner), kind, waters, self.rules).only(part)),
        }
    }

    /// The same by the ways that its light takes, which together are all of it.
    pub(super) fn by_ways(&self, scene: &Scene, settings: &Settings, source: Source) -> Vec<(Source, Way)> {
        let Some(kind) = kind(scene, settings, &source) else { return vec![(source, Way::Direct)] };
        let inner: Arc<dyn Illuminate> = Arc::from(source.light);
        let along = |(way, part): (Way, Part)| {
            let light = self.bring(scene, (&source.name, kind), Arc::clone(&inner), part);
            let name = source.name.clone();
            (Source { name, light, beam: source.beam, point: None, among_leaves: None }, way)
        };
        let ways =
            [(Way::Direct, Part::Direct), (Way::Reflected, Part::Reflected), (Way::Through, Part::Through)];
        ways.into_iter().map(along).collect()
    }
}

/// How its light finds its way through a surface; none of a source that is none of the scene's.
fn kind(scene: &Scene, settings: &Settings, source: &Source) -> Option<Kind> {
    let sun = scene.sun.as_ref().filter(|_| source.name == SUN).map(|sun| Kind::Toward(sun.toward));
    let point = source.point.and_then(|point| match point {
        PointSource::Toward(toward) => Some(Kind::Toward(toward)),
        PointSource::At(position) => Some(Kind::At(position)),
        PointSource::Below { .. } => None,
    });
    let sky = (source.name == SKY).then_some(Kind::Around);
    let lamp = scene.area_lights.iter().find(|lamp| lamp.name == source.name);
    let lamp = || lamp.map(|lamp| Kind::Area(area(lamp, settings)));
    sun.or(point).or(sky).or_else(lamp)
}

fn rules(settings: &Settings) -> Rules {
    Rules {
        paths: match settings.choice("water.paths") {
            "thesis" => Paths::Thesis,
            _ => Paths::Exact,
        },
        scattered: match settings.choice("water.scattering") {
            "off" => Scattered::Off,
            "single" => Scattered::Once,
            _ => Scattered::Often,
        },
        along: match settings.choice("water.lamp-integral") {
            "steps" => Along::Steps(settings.number("water.lamp-step")),
            _ => {
                let relative = settings.number("water.lamp-tolerance");
                Along::Quadrature(Tolerance { relative, ..LAMP_TOLERANCE })
            }
        },
        window: settings.integer("water.sky-rays"),
        still: !settings.are_for_sensors(),
        shafts: settings.integer("water.sky-shafts"),
    }
}

/// The waves of a water, at its moment.
fn waves(water: &scene::Water, scene: &Scene) -> Result<Waves, Error> {
    let fault = |what: String, error: WaveError| {
        Error::Content(format!("[[water]] {:?}, {what}: {error}", water.name))
    };
    let given = water.waves.each.iter().enumerate().map(|(i, wave)| {
        Stokes::new(wave.amplitude, wave.wavelength, wave.toward, wave.phase)
            .map_err(|error| fault(format!("waves, number {}", i + 1), error))
    });
    let mut all = given.collect::<Result<Vec<_>, Error>>()?;
    if let Some(wind) = &water.waves.wind {
        let scene::Wind { speed, fetch, toward, depth, waves, seed } = *wind;
        let wind = Wind { speed, fetch, toward, depth, waves: waves as usize };
        all.extend(wind.raise(seed).map_err(|error| fault("wind".to_owned(), error))?);
    }
    // Phases count from where the file's coordinates do.
    let origin = DVec2::new(-scene.origin.x, -scene.origin.z);
    Ok(Waves::new(all, origin).at_moment(water.waves.moment))
}
