//! Light that surfaces send each other → one more source of the pipeline.

mod painted;
mod parted;
mod sides;
mod still;

use std::sync::Arc;

use light::{Arrival, Geometry, Illuminate, Nearest, Occlude, Place, Spectrum};
use radiosity::{
    Between, Cut, Interreflected, Linking, Links, Obstacles, Orders, Passage, Patches, Source as Sent,
    direct, solve,
};
use raytrace::surface::Surface;
use scene::Scene;
use water::flat::FlatWater;

use super::heavens::SKY;
use super::lights::SUN;
use super::materials;
use crate::knobs::Settings;
use crate::pipeline::Source;
use painted::Painted;
use parted::Parted;
use sides::{Sides, Sight};
use still::{Apart, Still};

/// What the layer of interreflected light is called.
pub(super) const NAME: &str = "interreflected";

/// Share of all light that may be left when it has gone round often enough: far below what patches leave.
const LEFT: f64 = 1e-5;

/// How often a patch is halved where its primary light is uneven: to an eighth of its edges.
const HALVINGS: u32 = 6;

/// Whether interreflected light is asked for.
pub(super) fn asked(settings: &Settings) -> bool {
    settings.choice("interreflection") == "patches"
}

/// What light from face to face meets.
#[derive(Clone, Copy)]
pub(super) struct Among<'a> {
    /// Things that light meets first, without water surfaces.
    pub(super) nearest: &'a dyn Nearest,
    /// Things in its way.
    pub(super) occlude: &'a dyn Occlude,
    /// All faces, water surfaces among them.
    pub(super) seen: &'a Geometry,
    pub(super) waters: Option<&'a Arc<[FlatWater]>>,
}

/// Patches, and what they see of each other: the same as long as nothing but the light changes.
pub(super) struct Linked {
    parted: Arc<Parted>,
    patches: Arc<Patches>,
    links: Links,
    linking: Linking,
    /// By patch: exitance of its own.
    emitted: Vec<Spectrum>,
    still: Option<Still>,
    /// Surfaces that the light passes.
    passages: Vec<Arc<dyn Passage>>,
}

impl Linked {
    /// Of a scene with these primary `sources`, of which sun and sky may change.
    pub(super) fn new(scene: &Scene, settings: &Settings, among: Among<'_>, sources: &[Source]) -> Self {
        let parted = Arc::new(Parted::new(&scene.geometry, &scene.waters));
        let still = among.waters.map(|waters| Still(Arc::clone(waters)));
        let surfaces: Vec<Option<Surface>> = scene.materials.iter().map(materials::matt).collect();
        let lamps: Vec<u32> = scene.area_lights.iter().filter_map(|lamp| lamp.face).collect();
        let all = Painted {
            geometry: &parted.geometry,
            surfaces: &surfaces,
            still: still.as_ref(),
            lamps: &lamps,
            sides: None,
        };
        let edge = settings.own_or("interreflection.patch").unwrap_or(0.0);
        let cut = Cut { edge, most: settings.integer("interreflection.patches") as usize };
        let tried = Patches::new(&parted.geometry, &all, &cut);
        let sides = reached(scene, (&tried, &all), &parted, among, sources);
        let painted = Painted { sides: Some(&sides), ..all };
        let patches = Arc::new(Patches::new(&parted.geometry, &painted, &cut));
        let linking = Linking {
            share: settings.number("interreflection.share"),
            rays: settings.integer("interreflection.rays"),
            closed: sides.sealed && is_all_faces(scene) && scene.waters.is_empty() && is_opaque(scene),
            ..Linking::default()
        };
        // Of curved bodies and trees nobody here knows where they are not.
        let obstacles = is_all_faces(scene).then(|| Obstacles::new(among.seen));
        let passages = match &still {
            Some(still) if settings.choice("interreflection.across") == "on" => still.passages(),
            _ => Vec::new(),
        };
        let between =
            Between { passages: &passages, obstacles: obstacles.as_ref(), ..Between::dry(among.occlude) };
        let links = links(&patches, still.as_ref(), &between, &linking);
        let emitted = patches.iter().map(|patch| painted.emitted(&patch)).collect();
        Self { parted, patches, links, linking, emitted, still, passages }
    }

