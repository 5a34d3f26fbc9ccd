//! How much light goes straight through a transparent body: the rule of its shadow.
//!
//! The thesis (2.1 to 2.3) lets a shadow ray go straight, and multiplies for each body on its way
//!
//!   t_p = (1 − r_a)(1 − r_b) e^(−q d),   r = 1 beyond the critical angle
//!
//! with r_a at the angle between ray and entry face, and r_b as if the ray met the exit face, inside, at its own
//! angle. That makes any slab black beyond arcsin 1/n, and the answer depends on which end the light is at. Here
//! the position stays on the straight ray, but the direction inside is Snell's: with u the refracted
//! direction of the ray at face a,
//!
//!   t(a→b) = (1 − F(n, cos a)) (1 − F(1/n, u·b)) e^(−q d'),   d' = d (ray·b)/(u·b)
//!
//! d' being the refracted way to the plane of the exit face; and since nobody says where the light is,
//!
//!   t_p = √(t(a→b) t(b→a)).
//!
//! Exact for slabs (but for light that is reflected inside more than once); 0 as soon as light is totally reflected in
//! either direction; symmetric by its form; exactly 1 for n = 1 without absorption.
//!
//! *Where it is wrong.* Light that is totally reflected at one face often leaves by another: prisms are too dark (a
//! low stand by 0.2 to 0.4 of the light), and a ball's focus is not there at all; locally it errs less than the thesis'
//! rule for slabs and stands. `tests/refracted_light.rs`
//! measures it, and the thesis' own, against light that is refracted.

use glam::DVec3;
use light::{Medium, Spectrum, fresnel, fresnel_polarised, refract};

/// Where a line passes the surface of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance along the line \[m\].
    pub t: f64,
    /// Unit normal of the surface, outwards.
    pub outward: DVec3,
}

impl Crossing {
    fn entering(&self, direction: DVec3) -> bool {
        self.outward.dot(direction) < 0.0
    }
}

/// Share of light that passes one body along the unit vector `direction`, within \[0, 1\] per band.
///
/// `crossings` are those of that body alone, in any order (they are put in order), all between the ends of
/// a segment of `length` \[m\] (infinite for a sun). Crossings within `same` \[m\] of each other that go the same way
/// are one: neighbours met on their common edge, faces that lie in each other; parts of a body that touch
/// within it are one piece.
///
/// An end may lie inside the body: a segment that leaves more often than it enters has started inside, one that
/// enters more often has ended there (bodies with holes are taken at that word). Such an end is seen through one interface.
/// A segment that meets no crossing is not attenuated, wherever it lies.
///
/// For a thin body every crossing is a [`pane`].
pub fn through(
    direction: DVec3,
    crossings: &mut [Crossing],
    length: f64,
    same: f64,
    medium: &Medium,
) -> Spectrum {
    let entering = order(direction, crossings, same);
    if medium.thin {
        return panes(direction, crossings, same, medium);
    }
    let step = |i: usize| -> i32 {
        let mut near = (0..i).rev().take_while(|&j| crossings[i].t - crossings[j].t <= same);
        let again = near.any(|j| entering[j] == entering[i]);
        i32::from(!again) * if entering[i] { 1 } else { -1 }
    };
    let sums = (0..crossings.len()).scan(0, |sum, i| {
        *sum += step(i);
        Some(*sum)
    });
    let mut depth = -sums.min().unwrap_or(0).min(0);
    let (mut left, mut entry) = (Spectrum::ONE, None);
    for (i, crossing) in crossings.iter().enumerate() {
        let before = depth;
        depth += step(i);
        if before == 0 && depth == 1 {
            entry = Some(*crossing);
        } else if before == 1 && depth == 0 {
            left *= match entry.take() {
                Some(entry) => whole(direction, &entry, crossing, medium),
                None => half(-direction, crossing.outward, crossing.t, medium),
            };
        }
    }
    match entry {
        // Towards the sun nobody stays inside: the body has a hole there.
        Some(entry) => {
            let way = if length.is_finite() { length - entry.t } else { 0.0 };
            left * half(direction, entry.outward, way.max(0.0), medium)
        }
        None => left,
    }
}

