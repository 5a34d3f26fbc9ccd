//! How often light is reflected from patch to patch, and what arrives in the end.

use light::Spectrum;
use light::bands::BANDS;

use crate::{Links, Patches};

/// How many diffuse reflections are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orders {
    /// So many: the thesis follows three. What is left out is at most ρⁿ of it all.
    Count(u32),
    /// Until no more than this share of the flux that set out is still under way, in any band; at most [`MOST_ORDERS`] times.
    Until(f64),
}

impl Default for Orders {
    fn default() -> Self {
        Self::Count(3)
    }
}

/// Nobody waits for more: with ρ = 0.99 everywhere 4·10⁻⁵ is left after so many.
pub const MOST_ORDERS: u32 = 1000;

/// What sets out from the patches before anything is reflected twice.
///
/// B_0 = emitted + ρ · direct. Lists shorter than the patches count as dark at their end.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Exitance of patches that shine by themselves \[W m⁻² nm⁻¹\]. Those that other stages answer for (lamps) do not belong
    /// here: what arrives from them directly would be counted twice.
    pub emitted: &'a [Spectrum],
    /// Irradiance by primary light: all that arrives without a diffuse reflection \[W m⁻² nm⁻¹\].
    pub direct: &'a [Spectrum],
}

/// Interreflected light.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// By patch: irradiance from all other patches \[W m⁻² nm⁻¹\], without the primary light.
    pub irradiance: Vec<Spectrum>,
    /// How many reflections were followed.
    pub orders: u32,
    /// Share of the flux that set out which was still under way when they ended, the largest over the bands.
    pub left: f64,
    /// By patch: exitance that was handed on to others \[W m⁻² nm⁻¹\].
    pub exitance: Vec<Spectrum>,
}

/// Follows light from patch to patch:
///
///   E = F Σ_k<n B_k,   B_k+1 = ρ F B_k
///
/// (n orders; F_ij in this crate's convention, [`crate::form_factor()`]). Rows and columns of A_i F_ij sum to no more than A_i: with
/// reflectances up to ρ neither E nor the flux ever exceeds what set out over 1 − ρ.
pub fn solve(patches: &Patches, links: &Links, source: &Source<'_>, orders: Orders) -> Solution {
    let most = match orders {
        Orders::Count(count) => count.min(MOST_ORDERS),
        Orders::Until(_) => MOST_ORDERS,
    };
    let enough = if let Orders::Until(share) = orders { share } else { 0.0 };
    let at = |list: &[Spectrum], patch: usize| list.get(patch).copied().unwrap_or_default();
    let mut going: Vec<_> = (0..patches.len())
        .map(|i| at(source.emitted, i) + patches.reflectance(i) * at(source.direct, i))
        .collect();
    let first = patches.integral(&going);
    let mut total = vec![Spectrum::ZERO; patches.len()];
    let mut irradiance = vec![Spectrum::ZERO; patches.len()];
    let (mut done, mut left) = (0, left(first, first));
    while done < most && left > enough {
        let arriving = links.irradiance(patches, &going);
        for patch in 0..patches.len() {
            total[patch] += going[patch];
            irradiance[patch] += arriving[patch];
            going[patch] = patches.reflectance(patch) * arriving[patch];
        }
        done += 1;
        left = self::left(patches.integral(&going), first);
    }
    Solution { irradiance, orders: done, left, exitance: total }
}

/// The largest share over the bands; 0 where nothing set out.
fn left(now: [f64; BANDS], first: [f64; BANDS]) -> f64 {
    now.iter()
        .zip(first)
        .filter(|&(_, first)| first > 0.0)
        .map(|(now, first)| now / first)
        .fold(0.0, f64::max)
}

/// By node, the mean of what its patches have.
pub(crate) fn pulled(patches: &Patches, values: &[Spectrum]) -> Vec<Spectrum> {
    let nodes = &patches.tree.nodes;
    let mut means = vec![Spectrum::ZERO; nodes.len()];
    for (node, patch) in patches.leaves.iter().zip(values) {
        means[*node as usize] = *patch;
    }
    for (k, node) in nodes.iter().enumerate().rev() {
        if let Some([a, b]) = node.children.map(|children| children.map(|child| child as usize)) {
            let share = (nodes[a].area / node.area) as f32;
            means[k] = means[a] * share + means[b] * (1.0 - share);
        }
    }
    means
}
