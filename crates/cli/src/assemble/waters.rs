//! Waters of the scene → their surfaces among what is seen, what fills them, and what their surfaces do to lights.

use std::sync::Arc;

use glam::DVec2;
use light::{Geometry, Illuminate, Instance, PointSource, Shade, Spectrum, Traverse};
use scene::Scene;
use water::caustics::{Beams, Setting};
use water::flat::{Fill, FlatWater, Lit, Source as Kind, SurfaceShade};
use water::waves::{Stokes, WaveError, Waves, WavyShade, Wind};
use water::{Paths, Water};

use super::heavens::SKY;
use super::lights::SUN;
use crate::Error;
use crate::knobs::Settings;
use crate::pipeline::Source;

/// All waters of a scene; none without any.
pub(super) struct Waters {
    waters: Arc<[FlatWater]>,
    /// On each of them.
    waves: Vec<Arc<Waves>>,
    paths: Paths,
    /// How finely waves gather light; none = they do not.
    beams: Option<Setting>,
}

impl Waters {
    /// # Errors
    /// A water that there is not, with those that there are; waves that cannot be.
    pub(super) fn of(scene: &Scene, settings: &Settings) -> Result<Option<Self>, Error> {
        let flat = |water: &scene::Water| Ok(FlatWater::new(quality(water)?, &water.surface, &water.place));
        let paths = match settings.choice("water.paths") {
            "thesis" => Paths::Thesis,
            _ => Paths::Exact,
        };
        let waters = scene.waters.iter().map(flat).collect::<Result<Arc<[_]>, Error>>()?;
        let waves = scene.waters.iter().map(|water| Ok(Arc::new(waves(water, scene)?)));
        let waves = waves.collect::<Result<_, Error>>()?;
        let beams = (settings.choice("water.caustics") == "beams").then(|| Setting {
            cells: settings.number("water.caustics.cells"),
            width: settings.number("water.caustics.width"),
            disc: 0.0,
        });
        Ok((!waters.is_empty()).then_some(Self { waters, waves, paths, beams }))
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

    pub(super) fn fill(&self) -> Arc<dyn Traverse> {
        Arc::new(Fill::new(Arc::clone(&self.waters)))
    }

    /// A source as it arrives above and below; its shadows are no straight lines any more. A lamp with an extent stays as
    /// it is, and goes through water as through air.
    pub(super) fn lit(&self, scene: &Scene, source: Source) -> Source {
        let sun = scene.sun.as_ref().filter(|_| source.name == SUN).map(|sun| Kind::Toward(sun.toward));
        let point = source.point.map(|point| match point {
            PointSource::Toward(toward) => Kind::Toward(toward),
            PointSource::At(position) => Kind::At(position),
        });
        let sky = (source.name == SKY).then_some(Kind::Around);
        let Some(kind) = sun.or(point).or(sky) else { return source };
        let waters = Arc::clone(&self.waters);
        let beams =
            self.beams.filter(|_| kind != Kind::Around && self.waves.iter().any(|waves| !waves.is_calm()));
        let light: Box<dyn Illuminate> = match beams {
            Some(setting) => {
                let sun = scene.sun.as_ref().filter(|_| source.name == SUN);
                let disc = sun.map_or(0.0, |sun| 0.5 * sun.diameter.to_radians());
                let how = (self.paths, Setting { disc, ..setting });
                Box::new(Beams::new(source.light.into(), kind, waters, &self.waves, how))
            }
            None => Box::new(Lit::new(source.light, kind, waters, self.paths)),
        };
        Source { light, point: None, ..source }
    }
}

/// The water that absorbs and scatters nothing.
const CLEAR: &str = "clear";

fn quality(asked: &scene::Water) -> Result<Water, Error> {
    let fault =
        |error: &dyn std::fmt::Display| Error::Content(format!("[[water]] {:?}: {error}", asked.name));
    let named = match asked.quality.as_str() {
        CLEAR => {
            Water::named("distilled").and_then(|water| Water::new(Spectrum::ZERO, Vec::new(), water.index()))
        }
        name => Water::named(name),
    };
    let named = named.map_err(|error| fault(&error))?;
    let Some(index) = asked.index else { return Ok(named) };
    Water::new(named.absorption(), named.scatterers().to_vec(), index).map_err(|error| fault(&error))
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
