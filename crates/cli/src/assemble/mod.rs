//! Plan and scene → pipeline: the only place that names chapters.

mod banks;
mod heavens;
mod interreflection;
mod judge;
mod lights;
mod maps;
mod materials;
mod measuring;
mod open_sky;
mod qualities;
mod solids;
mod trees;
mod waters;

use std::sync::{Arc, OnceLock};

use light::{Bodies, First, Geometry, Nearest, Occlude, PointSource, Product, See, Shade, Traverse, View};
use raytrace::solid::{Acceleration, Solids};
use raytrace::{BruteForce, Quality, Rays, Supersample, World};
use scanline::{Knobs, Localised, Rule, Scanline, Shading};
use scene::{Camera, Scene};

use crate::Error;
use crate::knobs::Settings;
use crate::pipeline::{Count, Limits, Pipeline, Source};
use crate::plan::Plan;
use crate::shadows::NUMBERED;
use interreflection::{Among, Linked};
use waters::Waters;

#[cfg(test)]
pub(crate) use heavens::skies;
pub(crate) use heavens::{lacks, place_of_sun};
pub use judge::{Judge, Judged, Walks};
pub(crate) use lights::outline;
pub use maps::Maps;
pub(crate) use materials::mirrors;
pub use measuring::{Column, Measuring, Way};
pub(crate) use open_sky::OpenSky;
pub(crate) use qualities::{Optics, waters as water_names};
pub(crate) use trees::{Made, Worn, baked, from_photos, grown, names as tree_names};

/// Builds the stages that `plan` names for `scene`.
///
/// # Errors
/// What only building can find: a solid that cannot be.
pub fn assemble(plan: &Plan, scene: &Scene) -> Result<Pipeline, Error> {
    let standing = Standing::new(plan, scene)?;
    let mut sources = standing.light(plan, scene, &mut Maps::default());
    sources.extend(standing.interreflected(plan, scene, &sources));
    standing.pipeline(plan, scene, sources.into())
}

/// What neither a camera nor a sun that moves changes: who answers rays, and who shades.
pub struct Standing {
    traced: Traced,
    occlude: Arc<Product>,
    shade: Arc<[Box<dyn Shade>]>,
    waters: Option<Waters>,
    /// All trees, if there are any.
    stand: Option<Arc<::trees::Stand>>,
    /// What faces see of each other, once that has been asked for.
    linked: OnceLock<Linked>,
    /// What only building can find to be unusual, in words.
    pub warnings: Vec<String>,
}

impl Standing {
    /// Of this scene, as long as neither its things nor the plan's settings change.
    ///
    /// # Errors
    /// A solid that cannot be.
    pub fn new(plan: &Plan, scene: &Scene) -> Result<Self, Error> {
        let (solids, more) = solids::bodies(scene)?
            .map_or((None, Vec::new()), |dressed| (Some(dressed.solids), dressed.shaders));
        let waters = Waters::of(scene, &plan.settings)?;
        let seen = match waters {
            Some(_) => Waters::seen(scene, (scene.materials.len() + more.len()) as u32),
            None => Arc::clone(&scene.geometry),
        };
        let traced = Traced::of([&seen, &scene.geometry], plan, solids);
        let waters = waters.map(|waters| waters.over_beds(&*traced.dry()));
        let flat = waters.as_ref().map(|waters| &**waters.flat()).unwrap_or_default();
        let ground = trees::Ground { dry: &*traced.dry(), waters: flat };
        let planted = trees::stand(scene, &plan.settings, ground)?;
        let stand = planted.as_ref().and_then(|planted| planted.stand.clone());
        let occlude = Arc::new(Product(match plan.settings.choice("shadows") {
            "off" => Vec::new(),
            _ => traced.occlude().into_iter().chain(stand.iter().map(shading)).collect(),
        }));
        let surfaces = waters.iter().flat_map(Waters::shaders);
        let shade = scene.materials.iter().map(materials::shade).chain(more).chain(surfaces).collect();
        let mut warnings = banks::warnings(scene, flat, &*traced.dry());
        warnings.extend(waters.iter().flat_map(|waters| waters.warnings(scene)));
        warnings.extend(planted.iter().flat_map(trees::Planted::warnings));
        Ok(Self { traced, occlude, shade, waters, stand, linked: OnceLock::new(), warnings })
    }

    /// Without what is known of what faces see of each other.
    pub(crate) fn unlinked(self) -> Self {
        Self { linked: OnceLock::new(), ..self }
    }

