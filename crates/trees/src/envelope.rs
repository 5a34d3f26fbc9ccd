//! The outline of a tree as a surface of revolution (thesis 5.3.1).

use glam::{Vec2, Vec3};

/// Knots of the outlines that have a formula: chords of a half ellipse in as many parts miss less than 1 % of its radius
/// away from the ends.
const KNOTS: usize = 24;

/// Share of a pencil's height that its pointed top takes.
const POINT: f32 = 0.3;

/// The outline of a tree around its axis (+Y through the foot at the origin): radius over height, linear between knots.
///
/// Leaves as a whole face as its normal does, and its inside is where leaves are.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    knots: Vec<Vec2>,
}

impl Envelope {
    /// A column of `radius` from height `base` on, with a pointed top \[m\].
    pub fn pencil(base: f32, top: f32, radius: f32) -> Option<Self> {
        let shoulder = top - POINT * (top - base);
        Self::fitted(&[Vec2::new(base, radius), Vec2::new(shoulder, radius), Vec2::new(top, 0.0)])
    }

    /// An ellipsoid between heights `base` and `top`, of `radius` about the axis \[m\].
    pub fn ellipsoid(base: f32, top: f32, radius: f32) -> Option<Self> {
        let knot = |i: usize| {
            // Equal angles: knots are dense where the outline bends.
            let (sin, cos) = (std::f32::consts::PI * i as f32 / KNOTS as f32).sin_cos();
            Vec2::new(base + (top - base) * 0.5 * (1.0 - cos), radius * sin.max(0.0))
        };
        Self::fitted(&(0..=KNOTS).map(knot).collect::<Vec<_>>())
    }

    /// A cone that stands on its tip at height `base` and has `radius` at height `top` \[m\], slightly domed so that its lid
    /// has a normal everywhere.
    pub fn inverted_cone(base: f32, top: f32, radius: f32) -> Option<Self> {
        let rim = top - 0.1 * (top - base);
        Self::fitted(&[Vec2::new(base, 0.0), Vec2::new(rim, radius), Vec2::new(top, 0.0)])
    }

    /// Through knots (height, radius) \[m\], heights rising strictly, radii ≥ 0 and not all 0; none otherwise.
    pub fn fitted(knots: &[Vec2]) -> Option<Self> {
        let sound = knots.iter().all(|k| k.is_finite() && k.y >= 0.0) && knots.iter().any(|k| k.y > 0.0);
        let rising = knots.windows(2).all(|pair| pair[0].x < pair[1].x);
        (knots.len() >= 2 && sound && rising).then(|| Self { knots: knots.to_vec() })
    }

    /// (height, radius) \[m\] of each knot.
    pub fn knots(&self) -> &[Vec2] {
        &self.knots
    }

    /// Lowest and highest height \[m\].
    pub fn heights(&self) -> [f32; 2] {
        [self.knots[0].x, self.knots[self.knots.len() - 1].x]
    }

    /// The largest radius \[m\].
    pub fn widest(&self) -> f32 {
        self.knots.iter().fold(0.0, |widest, knot| widest.max(knot.y))
    }

    /// Radius at a height \[m\]; 0 above and below.
    pub fn radius(&self, height: f32) -> f32 {
        let after = self.knots.partition_point(|knot| knot.x <= height);
        match (after.checked_sub(1).and_then(|i| self.knots.get(i)), self.knots.get(after)) {
            (Some(a), Some(b)) => a.y + (b.y - a.y) * (height - a.x) / (b.x - a.x),
            (Some(end), None) if end.x == height => end.y,
            _ => 0.0,
        }
    }

    /// True inside.
    pub fn holds(&self, point: Vec3) -> bool {
        let radius = self.radius(point.y);
        point.x * point.x + point.z * point.z < radius * radius
    }

    /// Unit outward normal at the height of `point`, in the direction from the axis to it: slopes of neighbouring pieces are
    /// mixed, so that shading shows no rings. +Y on the axis.
    pub fn normal(&self, point: Vec3) -> Vec3 {
        let [low, high] = self.heights();
        // Over a twelfth of the height: outlines that were fitted are rough.
        let step = (high - low) / 24.0;
        let at = |height: f32| self.radius(height.clamp(low, high));
        let around = (at(point.y - step), at(point.y + step));
        // Beyond an end the radius is taken to fall to 0 within a step.
        let below = if point.y - step < low { 0.0 } else { around.0 };
        let above = if point.y + step > high { 0.0 } else { around.1 };
        let slope = (above - below) / (2.0 * step);
        let outward = Vec3::new(point.x, 0.0, point.z).normalize_or_zero();
        (outward - Vec3::Y * slope).try_normalize().unwrap_or(Vec3::Y)
    }

    /// Stretches of the line `origin` + t `direction`, t > 0, that lie inside, in any order, touching ones not joined.
    ///
    ///   in each piece |(x, z)|² ≤ (r₀ + s (y − h₀))²: a quadratic inequality in t
    pub fn inside(&self, origin: Vec3, direction: Vec3, mut receive: impl FnMut(f32, f32)) {
        // f64: along the axis both roots of a piece fall together, and their difference is the root of a rounding.
        let (o, d) = (origin.as_dvec3(), direction.as_dvec3());
        for pair in self.knots.windows(2) {
            let [low, high] = [pair[0], pair[1]].map(Vec2::as_dvec2);
            let Some([from, to]) = slab(o.y, d.y, low.x, high.x) else { continue };
            let slope = (high.y - low.y) / (high.x - low.x);
            let (at, along) = (low.y + slope * (o.y - low.x), slope * d.y);
            let a = d.x * d.x + d.z * d.z - along * along;
            let b = o.x * d.x + o.z * d.z - at * along;
            let c = o.x * o.x + o.z * o.z - at * at;
            not_positive(a, b, c, |low, high| {
                let (low, high) = (low.max(from).max(0.0), high.min(to));
                if high > low {
                    receive(low as f32, high as f32);
                }
            });
        }
    }

