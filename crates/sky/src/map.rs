//! Illuminance maps: the light of the sky kept at points of every face (thesis 4.4).

mod buried;
mod kept;
mod key;
mod point;
mod refine;
mod seams;
mod settings;
mod shelves;
mod sights;
mod tree;

use std::sync::{Arc, OnceLock};

use glam::{DVec2, DVec3, Vec3};
use light::bands::BANDS;
use light::{Arrival, Geometry, Illuminate, Occlude, Place, Ray, Spectrum};
use rayon::prelude::*;

use crate::WholeSky;
pub use kept::KeptError;
pub use key::{Described, Fnv, Key};
use point::Point;
use seams::Seams;
pub use settings::Settings;
use shelves::{PointKey, Shelves};
pub use sights::Sights;
use tree::FaceMap;

/// One of the two sides of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The one it is wound for.
    Front,
    /// The other.
    Back,
}

/// A sky whose light is kept at points of every face and interpolated between them.
///
/// *Stored* is, per side of a face and point, V = E/E_open(n) with n the interpolated normal there, within \[0, 1\];
/// the answer for a normal m is V · E_open(m), exact for the one it was found with. Places on no known face (sensors,
/// bodies) are passed on to the inner stage.
///
/// *Between the points* of a cell V is linear (eq. 4.24 for triangles), without a step from cell to cell, nor from face
/// to face where the mesh goes on smoothly (one plane, or equal normals). Where two meshes touch, or an edge meets
/// the middle of another, both sides are right within the tolerance each, but not equal.
///
/// *Made when asked for* first, from the face alone: results do not depend on who asks when, as long as all ask with
/// the same occluder. That is not looked at again.
///
/// *Errors.* Points inside of what stands on a face, at which nothing at all arrives, take the mean of their lit
/// neighbours; so do wholly dark ones beyond a wall thinner than a cell, which shows as a strip of light as wide as
/// `least`. What lies wholly between points of `coarse` is missed. Twisted normals count as if what
/// hides the sky hid the same share of it for them.
///
/// ```
/// use std::sync::Arc;
/// use glam::{DAffine3, Vec3};
/// use light::{Geometry, Illuminate, Instance, Mesh, Place, Spectrum, Uniform, Vacuum};
/// use keikan_sky::map::{Described, Mapped, Settings};
///
/// let positions = vec![Vec3::ZERO, Vec3::Z * 9.0, Vec3::X * 9.0];
/// let lawn = Mesh { positions, triangles: vec![[0, 1, 2]], ..Mesh::default() };
/// let placed = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
/// let geometry = Arc::new(Geometry { meshes: vec![lawn], instances: vec![placed] });
///
/// let sky = Arc::new(Uniform { radiance: Spectrum::ONE });
/// let map = Mapped::new(sky, geometry, Settings::default(), &Described::default());
/// let place = Place { position: Vec3::new(2.0, 0.0, 3.0), error: 1e-6, normal: Vec3::Y, seed: 1 };
/// let mut sum = Spectrum::ZERO;
/// map.arrivals_on([0, 0], &place, &Vacuum, &mut |arrival| sum += arrival.on_plane(Vec3::Y));
/// assert_eq!(sum, Spectrum::splat(std::f32::consts::PI));
/// ```
pub struct Mapped {
    inner: Arc<dyn WholeSky>,
    geometry: Arc<Geometry>,
    settings: Settings,
    key: Key,
    /// By mesh.
    seams: Vec<Seams>,
    /// Triangles of all placements before each, and of all.
    before: Vec<usize>,
    /// By triangle of all placements: front, back.
    faces: Vec<[OnceLock<Box<FaceMap>>; 2]>,
    shared: Shelves<Spectrum>,
    sights: Option<Arc<Sights>>,
}

/// A side of a face.
#[derive(Clone, Copy)]
struct FaceSide {
    /// Instance and triangle.
    face: [u32; 2],
    /// 0 = front, 1 = back.
    side: usize,
}

