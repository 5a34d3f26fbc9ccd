//! Factors that put the balance of light right.

use rayon::prelude::*;

use crate::{Links, Patches};

/// By patch, what its light is multiplied with when it is sent, and when it is received.
pub(crate) struct Balance {
    pub(crate) send: Vec<f32>,
    pub(crate) receive: Vec<f32>,
}

/// Rounds of the iteration; what is too much after them is taken off where it arrives, so that no light is made.
const ROUNDS: usize = 50;

/// The iteration ends when no sum is off by more: ten roundings of f32.
const ENOUGH: f64 = 1e-6;

/// Parts in which sums over links are made side by side.
const PARTS: usize = 16;

impl Balance {
    pub(crate) fn none(patches: usize) -> Self {
        Self { send: vec![1.0; patches], receive: vec![1.0; patches] }
    }

    /// Finds u and w so that u_i Σ_j F_ij w_j = t_i and w_j Σ_i A_i u_i F_ij = A_j t_j, where t_i = Σ_j F_ij, at most 1, is what patch i
    /// sees of others: by reciprocity what leaves it arrives in the same share. Through surfaces the first sum is of F_ij n_j²/n_i², as
    /// A_i n_i² is what is reciprocal there; of the second that leaves nothing.
    pub(crate) fn of(patches: &Patches, links: &Links, closed: bool) -> Self {
        let count = patches.len();
        let (mut send, mut receive) = (vec![1.0; count], vec![1.0; count]);
        let rows = received(patches, links, &send);
        let aims: Vec<f64> =
            rows.iter().map(|&row| if closed && row > 0.0 { 1.0 } else { row.min(1.0) }).collect();
        let factor = |aim: f64, sum: f64| if sum > 0.0 { aim / sum } else { 1.0 };
        let mut rows = rows;
        for _ in 0..ROUNDS {
            for (patch, receive) in receive.iter_mut().enumerate() {
                *receive = factor(aims[patch], rows[patch]);
            }
            let columns = sent(patches, links, &receive);
            for (patch, send) in send.iter_mut().enumerate() {
                *send = factor(aims[patch], columns[patch]);
            }
            rows = received(patches, links, &send);
            let off = (0..count).map(|i| (rows[i] * receive[i] - aims[i]).abs()).fold(0.0, f64::max);
            if off <= ENOUGH {
                break;
            }
        }
        // Columns are right now; rows that are still too large are made smaller, which makes no column larger.
        for (patch, receive) in receive.iter_mut().enumerate() {
            *receive *= factor(aims[patch], rows[patch] * *receive).min(1.0);
        }
        let [send, receive] =
            [send, receive].map(|list| list.into_iter().map(|factor| factor as f32).collect());
        Self { send, receive }
    }

    pub(crate) fn largest(&self) -> f64 {
        let all = self.send.iter().chain(&self.receive);
        all.map(|&factor| f64::from((factor - 1.0).abs())).fold(0.0, f64::max)
    }
}

/// By patch: Σ_j F_ij w_j.
fn received(patches: &Patches, links: &Links, weights: &[f64]) -> Vec<f64> {
    let nodes = &patches.tree.nodes;
    let mut means = vec![0.0; nodes.len()];
    for (&node, weight) in patches.leaves.iter().zip(weights) {
        means[node as usize] = *weight;
    }
    for (k, node) in nodes.iter().enumerate().rev() {
        if let Some(children) = node.children {
            let sum: f64 = children.iter().map(|&c| means[c as usize] * nodes[c as usize].area).sum();
            means[k] = sum / node.area;
        }
    }
    let sum = |patch: usize| {
        let mine = &links.links[links.starts[patch]..links.starts[patch + 1]];
        mine.iter().map(|link| links.taken(patch, link, patches) * means[link.source as usize]).sum()
    };
    (0..patches.len()).into_par_iter().with_min_len(64).map(sum).collect()
}

/// By patch: Σ_i A_i u_i F_ij / A_j, where what a node sends is sent by all of its patches alike.
fn sent(patches: &Patches, links: &Links, weights: &[f64]) -> Vec<f64> {
    let nodes = &patches.tree.nodes;
    let part = |mine: std::ops::Range<usize>| {
        let mut sums = vec![0.0; nodes.len()];
        for patch in mine {
            let flux = patches.node(patch).area * weights[patch];
            for link in &links.links[links.starts[patch]..links.starts[patch + 1]] {
                sums[link.source as usize] += flux * links.largest(link);
            }
        }
        sums
    };
    // As many parts whatever the threads are, summed in order: the same bits.
    let size = weights.len().div_ceil(PARTS).max(1);
    let parts: Vec<Vec<f64>> = (0..PARTS)
        .into_par_iter()
        .map(|k| part((k * size).min(weights.len())..((k + 1) * size).min(weights.len())))
        .collect();
    let total = |node: usize| parts.iter().map(|sums| sums[node]).sum::<f64>() / nodes[node].area;
    let mut sums: Vec<f64> = (0..nodes.len()).map(total).collect();
    for (k, node) in nodes.iter().enumerate() {
        for child in node.children.into_iter().flatten() {
            sums[child as usize] += sums[k];
        }
    }
    patches.leaves.iter().map(|&node| sums[node as usize]).collect()
}
