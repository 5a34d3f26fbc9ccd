//! Waters of the scene → their surfaces among what is seen, what fills them, and what their surfaces do to lights.

use std::sync::Arc;

use light::{Geometry, Instance, PointSource, Shade, Spectrum, Traverse};
use scene::Scene;
use water::flat::{Along, Fill, FlatWater, Lit, Rules, Scattered, Source as Kind, SurfaceShade};
use water::scatter::LAMP_TOLERANCE;
use water::{Paths, Tolerance, Water};

use super::heavens::SKY;
use super::lights::{SUN, area};
use crate::Error;
use crate::knobs::Settings;
use crate::pipeline::Source;

/// All waters of a scene; none without any.
pub(super) struct Waters {
    waters: Arc<[FlatWater]>,
    rules: Rules,
}

impl Waters {
    /// # Errors
    /// A water that there is not, with those that there are.
    pub(super) fn of(scene: &Scene, settings: &Settings) -> Result<Option<Self>, Error> {
        let flat = |water: &scene::Water| Ok(FlatWater::new(quality(water)?, &water.surface, &water.place));
        let waters = scene.waters.iter().map(flat).collect::<Result<Arc<[_]>, Error>>()?;
        Ok((!waters.is_empty()).then_some(Self { waters, rules: rules(settings) }))
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
        (0..self.waters.len())
            .map(|i| -> Box<dyn Shade> { Box::new(SurfaceShade::new(Arc::clone(&self.waters), i)) })
    }

    pub(super) fn fill(&self) -> Arc<dyn Traverse> {
        Arc::new(Fill::new(Arc::clone(&self.waters)))
    }

    /// Sources as they arrive above and below; their shadows are no straight lines any more. Lamps with an extent are last, in the
    /// scene's order.
    pub(super) fn lit_all(
        &self,
        scene: &Scene,
        settings: &Settings,
        sources: impl ExactSizeIterator<Item = Source>,
    ) -> Arc<[Source]> {
        let points = sources.len() - scene.area_lights.len();
        let lamp = |i: usize| i.checked_sub(points).and_then(|i| scene.area_lights.get(i));
        let area = |i| lamp(i).map(|lamp| Kind::Area(area(lamp, settings)));
        sources.enumerate().map(|(i, source)| self.lit(scene, source, area(i))).collect()
    }

    fn lit(&self, scene: &Scene, source: Source, area: Option<Kind>) -> Source {
        let sun = scene.sun.as_ref().filter(|_| source.name == SUN).map(|sun| Kind::Toward(sun.toward));
        let point = source.point.and_then(|point| match point {
            PointSource::Toward(toward) => Some(Kind::Toward(toward)),
            PointSource::At(position) => Some(Kind::At(position)),
            PointSource::Below { .. } => None,
        });
        let sky = (source.name == SKY).then_some(Kind::Around);
        let Some(kind) = area.or(sun).or(point).or(sky) else { return source };
        Source {
            light: Box::new(Lit::new(source.light, kind, Arc::clone(&self.waters), self.rules)),
            point: None,
            ..source
        }
    }
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
        shafts: settings.integer("water.sky-shafts"),
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
