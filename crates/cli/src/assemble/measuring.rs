//! The pipeline of `keikan lux`: a source for every way that light takes.

use std::fmt;
use std::sync::Arc;

use light::Nearest;
use scene::Scene;

use super::{Maps, Standing, interreflection};
use crate::Error;
use crate::knobs::Settings;
use crate::pipeline::{Pipeline, Source};
use crate::plan::Plan;

/// How light gets from a source to a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// Past no water surface and off no face.
    Direct,
    /// Off a water surface, from above or from below.
    Reflected,
    /// Through a water surface.
    Through,
    /// Off faces, diffusely.
    Interreflected,
}

impl Way {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Direct, Self::Reflected, Self::Through, Self::Interreflected];
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direct => "direct",
            Self::Reflected => "reflected",
            Self::Through => "through",
            Self::Interreflected => "interreflected",
        })
    }
}

/// One source, or what of its light takes a certain way.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Column {
    /// Its name.
    pub source: String,
    /// Which way.
    pub way: Way,
}

/// What sensors are asked with.
pub struct Measuring {
    /// Its sources are the columns.
    pub pipeline: Pipeline,
    /// What stands there, without water surfaces.
    pub dry: Arc<dyn Nearest>,
    /// What its columns are.
    pub columns: Vec<Column>,
    /// Interreflected light by coarser patches, to see how far they leave it off.
    pub coarser: Option<Source>,
    /// What only building could find to be unusual, in words.
    pub warnings: Vec<String>,
}

/// How many times fewer patches, or longer ones and links of larger shares, the coarser ones are.
const COARSER: [f64; 2] = [4.0, 2.0];

impl Measuring {
    /// For the sensors of `scene`.
    ///
    /// # Errors
    /// As [`super::assemble`].
    pub fn new(plan: &Plan, scene: &Scene) -> Result<Self, Error> {
        let standing = Standing::new(plan, scene)?;
        let (interreflected, coarser) = match interreflection::asked(&plan.settings) {
            true => {
                let whole = standing.light(plan, scene, &mut Maps::default());
                let coarse = standing.linked(&coarser(plan)?, scene, &whole);
                let coarse = coarse.source(&plan.settings, &whole, &*standing.occlude);
                (standing.interreflected(plan, scene, &whole), Some(coarse))
            }
            false => (None, None),
        };
        let mut parts = standing.light_by_ways(plan, scene);
        parts.extend(interreflected.map(|source| (source, Way::Interreflected)));
        let (sources, columns): (Vec<_>, Vec<_>) = parts
            .into_iter()
            .map(|(source, way)| {
                let column = Column { source: source.name.clone(), way };
                (source, column)
            })
            .unzip();
        let pipeline = standing.pipeline(plan, scene, sources.into())?;
        Ok(Self { pipeline, dry: standing.traced.dry(), columns, coarser, warnings: standing.warnings })
    }
}

/// The settings with fewer patches, and coarser links between them.
fn coarser(plan: &Plan) -> Result<Settings, Error> {
    let mut settings = plan.settings.clone();
    let [fewer, longer] = COARSER;
    let most = (f64::from(settings.integer("interreflection.patches")) / fewer).max(16.0) as u32;
    settings.set("interreflection.patches", &most.to_string(), "keikan lux")?;
    if let Some(edge) = settings.own_or("interreflection.patch") {
        let edge = (edge * longer).min(1e6);
        settings.set("interreflection.patch", &edge.to_string(), "keikan lux")?;
    }
    let share = (settings.number("interreflection.share") * longer).min(1.0);
    settings.set("interreflection.share", &share.to_string(), "keikan lux")?;
    Ok(settings)
}
