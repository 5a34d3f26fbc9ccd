//! Interreflected light as a stage of the pipeline.

use std::sync::Arc;

use light::{Arrival, Geometry, Illuminate, Occlude, Place, Spectrum};

use crate::between::{Attenuate, Between, Clear, Mirror};
use crate::gather::{Gather, Receiver};
use crate::passage::Passage;
use crate::tree::Node;
use crate::vertices::Vertices;
use crate::{Linking, Links, Patches, Solution};

/// Light that other surfaces reflect diffusely, without primary light.
///
/// *On faces* it is interpolated between the corners of patches, linearly: without a step from patch to patch, nor from face to
/// face where they go on smoothly (one plane, or equal normals) and share an edge. The mean over each patch is nearly that of
/// the solution. What changes within a patch (sharp contact shadows) is smoothed to its size.
///
/// *Elsewhere* (sensors, bodies, sides that take no part) all patches are gathered, at some hundred times the cost: exact
/// form factors from the point, ways tried by the place's seed.
///
/// *Known to be wrong:* light leaks by the width of a patch below a wall that stands on a face without an edge there.
pub struct Interreflected {
    patches: Arc<Patches>,
    vertices: Vertices,
    /// By node: exitance as links see it.
    sent: Vec<Spectrum>,
    attenuate: Arc<dyn Attenuate>,
    mirrors: Vec<Arc<dyn Mirror>>,
    passages: Vec<Arc<dyn Passage>>,
    share: f64,
    rays: u32,
}

impl Interreflected {
    /// The stage of a solution. `geometry` is what the patches were made of; gathering is as fine as `linking`.
    pub fn new(
        geometry: &Geometry,
        patches: Arc<Patches>,
        links: &Links,
        solution: &Solution,
        linking: &Linking,
    ) -> Self {
        let vertices = Vertices::new(geometry, &patches, &solution.irradiance);
        let sent = links.sent(&patches, &solution.exitance);
        let (share, rays) = (links.share(), linking.rays);
        let (attenuate, mirrors, passages) = (Arc::new(Clear), Vec::new(), Vec::new());
        Self { patches, vertices, sent, attenuate, mirrors, passages, share, rays }
    }

    /// The same with a medium and mirrors between the patches, as the links had them.
    pub fn through(mut self, attenuate: Arc<dyn Attenuate>, mirrors: Vec<Arc<dyn Mirror>>) -> Self {
        (self.attenuate, self.mirrors) = (attenuate, mirrors);
        self
    }

    /// The same with surfaces that light passes, as the links had them.
    pub fn across(mut self, passages: Vec<Arc<dyn Passage>>) -> Self {
        self.passages = passages;
        self
    }

    /// Vertices that values are kept at.
    pub fn vertices(&self) -> usize {
        self.vertices.len()
    }

    /// Irradiance at a place by gathering all patches, whether or not it is on a face \[W m⁻² nm⁻¹\].
    pub fn gathered(&self, place: &Place, occlude: &dyn Occlude) -> Spectrum {
        let between = Between {
            occlude,
            attenuate: &*self.attenuate,
            mirrors: &self.mirrors,
            passages: &self.passages,
            obstacles: None,
        };
        let gather = Gather {
            patches: &self.patches,
            between: &between,
            share: self.share,
            rays: self.rays,
            seed: place.seed,
        };
        let point = Node::point(place.position.as_dvec3(), place.normal.as_dvec3());
        // A place on a surface's border is lit where it looks.
        let part = between.part(point.centre + point.normal * OFF);
        let receiver = Receiver { node: &point, name: place.seed, error: place.error, part };
        let mut sum = Spectrum::ZERO;
        gather.all(&receiver, &mut |seen| {
            sum += self.sent[seen.source as usize] * seen.tint * seen.share as f32;
        });
        sum
    }

    fn interpolated(&self, face: [u32; 2], place: &Place) -> Option<Spectrum> {
        let side = self.patches.side(face, place.normal.as_dvec3())?;
        let (patch, weights) = self.patches.locate(face, side, place.position.as_dvec3())?;
        Some(self.vertices.at(patch, weights))
    }
}

/// How far in front of a place \[m\] tells which part of space it is in.
const OFF: f64 = 1e-3;

impl Illuminate for Interreflected {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let irradiance = self.gathered(place, occlude);
        if !irradiance.is_zero() {
            receive(Arrival::Field { irradiance });
        }
    }

    fn arrivals_on(
        &self,
        face: [u32; 2],
        place: &Place,
        occlude: &dyn Occlude,
        receive: &mut dyn FnMut(Arrival),
    ) {
        match self.interpolated(face, place) {
            Some(irradiance) if irradiance.is_zero() => {}
            Some(irradiance) => receive(Arrival::Field { irradiance }),
            None => self.arrivals(place, occlude, receive),
        }
    }
}
