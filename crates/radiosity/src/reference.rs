//! The slow way, to judge the fast one by: every pair of patches by itself, in f64.
//!
//! It shares no formula with it: form factors are contour integrals (Stokes) of mutually clipped triangles, what is in the way
//! is asked for on a full grid of ways, and there is no tree. For some hundreds of patches; mirrors are left out.

use std::f64::consts::TAU;

use glam::DVec3;
use light::bands::BANDS;
use rayon::prelude::*;

use crate::patch::{place, reach};
use crate::{Between, Patch, Patches, Source};

/// One number per band.
pub type Bands = [f64; BANDS];

/// A_i F_ij of all pairs.
pub struct Dense {
    areas: Vec<f64>,
    reflectances: Vec<Bands>,
    exchange: Vec<Vec<Bands>>,
}

impl Dense {
    /// All pairs of patches; 4^`halvings` points on each for what is in the way.
    pub fn new(patches: &Patches, between: &Between<'_>, halvings: u32) -> Self {
        let all: Vec<Patch> = patches.iter().collect();
        let grids: Vec<Vec<DVec3>> = all.iter().map(|patch| grid(patch.corners, halvings)).collect();
        let half: Vec<Vec<Bands>> = (0..all.len())
            .into_par_iter()
            .map(|i| {
                let row = |j: usize| {
                    let clear = exchange(&all[i].corners, &all[j].corners);
                    if clear > 0.0 {
                        through([&all[i], &all[j]], [&grids[i], &grids[j]], between)
                            .map(|share| share * clear)
                    } else {
                        [0.0; BANDS]
                    }
                };
                (0..i).map(row).collect()
            })
            .collect();
        let of = |i: usize, j: usize| match i.cmp(&j) {
            std::cmp::Ordering::Greater => half[i][j],
            std::cmp::Ordering::Less => half[j][i],
            std::cmp::Ordering::Equal => [0.0; BANDS],
        };
        Self {
            areas: all.iter().map(Patch::area).collect(),
            reflectances: (0..all.len()).map(|i| patches.reflectance(i).0.map(f64::from)).collect(),
            exchange: (0..all.len()).map(|i| (0..all.len()).map(|j| of(i, j)).collect()).collect(),
        }
    }

    /// F_ij.
    pub fn form_factor(&self, i: usize, j: usize) -> Bands {
        self.exchange[i][j].map(|exchange| exchange / self.areas[i])
    }

    /// By patch: irradiance from all others after so many reflections, as [`crate::solve`] has it.
    pub fn irradiance(&self, source: &Source<'_>, orders: u32) -> Vec<Bands> {
        let at =
            |list: &[light::Spectrum], i: usize| list.get(i).copied().unwrap_or_default().0.map(f64::from);
        let count = self.areas.len();
        let mut going: Vec<Bands> = (0..count)
            .map(|i| {
                let (emitted, direct) = (at(source.emitted, i), at(source.direct, i));
                std::array::from_fn(|b| emitted[b] + self.reflectances[i][b] * direct[b])
            })
            .collect();
        let mut total = vec![[0.0; BANDS]; count];
        for _ in 0..orders {
            let arriving: Vec<Bands> = (0..count).map(|i| self.arriving(i, &going)).collect();
            for i in 0..count {
                for b in 0..BANDS {
                    total[i][b] += arriving[i][b];
                    going[i][b] = self.reflectances[i][b] * arriving[i][b];
                }
            }
        }
        total
    }

    fn arriving(&self, i: usize, exitance: &[Bands]) -> Bands {
        let mut sum = [0.0; BANDS];
        for (exchange, exitance) in self.exchange[i].iter().zip(exitance) {
            for b in 0..BANDS {
                sum[b] += exchange[b] * exitance[b];
            }
        }
        sum.map(|sum| sum / self.areas[i])
    }
}