    /// The scene's primary sources; `maps` have what is known of the sky's light, and keep what becomes known.
    pub fn light(&self, plan: &Plan, scene: &Scene, maps: &mut Maps) -> Vec<Source> {
        let bodies = self.traced.solids.as_ref().map(|[solids, _]| &**solids as &dyn Bodies);
        let sources = lights::sources(scene, &plan.settings, bodies, maps).into_iter();
        match &self.waters {
            Some(waters) => sources.map(|source| waters.lit(scene, &plan.settings, source)).collect(),
            None => sources.collect(),
        }
    }

    /// The same by the ways that light takes past water.
    fn light_by_ways(&self, plan: &Plan, scene: &Scene) -> Vec<(Source, Way)> {
        let bodies = self.traced.solids.as_ref().map(|[solids, _]| &**solids as &dyn Bodies);
        let sources = lights::sources(scene, &plan.settings, bodies, &mut Maps::default()).into_iter();
        match &self.waters {
            Some(waters) => {
                sources.flat_map(|source| waters.by_ways(scene, &plan.settings, source)).collect()
            }
            None => sources.map(|source| (source, Way::Direct)).collect(),
        }
    }

    /// What faces send each other of the light of the primary `sources`, if that is asked for.
    pub fn interreflected(&self, plan: &Plan, scene: &Scene, sources: &[Source]) -> Option<Source> {
        let settings = &plan.settings;
        interreflection::asked(settings).then(|| {
            let linked = self.linked.get_or_init(|| self.linked(settings, scene, sources));
            linked.source(settings, sources, &*self.occlude)
        })
    }

    /// What faces see of each other.
    fn linked(&self, settings: &Settings, scene: &Scene, sources: &[Source]) -> Linked {
        let among = Among {
            nearest: self.traced.first(),
            occlude: &*self.occlude,
            seen: &self.traced.seen,
            waters: self.waters.as_ref().map(Waters::flat),
        };
        Linked::new(scene, settings, among, sources)
    }

    /// What fills the space.
    fn between(&self) -> Vec<Arc<dyn Traverse>> {
        let fill = self.waters.as_ref().map(Waters::fill);
        let stand = self.stand.as_ref().map(Arc::clone);
        match (stand, fill) {
            (Some(stand), Some(fill)) => vec![Arc::new(trees::Submerged { stand, fill })],
            (Some(stand), None) => vec![stand],
            (None, Some(fill)) => vec![Arc::new(fill)],
            (None, None) => Vec::new(),
        }
    }

    /// All stages of one picture.
    ///
    /// # Errors
    /// A camera that the scene does not have.
    pub fn pipeline(&self, plan: &Plan, scene: &Scene, sources: Arc<[Source]>) -> Result<Pipeline, Error> {
        let (settings, view) = (&plan.settings, view(plan, scene)?);
        let (see, needed_rays) = see(plan, view, &self.traced, (&sources, &self.occlude));
        Ok(Pipeline {
            view,
            see,
            needed_rays,
            nearest: self.traced.nearest(),
            shade: Arc::clone(&self.shade),
            sources,
            occlude: Arc::clone(&self.occlude) as Arc<dyn Occlude>,
            between: self.between(),
            limits: Limits {
                depth: settings.integer("ray-depth") as u8,
                share: settings.number("ray-share") as f32,
                alike: settings.number("body.tolerance") as f32,
            },
        })
    }
}

/// Trees as what stands in light's way.
fn shading(stand: &Arc<::trees::Stand>) -> Box<dyn Occlude> {
    Box::new(Arc::clone(stand))
}

/// Who finds what the eye sees, and how many pixels have needed a ray for it.
fn see(
    plan: &Plan,
    view: View,
    traced: &Traced,
    (sources, occlude): (&[Source], &Arc<Product>),
) -> (Box<dyn See>, Option<Count>) {
    let settings = &plan.settings;
    let samples = settings.integer("samples");
    let per_face = settings.choice("shading") == "pixel";
    match (settings.choice("visibility"), &traced.eye) {
        // Faces met by several samples of a pixel are shaded once: for triangles alone.
        ("rays", Triangles::Bvh(world)) if per_face && traced.solids.is_none() => {
            (Box::new(Rays::new(Arc::clone(world), view, samples)), None)
        }
        ("rays", _) => (Box::new(Supersample::new(traced.nearest(), view, samples)), None),
        _ => {
            let mut scanline = Scanline::new(Arc::clone(&traced.seen), view, knobs(plan));
            if let Some(least) = plan.shadows.spans_from {
                let occlude = Arc::clone(occlude) as Arc<dyn Occlude>;
                scanline = scanline.with_shadows(points(sources), occlude).cut_from(least);
            }
            match &traced.solids {
                Some([solids, _]) => {
                    let bodies = Arc::clone(solids) as Arc<dyn Bodies>;
                    let samples = settings.integer("body.samples");
                    let local = Arc::new(Localised::new(scanline, bodies).with_samples(samples));
                    let count = Arc::clone(&local);
                    (Box::new(local), Some(Box::new(move || count.needed_rays())))
                }
                None => (Box::new(scanline), None),
            }
        }
    }
}

