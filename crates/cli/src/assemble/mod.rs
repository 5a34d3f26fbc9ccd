//! Plan and scene → pipeline: the only place that names chapters.

mod lights;
mod materials;

pub(crate) use materials::mirrors;

use std::sync::Arc;

use light::{Geometry, Nearest, Occlude, Product, See, View};
use raytrace::{BruteForce, Quality, Rays, World};
use scanline::{Knobs, Rule, Scanline, Shading};
use scene::{Camera, Scene};

use crate::Error;
use crate::pipeline::{Limits, Pipeline};
use crate::plan::Plan;

/// Builds the stages that `plan` names for `scene`.
///
/// # Errors
/// Usage errors for what the plan could not check: a model of the sky that does not exist.
pub fn assemble(plan: &Plan, scene: &Scene) -> Result<Pipeline, Error> {
    let settings = &plan.settings;
    let geometry = Arc::clone(&scene.geometry);
    let view = view(plan, scene)?;
    let sources = lights::sources(scene, settings)?;
    let rays = Stages::of(&geometry, plan);
    let see: Box<dyn See> = match (settings.choice("visibility"), &rays) {
        ("rays", Stages::Bvh(world)) => {
            Box::new(Rays::new(Arc::clone(world), view, settings.integer("samples")))
        }
        ("rays", Stages::Every(_)) => {
            return Err(Error::Usage(
                "visibility = rays needs accelerate = bvh (every face in turn is for shadows and mirrors only)".to_owned(),
            ));
        }
        _ => Box::new(Scanline::new(Arc::clone(&geometry), view, knobs(plan))),
    };
    let occlude = match settings.choice("shadows") {
        "off" => Vec::new(),
        _ => vec![rays.occlude()],
    };
    Ok(Pipeline {
        view,
        see,
        nearest: rays.nearest(),
        shade: scene.materials.iter().map(materials::shade).collect(),
        sources,
        occlude: Box::new(Product(occlude)),
        limits: Limits {
            depth: settings.integer("ray-depth") as u8,
            share: settings.number("ray-share") as f32,
        },
    })
}

/// Who answers rays.
enum Stages {
    Bvh(Arc<World>),
    Every(Arc<BruteForce>),
}

impl Stages {
    fn of(geometry: &Arc<Geometry>, plan: &Plan) -> Self {
        match plan.settings.choice("accelerate") {
            "none" => Self::Every(Arc::new(BruteForce::new(Arc::clone(geometry)))),
            _ => {
                let quality = match plan.settings.choice("bvh-quality") {
                    "fast" => Quality::Fast,
                    "best" => Quality::Best,
                    _ => Quality::Medium,
                };
                Self::Bvh(Arc::new(World::build(Arc::clone(geometry), quality)))
            }
        }
    }

    fn occlude(&self) -> Box<dyn Occlude> {
        match self {
            Self::Bvh(world) => Box::new(Arc::clone(world)),
            Self::Every(every) => Box::new(Arc::clone(every)),
        }
    }

    fn nearest(&self) -> Arc<dyn Nearest> {
        match self {
            Self::Bvh(world) => Arc::clone(world) as Arc<dyn Nearest>,
            Self::Every(every) => Arc::clone(every) as Arc<dyn Nearest>,
        }
    }
}

fn knobs(plan: &Plan) -> Knobs {
    let settings = &plan.settings;
    Knobs {
        sub_scanlines: settings.integer("sub-scanlines"),
        rule: match settings.choice("scan-rule") {
            "trapezoid" => Rule::Trapezoid,
            _ => Rule::Midpoint,
        },
        shading: match settings.choice("shading") {
            "span" => Shading::PerSpan,
            _ => Shading::PerPixel,
        },
    }
}

fn view(plan: &Plan, scene: &Scene) -> Result<View, Error> {
    let camera: &Camera = plan
        .camera(scene)
        .ok_or_else(|| Error::Usage(format!("the scene has no camera named \"{}\"", plan.camera)))?;
    Ok(View {
        eye: camera.position,
        world_from_view: camera.world_from_camera,
        projection: camera.projection,
        width: plan.width,
        height: plan.height,
        near: camera.near,
    })
}
