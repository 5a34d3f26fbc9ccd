//! Which parts of the scene light which: links between nodes of the tree, as coarse as they may be.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use light::Spectrum;
use light::sampling::scramble;
use rayon::prelude::*;

use crate::Patches;
use crate::between::{Between, Mirror, Pair};
use crate::form_factor::{far_exchange, form_factor, point_exchange};
use crate::sight::{Sight, sight};
use crate::tree::Node;

/// How exactly light is followed from patch to patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linking {
    /// No link between groups of patches carries more than this share of what either sends out, as bounded by their
    /// spheres; pairs that things hide in part carry no more than a fourth of it. Links grow as its inverse.
    pub share: f64,
    /// Ways that are tried for each link, and four times as many more where they disagree; 0 counts as 1.
    pub rays: u32,
    /// No more links than this (24 bytes each): `share` grows until they fit.
    pub most: usize,
    /// Decides which ways are tried, together with the pair.
    pub seed: u32,
}

impl Default for Linking {
    /// See the crate's first page for what it costs and leaves.
    fn default() -> Self {
        Self { share: 0.02, rays: 4, most: 100_000_000, seed: 0 }
    }
}

/// A pair of nodes that light each other.
#[derive(Clone, Copy)]
struct Link {
    nodes: [u32; 2],
    /// A_i F_ij = A_j F_ji \[m²\], with what is in the way.
    exchange: f32,
    /// Index into the tints; 0 = all bands alike.
    tint: u32,
}

/// What every patch sees of all others.
///
/// Each link serves both directions, so that A_i F_ij = A_j F_ji to the bit. Where the shares that a patch sees sum to more
/// than 1, by the errors of the links or of the tried ways, its links are scaled down: no light is ever made.
pub struct Links {
    links: Vec<Link>,
    tints: Vec<Spectrum>,
    /// By node: where its links begin in `ends`; and the end of all.
    starts: Vec<usize>,
    /// By node, the links it is an end of.
    ends: Vec<u32>,
    share: f64,
}

/// Pairs that are looked at one by one before they are shared out: many times what any machine has threads.
const FRONTIER: usize = 4096;

/// Two nodes, and over which mirror.
type Candidate = ([u32; 2], Option<u32>);

impl Links {
    /// Finds the links of all patches.
    pub fn new(patches: &Patches, between: &Between<'_>, linking: &Linking) -> Self {
        let mut finder = Finder { patches, between, linking: *linking, found: AtomicUsize::new(0) };
        finder.linking.share = if linking.share > 0.0 { linking.share.min(1.0) } else { 1e-6 };
        loop {
            if let Some(found) = finder.find() {
                let mut links = Self::of(patches, found, finder.linking.share);
                links.bound(patches);
                return links;
            }
            finder.linking.share *= std::f64::consts::SQRT_2;
            finder.found = AtomicUsize::new(0);
        }
    }