/// The sources that cast sharp shadows, by the numbers that the pipeline knows them by.
fn points(sources: &[Source]) -> Vec<(u32, PointSource)> {
    let numbered = sources.iter().take(NUMBERED).enumerate();
    numbered.filter_map(|(i, source)| Some((i as u32, source.point?))).collect()
}

/// Who answers rays: the eye's and mirrors' (`nearest`), and those that ask for shadows (`occlude`).
struct Traced {
    /// What the eye's rays and scanlines meet.
    seen: Arc<Geometry>,
    eye: Triangles,
    shadow: Triangles,
    solids: Option<[Arc<Solids>; 2]>,
}

/// Triangles in a hierarchy, or one after the other.
#[derive(Clone)]
enum Triangles {
    Bvh(Arc<World>),
    Every(Arc<BruteForce>),
}

impl Triangles {
    /// What is met first of these and the solids.
    fn with(&self, solids: Option<&Arc<Solids>>) -> Arc<dyn Nearest> {
        let triangles: Arc<dyn Nearest> = match self {
            Self::Bvh(world) => Arc::clone(world) as Arc<dyn Nearest>,
            Self::Every(every) => Arc::clone(every) as Arc<dyn Nearest>,
        };
        match solids {
            Some(solids) => Arc::new(First(vec![triangles, Arc::clone(solids) as Arc<dyn Nearest>])),
            None => triangles,
        }
    }
}

impl Traced {
    /// `accelerate` = none | view | bvh: the cases I and II, III and IV of the thesis' table 2.1.
    ///
    /// `seen` is what the eye meets, `hiding` what stands in light's way: less, where there is water.
    fn of([seen, hiding]: [&Arc<Geometry>; 2], plan: &Plan, solids: Option<Solids>) -> Self {
        let every = |geometry| Triangles::Every(Arc::new(BruteForce::new(Arc::clone(geometry))));
        let quality = match plan.settings.choice("bvh-quality") {
            "fast" => Quality::Fast,
            "best" => Quality::Best,
            _ => Quality::Medium,
        };
        let bvh = |geometry| Triangles::Bvh(Arc::new(World::build(Arc::clone(geometry), quality)));
        let (eye, shadow, boxes) = match plan.settings.choice("accelerate") {
            "none" => (every(seen), every(hiding), [Acceleration::None; 2]),
            "view" => (bvh(seen), every(hiding), [Acceleration::Boxes, Acceleration::None]),
            _ => {
                let eye = bvh(seen);
                let shadow = if Arc::ptr_eq(seen, hiding) { eye.clone() } else { bvh(hiding) };
                (eye, shadow, [Acceleration::Boxes; 2])
            }
        };
        let solids = solids.map(|solids| boxes.map(|boxes| Arc::new(solids.clone().with(boxes))));
        Self { seen: Arc::clone(seen), eye, shadow, solids }
    }

    fn nearest(&self) -> Arc<dyn Nearest> {
        self.eye.with(self.solids.as_ref().map(|[solids, _]| solids))
    }

    /// What there is without water surfaces.
    fn dry(&self) -> Arc<dyn Nearest> {
        self.shadow.with(self.solids.as_ref().map(|[_, solids]| solids))
    }

    /// What light between faces meets first: triangles alone, without water surfaces.
    fn first(&self) -> &dyn Nearest {
        match &self.shadow {
            Triangles::Bvh(world) => &**world,
            Triangles::Every(every) => &**every,
        }
    }

    fn occlude(&self) -> Vec<Box<dyn Occlude>> {
        let triangles: Box<dyn Occlude> = match &self.shadow {
            Triangles::Bvh(world) => Box::new(Arc::clone(world)),
            Triangles::Every(every) => Box::new(Arc::clone(every)),
        };
        let solids = self.solids.iter().map(|[_, solids]| Box::new(Arc::clone(solids)) as Box<dyn Occlude>);
        std::iter::once(triangles).chain(solids).collect()
    }
}

fn knobs(plan: &Plan) -> Knobs {
    let settings = &plan.settings;
    Knobs {
        sub_scanlines: settings.integer("sub-scanlines"),
        rule: match settings.choice("scan-rule") {
            "trapezoid" => Rule::Trapezoid,
            "midpoint" => Rule::Midpoint,
            _ => Rule::Exact,
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