/// Puts crossings in order and says which enter. Where a leaving and an entering one are the same place, the entering
/// one comes first: parts that touch are one, and an edge that is just grazed has nothing before it.
fn order(direction: DVec3, crossings: &mut [Crossing], same: f64) -> Vec<bool> {
    crossings.sort_by(|a, b| a.t.total_cmp(&b.t));
    let enters = |crossing: &Crossing| crossing.entering(direction);
    for i in 1..crossings.len() {
        let mut j = i;
        while j > 0
            && enters(&crossings[j])
            && !enters(&crossings[j - 1])
            && crossings[j].t - crossings[j - 1].t <= same
        {
            let t = (crossings[j - 1].t, crossings[j].t);
            crossings.swap(j - 1, j);
            (crossings[j - 1].t, crossings[j].t) = t;
            j -= 1;
        }
    }
    crossings.iter().map(enters).collect()
}

/// Panes one after the other, each counted once however many faces lie in it.
fn panes(direction: DVec3, crossings: &[Crossing], same: f64, medium: &Medium) -> Spectrum {
    let mut left = Spectrum::ONE;
    let mut last = f64::NEG_INFINITY;
    for crossing in crossings {
        if crossing.t - last > same {
            let share = pane(f64::from(medium.index), crossing.outward.dot(direction).abs());
            left *= medium.tint * (medium.transmission * share as f32);
        }
        last = crossing.t;
    }
    left
}

/// Directional transmittance of a clear pane of relative index `index`: two parallel interfaces and all reflections
/// between them, the mean of both polarisations (r: what one interface reflects).
///
///   T = ½ Σ (1 − r)/(1 + r)
///
/// ```
/// use keikan_raytrace::pane;
/// let r = (0.52f64 / 2.52).powi(2);
/// assert!((pane(1.52, 1.0) - (1.0 - r) / (1.0 + r)).abs() < 1e-15); // head on, to rounding
/// ```
pub fn pane(index: f64, cos: f64) -> f64 {
    fresnel_polarised(index, cos).iter().map(|r| 0.5 * (1.0 - r) / (1.0 + r)).sum()
}

/// √(t(a→b) t(b→a)) with the surface's own share.
fn whole(direction: DVec3, enter: &Crossing, leave: &Crossing, medium: &Medium) -> Spectrum {
    let index = f64::from(medium.index);
    let way = leave.t - enter.t;
    let share = f64::from(medium.transmission).powi(2);
    let (there, back) = (
        one_way(direction, enter.outward, leave.outward, index),
        one_way(-direction, leave.outward, enter.outward, index),
    );
    let (Some((a, longer)), Some((b, longer_back))) = (there, back) else { return Spectrum::ZERO };
    let way = way * (longer * longer_back).sqrt();
    medium.tint * medium.tint * medium.absorption.attenuate(way as f32) * ((a * b).sqrt() * share) as f32
}

/// Share that passes both interfaces from `enter` to `leave` (outward normals), and how many times as long as the
/// straight way the refracted way inside is; none where light is totally reflected.
fn one_way(direction: DVec3, enter: DVec3, leave: DVec3, index: f64) -> Option<(f64, f64)> {
    if index == 1.0 {
        return Some((1.0, 1.0));
    }
    let inside = refract(direction, enter, index)?;
    let (cos, straight) = (inside.dot(leave), direction.dot(leave));
    // The refracted ray may turn away from the exit face: it leaves elsewhere, if at all.
    if cos <= 0.0 {
        return None;
    }
    let share = (1.0 - fresnel(index, -direction.dot(enter))) * (1.0 - fresnel(1.0 / index, cos));
    (share > 0.0).then(|| (share, (straight / cos).max(0.0)))
}

/// One interface, `direction` entering, and a straight `way` that ends inside: the refracted way to the same depth.
fn half(direction: DVec3, outward: DVec3, way: f64, medium: &Medium) -> Spectrum {
    let index = f64::from(medium.index);
    let cos = -direction.dot(outward);
    let Some(inside) = refract(direction, outward, index) else { return Spectrum::ZERO };
    let cos_inside = -inside.dot(outward);
    let way = if index == 1.0 || cos_inside <= 0.0 { way } else { way * cos / cos_inside };
    let share = (1.0 - fresnel(index, cos)) * f64::from(medium.transmission);
    medium.tint * medium.absorption.attenuate(way as f32) * share as f32
}
