//! The sky's light by a receiving cuboid (thesis 4.3).

mod coverage;
mod front;
mod layout;
mod optimum;
mod rasterise;
mod sums;

use glam::{DVec3, Vec3};
use light::bands::BANDS;
use light::{Arrival, Bodies, Geometry, Illuminate, Occlude, Place, Ray, Spectrum};

pub use coverage::Coverage;
pub use layout::{Element, Face, Layout};
pub use optimum::Optimum;
pub use rasterise::{Drawing, Rasterise, Things, Viewpoint};

use front::{hide_behind, known};
pub(crate) use rasterise::is_soft;
use sums::{Flux, Sums, on_plane};

use crate::Description;
use crate::ground::Surround;
use crate::open_sky::OpenSky;
use crate::sampling::transmit;

/// Elements across the cuboid's top; what it costs and leaves is at [`Division::elements`].
pub const ELEMENTS: u32 = 40;

/// How finely a [`CuboidSky`] is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Division {
    /// Elements across the top of the cuboid, n ≥ 1. Among 400 houses n = 10, 20, 40 and 80 leave, root mean square over
    /// places under an overcast sky, 1.3, 0.6, 0.27 and 0.12 % of what an open lawn receives, a little less under a clear sky; the time grows
    /// nearly in proportion. The bench `cuboid` lists more.
    pub elements: u32,
    /// Parts k ≥ 1 across an element of which each is drawn by itself: k² bits an element. 1 = the thesis' own. n with k × k parts
    /// leaves nearly what k n leaves and takes up to twice as long, but asks the sky less and needs less memory (200 bytes an
    /// element).
    pub parts: u32,
}

impl Default for Division {
    fn default() -> Self {
        Self { elements: ELEMENTS, parts: 1 }
    }
}

/// The light of sky and ground, what hides them drawn onto a cuboid around the place (thesis 4.3.5).
///
///   E(λ) = Σ H_i L_i dS_i cos ξ_i      (4.20; the thesis' factor 1/2π does not belong there)
///
/// over the elements i whose middle is in front of the place's plane; H_i = 1 where nothing covers it, 0 where something does;
/// with k × k parts to an element the share of parts, among those in front, that nothing covers. L is the sky's above the
/// horizon and the ground's below it, as [`crate::Dome`] has them; an element across it has the mean. Nothing is random: the place's seed does not matter.
///
/// *Occlusion.* Solid faces of the geometry are drawn by a [`Rasterise`]; what the handed occluder says of them is not asked. Where
/// only soft things cover an element (faces with an opacity or a medium, hulls of bodies), the
/// occluder is asked by a ray through its middle. What an occluder hides that is in neither geometry nor hulls stays unseen.
///
/// *Grazing.* The cuboid's centre is where rays leave the place, beyond all that the place's error may hide, so that its own
/// plane never covers anything. Directions within 2e-6 of the plane count as behind it.
///
/// *Where it is wrong.* An element is there or not: an edge across it misplaces up to half of it, so that small parts of the
/// sky seen (slits narrower than 2°) come and go. Open places differ from [`crate::Dome`]'s exact value by the
/// quadrature, some 1/(3 n²) of the light.
///
/// ```
/// use std::sync::Arc;
/// use glam::Vec3;
/// use light::{Geometry, Illuminate, Place, Spectrum, Uniform, Vacuum};
/// use keikan_sky::{CuboidSky, Description, Division};
/// let sky = Arc::new(Uniform { radiance: Spectrum::ONE });
/// let description = Description { albedo: 0.0, ..Description::new(sky) };
/// let cuboid = CuboidSky::new(&description, &Geometry::default(), None, Division::default());
/// let lawn = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 0 };
/// let e = cuboid.irradiance(&lawn, &Vacuum)[0];
/// assert!((e / std::f32::consts::PI - 1.0).abs() < 1e-3);
/// ```
pub struct CuboidSky {
    around: Surround,
    layout: Layout,
    parts: usize,
    sums: Sums,
    /// What is known beforehand of each face: elements that give nothing are not asked for.
    known: [Coverage; 6],
    rasterise: Box<dyn Rasterise>,
    has_soft: bool,
}

impl CuboidSky {
    /// The sky that `description` describes (its `samples` do not matter) among the things of `geometry` and `bodies`, drawn by the
    /// processor. Takes some 10 ms, 9 questions to the sky for each element, and 1 µs for each triangle.
    pub fn new(
        description: &Description,
        geometry: &Geometry,
        bodies: Option<&dyn Bodies>,
        division: Division,
    ) -> Self {
        let optimum = Optimum::of(&*description.sky);
        let layout = optimum.layout(description.sky.brightest(), division.elements);
        let drawing = Drawing::new(&layout, division.parts, geometry, bodies);
        let has_soft = geometry.meshes.iter().any(is_soft) || bodies.is_some_and(|b| !b.hulls().is_empty());
        Self::with(description, layout, division.parts, Box::new(drawing), has_soft)
    }

    /// The same with any layout and drawing; `has_soft` tells whether there are any [`Things::Soft`] to draw.
    pub fn with(
        description: &Description,
        layout: Layout,
        parts: u32,
        rasterise: Box<dyn Rasterise>,
        has_soft: bool,
    ) -> Self {
        let around = Surround::new(description, &OpenSky::new(&*description.sky));
        let parts = parts.max(1) as usize;
        let sums = Sums::new(&layout, &around);
        Self {
            known: std::array::from_fn(|index| {
                known(&layout.faces()[index], parts, |[column, row]| {
                    sums.run(index, row, column, column + 1) == [DVec3::ZERO; BANDS]
                })
            }),
            around,
            layout,
            sums,
            parts,
            rasterise,
            has_soft,
        }
    }