    fn of(patches: &Patches, found: Vec<(Link, Spectrum)>, share: f64) -> Self {
        let nodes = patches.tree.nodes.len();
        let mut tints = vec![Spectrum::ONE];
        let mut links = Vec::with_capacity(found.len());
        let mut starts = vec![0; nodes + 1];
        for (mut link, tint) in found {
            if tint != Spectrum::ONE {
                link.tint = tints.len() as u32;
                tints.push(tint);
            }
            for node in distinct(link.nodes) {
                starts[node as usize + 1] += 1;
            }
            links.push(link);
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut ends = vec![0; starts[nodes]];
        for (k, link) in links.iter().enumerate() {
            for node in distinct(link.nodes) {
                ends[next[node as usize]] = k as u32;
                next[node as usize] += 1;
            }
        }
        Self { links, tints, starts, ends, share }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.links.len()
    }

    /// Whether no patch sees another.
    pub fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// The bound on a link's share in the end: [`Linking::share`], or what [`Linking::most`] made of it.
    pub fn share(&self) -> f64 {
        self.share
    }

    /// Memory taken \[bytes\].
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.links) + size_of_val(&*self.tints) + size_of_val(&*self.ends) + size_of_val(&*self.starts)
    }

    /// By patch, the share of its hemisphere that is filled with patches, Σ_j F_ij, within \[0, 1\]: 1 in a closed room, but for the
    /// errors of the links.
    pub fn closure(&self, patches: &Patches) -> Vec<Spectrum> {
        let all = vec![Spectrum::ONE; patches.tree.nodes.len()];
        let seen = self.irradiance(patches, &all);
        patches.leaves.iter().map(|&node| seen[node as usize]).collect()
    }

    /// E_i = Σ_j F_ij B_j by node, from exitances by node; what groups receive is all of their parts'.
    pub(crate) fn irradiance(&self, patches: &Patches, exitance: &[Spectrum]) -> Vec<Spectrum> {
        let nodes = &patches.tree.nodes;
        let receive = |node: usize| -> Spectrum {
            let mut sum = Spectrum::ZERO;
            for &end in &self.ends[self.starts[node]..self.starts[node + 1]] {
                let link = &self.links[end as usize];
                let [a, b] = link.nodes;
                let other = if a as usize == node { b } else { a };
                let carried = exitance[other as usize] * link.exchange;
                sum += if link.tint == 0 { carried } else { carried * self.tints[link.tint as usize] };
            }
            sum * (nodes[node].area as f32).recip()
        };
        let mut irradiance: Vec<_> = (0..nodes.len()).into_par_iter().with_min_len(64).map(receive).collect();
        for (node, children) in nodes.iter().enumerate().filter_map(|(k, node)| Some((k, node.children?))) {
            let above = irradiance[node];
            for child in children {
                irradiance[child as usize] += above;
            }
        }
        irradiance
    }

    /// Scales down what would make light.
    fn bound(&mut self, patches: &Patches) {
        let nodes = &patches.tree.nodes;
        let mut seen: Vec<f32> = vec![1.0; nodes.len()];
        for (patch, sum) in self.closure(patches).into_iter().enumerate() {
            seen[patches.leaves[patch] as usize] = sum.max().max(1.0);
        }
        for (node, children) in nodes.iter().enumerate().rev() {
            if let Some([a, b]) = children.children {
                seen[node] = seen[a as usize].max(seen[b as usize]);
            }
        }
        for link in &mut self.links {
            let most = link.nodes.map(|node| seen[node as usize]);
            link.exchange /= most[0].max(most[1]);
        }
    }
}

/// Both ends of a link, or the one end of one to itself over a mirror.
fn distinct([a, b]: [u32; 2]) -> impl Iterator<Item = u32> {
    [Some(a), (a != b).then_some(b)].into_iter().flatten()
}

/// What comes of a candidate.
enum Outcome {
    Nothing,
    Link(Link, Spectrum),
    Split(Vec<Candidate>),
}

struct Finder<'a> {
    patches: &'a Patches,
    between: &'a Between<'a>,
    linking: Linking,
    found: AtomicUsize,
}

