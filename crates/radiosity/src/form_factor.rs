//! What share of one patch's light meets another.

use glam::DVec3;

use crate::lambert::point_form_factor;
use crate::triangle::{self, Corners};

/// Form factors and how exactly they are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormFactor {
    /// Share of what leaves the first patch that arrives at the second, within \[0, 1\].
    pub share: f64,
    /// Estimate of its error: the sum, by area, of what the last two halvings changed.
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
/// Over j the integral is exact (Lambert). Over i it is a rule of three points on pieces of what of it is in front of j, halved
/// until two halvings in a row change their mean by no more than `tolerance`.
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
    halved(from, to, tolerance, MOST_HALVINGS)
}

/// The same with no more than so many halvings.
fn halved(from: &Corners, to: &Corners, tolerance: f64, most: u32) -> FormFactor {
    let facing = Facing::new(from, to);
    over_front(from, to, |part| facing.refine(part, [facing.rule(part), f64::INFINITY], tolerance, most))
}

/// The same through a medium that leaves exp(−K r) of diffuse light after r metres (eq. 3.20): `extinction` K \[1/m\], ≥ 0.
pub fn attenuated_form_factor(
    from: &[DVec3; 3],
    to: &[DVec3; 3],
    extinction: f64,
    tolerance: f64,
) -> FormFactor {
    let through = Through { extinction, normal: triangle::cross(from).normalize_or_zero() };
    over_front(from, to, |part| {
        through.refine([part, to], [through.rule(part, to), f64::INFINITY], tolerance, MOST_HALVINGS)
    })
}

/// The mean over `from`, from that of the parts of it in front of `to`, in each of which the integrand has no kink.
fn over_front(from: &Corners, to: &Corners, mean: impl Fn(&Corners) -> FormFactor) -> FormFactor {
    let (parts, count) = triangle::in_front(from, to);
    let whole = triangle::cross(from).length();
    let mut sum = FormFactor { share: 0.0, error: 0.0 };
    for part in &parts[..count] {
        let weight = triangle::cross(part).length() / whole;
        if weight > 0.0 {
            let mean = mean(part);
            sum.share += weight * mean.share;
            sum.error += weight * mean.error;
        }
    }
    sum
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
    fn seen_from(&self, at: DVec3) -> f64 {
        if (at - self.to[0]).dot(self.across) > 0.0 {
            point_form_factor(at, self.normal, self.to)
        } else {
            0.0
        }
    }

    /// Between two elements as large as the triangles.
    fn between_middles(&self, at: DVec3) -> f64 {
        let way = triangle::centre(self.to) - at;
        let square = way.length_squared();
        let cosines = way.dot(self.normal).max(0.0) * (-way.dot(self.across)).max(0.0) * 0.5;
        if square > 0.0 { cosines / (std::f64::consts::PI * square * square) } else { 0.0 }
    }

    fn rule(&self, from: &Corners) -> f64 {
        triangle::three_points(from).iter().map(|&at| self.seen_from(at)).sum::<f64>() / 3.0
    }

    /// Mean over `from`, of which `whole` is a first guess, by which the halving before changed it.
    fn refine(&self, from: &Corners, [whole, before]: [f64; 2], tolerance: f64, left: u32) -> FormFactor {
        let halves = triangle::halves(from, triangle::apex(from));
        let [first, second] = [0, 1].map(|k| self.rule(&halves[k]));
        let better = 0.5 * (first + second);
        let change = (better - whole).abs();
        if let Some(error) = settled(change, before, tolerance, left) {
            return FormFactor { share: better, error };
        }
        let [a, b] = [(0, first), (1, second)]
            .map(|(k, mean)| self.refine(&halves[k], [mean, change], tolerance, left - 1));
        FormFactor { share: 0.5 * (a.share + b.share), error: 0.5 * (a.error + b.error) }
    }
}

/// The error of a mean that two halvings in a row have hardly changed; none as long as they do. One alone may agree by
/// chance.
fn settled(change: f64, before: f64, tolerance: f64, left: u32) -> Option<f64> {
    let error = change.max(0.25 * before);
    (error <= tolerance || left == 0).then_some(error)
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

    fn refine(
        &self,
        [from, to]: [&Corners; 2],
        [whole, before]: [f64; 2],
        tolerance: f64,
        left: u32,
    ) -> FormFactor {
        let [mine, theirs] = [from, to].map(|corners| triangle::halves(corners, triangle::apex(corners)));
        let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| (&mine[i], &theirs[j]));
        let parts = pairs.map(|(i, j)| self.rule(i, j));
        let better = 0.5 * parts.iter().sum::<f64>();
        let change = (better - whole).abs();
        if let Some(error) = settled(change, before, tolerance, left) {
            return FormFactor { share: better, error };
        }
        let mut sum = FormFactor { share: 0.0, error: 0.0 };
        for ((i, j), part) in pairs.into_iter().zip(parts) {
            let part = self.refine([i, j], [part, 0.5 * change], 0.5 * tolerance, left - 1);
            sum.share += 0.5 * part.share;
            sum.error += 0.5 * part.error;
        }
        sum
    }
}

/// Form factor of a pair whose centres are `gap` radii of both apart, as cheaply as that allows.
///
/// From middle to middle, cos θ_i cos θ_j A_j/(π r²), leaves out terms of the second order in either size, 3 (1/2 gap)² of the pair's own F at
/// most where both are of one size. The middle of i alone leaves out terms of the second order, (1/gap)² of the pair's own F at most, three points those of the
/// third; where both agree within ten times `tolerance` the three are taken to be within it.
pub(crate) fn quick_form_factor(from: &Corners, to: &Corners, gap: f64, tolerance: f64) -> f64 {
    let facing = Facing::new(from, to);
    if gap > FARTHEST {
        return facing.between_middles(triangle::centre(from));
    }
    let is_whole = from.iter().all(|&corner| (corner - to[0]).dot(facing.across) >= 0.0);
    if !is_whole {
        return halved(from, to, tolerance, FEW_HALVINGS).share;
    }
    let middle = facing.seen_from(triangle::centre(from));
    if gap > FAR {
        return middle;
    }
    let three = facing.rule(from);
    if (three - middle).abs() <= 10.0 * tolerance {
        three
    } else {
        halved(from, to, tolerance, FEW_HALVINGS).share
    }
}

/// Distance in radii from which middles are enough on both sides: within 3 (1/24)² = 0.5 %.
const FARTHEST: f64 = 12.0;

/// Distance in radii from which the middle is enough: (1/8)² is below the noise of some tried ways.
const FAR: f64 = 8.0;

/// Of pairs of patches: pieces of 1/32 of an edge, whatever their shape.
const FEW_HALVINGS: u32 = 10;
