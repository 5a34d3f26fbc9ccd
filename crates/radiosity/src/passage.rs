//! Diffuse light that passes a flat surface bent: patches above and below it light each other.

use std::f64::consts::PI;

use glam::DVec3;

use crate::point_form_factor;
use crate::sight::{Sight, best_cosine};
use crate::tree::{Node, Tree};
use crate::triangle::{self, Corners};

/// A flat surface that diffuse light passes by Snell's and Fresnel's laws: still water (left out by the thesis, its assumption 8).
///
/// Passage number k lies between part 0 of space and part k + 1 ([`crate::Surfaces::part`]): light passes between patches of these two.
/// Ways through two surfaces, or through one and over a mirror, are left out.
pub trait Passage: Send + Sync {
    /// A point of its plane \[m\], and the unit normal on the side of part 0.
    fn plane(&self) -> (DVec3, DVec3);

    /// Whether a point is in part k + 1.
    fn holds(&self, point: DVec3) -> bool;

    /// Whether the surface is there at a point of its plane.
    fn covers(&self, at: DVec3) -> bool;

    /// Index of refraction of part k + 1 relative to part 0.
    fn index(&self) -> f64;

    /// The way from `source` to `receiver` through the plane, whether or not the surface covers it; down into part k + 1, or up.
    /// What lies on the wrong side counts as on the surface. None where there is no way, or no finite one.
    fn bent(&self, source: DVec3, receiver: DVec3, down: bool) -> Option<Bent>;
}

/// A way through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bent {
    /// Where it meets the surface \[m\].
    pub at: DVec3,
    /// Unit vector along which light leaves the source.
    pub leaving: DVec3,
    /// Unit vector at the receiver towards where light comes from.
    pub toward: DVec3,
    /// Share that passes the surface, within \[0, 1\].
    pub share: f64,
    /// Irradiance on a plane that faces the arriving light over the source's intensity, nothing being lost \[1/m²\].
    pub spread: f64,
}

/// One passage, as one side looks through it at the other.
#[derive(Clone, Copy)]
pub(crate) struct Through<'a> {
    pub(crate) passage: &'a dyn Passage,
    /// Part of space below it.
    below: u32,
    /// Whether light goes down through it.
    down: bool,
    /// (n_i/n_j)²: radiance that passes grows by this.
    grows: f64,
}

/// A node as it appears through a surface.
pub(crate) struct Apparent {
    bent: Bent,
    /// How far away it seems \[m\].
    distance: f64,
}

impl<'a> Through<'a> {
    /// For light that goes down, or up.
    pub(crate) fn new(passage: &'a dyn Passage, below: u32, down: bool) -> Self {
        let square = passage.index().powi(2);
        Self { passage, below, down, grows: if down { square } else { square.recip() } }
    }

    /// Whether light may pass it from one part of space to another.
    pub(crate) fn joins(&self, parts: [u32; 2]) -> bool {
        parts == [0, self.below] || parts == [self.below, 0]
    }

    /// The way from one point to another, as [`Passage::bent`].
    pub(crate) fn bent(&self, source: DVec3, receiver: DVec3) -> Option<Bent> {
        self.passage.bent(source, receiver, self.down)
    }

    /// What arrives at `x` from `y`, each a point with its normal, by the area of either.
    pub(crate) fn carries(&self, x: (DVec3, DVec3), y: (DVec3, DVec3)) -> f64 {
        self.bent(y.0, x.0).map_or(0.0, |bent| {
            let cosines = bent.toward.dot(x.1).max(0.0) * bent.leaving.dot(y.1).max(0.0);
            cosines * bent.share * bent.spread
        })
    }

    /// A source without what of it lies on the wrong side: that is brought to the surface.
    fn sending(&self, corners: &Corners) -> Corners {
        let (point, normal) = self.passage.plane();
        let up = if self.down { 1.0 } else { -1.0 };
        corners.map(|corner| corner - normal * (up * (up * (corner - point).dot(normal)).min(0.0)))
    }

    /// How `b` appears from the middle of `a`; none where no way leads through.
    pub(crate) fn apparent(&self, a: &Node, b: &Node) -> Option<Apparent> {
        let middle = if b.is_piece { triangle::centre(&self.sending(&b.corners)) } else { b.centre };
        let bent = self.bent(middle, a.centre)?;
        // dΩ = dA · spread · (n_j/n_i)²: the solid angle that it fills here.
        let distance = (self.grows / bent.spread).sqrt();
        (distance > 0.0 && distance.is_finite()).then_some(Apparent { bent, distance })
    }

    /// F_ij with nothing in the way (any tree's node `b`), `gap` radii apart.
    pub(crate) fn form_factor(
        &self,
        (tree, a, b): (&Tree, &Node, &Node),
        apparent: &Apparent,
        gap: f64,
    ) -> f64 {
        if !b.is_piece {
            let Bent { leaving, toward, share, spread, .. } = apparent.bent;
            return a.normal.dot(toward).max(0.0) * tree.projected(b, leaving) * share * spread / PI;
        }
        let middle = self.seen_from(a.centre, a.normal, &b.corners);
        if a.radius == 0.0 || gap > FAR {
            return middle;
        }
        let three = self.rule(&a.corners, a.normal, &b.corners, 0);
        if (three - middle).abs() <= EVEN { three } else { self.rule(&a.corners, a.normal, &b.corners, 2) }
    }