    /// How the cuboid stands and is divided.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Irradiance on the plane of unit `normal` with nothing in the way, as these elements sum it \[W m⁻² nm⁻¹\].
    pub fn open_irradiance(&self, normal: Vec3) -> Spectrum {
        let open = self.in_front(normal);
        on_plane(&self.visible(normal, &open, &open), normal)
    }

    /// Bits of what is not behind the plane of unit `normal`, nor known to give nothing.
    fn in_front(&self, normal: Vec3) -> [Coverage; 6] {
        let mut bits = self.known.clone();
        let toward = self.layout.frame_from_world() * normal.as_dvec3();
        for (face, bits) in self.layout.faces().iter().zip(&mut bits) {
            hide_behind(face, bits, toward);
        }
        bits
    }

    /// Where the cuboid's centre is: where rays leave the place.
    fn viewpoint(&self, place: &Place) -> Viewpoint {
        let origin = place.leave(place.normal, f32::INFINITY).origin.as_dvec3();
        let rise = origin.y - f64::from(place.position.y);
        let floor = self.around.fall(place).map_or(f64::NEG_INFINITY, |fall| -f64::from(fall) - rise);
        // Rounding of what was computed in the world's coordinates.
        let error = f64::from(place.error) + 8.0 * f64::EPSILON * origin.abs().max_element();
        Viewpoint { origin, error, normal: place.normal, floor }
    }

    /// Σ over the elements that are open, each by the share of its parts in front that are.
    fn visible(&self, normal: Vec3, front: &[Coverage; 6], open: &[Coverage; 6]) -> Flux {
        let mut sum = [DVec3::ZERO; BANDS];
        let mut add = |flux: &Flux, share: f64| {
            (0..BANDS).for_each(|band| sum[band] += flux[band] * share);
        };
        for (index, face) in self.layout.faces().iter().enumerate() {
            for row in 0..face.count[1] {
                if self.parts == 1 {
                    open[index].open_runs(row, |from, to| add(&self.sums.run(index, row, from, to), 1.0));
                    continue;
                }
                for column in 0..face.count[0] {
                    let of = |bits: &Coverage| self.open_parts(bits, [column, row]);
                    if let open @ 1.. = of(&open[index])
                        && self.faces_plane(face, [column, row], normal)
                    {
                        let share = f64::from(open) / f64::from(of(&front[index]));
                        add(&self.sums.run(index, row, column, column + 1), share);
                    }
                }
            }
        }
        sum
    }

    /// Whether the middle of an element is in front of the plane.
    fn faces_plane(&self, face: &Face, cell: [usize; 2], normal: Vec3) -> bool {
        self.layout.element(face, cell).direction.dot(normal.as_dvec3()) > 0.0
    }

    /// How many parts of an element are open.
    fn open_parts(&self, bits: &Coverage, [column, row]: [usize; 2]) -> u32 {
        let k = self.parts;
        let parts = (0..k * k).filter(|at| !bits.is_covered([column * k + at % k, row * k + at / k]));
        parts.count() as u32
    }

    /// The parts that soft things alone cover: the direction of each, and what it gives on the plane.
    fn soft<'a>(
        &'a self,
        normal: Vec3,
        front: &'a [Coverage; 6],
        solid: &'a [Coverage; 6],
        all: &'a [Coverage; 6],
    ) -> impl Iterator<Item = (Vec3, Spectrum)> + 'a {
        let k = self.parts;
        let world_from_frame = self.layout.frame_from_world().transpose();
        let faces = self.layout.faces().iter().enumerate().filter(|(i, _)| solid[*i] != all[*i]);
        faces.flat_map(move |(i, face)| {
            let fine = Face { count: face.count.map(|count| count * k), ..*face };
            let only_soft = move |part: &[usize; 2]| all[i].is_covered(*part) && !solid[i].is_covered(*part);
            fine.cells().filter(only_soft).filter_map(move |part| {
                let [column, row] = part.map(|index| index / k);
                let flux = self.sums.run(i, row, column, column + 1);
                let share = 1.0 / self.open_parts(&front[i], [column, row]) as f32;
                let direction = world_from_frame * fine.point(part.map(|index| index as f64 + 0.5));
                let in_front = k == 1 || self.faces_plane(face, [column, row], normal);
                in_front
                    .then(|| (direction.normalize().as_vec3().normalize(), on_plane(&flux, normal) * share))
            })
        })
    }
}

impl Illuminate for CuboidSky {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let view = self.viewpoint(place);
        let front = self.in_front(place.normal);
        let mut bits = front.clone();
        self.rasterise.cover(&view, Things::Solid, &mut bits);
        let mut through = Spectrum::ZERO;
        if self.has_soft {
            let solid = bits.clone();
            self.rasterise.cover(&view, Things::Soft, &mut bits);
            let asked = self.soft(place.normal, &front, &solid, &bits);
            let rays = asked.map(|(direction, weight)| (self.around.ray(place, direction), weight));
            transmit(occlude, rays, |weight, transmittance| through += transmittance * weight);
        }
        let irradiance = on_plane(&self.visible(place.normal, &front, &bits), place.normal) + through;
        if !irradiance.is_zero() {
            receive(Arrival::Field { irradiance });
        }
    }

    fn radiance(&self, ray: &Ray) -> Spectrum {
        self.around.radiance(ray.direction)
    }
}

#[cfg(test)]
mod tests;
