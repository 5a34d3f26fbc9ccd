//! Which parts of the scene light which patch: links to nodes of the tree, as coarse as they may be.

use std::sync::atomic::{AtomicUsize, Ordering};

use light::Spectrum;
use rayon::prelude::*;

use crate::Patches;
use crate::balance::Balance;
use crate::between::Between;
use crate::gather::{Gather, Receiver, Sent};

/// How exactly light is followed from patch to patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linking {
    /// A part of the scene is seen as one, with the mean of its light, where it surely fills no more than this share of a patch's
    /// hemisphere; one that things hide in part, no more than a fourth of it. Links grow as its inverse.
    pub share: f64,
    /// Ways that are tried for each link, and four times as many more where they disagree; 0 counts as 1.
    pub rays: u32,
    /// That every patch sees nothing but patches, through clear air: shares are made to sum to 1, which takes out the noise of the
    /// tried ways from the balance of light.
    pub closed: bool,
    /// No more links than this (12 bytes each): `share` grows until they fit.
    pub most: usize,
    /// Decides which ways are tried, together with the pair.
    pub seed: u32,
}

impl Default for Linking {
    /// See the crate's first page for what it costs and leaves.
    fn default() -> Self {
        Self { share: 0.05, rays: 4, closed: false, most: 100_000_000, seed: 0 }
    }
}

/// A part of the scene that a patch sees.
#[derive(Clone, Copy)]
pub(crate) struct Link {
    /// Node.
    pub(crate) source: u32,
    /// F_ij, with what is in the way.
    pub(crate) share: f32,
    /// Index into the tints; 0 = all bands alike. Links through a surface are marked by [`BENT`].
    tint: u32,
}

/// Marks the tint of a link through a surface.
const BENT: u32 = 1 << 31;

impl Link {
    fn tint(&self) -> usize {
        (self.tint & !BENT) as usize
    }
}

/// What every patch sees of all others.
///
/// *Balance.* Links see parts of the scene as evenly bright. What that does to the sums of F_ij over the receivers j of each i's
/// light is put right by a factor for each patch as a sender and one as a receiver (Sinkhorn's iteration): of all that leaves
/// a patch the share arrives that the patch itself sees of others, A_i Σ_j F_ij both ways, and no light is ever made.
pub struct Links {
    pub(crate) links: Vec<Link>,
    tints: Vec<Spectrum>,
    /// By patch: where its links begin; and the end of all.
    pub(crate) starts: Vec<usize>,
    /// By part of space from 1 on: n² relative to part 0.
    squares: Vec<f64>,
    balance: Balance,
    share: f64,
}

impl Links {
    /// Finds the links of all patches.
    pub fn new(patches: &Patches, between: &Between<'_>, linking: &Linking) -> Self {
        let share = if linking.share > 0.0 { linking.share.min(1.0) } else { 1e-6 };
        let mut finder =
            Finder { patches, between, linking: Linking { share, ..*linking }, found: AtomicUsize::new(0) };
        let found = loop {
            if let Some(found) = finder.find() {
                break found;
            }
            finder.linking.share *= std::f64::consts::SQRT_2;
            finder.found = AtomicUsize::new(0);
        };
        let count = found.iter().map(|(list, _)| list.len()).sum();
        let (mut tints, mut links, mut starts) = (vec![Spectrum::ONE], Vec::with_capacity(count), vec![0]);
        for (list, colours) in found {
            links.extend(list.into_iter().map(|link| Link {
                tint: if link.tint() == 0 { link.tint } else { link.tint - 1 + tints.len() as u32 },
                ..link
            }));
            tints.extend(colours);
            starts.push(links.len());
        }
        let squares = between.passages.iter().map(|passage| passage.index().powi(2)).collect();
        let mut all = Self {
            links,
            tints,
            starts,
            squares,
            balance: Balance::none(patches.len()),
            share: finder.linking.share,
        };
        all.balance = Balance::of(patches, &all, linking.closed);
        all
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
        size_of_val(&*self.links) + size_of_val(&*self.tints) + size_of_val(&*self.starts)
    }