/// Middles of the 4ⁿ like parts of a triangle.
fn grid([a, b, c]: [DVec3; 3], halvings: u32) -> Vec<DVec3> {
    if halvings == 0 {
        return vec![(a + b + c) / 3.0];
    }
    let [ab, bc, ca] = [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
    let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    parts.into_iter().flat_map(|part| grid(part, halvings - 1)).collect()
}

/// Mean share of the light that arrives, over all ways from grid to grid.
fn through(patches: [&Patch; 2], grids: [&[DVec3]; 2], between: &Between<'_>) -> Bands {
    let [mine, theirs] = patches.map(Patch::normal);
    let size = reach(&patches[0].corners);
    let (mut sums, mut weights) = ([0.0; BANDS], 0.0);
    for &x in grids[0] {
        for &y in grids[1] {
            let way = y - x;
            let weight = way.dot(mine).max(0.0) * way.dot(-theirs).max(0.0) / way.length_squared().powi(2);
            if weight > 0.0 {
                let from = place(x, mine, size, 0);
                let leg = between.occlude.transmittance(&from.toward(y.as_vec3()));
                let left = between.attenuate.factor(x, y);
                (0..BANDS).for_each(|b| sums[b] += weight * f64::from(leg[b]) * f64::from(left[b]));
                weights += weight;
            }
        }
    }
    if weights > 0.0 { sums.map(|sum| sum / weights) } else { [0.0; BANDS] }
}

/// A_i F_ij \[m²\] as a contour integral, exact but for the quadrature over the edges:
///
///   A_i F_ij = 1/(2π) ∮∮ ln r dx · dy
///
/// of the parts of both that are in front of the other's plane. Edges that lie on each other are integrated in closed form.
pub fn exchange(i: &[DVec3; 3], j: &[DVec3; 3]) -> f64 {
    let (mine, theirs) = (clipped(i, j), clipped(j, i));
    let mut sum = 0.0;
    for edge in edges(&mine) {
        for other in edges(&theirs) {
            let [d, e] = [edge, other].map(|[from, to]| to - from);
            let along = d.dot(e);
            if along != 0.0 {
                sum += along * mean_logarithm(edge, other);
            }
        }
    }
    // Both run counter-clockwise seen from their fronts.
    (sum / TAU).max(0.0)
}

fn edges(corners: &[DVec3]) -> impl Iterator<Item = [DVec3; 2]> + '_ {
    (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]])
}

/// The part of a triangle in front of another's plane.
fn clipped(corners: &[DVec3; 3], by: &[DVec3; 3]) -> Vec<DVec3> {
    let normal = (by[1] - by[0]).cross(by[2] - by[0]).normalize_or_zero();
    let size = reach(corners) + reach(by);
    let mut kept = Vec::new();
    for [p, q] in edges(corners) {
        // What lies in the plane but for rounding lies in it.
        let [hp, hq] =
            [p, q].map(|p| (p - by[0]).dot(normal)).map(|h| if h.abs() < 1e-12 * size { 0.0 } else { h });
        if hp >= 0.0 {
            kept.push(p);
        }
        if hp * hq < 0.0 {
            kept.push(p.lerp(q, hp / (hp - hq)));
        }
    }
    kept
}

/// ∫∫ ln r ds dt over two edges, each of length 1 in s and t.
fn mean_logarithm(edge: [DVec3; 2], other: [DVec3; 2]) -> f64 {
    let length = edge[0].distance(edge[1]);
    let same = |k: usize| edge[0].distance(other[k]).max(edge[1].distance(other[1 - k])) < 1e-12 * length;
    if same(0) || same(1) {
        return length.ln() - 1.5;
    }
    let mut sum = 0.0;
    for (s, ws) in GAUSS {
        for (t, wt) in GAUSS {
            let [x, y] = [edge[0].lerp(edge[1], 0.5 + 0.5 * s), other[0].lerp(other[1], 0.5 + 0.5 * t)];
            sum += 0.25 * ws * wt * 0.5 * x.distance_squared(y).ln();
        }
    }
    sum
}

/// Gauss' rule of ten points on \[−1, 1\] (Abramowitz and Stegun, table 25.4).
const GAUSS: [(f64, f64); 10] = [
    (-0.973906528517172, 0.066671344308688),
    (-0.865063366688985, 0.149451349150581),
    (-0.679409568299024, 0.219086362515982),
    (-0.433395394129247, 0.269266719309996),
    (-0.148874338981631, 0.295524224714753),
    (0.148874338981631, 0.295524224714753),
    (0.433395394129247, 0.269266719309996),
    (0.679409568299024, 0.219086362515982),
    (0.865063366688985, 0.149451349150581),
    (0.973906528517172, 0.066671344308688),
];
