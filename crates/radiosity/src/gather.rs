//! What a patch or a point sees of all patches, part by part.

use std::f64::consts::PI;

use light::Spectrum;
use light::sampling::scramble;

use crate::between::{Between, Cleared, Mirror, Pair};
use crate::form_factor::quick_form_factor;
use crate::sight::{Sight, sight};
use crate::tree::Node;
use crate::{Patches, point_form_factor};

/// Who looks.
pub(crate) struct Receiver<'a> {
    /// A patch, or a piece without an extent.
    pub(crate) node: &'a Node,
    /// Decides, with that of what is seen, which ways are tried.
    pub(crate) name: u32,
    /// It is at least this far off \[m\].
    pub(crate) error: f32,
}

/// How to look.
pub(crate) struct Gather<'a> {
    pub(crate) patches: &'a Patches,
    pub(crate) between: &'a Between<'a>,
    /// As [`crate::Linking`] has them.
    pub(crate) share: f64,
    pub(crate) rays: u32,
    pub(crate) seed: u32,
}

/// Straight, or over a mirror.
type Way<'a> = Option<(u32, &'a dyn Mirror)>;

/// Takes a node, F from the receiver to it, and the share that arrives.
type Receive<'a> = dyn FnMut(u32, f64, Spectrum) + 'a;

impl Gather<'_> {
    /// Reports all that the receiver sees, each part of the scene once for every way.
    pub(crate) fn all(&self, receiver: &Receiver<'_>, receive: &mut Receive<'_>) {
        if self.patches.is_empty() {
            return;
        }
        let mirrors = self.between.mirrors.iter().enumerate();
        for by in std::iter::once(None).chain(mirrors.map(|(k, mirror)| Some((k as u32, &**mirror)))) {
            let mut open = vec![0];
            while let Some(node) = open.pop() {
                if let Look::Into([first, second]) = self.look(receiver, node, by, receive) {
                    open.extend([second, first]);
                }
            }
        }
    }

    /// Looks at a node, and reports it if it may be seen as one.
    fn look(&self, receiver: &Receiver<'_>, source: u32, by: Way<'_>, receive: &mut Receive<'_>) -> Look {
        let (a, b) = (receiver.node, &self.patches.tree.nodes[source as usize]);
        let image;
        let seen = match by {
            None => b,
            Some((_, mirror)) if are_apart(mirror, a, b) => return Look::Done,
            Some((_, mirror)) => {
                image = b.image(mirror.plane().0, mirror.plane().1);
                &image
            }
        };
        let Sight::Within(most) = sight(a, seen) else { return Look::Done };
        let gap = a.centre.distance(seen.centre) / (a.radius + b.radius);
        let may = most <= self.share && (b.is_piece || (b.spread <= WIDEST_GROUP && gap >= FAR));
        let children = match b.children {
            Some(children) if !may => return Look::Into(children),
            other => other,
        };
        let share = self.clear_share(a, b, seen, by, gap);
        if share <= 0.0 {
            return Look::Done;
        }
        let (tint, partial) = self.through(receiver, source, by, self.ways(most));
        match children {
            Some(children) if partial && most > 0.25 * self.share => Look::Into(children),
            _ => {
                receive(source, share, tint);
                Look::Done
            }
        }
    }

    /// F_ij with nothing in the way; `seen` is `b`, or its mirror image.
    fn clear_share(&self, a: &Node, b: &Node, seen: &Node, by: Way<'_>, gap: f64) -> f64 {
        if !b.is_piece {
            let distance = a.centre.distance(seen.centre);
            let toward = (seen.centre - a.centre) / distance;
            // A mirrored group is the group itself, seen along the mirrored way.
            let back = by.map_or(-toward, |(_, mirror)| {
                let normal = mirror.plane().1;
                normal * (2.0 * toward.dot(normal)) - toward
            });
            let projected = self.patches.tree.projected(b, back);
            return a.normal.dot(toward).max(0.0) * projected / (PI * distance * distance);
        }
        if a.radius == 0.0 {
            let facing = (a.centre - seen.corners[0]).dot(seen.normal) > 0.0;
            return if facing { point_form_factor(a.centre, a.normal, &seen.corners) } else { 0.0 };
        }
        quick_form_factor(&a.corners, &seen.corners, gap, PAIR_TOLERANCE)
    }

    /// How many ways are tried to what fills no more than `most` of the hemisphere: fewer where less depends on them.
    ///
    /// n ways leave a link's light uncertain by share²/(4 n) at most. From a quarter of the largest share down n goes with the share: then
    /// the many small links of a patch leave no more in all than the few large ones.
    fn ways(&self, most: f64) -> u32 {
        let rays = self.rays.clamp(1, 1 << 16);
        let part = (4.0 * most / self.share).min(1.0);
        ((f64::from(rays) * part).ceil() as u32).clamp(1, rays)
    }

    /// The share that arrives between receiver and node by so many ways, and whether things hide them in part.
    fn through(&self, receiver: &Receiver<'_>, source: u32, by: Way<'_>, rays: u32) -> (Spectrum, bool) {
        let nodes = [receiver.node, &self.patches.tree.nodes[source as usize]];
        let mirror = by.map(|(_, mirror)| mirror);
        let cleared;
        let between = match self.between.cleared(nodes, mirror) {
            Cleared::All => return (Spectrum::ONE, false),
            Cleared::OfThings(between) => {
                cleared = between;
                &cleared
            }
            Cleared::No => self.between,
        };
        let over = by.map_or(0, |(mirror, _)| mirror + 1);
        let name = scramble(receiver.name ^ scramble(source ^ scramble(over)));
        let pair = Pair {
            tree: &self.patches.tree,
            nodes,
            mirror,
            seed: scramble(name ^ scramble(self.seed)),
            rays: self.rays.max(1),
            error: receiver.error,
        };
        let mut first = between.ways(&pair, 0, rays);
        if first.is_nothing() && rays < self.rays {
            // Points of groups may look away from each other.
            first = between.ways(&pair, rays, self.rays - rays);
        }
        if first.is_partial() {
            return (first.and(between.ways(&pair, rays, 4 * rays)).value(), true);
        }
        (first.value(), false)
    }
}

/// What to do after a look.
enum Look {
    Done,
    Into([u32; 2]),
}

/// Distance, in radii, from which groups are taken as points: their shares are off by up to (1/FAR)².
const FAR: f64 = 4.0;

/// Groups whose normals are farther apart \[rad\] are never seen as one.
const WIDEST_GROUP: f64 = 0.5;

/// Of form factors of near pairs: a patch has some tens of them, whose errors add at worst.
const PAIR_TOLERANCE: f64 = 1e-4;

/// Whether two nodes lie on different sides of a mirror, which does not join them then.
fn are_apart(mirror: &dyn Mirror, a: &Node, b: &Node) -> bool {
    let (point, normal) = mirror.plane();
    let [ha, hb] = [a, b].map(|node| (node.centre - point).dot(normal));
    (ha >= a.radius && hb <= -b.radius) || (ha <= -a.radius && hb >= b.radius)
}
