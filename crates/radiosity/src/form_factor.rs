//! What share of one patch's light meets another.

use std::f64::consts::PI;

use glam::DVec3;

use crate::lambert::point_form_factor;
use crate::triangle::{self, Corners};

/// Form factors and how exactly they are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormFactor {
    /// Share of what leaves the first patch that arrives at the second, within \[0, 1\].
    pub share: f64,
    /// Estimate of its error: the sum of what the last halving changed.
    pub error: f64,
}

/// Halvings of either patch: pieces of 2⁻¹¹ of an edge, smaller than any error that is worth asking for.
const MOST_HALVINGS: u32 = 22;

/// Form factor F_ij = 1/(π A_i) ∫∫ cos θ_i cos θ_j / r² dA_j dA_i (thesis eq. 3.18) between two triangles, each seen from
/// its front (counter-clockwise) side, nothing in the way.
///
/// *The one convention of this crate:* F_ij is the share of what leaves **i** that arrives at **j**; hence A_i F_ij =
/// A_j F_ji, Σ_j F_ij = 1 in a closed room, and the irradiance of i is E_i = Σ_j F_ij B_j. (The thesis divides by the
/// source's area in 3.18 and by the receiver's in 3.19 and 3.20.)
///
/// Over j the integral is exact (Lambert), over i it is a rule of three points on pieces, halved until the halves change
/// no more than `tolerance` of the whole, by area.
///
/// ```
/// use glam::DVec3;
/// use keikan_radiosity::form_factor;
/// let floor = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// let above = [DVec3::Z, DVec3::Y + DVec3::Z, DVec3::X + DVec3::Z]; // looks down
/// let there = form_factor(&floor, &above, 1e-6);
/// assert!((there.share - form_factor(&above, &floor, 1e-6).share).abs() < 2e-6); // equal areas
/// ```
pub fn form_factor(from: &[DVec3; 3], to: &[DVec3; 3], tolerance: f64) -> FormFactor {
    let facing = Facing::new(from, to);
    let whole = facing.rule(from);
    facing.refine(from, whole, tolerance, MOST_HALVINGS)
}

/// The same through a medium that leaves exp(−K r) of diffuse light after r metres (eq. 3.20): `extinction` K \[1/m\], ≥ 0.
pub fn attenuated_form_factor(
    from: &[DVec3; 3],
    to: &[DVec3; 3],
    extinction: f64,
    tolerance: f64,
) -> FormFactor {
    let through = Through { extinction, normal: triangle::cross(from).normalize_or_zero() };
    let whole = through.rule(from, to);
    through.refine([from, to], whole, tolerance, MOST_HALVINGS)
}

/// A patch that looks at another.
struct Facing<'a> {
    normal: DVec3,
    to: &'a Corners,
    /// Twice the area times the normal of `to`.
    across: DVec3,
}

impl<'a> Facing<'a> {
    fn new(from: &Corners, to: &'a Corners) -> Self {
        Self { normal: triangle::cross(from).normalize_or_zero(), to, across: triangle::cross(to) }
    }

    /// From one point; 0 from behind `to`.
    fn from_point(&self, at: DVec3) -> f64 {
        if (at - self.to[0]).dot(self.across) > 0.0 {
            point_form_factor(at, self.normal, self.to)
        } else {
            0.0
        }
    }

    fn rule(&self, from: &Corners) -> f64 {
        triangle::three_points(from).iter().map(|&at| self.from_point(at)).sum::<f64>() / 3.0
    }

    /// Mean over `from`, of which `whole` is a first guess.
    fn refine(&self, from: &Corners, whole: f64, tolerance: f64, left: u32) -> FormFactor {
        let halves = triangle::halves(from, triangle::apex(from));
        let [first, second] = [0, 1].map(|k| self.rule(&halves[k]));
        let better = 0.5 * (first + second);
        let error = (better - whole).abs();
        // Two points of difference: nothing seen at all by nine points is taken at its word only for small pieces.
        if error <= tolerance || left == 0 {
            return FormFactor { share: better, error };
        }
        let [a, b] = [(0, first), (1, second)].map(|(k, mean)| self.refine(&halves[k], mean, tolerance, left - 1));
        FormFactor { share: 0.5 * (a.share + b.share), error: 0.5 * (a.error + b.error) }
    }
}

/// A medium between two patches.
struct Through {
    extinction: f64,
    normal: DVec3,
}

impl Through {
    /// Mean over three points of `from` of Σ over nine points of `to` of F · e^(−K r), F being exact for the parts of `to` that the
    /// points stand for.
    fn rule(&self, from: &Corners, to: &Corners) -> f64 {
        let across = triangle::cross(to);
        let seen = |at: DVec3| -> f64 {
            if (at - to[0]).dot(across) <= 0.0 {
                return 0.0;
            }
            let whole = point_form_factor(at, self.normal, to);
            let mut sums = [0.0; 2];
            for y in triangle::three_points(to) {
                let way = y - at;
                let weight = way.dot(self.normal).max(0.0) / way.length_squared().powi(2) * -way.dot(across);
                sums[0] += weight;
                sums[1] += weight * (-self.extinction * way.length()).exp();
            }
            if sums[0] > 0.0 { whole * sums[1] / sums[0] } else { 0.0 }
        };
        triangle::three_points(from).into_iter().map(seen).sum::<f64>() / 3.0
    }

    fn refine(&self, [from, to]: [&Corners; 2], whole: f64, tolerance: f64, left: u32) -> FormFactor {
        let [mine, theirs] = [from, to].map(|corners| triangle::halves(corners, triangle::apex(corners)));
        let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| (&mine[i], &theirs[j]));
        let parts = pairs.map(|(i, j)| self.rule(i, j));
        let better = 0.5 * parts.iter().sum::<f64>();
        let error = (better - whole).abs();
        if error <= tolerance || left == 0 {
            return FormFactor { share: better, error };
        }
        let mut sum = FormFactor { share: 0.0, error: 0.0 };
        for ((i, j), part) in pairs.into_iter().zip(parts) {
            let part = self.refine([i, j], part, 0.5 * tolerance, left - 1);
            sum.share += 0.5 * part.share;
            sum.error += 0.5 * part.error;
        }
        sum
    }
}

/// A_i F_ij \[m²\] of a pair whose centres are farther apart than four times their radii together: three points, whose rule
/// leaves out terms of the third order, under (¼)³/10 of the pair's own F.
pub(crate) fn far_exchange(from: &Corners, to: &Corners) -> f64 {
    Facing::new(from, to).rule(from) * 0.5 * triangle::cross(from).length()
}

/// A_i F_ij by centres alone \[m²\], for projected areas \[m²\] at `distance` \[m\].
pub(crate) fn point_exchange(projected: [f64; 2], distance: f64) -> f64 {
    projected[0] * projected[1] / (PI * distance * distance)
}