impl Finder<'_> {
    /// All links in an order that threads have no part in; none when they are too many.
    fn find(&self) -> Option<Vec<(Link, Spectrum)>> {
        if self.patches.is_empty() {
            return Some(Vec::new());
        }
        let mirrors = 0..self.between.mirrors.len() as u32;
        let mut frontier: Vec<Candidate> = vec![([0, 0], None)];
        frontier.extend(mirrors.map(|mirror| ([0, 0], Some(mirror))));
        let mut links = Vec::new();
        while !frontier.is_empty() && frontier.len() < FRONTIER {
            let mut next = Vec::new();
            for candidate in frontier {
                match self.look(candidate) {
                    Outcome::Nothing => {}
                    Outcome::Link(link, tint) => links.push((link, tint)),
                    Outcome::Split(parts) => next.extend(parts),
                }
            }
            frontier = next;
        }
        let rest: Vec<_> = frontier.into_par_iter().with_max_len(1).map(|one| self.below(one)).collect();
        if self.found.load(Ordering::Relaxed) > self.linking.most {
            return None;
        }
        links.extend(rest.into_iter().flatten());
        Some(links)
    }

    /// The links of a candidate and its parts; whatever, once there are too many.
    fn below(&self, candidate: Candidate) -> Vec<(Link, Spectrum)> {
        let (mut open, mut links) = (vec![candidate], Vec::new());
        while let Some(candidate) = open.pop() {
            match self.look(candidate) {
                Outcome::Nothing => {}
                Outcome::Link(link, tint) => {
                    links.push((link, tint));
                    if self.found.fetch_add(1, Ordering::Relaxed) >= self.linking.most {
                        return links;
                    }
                }
                Outcome::Split(parts) => open.extend(parts),
            }
        }
        links
    }

    fn look(&self, (nodes, mirror): Candidate) -> Outcome {
        let all = &self.patches.tree.nodes;
        let [a, b] = nodes.map(|node| &all[node as usize]);
        if nodes[0] == nodes[1] {
            if a.is_piece && mirror.is_none() {
                return Outcome::Nothing;
            }
            if let Some([first, second]) = a.children {
                let parts = [[first, first], [first, second], [second, second]];
                return Outcome::Split(parts.map(|nodes| (nodes, mirror)).to_vec());
            }
        }
        let by = mirror.map(|mirror| self.between.mirrors[mirror as usize]);
        let seen = match by {
            None => *b,
            Some(by) if are_apart(by.plane(), [a, b]) => return Outcome::Nothing,
            Some(by) => b.image(by.plane().0, by.plane().1),
        };
        let Sight::Within(share) = sight(a, &seen) else { return Outcome::Nothing };
        let whole = a.children.is_none() && b.children.is_none();
        if share <= self.linking.share || whole {
            let exchange = self.exchange([a, b], &seen, nodes, by);
            if exchange <= 0.0 {
                return Outcome::Nothing;
            }
            let (tint, partial) = self.through([a, b], nodes, by, mirror);
            if whole || !partial || share <= 0.25 * self.linking.share {
                return link(nodes, exchange, tint);
            }
        }
        Outcome::Split(split(all, nodes).map(|nodes| (nodes, mirror)).to_vec())
    }

    /// A_i F_ij with nothing in the way \[m²\]; `seen` is the second node, or its mirror image.
    fn exchange(&self, [a, b]: [&Node; 2], seen: &Node, nodes: [u32; 2], by: Option<&dyn Mirror>) -> f64 {
        let tree = &self.patches.tree;
        let distance = a.centre.distance(seen.centre);
        let exchange = if a.is_piece && b.is_piece {
            // Points on the smaller, the exact integral over the larger.
            let swap = b.radius < a.radius || (b.radius == a.radius && nodes[1] < nodes[0]);
            let (outer, inner) = if swap { (seen, a) } else { (a, seen) };
            if distance > 4.0 * (a.radius + b.radius) {
                far_exchange(&outer.corners, &inner.corners)
            } else {
                let tolerance = 0.01 * self.linking.share;
                outer.area * form_factor(&outer.corners, &inner.corners, tolerance).share
            }
        } else {
            let toward = (seen.centre - a.centre) / distance;
            // A mirrored group is the group itself seen along the mirrored way.
            let back = by.map_or(-toward, |by| {
                let normal = by.plane().1;
                normal * (2.0 * toward.dot(normal)) - toward
            });
            point_exchange([tree.projected(a, toward), tree.projected(b, back)], distance)
        };
        exchange.min(a.area).min(b.area)
    }

    /// The share that arrives between two nodes, and whether things hide them in part.
    fn through(
        &self,
        pair: [&Node; 2],
        nodes: [u32; 2],
        by: Option<&dyn Mirror>,
        mirror: Option<u32>,
    ) -> (Spectrum, bool) {
        let name = nodes[0].min(nodes[1]) ^ scramble(nodes[0].max(nodes[1]) ^ scramble(mirror.map_or(0, |m| m + 1)));
        let rays = self.linking.rays.clamp(1, 1 << 16);
        let seed = scramble(name ^ scramble(self.linking.seed));
        let pair = Pair { tree: &self.patches.tree, nodes: pair, mirror: by, seed, rays };
        let first = self.between.ways(&pair, 0, rays);
        if first.is_partial() {
            let more = self.between.ways(&pair, rays, 4 * rays);
            return (first.and(more).value(), true);
        }
        (first.value(), false)
    }
}

fn link(nodes: [u32; 2], exchange: f64, tint: Spectrum) -> Outcome {
    if tint.is_zero() {
        return Outcome::Nothing;
    }
    let grey = tint.0.iter().all(|&band| band == tint[0]);
    let (exchange, tint) =
        if grey { (exchange as f32 * tint[0], Spectrum::ONE) } else { (exchange as f32, tint) };
    Outcome::Link(Link { nodes, exchange, tint: 0 }, tint)
}

/// Whether two nodes lie on different sides of a plane, where no mirror joins them.
fn are_apart((point, normal): (DVec3, DVec3), nodes: [&Node; 2]) -> bool {
    let [a, b] = nodes.map(|node| (node.centre - point).dot(normal));
    let [ra, rb] = nodes.map(|node| node.radius);
    (a >= ra && b <= -rb) || (a <= -ra && b >= rb)
}

/// The larger of the two halved, if it can be.
fn split(all: &[Node], [a, b]: [u32; 2]) -> [[u32; 2]; 2] {
    let [mine, theirs] = [a, b].map(|node| &all[node as usize]);
    match (mine.children, theirs.children) {
        (Some(parts), Some(_)) if mine.radius >= theirs.radius => parts.map(|part| [part, b]),
        (Some(parts), None) => parts.map(|part| [part, b]),
        (_, Some(parts)) => parts.map(|part| [a, part]),
        // Only asked for pairs that can be halved; a pair of patches is its own half otherwise.
        (None, None) => [[a, b]; 2],
    }
}