    /// What the patches send each other of the light of `sources`.
    pub(super) fn source(&self, settings: &Settings, sources: &[Source], occlude: &dyn Occlude) -> Source {
        let direct = primary(&self.parted, &self.patches, sources.iter(), (occlude, HALVINGS));
        let orders = match settings.integer("interreflection.orders") {
            0 => Orders::Until(LEFT),
            count => Orders::Count(count),
        };
        let sent = Sent { emitted: &self.emitted, direct: &direct };
        let solution = solve(&self.patches, &self.links, &sent, orders);
        let patches = Arc::clone(&self.patches);
        let mut stage =
            Interreflected::new(&self.parted.geometry, patches, &self.links, &solution, &self.linking);
        if let Some(still) = &self.still {
            stage = stage.through(Arc::new(still.clone()), still.mirrors()).across(self.passages.clone());
        }
        let light = Stage { stage, parted: Arc::clone(&self.parted), still: self.still.clone() };
        Source { name: NAME.to_owned(), light: Box::new(light), beam: false, point: None, among_leaves: None }
    }
}

/// Whether faces are all there is.
fn is_all_faces(scene: &Scene) -> bool {
    scene.solids.is_empty() && scene.trees.is_empty()
}

/// Whether no face lets light pass.
fn is_opaque(scene: &Scene) -> bool {
    scene.geometry.meshes.iter().all(|mesh| mesh.opacity.is_none() && mesh.medium.is_none())
}

/// The sides of faces that light gets to.
fn reached(
    scene: &Scene,
    (patches, painted): (&Patches, &Painted<'_>),
    parted: &Parted,
    among: Among<'_>,
    sources: &[Source],
) -> Sides {
    let stands = |source: &&Source| source.name != SUN && source.name != SKY;
    let lamps = primary(parted, patches, sources.iter().filter(stands), (among.occlude, 0));
    let shines = |(patch, arrives): (radiosity::Patch, &Spectrum)| {
        !arrives.is_zero() || !painted.emitted(&patch).is_zero()
    };
    let lit: Vec<bool> = patches.iter().zip(&lamps).map(shines).collect();
    let passes = |material: u32| scene.materials.get(material as usize).is_some_and(|m| m.medium().is_some());
    let open = scene.sun.is_some() || scene.sky.is_some();
    Sides::new(patches, &lit, &Sight { nearest: among.nearest, parted, passes: &passes, open })
}

fn links(patches: &Patches, still: Option<&Still>, dry: &Between<'_>, linking: &Linking) -> Links {
    let Some(still) = still else { return Links::new(patches, dry, linking) };
    let apart = Apart { things: dry.occlude, still };
    let mirrors = still.mirrors();
    Links::new(patches, &Between { occlude: &apart, attenuate: still, mirrors: &mirrors, ..*dry }, linking)
}

/// By patch: irradiance by these sources.
fn primary<'a>(
    parted: &Parted,
    patches: &Patches,
    sources: impl Iterator<Item = &'a Source>,
    (occlude, halvings): (&dyn Occlude, u32),
) -> Vec<Spectrum> {
    let lights: Vec<_> = sources.map(|source| OnPieces { light: &*source.light, parted }).collect();
    let lights: Vec<&dyn Illuminate> = lights.iter().map(|light| light as &dyn Illuminate).collect();
    direct(patches, &lights, occlude, halvings)
}

/// A light that is asked for pieces of faces, and knows the faces.
struct OnPieces<'a> {
    light: &'a dyn Illuminate,
    parted: &'a Parted,
}

impl Illuminate for OnPieces<'_> {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        self.light.arrivals(place, occlude, receive);
    }

    fn arrivals_on(
        &self,
        face: [u32; 2],
        place: &Place,
        occlude: &dyn Occlude,
        receive: &mut dyn FnMut(Arrival),
    ) {
        self.light.arrivals_on(self.parted.whole(face), place, occlude, receive);
    }
}

/// Interreflected light on the scene's faces, and anywhere else.
///
/// *Left out:* what of it water scatters into rays: places that belong to no face get none when a picture asks. (Sensors get theirs.)
struct Stage {
    stage: Interreflected,
    parted: Arc<Parted>,
    still: Option<Still>,
}

impl Stage {
    /// Asks with the waters' surfaces in the way.
    fn ask(&self, occlude: &dyn Occlude, with: impl FnOnce(&dyn Occlude)) {
        match &self.still {
            Some(still) => with(&Apart { things: occlude, still }),
            None => with(occlude),
        }
    }
}

/// The face of a place that lies on none.
const NO_FACE: u32 = u32::MAX;

impl Illuminate for Stage {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        self.ask(occlude, |occlude| self.stage.arrivals(place, occlude, receive));
    }

    fn arrivals_on(
        &self,
        face: [u32; 2],
        place: &Place,
        occlude: &dyn Occlude,
        receive: &mut dyn FnMut(Arrival),
    ) {
        if face[0] == NO_FACE {
            return;
        }
        let piece = self.parted.piece(face, place.position.as_dvec3());
        self.ask(occlude, |occlude| self.stage.arrivals_on(piece, place, occlude, receive));
    }
}