impl Mapped {
    /// An empty map of `inner` over all of `geometry`; `described` is part of [`Self::key`]. Nothing is asked for yet.
    pub fn new(
        inner: Arc<dyn WholeSky>,
        geometry: Arc<Geometry>,
        settings: Settings,
        described: &Described,
    ) -> Self {
        let key = Key::new(&geometry, &settings, described);
        let seams = geometry.meshes.par_iter().map(Seams::new).collect();
        let mut before = vec![0];
        for instance in &geometry.instances {
            let count = geometry.meshes[instance.mesh as usize].triangles.len();
            before.push(before[before.len() - 1] + count);
        }
        let faces = (0..before[before.len() - 1]).map(|_| Default::default()).collect();
        Self {
            inner,
            geometry,
            settings,
            key,
            seams,
            before,
            faces,
            shared: Shelves::default(),
            sights: None,
        }
    }

    /// The same, with what its points see kept in `sights`, if these belong to it and the inner stage parts that from how bright
    /// the sky is ([`WholeSky::patches`]).
    pub fn with_sights(mut self, sights: Arc<Sights>) -> Self {
        self.sights = sights.belong_to(self.key).then_some(sights);
        self
    }

    /// What its values belong to.
    pub fn key(&self) -> Key {
        self.key
    }

    /// Makes the maps of these sides of all faces, in parallel.
    pub fn prepare(&self, occlude: &dyn Occlude, sides: &[Side]) {
        (0..self.before.len() - 1).into_par_iter().for_each(|instance| {
            let count = (self.before[instance + 1] - self.before[instance]) as u32;
            (0..count).into_par_iter().for_each(|triangle| {
                for &side in sides {
                    let face = [instance as u32, triangle];
                    if self.outward(face) != DVec3::ZERO {
                        self.face_map(FaceSide { face, side: side as usize }, occlude);
                    }
                }
            });
        });
    }

    /// How many sides of faces are made, how many points they have, and what all this takes \[bytes\].
    pub fn size(&self) -> [usize; 3] {
        let made = self.made();
        let points = made.iter().map(|(_, face)| face.values.len()).sum();
        let bytes = made.iter().map(|(_, face)| face.bytes()).sum::<usize>();
        [
            made.len(),
            points,
            bytes + size_of_val(&*self.faces) + self.shared.size()[1] * size_of::<(PointKey, Spectrum)>(),
        ]
    }

    /// All that is made so far, for [`Self::recall`] in another run.
    pub fn to_bytes(&self) -> Vec<u8> {
        kept::write(&self.key, &self.made())
    }

    /// Takes over what [`Self::to_bytes`] of a map of the same key has made, so many sides of faces; one that is made already stays.
    ///
    /// # Errors
    /// What is damaged, or belongs to other places, or to another sky: under another sun other cells may be needed, and
    /// [`Sights`] spare what is dear.
    pub fn recall(&mut self, bytes: &[u8]) -> Result<usize, KeptError> {
        let (key, faces) = kept::read(bytes, 2 * self.faces.len())?;
        if key.places != self.key.places {
            return Err(KeptError::OtherPlaces);
        }
        if key.sky != self.key.sky {
            return Err(KeptError::OtherSky);
        }
        let count = faces.len();
        for (slot, face) in faces {
            self.faces[slot / 2][slot % 2].get_or_init(|| Box::new(face));
        }
        Ok(count)
    }

    /// All that is made, by slot.
    fn made(&self) -> Vec<(usize, &FaceMap)> {
        let sides = self.faces.as_flattened().iter().enumerate();
        sides.filter_map(|(slot, side)| Some((slot, &**side.get()?))).collect()
    }

    /// Unit normal of a face on the side it is wound for; 0 without an area.
    fn outward(&self, [instance, triangle]: [u32; 2]) -> DVec3 {
        point::outward(&self.geometry, instance, &self.geometry.triangle(instance, triangle))
    }

    fn slot(&self, [instance, triangle]: [u32; 2], side: usize) -> usize {
        2 * (self.before[instance as usize] + triangle as usize) + side
    }

