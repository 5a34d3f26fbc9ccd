//! What lies between two points that light each other: things, a medium, and mirrors beside the straight way.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;
use light::{Occlude, Place, Spectrum, Vacuum, sampling};

use crate::obstacles::Obstacles;
use crate::passage::{Bent, Passage, Through};
use crate::patch::{place, reach};
use crate::tree::{Node, Tree};

/// How much of diffuse light is left after a straight way through the medium there?
///
/// 1 per band, within \[0, 1\]; 1 = no medium. Reciprocal.
pub trait Attenuate: Send + Sync {
    /// The share that is left between two points \[m\].
    fn factor(&self, from: DVec3, to: DVec3) -> Spectrum;

    /// Whether surely nothing is lost between any two points of the box from `low` to `high` \[m\].
    fn is_clear(&self, low: DVec3, high: DVec3) -> bool {
        let _ = (low, high);
        false
    }
}

/// No medium: the null answer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Clear;

impl Attenuate for Clear {
    fn factor(&self, _: DVec3, _: DVec3) -> Spectrum {
        Spectrum::ONE
    }

    fn is_clear(&self, _: DVec3, _: DVec3) -> bool {
        true
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
    /// Surfaces that light passes bent; most often none.
    pub passages: &'a [Arc<dyn Passage>],
    /// All that may be in the way, to tell where nothing is without asking `occlude`; none = always ask.
    pub obstacles: Option<&'a Obstacles>,
}

impl<'a> Between<'a> {
    /// Things in the way, no medium and no mirror.
    pub fn dry(occlude: &'a dyn Occlude) -> Self {
        Self { occlude, attenuate: &Clear, mirrors: &[], passages: &[], obstacles: None }
    }

    /// All kinds of ways that lead to something in a part of space.
    pub(crate) fn ways_to(&self, part: u32) -> impl Iterator<Item = Way<'a>> + use<'a> {
        let mirrored = self.mirrors.iter().map(|mirror| By::Mirrored(&**mirror));
        let through = self.passages.iter().zip(1..).filter(move |&(_, below)| part == 0 || part == below);
        let through =
            through.map(move |(passage, below)| By::Through(Through::new(&**passage, below, part != 0)));
        std::iter::once(By::Straight)
            .chain(mirrored)
            .chain(through)
            .zip(0..)
            .map(|(by, number)| Way { by, number })
    }

    /// The part of space that a point is in.
    pub(crate) fn part(&self, point: DVec3) -> u32 {
        self.passages.iter().position(|passage| passage.holds(point)).map_or(0, |k| k as u32 + 1)
    }

    /// The share of light that one straight leg leaves.
    fn leg(&self, from: &Place, to: DVec3) -> Spectrum {
        let through = self.attenuate.factor(from.position.as_dvec3(), to);
        if through.is_zero() {
            return through;
        }
        through * self.occlude.transmittance(&from.toward(to.as_vec3()))
    }

    /// The share of light that arrives between two places, without what a passage itself takes.
    pub(crate) fn share(&self, by: By<'_>, from: &Place, to: &Place) -> Spectrum {
        match by {
            By::Straight => self.leg(from, to.position.as_dvec3()),
            By::Mirrored(mirror) => self.mirrored(mirror, from, to),
            By::Through(through) => self.passing(&through, from, to),
        }
    }

    fn passing(&self, through: &Through<'_>, from: &Place, to: &Place) -> Spectrum {
        let [x, y] = [from, to].map(|place| place.position.as_dvec3());
        match through.bent(y, x) {
            Some(Bent { at, .. }) if through.passage.covers(at) => self.leg(from, at) * self.leg(to, at),
            _ => Spectrum::ZERO,
        }
    }

