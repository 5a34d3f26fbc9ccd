//! What a patch or a point sees of all patches, part by part.

use std::f64::consts::PI;

use light::Spectrum;
use light::sampling::scramble;

use crate::between::{Between, By, Cleared, Pair, Way};
use crate::form_factor::quick_form_factor;
use crate::passage::{Apparent, Through};
use crate::sight::{Sight, sight};
use crate::tree::{MIXED, Node};
use crate::{Mirror, Patches, point_form_factor};

/// Who looks.
pub(crate) struct Receiver<'a> {
    /// A patch, or a piece without an extent.
    pub(crate) node: &'a Node,
    /// Decides, with that of what is seen, which ways are tried.
    pub(crate) name: u32,
    /// It is at least this far off \[m\].
    pub(crate) error: f32,
    /// Part of space that it is in.
    pub(crate) part: u32,
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

/// What a receiver sees of a node.
pub(crate) struct Sent {
    /// The node.
    pub(crate) source: u32,
    /// F from the receiver to it.
    pub(crate) share: f64,
    /// The share of that which arrives.
    pub(crate) tint: Spectrum,
    /// Whether it has passed a surface.
    pub(crate) bent: bool,
}

/// Takes what is seen.
type Receive<'a> = dyn FnMut(Sent) + 'a;

impl Gather<'_> {
    /// Reports all that the receiver sees, each part of the scene once for every way.
    pub(crate) fn all(&self, receiver: &Receiver<'_>, receive: &mut Receive<'_>) {
        if self.patches.is_empty() {
            return;
        }
        for way in self.between.ways_to(receiver.part) {
            let mut open = vec![0];
            while let Some(node) = open.pop() {
                if let Look::Into([first, second]) = self.look(receiver, node, way, receive) {
                    open.extend([second, first]);
                }
            }
        }
    }

    /// Looks at a node, and reports it if it may be seen as one.
    fn look(&self, receiver: &Receiver<'_>, source: u32, way: Way<'_>, receive: &mut Receive<'_>) -> Look {
        let b = &self.patches.tree.nodes[source as usize];
        let seen = match way.by {
            By::Through(through) => match self.bent(receiver, b, &through) {
                Ok(seen) => seen,
                Err(Hidden) => return b.children.map_or(Look::Done, Look::Into),
            },
            By::Mirrored(mirror) if are_apart(mirror, receiver.node, b) => None,
            _ => self.unbent(receiver.node, b, way.by),
        };
        let Some(seen) = seen else { return Look::Done };
        let is_small = seen.most <= self.share && b.part != MIXED;
        let may = is_small && (b.is_piece || (b.spread <= WIDEST_GROUP && seen.gap >= FAR));
        let children = match b.children {
            Some(children) if !may => return Look::Into(children),
            other => other,
        };
        let share = self.clear_share(receiver.node, b, &seen, way.by);
        if share <= 0.0 {
            return Look::Done;
        }
        let (tint, partial) = self.through(receiver, source, way, self.ways(seen.most));
        match children {
            Some(children) if partial && seen.most > 0.25 * self.share => Look::Into(children),
            _ => {
                receive(Sent { source, share, tint, bent: matches!(way.by, By::Through(_)) });
                Look::Done
            }
        }
    }

    /// What is known of a node that is seen straight, or in a mirror; none where surely nothing is.
    fn unbent(&self, a: &Node, b: &Node, by: By<'_>) -> Option<Seen> {
        let image = match by {
            By::Mirrored(mirror) => b.image(mirror.plane().0, mirror.plane().1),
            _ => *b,
        };
        let Sight::Within(most) = sight(a, &image) else { return None };
        let gap = a.centre.distance(image.centre) / (a.radius + b.radius);
        Some(Seen { most, gap, how: How::As(image) })
    }

    /// The same of a node behind a surface; hidden where its middle says nothing about its parts.
    fn bent(&self, receiver: &Receiver<'_>, b: &Node, through: &Through<'_>) -> Result<Option<Seen>, Hidden> {
        if b.part == MIXED {
            return Err(Hidden);
        }
        if !through.joins([receiver.part, b.part]) {
            return Ok(None);
        }
        // The middle of a group may lie beside the water and below its level.
        let apparent = through.apparent(receiver.node, b).ok_or(Hidden)?;
        let Sight::Within(most) = apparent.sight(receiver.node, b, through) else { return Ok(None) };
        Ok(Some(Seen { most, gap: apparent.gap(receiver.node, b), how: How::Bent(apparent) }))
    }

    /// F_ij with nothing in the way.
    fn clear_share(&self, a: &Node, b: &Node, seen: &Seen, by: By<'_>) -> f64 {
        let gap = seen.gap;
        let seen = match (&seen.how, by) {
            (How::As(image), _) => image,
            (How::Bent(apparent), By::Through(through)) => {
                return through.form_factor((&self.patches.tree, a, b), apparent, gap);
            }
            (How::Bent(_), _) => return 0.0,
        };
        if !b.is_piece {
            let distance = a.centre.distance(seen.centre);
            let toward = (seen.centre - a.centre) / distance;
            // A mirrored group is the group itself, seen along the mirrored way.
            let back = match by {
                By::Mirrored(mirror) => {
                    let normal = mirror.plane().1;
                    normal * (2.0 * toward.dot(normal)) - toward
                }
                _ => -toward,
            };
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
    fn through(&self, receiver: &Receiver<'_>, source: u32, way: Way<'_>, rays: u32) -> (Spectrum, bool) {
        let nodes = [receiver.node, &self.patches.tree.nodes[source as usize]];
        let cleared;
        let between = match self.between.cleared(nodes, way.by) {
            Cleared::All => return (Spectrum::ONE, false),
            Cleared::OfThings(between) => {
                cleared = between;
                &cleared
            }
            Cleared::No => self.between,
        };
        let name = scramble(receiver.name ^ scramble(source ^ scramble(way.number)));
        let pair = Pair {
            tree: &self.patches.tree,
            nodes,
            by: way.by,
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

/// What is known of a node before anything is tried.
struct Seen {
    /// As [`Sight::Within`].
    most: f64,
    /// Distance from the receiver, in radii of both.
    gap: f64,
    how: How,
}

/// Where it appears.
enum How {
    /// Where it is, or where its mirror image is.
    As(Node),
    Bent(Apparent),
}

/// The middle of a node does not show.
struct Hidden;

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