    fn face_map(&self, on: FaceSide, occlude: &dyn Occlude) -> &FaceMap {
        let [instance, triangle] = on.face;
        let slot = self.slot(on.face, on.side);
        self.faces[slot / 2][slot % 2].get_or_init(|| {
            let seams = &self.seams[self.geometry.instances[instance as usize].mesh as usize];
            let world = self.geometry.triangle(instance, triangle);
            let mut value = |at| self.value(Point::of(seams, triangle, at), on, occlude);
            let mut map = refine::refine(&world, &self.settings, &mut value);
            buried::fill(&mut map, &world, self.settings.least, seams.shared(triangle));
            Box::new(map)
        })
    }

    /// V at a point, whoever's it is.
    fn value(&self, point: Point, on: FaceSide, occlude: &dyn Occlude) -> Spectrum {
        let face = [on.face[0], point.triangle];
        let slot = self.slot(face, on.side);
        let find = || {
            // The owner's own normal, on the side that is asked for.
            let outward = self.outward(face);
            let facing = if on.side == 0 { outward } else { -outward };
            let place = point::place(&self.geometry, face, point.at, facing.as_vec3(), self.settings.inset);
            let place = Place { seed: self.settings.seed, ..place };
            self.share(place.normal, self.arriving((slot, point.at), &place, occlude))
        };
        if point.shared { self.shared.of(slot, point.at, find) } else { find() }
    }

    /// Irradiance at a point; by what is known of it already, where such is kept.
    fn arriving(&self, (slot, at): (usize, DVec2), place: &Place, occlude: &dyn Occlude) -> Spectrum {
        match (self.inner.patches(), &self.sights) {
            (Some(patches), Some(sights)) => {
                let sight = sights.of(slot, at, || patches.sight(place, occlude));
                patches.through(place.normal, &sight)
            }
            _ => self.inner.irradiance(place, occlude),
        }
    }

    /// E/E_open, within \[0, 1\]; 0 in bands that have no light.
    fn share(&self, normal: Vec3, there: Spectrum) -> Spectrum {
        let open = self.inner.open_irradiance(normal);
        let share =
            |band: usize| if open[band] > 0.0 { (there[band] / open[band]).clamp(0.0, 1.0) } else { 0.0 };
        let shares: [f32; BANDS] = std::array::from_fn(share);
        // clamp leaves NaN, which an inner stage must not give, but must not spread either.
        Spectrum(shares.map(|share| if share >= 0.0 { share } else { 0.0 }))
    }

    /// Which side of which face a place is on, and the weights of the face's corners there; none off all faces.
    fn locate(&self, face: [u32; 2], place: &Place) -> Option<(FaceSide, [f64; 3])> {
        let [instance, triangle] = face;
        let placed = self.geometry.instances.get(instance as usize)?;
        if triangle as usize >= self.geometry.meshes[placed.mesh as usize].triangles.len() {
            return None;
        }
        let world = self.geometry.triangle(instance, triangle);
        let cross = world.cross();
        let [a, b, c] = world.0;
        let p = place.position.as_dvec3() - a;
        // Areas of the two parts across from the second and the third corner, over the whole.
        let at = DVec2::new(p.cross(c - a).dot(cross), (b - a).cross(p).dot(cross)) / cross.length_squared();
        if !at.is_finite() {
            return None;
        }
        let v = at.x.clamp(0.0, 1.0);
        let w = at.y.clamp(0.0, 1.0 - v);
        let outward = point::outward(&self.geometry, instance, &world);
        let front = outward.dot(place.normal.as_dvec3()) >= 0.0;
        Some((FaceSide { face, side: usize::from(!front) }, [1.0 - v - w, v, w]))
    }
}

impl Illuminate for Mapped {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        self.inner.arrivals(place, occlude, receive);
    }

    fn arrivals_on(
        &self,
        face: [u32; 2],
        place: &Place,
        occlude: &dyn Occlude,
        receive: &mut dyn FnMut(Arrival),
    ) {
        let Some((on, weights)) = self.locate(face, place) else {
            return self.inner.arrivals_on(face, place, occlude, receive);
        };
        let share = self.face_map(on, occlude).value(weights);
        let irradiance = self.inner.open_irradiance(place.normal) * share;
        if !irradiance.is_zero() {
            receive(Arrival::Field { irradiance });
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.inner.radiance(ray)
    }
}

#[cfg(test)]
mod tests;