    /// Length \[m\] of what lies inside of the first `reach` metres of a line.
    pub fn chord(&self, origin: Vec3, direction: Vec3, reach: f32) -> f32 {
        let mut sum = 0.0;
        self.inside(origin, direction, |from, to| sum += (to.min(reach) - from).max(0.0));
        sum
    }

    /// Where a line is first and last inside \[m\]; none where it misses.
    pub fn meet(&self, origin: Vec3, direction: Vec3) -> Option<[f32; 2]> {
        let mut met: Option<[f32; 2]> = None;
        self.inside(origin, direction, |from, to| {
            met = Some(met.map_or([from, to], |[first, last]| [first.min(from), last.max(to)]));
        });
        met
    }
}

/// Where `origin` + t `direction` lies between `low` and `high`; none when never.
fn slab(origin: f64, direction: f64, low: f64, high: f64) -> Option<[f64; 2]> {
    if direction == 0.0 {
        return (low <= origin && origin < high).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let (a, b) = ((low - origin) / direction, (high - origin) / direction);
    let (from, to) = (a.min(b), a.max(b));
    (to > 0.0).then_some([from, to])
}

/// The stretches of t where a t² + 2 b t + c ≤ 0.
fn not_positive(a: f64, b: f64, c: f64, mut receive: impl FnMut(f64, f64)) {
    let discriminant = b * b - a * c;
    if a.abs() <= 1e-14 * b.abs() || a == 0.0 {
        // As good as linear: 2 b t + c ≤ 0.
        match b {
            b if b > 0.0 => receive(f64::NEG_INFINITY, -c / (2.0 * b)),
            b if b < 0.0 => receive(-c / (2.0 * b), f64::INFINITY),
            _ if c <= 0.0 => receive(f64::NEG_INFINITY, f64::INFINITY),
            _ => {}
        }
        return;
    }
    if discriminant <= 0.0 {
        if a < 0.0 {
            receive(f64::NEG_INFINITY, f64::INFINITY);
        }
        return;
    }
    // The root that does not cancel first, the other from the product of both.
    let q = -(b + discriminant.sqrt().copysign(b));
    let (one, two) = (q / a, if q == 0.0 { 0.0 } else { c / q });
    let (low, high) = (one.min(two), one.max(two));
    if a > 0.0 {
        receive(low, high);
    } else {
        receive(f64::NEG_INFINITY, low);
        receive(high, f64::INFINITY);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn shapes() -> [Envelope; 4] {
        [
            Envelope::pencil(1.0, 12.0, 1.2).unwrap(),
            Envelope::ellipsoid(2.0, 10.0, 3.5).unwrap(),
            Envelope::inverted_cone(2.0, 9.0, 4.0).unwrap(),
            Envelope::fitted(&[
                Vec2::new(0.0, 0.2),
                Vec2::new(2.0, 0.2),
                Vec2::new(3.0, 3.0),
                Vec2::new(8.0, 0.0),
            ])
            .unwrap(),
        ]
    }

    #[test]
    fn outlines_that_are_none_are_refused() {
        assert!(Envelope::pencil(1.0, 1.0, 1.0).is_none());
        assert!(Envelope::ellipsoid(0.0, 5.0, 0.0).is_none());
        assert!(Envelope::fitted(&[Vec2::new(0.0, f32::NAN), Vec2::ONE]).is_none());
        assert!(Envelope::fitted(&[Vec2::ZERO]).is_none());
    }

    #[test]
    fn a_line_through_the_middle_of_an_ellipsoid_is_as_long_as_it_is_wide() {
        let crown = Envelope::ellipsoid(2.0, 10.0, 3.5).unwrap();
        let [from, to] = crown.meet(Vec3::new(-20.0, 6.0, 0.0), Vec3::X).unwrap();
        // The equator is a knot: only rounding at distance 20 is left.
        assert!((from - 16.5).abs() < 1e-5 && (to - 23.5).abs() < 1e-5);
        let axis = crown.chord(Vec3::new(0.0, 20.0, 0.0), Vec3::NEG_Y, f32::INFINITY);
        assert!((axis - 8.0).abs() < 1e-4, "{axis}");
        assert!((crown.normal(Vec3::new(3.5, 6.0, 0.0)) - Vec3::X).length() < 1e-5);
    }

    proptest! {
        /// The reference is a walk in small steps with the definition of the inside.
        #[test]
        fn chords_agree_with_small_steps(
            shape in 0usize..4, from in prop::array::uniform3(-1.0f32..1.0), to in prop::array::uniform3(-1.0f32..1.0),
        ) {
            let crown = &shapes()[shape];
            let origin = Vec3::from(from) * 8.0 + Vec3::Y * 6.0;
            let target = Vec3::from(to) * 3.0 + Vec3::Y * 6.0;
            let Some(direction) = (target - origin).try_normalize() else { return Ok(()) };
            let (steps, step) = (4000, 0.01);
            let inside = (0..steps).filter(|i| crown.holds(origin + direction * (*i as f32 + 0.5) * step)).count();
            // At most 2 borders a piece where a line enters or leaves; here no line has more than 6, each off by a step.
            let error = (crown.chord(origin, direction, 40.0) - inside as f32 * step).abs();
            prop_assert!(error <= 6.0 * step + 1e-3, "{error}");
        }
    }
}
