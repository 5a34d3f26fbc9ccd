//! How leaves and bark are lit (thesis 5.3).

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;
use light::{Arrival, Place, Spectrum, Surroundings};

use crate::planes::Cross;
use crate::region::{self, CROWD, random};
use crate::species::Species;
use crate::stand::Placed;

/// How leaves answer light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Shading {
    /// Sun and lamps on the leaf that shows, reflected by its outer side or let through from the other; the sky's irradiance
    /// by the leaf's direction. A leaf lies as deep in the crown as light gets, at a depth that is its own.
    #[default]
    Leaves,
    /// Thesis eq. 5.4, beams only: (1 − α)(L · N') + α of each beam is reflected; no sky, nothing let through.
    Thesis {
        /// α, the ambient share, within \[0, 1\].
        ambient: f32,
    },
}

/// Where a ray crosses a plane of a tree.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Which tree, of [`crate::Stand::trees`].
    pub tree: u32,
    /// Which of the species' slices; none = the vertical plane.
    pub slice: Option<u32>,
    /// Along the ray \[m\].
    pub distance: f32,
    /// Share of what lies behind that it hides, within (0, 1\]: the picture's alpha × what the plane's angle leaves.
    pub opacity: f32,
    /// Linear colour of the picture.
    pub colour: Vec3,
    /// Where the leaf or bark is that shows, with the crown's outward normal (that of a stem towards the viewer); its seed
    /// is the leaf region's number.
    pub place: Place,
    /// 0: one leaf shows; 1: so many that only their mean shows; between: between.
    pub crowd: f32,
    /// False for bark.
    pub leafy: bool,
}

/// A line that meets a tree, in the tree's own metres.
pub(crate) struct Met<'a> {
    pub(crate) tree: u32,
    pub(crate) placed: &'a Placed,
    pub(crate) species: &'a Species,
    /// Where its vertical plane faces.
    pub(crate) facing: Vec3,
    pub(crate) line: (Vec3, Vec3),
    /// The world's metres in one of the tree's.
    pub(crate) scale: f32,
    /// Of the bundle at the crossing.
    pub(crate) width: f32,
}

impl Met<'_> {
    pub(crate) fn crossing(&self, cross: &Cross, colour: Vec3, opacity: f32) -> Crossing {
        let tree = self.species.description();
        let leafy = cross.sheet(self.species).leafy(cross.uv);
        let seed = tree.seed ^ cross.slice.map_or(0, |i| i + 1).wrapping_mul(0x9E37_79B9);
        // No two trees alike, though they share pictures: where it stands decides the rest.
        let planted = light::sampling::scramble(
            self.placed.position.to_array().iter().fold(seed, |seed, x| seed.rotate_left(9) ^ x.to_bits()),
        );
        // What looks one way: a leaf, or a scale of bark. Where it is less than half a pixel, only the mean of many shows.
        let size = if leafy { tree.leaf.size } else { BARK * tree.leaf.size };
        let crowd = (self.width / size - 1.0).clamp(0.0, 1.0);
        let number = if crowd < 1.0 { region::region(cross.at, size, planted) } else { planted };
        let (point, outward) = if leafy { self.leaf(number, crowd, cross) } else { self.bark(cross) };
        let position = self.placed.position + point * self.scale;
        let error = position.abs().max_element() * 4.0 * f32::EPSILON;
        Crossing {
            tree: self.tree,
            slice: cross.slice,
            distance: cross.t * self.scale,
            opacity,
            colour,
            place: Place { position, error, normal: outward, seed: number },
            crowd,
            leafy,
        }
    }

    /// Where the leaf of region `number` is, and the crown's normal there.
    ///
    /// On the view ray, between where it enters the envelope and where it leaves it (A and B of thesis 5.3.3): at a depth
    /// that sight reaches in the crown ([`Species::depth`]), decided by the region.
    ///
    /// A crowd has the median, u = 1/2: as far again to the sun, and half of its light arrives, which is the mean
    /// over all depths: ∫ exp(−k s) k exp(−k s) ds = 1/2.
    fn leaf(&self, number: u32, crowd: f32, cross: &Cross) -> (Vec3, Vec3) {
        let (origin, direction) = self.line;
        let envelope = &self.species.description().envelope;
        let Some([from, to]) = envelope.meet(origin, direction) else {
            // A leaf that sticks out of the envelope.
            let point = origin + direction * cross.t;
            return (point, envelope.normal(point));
        };
        let u = random(number, 2);
        let u = u + crowd * (0.5 - u);
        let depth = self.species.depth(u, to - from);
        (origin + direction * (from + depth), envelope.normal(origin + direction * from))
    }

    /// The same for bark: on the plane, facing the viewer.
    fn bark(&self, cross: &Cross) -> (Vec3, Vec3) {
        let (origin, direction) = self.line;
        let facing = if self.facing.dot(direction) > 0.0 { -self.facing } else { self.facing };
        (origin + direction * cross.t, facing)
    }
}

/// Scales of bark are so much smaller than leaves.
const BARK: f32 = 0.35;

/// Leaves turn their other side to the viewer over this range of cosines, not at once: nothing jumps as the eye moves.
const EDGE: f32 = 0.2;

/// What shows at a crossing, as a few flat faces: normal, weight (sum 1), share that shows its front.
struct Facets {
    of: [(Vec3, f32, f32); CROWD + LEAVES],
    count: usize,
}

/// Normals that one region has, weighed by how much of each shows: a leaf seen edge-on shows little, its neighbour more.
const LEAVES: usize = 2;

