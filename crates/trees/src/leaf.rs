//! How leaves and bark are lit (thesis 5.3).

use std::f32::consts::FRAC_1_PI;

use glam::Vec3;
use light::{Arrival, Place, Spectrum, Surroundings};

use crate::planes::{Cross, Planes};
use crate::region::{self, random};
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
    /// Where the leaf or bark is that shows, with the outward normal of the crown (of the trunk).
    pub place: Place,
    /// Unit normal of its leaf region, turned outwards (thesis 5.3.1).
    pub normal: Vec3,
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
    pub(crate) planes: &'a Planes,
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
        // Where one leaf is less than half a pixel, only the mean of many shows.
        let crowd = if leafy { (self.width / tree.leaf.size - 1.0).clamp(0.0, 1.0) } else { 0.0 };
        let number = if crowd < 1.0 { region::region(cross.at, tree.leaf.size, planted) } else { planted };
        let (point, outward, normal) =
            if leafy { self.leaf(cross, number, crowd) } else { self.bark(cross, number) };
        let position = self.placed.position + point * self.scale;
        let error = position.abs().max_element() * 4.0 * f32::EPSILON;
        Crossing {
            tree: self.tree,
            slice: cross.slice,
            distance: cross.t * self.scale,
            opacity,
            colour,
            place: Place { position, error, normal: outward, seed: number },
            normal,
            crowd,
            leafy,
        }
    }

    /// Where the leaf of region `number` is, the crown's normal there, and the leaf's own.
    ///
    /// On the view ray, between where it enters the envelope and where it leaves it (A and B of thesis 5.3.3): at a depth
    /// that light of the crown's extinction k reaches, decided by the region: s = −ln(1 − u (1 − exp(−k AB)))/k.
    ///
    /// A crowd has the median, u = 1/2: as far again to the sun, and half of its light arrives, which is the mean
    /// over all depths: ∫ exp(−k s) k exp(−k s) ds = 1/2.
    fn leaf(&self, cross: &Cross, number: u32, crowd: f32) -> (Vec3, Vec3, Vec3) {
        let (origin, direction) = self.line;
        let tree = self.species.description();
        let (entry, point) = match tree.envelope.meet(origin, direction) {
            Some([from, to]) => {
                let k = self.species.extinction();
                let u = random(number, 2);
                let u = u + crowd * (0.5 - u);
                let depth = -(1.0 - u * (1.0 - (-k * (to - from)).exp())).ln() / k;
                (origin + direction * from, origin + direction * (from + depth).min(to))
            }
            // A leaf that sticks out of the envelope.
            None => [origin + direction * cross.t; 2].into(),
        };
        let outward = tree.envelope.normal(entry);
        (point, outward, region::turned(region::normal(number, tree.leaf.scatter), outward))
    }

    /// The same for bark: a round stem whose outline is the picture's, facing anywhere on the viewer's side.
    fn bark(&self, cross: &Cross, number: u32) -> (Vec3, Vec3, Vec3) {
        let (origin, direction) = self.line;
        let facing = self.planes.facing;
        let facing = if facing.dot(direction) > 0.0 { -facing } else { facing };
        let aside = 2.0 * random(number, 3) - 1.0;
        let across = Vec3::new(facing.z, 0.0, -facing.x);
        let normal = facing * (1.0 - aside * aside).max(0.0).sqrt() + across * aside;
        (origin + direction * cross.t, facing, normal)
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
        let side = |place: &Place| {
            let mut sum = Spectrum::ZERO;
            around.arrivals(place, &mut |arrival| {
                if let Arrival::Field { irradiance } = arrival {
                    sum += irradiance;
                }
            });
            sum
        };
        Self { outer: side(place), inner: side(&place.flipped()) }
    }

    /// Irradiance on a plane whose normal has cosine `cos` to the outward one, linear in it: exact where each half of the
    /// surroundings is uniform.
    fn on(&self, cos: f32) -> Spectrum {
        self.outer * (0.5 * (1.0 + cos)) + self.inner * (0.5 * (1.0 - cos))
    }
}

/// Radiance \[W m⁻² sr⁻¹ nm⁻¹\] of what shows at a crossing, were it opaque.
///
///   L = (ρ E(N') + τ E(−N')) / π,   E: beams by the cosine with N', fields by [`Fields::on`]
pub(crate) fn radiance(
    crossing: &Crossing,
    species: &Species,
    shading: Shading,
    fields: &Fields,
    around: &dyn Surroundings,
) -> Spectrum {
    let (reflected, passed) = if crossing.leafy {
        species.leaf(crossing.colour)
    } else {
        (Spectrum::reflectance(crossing.colour), Spectrum::ZERO)
    };
    let caught = |toward: Vec3| {
        let one = crossing.normal.dot(toward).max(0.0);
        match crossing.crowd {
            0.0 => one,
            crowd => {
                one + crowd * (species.crowd.caught(crossing.place.normal.dot(toward).clamp(-1.0, 1.0)) - one)
            }
        }
    };
    let (mut outside, mut inside) = (Spectrum::ZERO, Spectrum::ZERO);
    let mut receive = |arrival: Arrival| {
        if let Arrival::Beam { toward, irradiance, .. } = arrival {
            match shading {
                Shading::Leaves => {
                    outside += irradiance * caught(toward);
                    inside += irradiance * caught(-toward);
                }
                Shading::Thesis { ambient } => {
                    outside += irradiance * ((1.0 - ambient) * caught(toward) + ambient);
                }
            }
        }
    };
    // A source behind the crown's outline is reported for the other side alone.
    let mut from = |place: &Place| {
        around.beams(place, &mut |arrival| {
            if let Arrival::Beam { toward, .. } = arrival
                && toward.dot(place.normal) >= 0.0
            {
                receive(arrival);
            }
        });
    };
    from(&crossing.place);
    from(&crossing.place.flipped());
    if shading == Shading::Leaves {
        let straight = crossing.normal.dot(crossing.place.normal);
        let cos = straight + crossing.crowd * (species.crowd.straight - straight);
        outside += fields.on(cos);
        inside += fields.on(-cos);
    }
    (reflected * outside + passed * inside) * FRAC_1_PI
}
