//! What lies between two points that light each other: things, a medium, and mirrors beside the straight way.

use std::sync::Arc;

use glam::DVec3;
use light::{Occlude, Place, Spectrum, sampling};

use crate::patch::{place, reach};
use crate::tree::{Node, Tree};

/// How much of diffuse light is left after a straight way through the medium there?
///
/// 1 per band, within \[0, 1\]; 1 = no medium. Reciprocal.
pub trait Attenuate: Send + Sync {
    /// The share that is left between two points \[m\].
    fn factor(&self, from: DVec3, to: DVec3) -> Spectrum;
}

/// No medium: the null answer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Clear;

impl Attenuate for Clear {
    fn factor(&self, _: DVec3, _: DVec3) -> Spectrum {
        Spectrum::ONE
    }
}

/// One medium everywhere: exp(−K r) (thesis eq. 3.20). Of diffuse light K is nearer a + b_b than c = a + b: what is scattered
/// forwards goes on.
#[derive(Clone, Copy, Debug)]
pub struct Absorbing {
    /// K \[1/m\], ≥ 0 per band.
    pub extinction: Spectrum,
}

impl Attenuate for Absorbing {
    fn factor(&self, from: DVec3, to: DVec3) -> Spectrum {
        self.extinction.attenuate(from.distance(to) as f32)
    }
}

/// A flat mirror that light also takes on its way from patch to patch (thesis eq. 3.19): still water, from above and from below.
///
/// Patches on the same side of it see each other's mirror images; across it nothing is mirrored. Whether straight ways may cross
/// it is for the occluder to say. Each leg of a folded way asks the occluder and the medium by itself. Ways over two
/// mirrors are left out.
pub trait Mirror: Send + Sync {
    /// A point of its plane \[m\], and the unit normal on the side called above.
    fn plane(&self) -> (DVec3, DVec3);

    /// The share reflected at a point of the plane, for a way that comes from above (or below) at the cosine `cos` to the
    /// normal, within \[0, 1\] per band; 0 where the mirror does not reach, 1 beyond the critical angle.
    fn reflectance(&self, at: DVec3, from_above: bool, cos: f64) -> Spectrum;
}

/// All that lies between patches.
#[derive(Clone, Copy)]
pub struct Between<'a> {
    /// What is in the way.
    pub occlude: &'a dyn Occlude,
    /// The medium.
    pub attenuate: &'a dyn Attenuate,
    /// Mirrors; most often none.
    pub mirrors: &'a [Arc<dyn Mirror>],
}

impl<'a> Between<'a> {
    /// Things in the way, no medium and no mirror.
    pub fn dry(occlude: &'a dyn Occlude) -> Self {
        Self { occlude, attenuate: &Clear, mirrors: &[] }
    }

    /// The share of light that one straight leg leaves.
    fn leg(&self, from: &Place, to: DVec3) -> Spectrum {
        let through = self.attenuate.factor(from.position.as_dvec3(), to);
        if through.is_zero() {
            return through;
        }
        through * self.occlude.transmittance(&from.toward(to.as_vec3()))
    }

    /// The share of light that arrives between two places: straight, or over a mirror.
    pub(crate) fn share(&self, mirror: Option<&dyn Mirror>, from: &Place, to: &Place) -> Spectrum {
        let [x, y] = [from, to].map(|place| place.position.as_dvec3());
        let Some(mirror) = mirror else { return self.leg(from, y) };
        let (point, normal) = mirror.plane();
        let [hx, hy] = [x, y].map(|p| (p - point).dot(normal));
        if hx * hy <= 0.0 {
            return Spectrum::ZERO;
        }
        // Where the way to the mirror image of y crosses the plane.
        let folded = (x - normal * hx).lerp(y - normal * hy, hx / (hx + hy));
        let length = x.distance(folded) + y.distance(folded);
        let cos = ((hx + hy).abs() / length).min(1.0);
        let reflected = mirror.reflectance(folded, hx > 0.0, cos);
        if reflected.is_zero() {
            return Spectrum::ZERO;
        }
        reflected * self.leg(from, folded) * self.leg(to, folded)
    }