    /// Mean of three points on each of the 2ⁿ parts of a receiver.
    fn rule(&self, from: &Corners, normal: DVec3, to: &Corners, halvings: u32) -> f64 {
        if halvings > 0 {
            let halves = triangle::halves(from, triangle::apex(from));
            return 0.5 * halves.iter().map(|half| self.rule(half, normal, to, halvings - 1)).sum::<f64>();
        }
        triangle::three_points(from).iter().map(|&at| self.seen_from(at, normal, to)).sum::<f64>() / 3.0
    }

    /// From an element, by the directions in which the corners appear:
    ///
    ///   F = (n_i/n_j)² T F_Lambert(apparent triangle)
    ///
    /// as radiance over n² is the same along a way, but for what the surface takes. Apparent edges are bent, most at the rim of Snell's
    /// window: triangles are halved until each counts as straight ([`STRAIGHT`]). Neighbours share edges, so that none of the light
    /// is counted twice or not at all. T is a mean of the second degree.
    fn seen_from(&self, at: DVec3, normal: DVec3, to: &Corners) -> f64 {
        let to = self.sending(to);
        let [Some(a), Some(b), Some(c)] = to.map(|corner| self.bent(corner, at)) else {
            return 0.0;
        };
        if a.toward.dot(b.toward.cross(c.toward)) >= 0.0 {
            return 0.0; // seen from behind
        }
        self.apparent_form_factor((at, normal), &to, &[a, b, c], MOST_HALVINGS)
    }

    fn apparent_form_factor(
        &self,
        (at, normal): (DVec3, DVec3),
        to: &Corners,
        bent: &[Bent; 3],
        halvings: u32,
    ) -> f64 {
        // Of an edge alone, so that triangles that share it agree.
        let apart = |k: usize| {
            let [a, b] = [&bent[k], &bent[(k + 1) % 3]];
            (a.toward.distance(b.toward) / STRAIGHT).max((a.share - b.share).abs() / ALIKE)
        };
        let widest =
            if apart(0) >= apart(1).max(apart(2)) { 0 } else { 1 + usize::from(apart(2) > apart(1)) };
        if halvings > 0 && apart(widest) > 1.0 {
            let [i, j, k] = [widest, (widest + 1) % 3, (widest + 2) % 3];
            let middle = to[i].midpoint(to[j]);
            let Some(halfway) = self.bent(middle, at) else { return 0.0 };
            let halves = [[to[i], middle, to[k]], [middle, to[j], to[k]]];
            let ways = [[bent[i], halfway, bent[k]], [halfway, bent[j], bent[k]]];
            let half = |h: usize| self.apparent_form_factor((at, normal), &halves[h], &ways[h], halvings - 1);
            return half(0) + half(1);
        }
        let Some(middle) = self.bent(triangle::centre(to), at) else { return 0.0 };
        let passes = (bent.iter().map(|way| way.share).sum::<f64>() + 9.0 * middle.share) / 12.0;
        self.grows * passes * point_form_factor(DVec3::ZERO, normal, &bent.map(|way| way.toward))
    }
}

impl Apparent {
    /// How many radii of both lie between two nodes.
    pub(crate) fn gap(&self, a: &Node, b: &Node) -> f64 {
        self.distance.min(self.bent.at.distance(a.centre) + self.bent.at.distance(b.centre))
            / (a.radius + b.radius)
    }

    /// What share of `b`'s light about arrives at `a` at most. No strict bound, as that between nodes without a surface is: what is
    /// seen under a grazing angle is drawn out by the surface.
    pub(crate) fn sight(&self, a: &Node, b: &Node, through: &Through<'_>) -> Sight {
        let slack = SLACK / self.gap(a, b);
        if slack >= 1.0 {
            return Sight::Within(f64::INFINITY);
        }
        let (Some(cos_a), Some(cos_b)) =
            (best_cosine(a, self.bent.toward, slack), best_cosine(b, self.bent.leaving, slack))
        else {
            return Sight::None;
        };
        let near = self.distance * (1.0 - slack);
        Sight::Within(through.grows * b.area * cos_a * cos_b / (PI * near * near))
    }
}

/// By how much directions may differ more behind a surface than before it: n at most, but at grazing angles.
const SLACK: f64 = 1.5;

/// Distance in radii from which the middle of a receiver stands for all of it, as between patches without a surface.
const FAR: f64 = 8.0;

/// Where the middle of a receiver and three points of it differ by no more, the three are taken as right to a tenth of that.
const EVEN: f64 = 1e-3;

/// Apparent edges up to this wide \[rad\] count as straight: the rim of Snell's window, 0.85 rad about the vertical, bulges by an
/// eighth of the square over that beyond its chord, 0.006.
const STRAIGHT: f64 = 0.2;

/// Shares that pass may differ by so much over an edge: at the rim they rise from nothing like a square root.
const ALIKE: f64 = 0.2;

/// Triangles are halved so often at most, down to a sixteenth of an edge.
const MOST_HALVINGS: u32 = 8;