    /// By patch, the share of its hemisphere that is filled with patches as far as it sees them, Σ_j F_ij n_j²/n_i², within \[0, 1\] but for
    /// rounding: 1 in a closed room, but for the noise of the tried ways.
    pub fn closure(&self, patches: &Patches) -> Vec<Spectrum> {
        let square = |i: usize| self.square(patches.parts[i]) as f32;
        let even: Vec<_> = (0..patches.len()).map(|i| Spectrum::splat(square(i))).collect();
        let arriving = self.irradiance(patches, &even);
        arriving.into_iter().enumerate().map(|(i, arriving)| arriving * square(i).recip()).collect()
    }

    /// The largest factor by which the balance changed a patch's light, less 1: what the links left to put right.
    pub fn imbalance(&self) -> f64 {
        self.balance.largest()
    }

    /// E_i = Σ_j F_ij B_j, by patch.
    pub fn irradiance(&self, patches: &Patches, exitance: &[Spectrum]) -> Vec<Spectrum> {
        let means = self.sent(patches, exitance);
        let receive = |patch: usize| -> Spectrum {
            let mut sum = Spectrum::ZERO;
            for link in &self.links[self.starts[patch]..self.starts[patch + 1]] {
                let carried = means[link.source as usize] * link.share;
                sum += if link.tint() == 0 { carried } else { carried * self.tints[link.tint()] };
            }
            sum * self.balance.receive[patch]
        };
        (0..patches.len()).into_par_iter().with_min_len(64).map(receive).collect()
    }

    /// By node: what it sends out, as its links see it.
    pub(crate) fn sent(&self, patches: &Patches, exitance: &[Spectrum]) -> Vec<Spectrum> {
        let balanced: Vec<_> =
            exitance.iter().zip(&self.balance.send).map(|(&exitance, &send)| exitance * send).collect();
        crate::solve::pulled(patches, &balanced)
    }

    /// Of a link, F_ij in its best band.
    pub(crate) fn largest(&self, link: &Link) -> f64 {
        f64::from(link.share) * f64::from(self.tints[link.tint()].max())
    }

    /// Of a link of patch `i`, F_ij n_j²/n_i² in its best band, or F_ij if it passes no surface: what it takes of a light in balance.
    pub(crate) fn taken(&self, i: usize, link: &Link, patches: &Patches) -> f64 {
        if link.tint & BENT == 0 {
            return self.largest(link);
        }
        let parts = [patches.parts[i], patches.tree.nodes[link.source as usize].part];
        self.largest(link) * self.square(parts[1]) / self.square(parts[0])
    }

    /// n² relative to part 0 of space.
    fn square(&self, part: u32) -> f64 {
        self.squares.get((part as usize).wrapping_sub(1)).copied().unwrap_or(1.0)
    }
}

/// The links of one patch, and the tints that they count from 1.
type Found = (Vec<Link>, Vec<Spectrum>);

struct Finder<'a> {
    patches: &'a Patches,
    between: &'a Between<'a>,
    linking: Linking,
    found: AtomicUsize,
}

impl Finder<'_> {
    /// All links by patch; none when they are too many.
    fn find(&self) -> Option<Vec<Found>> {
        let found = (0..self.patches.len()).into_par_iter().map(|patch| self.of(patch)).collect();
        (self.found.load(Ordering::Relaxed) <= self.linking.most).then_some(found)
    }

    /// The links of a patch; whatever, once there are too many in all.
    fn of(&self, patch: usize) -> Found {
        let mut found = (Vec::new(), Vec::new());
        if self.found.load(Ordering::Relaxed) > self.linking.most {
            return found;
        }
        let Self { patches, between, linking, .. } = self;
        let gather =
            Gather { patches, between, share: linking.share, rays: linking.rays, seed: linking.seed };
        let node = patches.node(patch);
        let receiver = Receiver { node, name: patches.leaves[patch], error: 0.0, part: node.part };
        gather.all(&receiver, &mut |seen| add(&mut found, &seen));
        self.found.fetch_add(found.0.len(), Ordering::Relaxed);
        found
    }
}

fn add((links, tints): &mut Found, &Sent { source, share, tint, bent }: &Sent) {
    let mark = if bent { BENT } else { 0 };
    if tint.is_zero() {
        return;
    }
    if tint.0.iter().all(|&band| band == tint[0]) {
        links.push(Link { source, share: share as f32 * tint[0], tint: mark });
    } else {
        tints.push(tint);
        links.push(Link { source, share: share as f32, tint: mark | tints.len() as u32 });
    }
}