    /// The mean of that over `count` ways between two nodes, weighed with what each would carry; the second of the pair is the
    /// node itself, not its image. Ways from number `first` on, of those that belong to the pair.
    pub(crate) fn ways(&self, pair: &Pair, first: u32, count: u32) -> Mean {
        let mut mean = Mean::default();
        let shifts = [1, 2].map(|purpose| sampling::shift(pair.seed, purpose));
        for i in first..first + count {
            let u = sampling::sobol(i, shifts[0]);
            let v = sampling::lattice(i, pair.rays, shifts[1]).map(f64::from);
            let (x, nx) = pair.tree.point(pair.nodes[0], u);
            let (y, ny) = pair.tree.point(pair.nodes[1], v);
            let (image, turned) = pair.image(y, ny);
            let way = image - x;
            let weight = way.dot(nx).max(0.0) * -way.dot(turned).min(0.0) / way.length_squared().powi(2);
            if weight > 0.0 && weight.is_finite() {
                let [from, to] = [(x, nx, 0), (y, ny, 1)]
                    .map(|(at, normal, k)| place(at, normal, pair.reach(k, at), pair.seed));
                let from = Place { error: from.error.max(pair.error), ..from };
                mean.add(self.share(pair.mirror, &from, &to), weight as f32);
            }
        }
        mean
    }
}

/// Two nodes that may light each other.
pub(crate) struct Pair<'a> {
    pub(crate) tree: &'a Tree,
    pub(crate) nodes: [&'a Node; 2],
    pub(crate) mirror: Option<&'a dyn Mirror>,
    pub(crate) seed: u32,
    pub(crate) rays: u32,
    /// The first is at least this far off \[m\].
    pub(crate) error: f32,
}

impl Pair<'_> {
    fn image(&self, at: DVec3, normal: DVec3) -> (DVec3, DVec3) {
        self.mirror.map_or((at, normal), |mirror| {
            let (point, across) = mirror.plane();
            let flip = |v: DVec3, height: f64| v - across * (2.0 * height);
            (flip(at, (at - point).dot(across)), flip(normal, normal.dot(across)))
        })
    }

    fn reach(&self, k: usize, at: DVec3) -> f64 {
        let node = self.nodes[k];
        if node.is_piece { reach(&node.corners) } else { at.abs().max_element() + node.radius }
    }
}

/// A weighed mean, and whether all that went into it was the same.
#[derive(Clone, Copy, Default)]
pub(crate) struct Mean {
    sum: Spectrum,
    weight: f32,
    least: f32,
    most: f32,
}

impl Mean {
    fn add(&mut self, value: Spectrum, weight: f32) {
        let mean = value.mean();
        self.least = if self.weight > 0.0 { self.least.min(mean) } else { mean };
        self.most = if self.weight > 0.0 { self.most.max(mean) } else { mean };
        self.sum += value * weight;
        self.weight += weight;
    }

    pub(crate) fn and(mut self, other: Self) -> Self {
        if self.weight > 0.0 && other.weight > 0.0 {
            self.least = self.least.min(other.least);
            self.most = self.most.max(other.most);
        } else if other.weight > 0.0 {
            return other;
        }
        self.sum += other.sum;
        self.weight += other.weight;
        self
    }

    /// 0 where no way carries anything.
    pub(crate) fn value(&self) -> Spectrum {
        if self.weight > 0.0 {
            // The quotient of two sums may round past 1.
            (self.sum * self.weight.recip()).map(|band| band.clamp(0.0, 1.0))
        } else {
            Spectrum::ZERO
        }
    }

    /// Whether some ways are hidden and others not: a difference of a tenth or more of all light.
    pub(crate) fn is_partial(&self) -> bool {
        self.most - self.least > 0.1
    }
}