impl Facets {
    fn new(crossing: &Crossing, species: &Species, shading: Shading, toward_eye: Vec3) -> Self {
        let mut facets = Self { of: [(Vec3::Y, 0.0, 1.0); CROWD + LEAVES], count: 0 };
        let (outward, seed, crowd) = (crossing.place.normal, crossing.place.seed, crossing.crowd);
        if !crossing.leafy {
            let stem = |aside: f32| {
                let across = Vec3::new(outward.z, 0.0, -outward.x);
                outward * (1.0 - aside * aside).max(0.0).sqrt() + across * aside
            };
            facets.add([stem(2.0 * random(seed, 3) - 1.0)].into_iter(), 1.0 - crowd, None);
            // Four strips of a stem's breadth.
            facets.add([-0.75, -0.25, 0.25, 0.75].into_iter().map(stem), crowd, None);
            return facets;
        }
        let leaf = &species.description().leaf;
        let (axis, eye, few) = match shading {
            Shading::Leaves => (leaf.axis(outward), Some(toward_eye), LEAVES),
            Shading::Thesis { .. } => (outward, None, 1),
        };
        let one = |i: usize| {
            region::turned(region::normal(seed ^ (i as u32).wrapping_mul(0x9E37_79B9), leaf.scatter), axis)
        };
        facets.add((0..few).map(one), 1.0 - crowd, eye);
        facets.add(species.crowd.normals.iter().map(|normal| region::turned(*normal, axis)), crowd, eye);
        facets
    }

    /// Adds normals of `weight` in all, each by how much of it shows where there is an eye.
    fn add(&mut self, normals: impl Iterator<Item = Vec3>, weight: f32, toward_eye: Option<Vec3>) {
        if weight <= 0.0 {
            return;
        }
        let first = self.count;
        let mut sum = 0.0;
        for normal in normals {
            let cos = toward_eye.map_or(1.0, |eye| normal.dot(eye));
            // A hundredth for leaves that are all edge-on.
            let shows = cos.abs() + 0.01;
            self.of[self.count] = (normal, shows, (0.5 + 0.5 * cos / EDGE).clamp(0.0, 1.0));
            self.count += 1;
            sum += shows;
        }
        self.of[first..self.count].iter_mut().for_each(|facet| facet.1 *= weight / sum);
    }

    /// Means of what the side that shows and the other side get, where a face of normal N gets `on`(N) on its front and
    /// `on`(−N) on its back.
    fn sides<T>(&self, on: impl Fn(Vec3) -> T) -> [T; 2]
    where
        T: Default + std::ops::AddAssign + std::ops::Mul<f32, Output = T> + Copy,
    {
        let mut sides = [T::default(); 2];
        for (normal, weight, front) in &self.of[..self.count] {
            let (fore, back) = (on(*normal), on(-*normal));
            sides[0] += fore * (weight * front);
            sides[0] += back * (weight * (1.0 - front));
            sides[1] += back * (weight * front);
            sides[1] += fore * (weight * (1.0 - front));
        }
        sides
    }
}

/// What arrives at a place from extended sources: on its outer side and on its inner one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fields {
    outer: Spectrum,
    inner: Spectrum,
}

impl Fields {
    /// None at all.
    pub(crate) const NONE: Self = Self { outer: Spectrum::ZERO, inner: Spectrum::ZERO };

    /// Asked for once per tree and ray: extended light is the costly part, and it varies little within a crown.
    pub(crate) fn new(place: &Place, around: &dyn Surroundings) -> Self {
        let [outer, inner] = around.both_sides(place);
        Self { outer, inner }
    }

    /// Irradiance on a plane whose normal has cosine `cos` to the outward one, linear in it: exact where each half of the
    /// surroundings is uniform.
    fn on(&self, cos: f32) -> Spectrum {
        self.outer * (0.5 * (1.0 + cos)) + self.inner * (0.5 * (1.0 - cos))
    }
}

/// Radiance \[W m⁻² sr⁻¹ nm⁻¹\] of what shows at a crossing towards `toward_eye`, were it opaque.
///
///   L = Σ_N w_N (ρ E(N') + τ E(−N')) / π,   N' = ±N, the side that shows; E: beams by the cosine, fields by [`Fields::on`]
pub(crate) fn radiance(
    crossing: &Crossing,
    species: &Species,
    shading: Shading,
    (fields, toward_eye): (&Fields, Vec3),
    around: &dyn Surroundings,
) -> Spectrum {
    let (reflected, passed) = if crossing.leafy {
        species.leaf(crossing.colour)
    } else {
        (Spectrum::reflectance(crossing.colour), Spectrum::ZERO)
    };
    let facets = Facets::new(crossing, species, shading, toward_eye);
    let mut sides = [Spectrum::ZERO; 2];
    let mut receive = |toward: Vec3, irradiance: Spectrum| {
        let [shown, other] = facets.sides(|normal| normal.dot(toward).max(0.0));
        match shading {
            Shading::Leaves => {
                sides[0] += irradiance * shown;
                sides[1] += irradiance * other;
            }
            Shading::Thesis { ambient } => sides[0] += irradiance * ((1.0 - ambient) * shown + ambient),
        }
    };
    // A source behind the crown's outline is reported for the other side alone.
    let mut from = |place: &Place| {
        around.beams(place, &mut |arrival| {
            if let Arrival::Beam { toward, irradiance, .. } = arrival
                && toward.dot(place.normal) >= 0.0
            {
                receive(toward, irradiance);
            }
        });
    };
    from(&crossing.place);
    from(&crossing.place.flipped());
    if shading == Shading::Leaves {
        let [shown, other] = facets.sides(|normal| fields.on(normal.dot(crossing.place.normal)));
        sides[0] += shown;
        sides[1] += other;
    }
    (reflected * sides[0] + passed * sides[1]) * FRAC_1_PI
}