    fn mirrored(&self, mirror: &dyn Mirror, from: &Place, to: &Place) -> Spectrum {
        let [x, y] = [from, to].map(|place| place.position.as_dvec3());
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

    /// The same without things in the way, where surely none is between two nodes; all of it, if nothing else is there either.
    pub(crate) fn cleared(&self, nodes: [&Node; 2], by: By<'_>) -> Cleared<'a> {
        let Some(obstacles) = self.obstacles else { return Cleared::No };
        let mut hull = [DVec3::ZERO; 2 * 2 * 8];
        let mut count = 0;
        for node in nodes {
            count += node.corners_of_hull(&mut hull[count..]);
        }
        let is_straight = matches!(by, By::Straight);
        if let Some((point, normal)) = by.plane() {
            // Legs end between the feet of what they join.
            for k in 0..count {
                hull[count + k] = hull[k] - normal * (hull[k] - point).dot(normal);
            }
            count *= 2;
        }
        let hull = &hull[..count];
        let tube = is_straight.then(|| (nodes.map(|node| node.centre), nodes[0].radius.max(nodes[1].radius)));
        if !obstacles.is_clear(hull, tube) {
            return Cleared::No;
        }
        let (low, high) = hull
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        if is_straight && self.attenuate.is_clear(low, high) {
            return Cleared::All;
        }
        Cleared::OfThings(Self { occlude: &Vacuum, ..*self })
    }

    /// The mean of that over `count` ways between two nodes, weighed with what each would carry; the second of the pair is the
    /// node itself, not its image. Ways from number `first` on, of those that belong to the pair.
    pub(crate) fn ways(&self, pair: &Pair, first: u32, count: u32) -> Mean {
        let mut mean = Mean::default();
        if pair.is_near() {
            let tried = (first * MORE..(first + count) * MORE).filter_map(|i| pair.by_direction(i));
            tried.take(count as usize).for_each(|ends| mean.add(self.way(pair, ends), 1.0));
        }
        if mean.weight > 0.0 {
            return mean;
        }
        for i in first..first + count {
            let (ends, weight) = pair.by_area(i);
            if weight > 0.0 && weight.is_finite() {
                mean.add(self.way(pair, ends), weight as f32);
            }
        }
        mean
    }

    /// The share that arrives between two points of a pair.
    fn way(&self, pair: &Pair, [x, y]: [Point; 2]) -> Spectrum {
        let [from, to] =
            [(x, 0), (y, 1)].map(|((at, normal), k)| place(at, normal, pair.reach(k, at), pair.seed));
        let from = Place { error: from.error.max(pair.error), ..from };
        self.share(pair.by, &from, &to)
    }
}

/// Where, and the unit normal there.
type Point = (DVec3, DVec3);

/// Nodes are near each other within this many times the sum of their radii: from there on cosines and distances hardly vary between
/// evenly spread points.
const NEAR: f64 = 2.0;

/// Directions that are tried at most for every way between near nodes, since some of them miss.
const MORE: u32 = 16;

/// How light goes from one node to another.
#[derive(Clone, Copy)]
pub(crate) enum By<'a> {
    Straight,
    Mirrored(&'a dyn Mirror),
    Through(Through<'a>),
}

impl By<'_> {
    /// A point and the normal of the plane that it meets.
    fn plane(&self) -> Option<(DVec3, DVec3)> {
        match self {
            Self::Straight => None,
            Self::Mirrored(mirror) => Some(mirror.plane()),
            Self::Through(through) => Some(through.passage.plane()),
        }
    }
}

/// One kind of way.
#[derive(Clone, Copy)]
pub(crate) struct Way<'a> {
    pub(crate) by: By<'a>,
    /// Among all that lead to a receiver.
    pub(crate) number: u32,
}

/// What is known of the way between two nodes before any is tried.
pub(crate) enum Cleared<'a> {
    No,
    /// No thing is in the way.
    OfThings(Between<'a>),
    /// Nor does anything else take light.
    All,
}

/// Two nodes that may light each other.
pub(crate) struct Pair<'a> {
    pub(crate) tree: &'a Tree,
    pub(crate) nodes: [&'a Node; 2],
    pub(crate) by: By<'a>,
    pub(crate) seed: u32,
    pub(crate) rays: u32,
    /// The first is at least this far off \[m\].
    pub(crate) error: f32,
}

impl Pair<'_> {
    fn image(&self, at: DVec3, normal: DVec3) -> (DVec3, DVec3) {
        let By::Mirrored(mirror) = self.by else { return (at, normal) };
        let (point, across) = mirror.plane();
        let flip = |v: DVec3, height: f64| v - across * (2.0 * height);
        (flip(at, (at - point).dot(across)), flip(normal, normal.dot(across)))
    }

    /// Whether the second, or its image, is so near that ways between evenly spread points are not those that light takes.
    fn is_near(&self) -> bool {
        let [a, b] = self.nodes;
        let is_bent = matches!(self.by, By::Through(_));
        b.is_piece
            && !is_bent
            && self.image(b.centre, b.normal).0.distance(a.centre) <= NEAR * (a.radius + b.radius)
    }

    /// Ends of way number `i` between points that are spread evenly over both, and what it carries.
    fn by_area(&self, i: u32) -> ([Point; 2], f64) {
        let shifts = [1, 2].map(|purpose| sampling::shift(self.seed, purpose));
        let x = self.tree.point(self.nodes[0], sampling::sobol(i, shifts[0]));
        let y = self.tree.point(self.nodes[1], sampling::lattice(i, self.rays, shifts[1]).map(f64::from));
        if let By::Through(through) = self.by {
            return ([x, y], through.carries(x, y));
        }
        let (image, turned) = self.image(y.0, y.1);
        let way = image - x.0;
        let cosines = way.dot(x.1).max(0.0) * (-way.dot(turned)).max(0.0);
        ([x, y], cosines / way.length_squared().powi(2))
    }

    /// Ends of way number `i` from points spread evenly over the first, in directions as diffuse light leaves it; none where it
    /// misses the second. All carry the same.
    fn by_direction(&self, i: u32) -> Option<[Point; 2]> {
        let [a, b] = self.nodes;
        let shifts = [1, 3].map(|purpose| sampling::shift(self.seed, purpose));
        // Two sets that do not know of each other: one sequence for both would tie directions to points.
        let x = self.tree.point(a, sampling::lattice(i, self.rays * MORE, shifts[0]).map(f64::from));
        let [square, turn] = sampling::sobol(i, shifts[1]);
        let (sin, cos) = (TAU * turn).sin_cos();
        let across = x.1.any_orthonormal_vector();
        let flat = across * cos + x.1.cross(across) * sin;
        let direction = flat * square.sqrt() + x.1 * (1.0 - square).sqrt();
        let [p, q, r] = b.corners.map(|corner| self.image(corner, b.normal).0);
        let turned = self.image(b.centre, b.normal).1;
        let speed = direction.dot(turned);
        let t = (p - x.0).dot(turned) / speed;
        if !(speed < 0.0 && t > 0.0) {
            return None;
        }
        let at = x.0 + direction * t;
        let cross = (q - p).cross(r - p);
        let v = (at - p).cross(r - p).dot(cross);
        let w = (q - p).cross(at - p).dot(cross);
        let inside = v >= 0.0 && w >= 0.0 && v + w <= cross.length_squared();
        inside.then(|| [x, (self.image(at, turned).0, b.normal)])
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

    /// Whether no way has carried anything.
    pub(crate) fn is_nothing(&self) -> bool {
        self.weight <= 0.0
    }

    /// Whether some ways are hidden and others not: a difference of a tenth or more of all light.
    pub(crate) fn is_partial(&self) -> bool {
        self.most - self.least > 0.1
    }
}
