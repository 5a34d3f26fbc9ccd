//! Where a ray meets triangles, without a gap between them (Woop, Benthin and Wald 2013).
//!
//! Corners are translated by the origin and sheared so that the ray becomes the last axis; then the signs of
//! three two-dimensional edge functions say whether the triangle is met:
//!
//! > U = Cx By − Cy Bx,   V = Ax Cy − Ay Cx,   W = Bx Ay − By Ax
//!
//! Two triangles that share an edge see the same two sheared corners and get exactly opposite values. In f32 a
//! value other than 0 has the right sign (rounding is monotone: ab > cd gives fl(ab) ≥ fl(cd)), and a 0
//! is looked at again in f64, where products of f32 are exact. So each sheared corner set is judged without
//! error, and nothing passes between neighbours. No fused multiply-add: it would break that.
//!
//! The distance is then computed in f64, from the corners themselves rather than the sheared ones.

use glam::DVec3;

use crate::{collapse::WIDTH, lanes::Lanes, shot::Shot, tree::Packet};

/// The line through a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// Distance along the ray, in lengths of its direction.
    pub(crate) t: f64,
    /// normal · (a corner − origin), where `normal` is twice the area times the unit normal.
    pub(crate) start: f64,
    /// normal · direction.
    pub(crate) speed: f64,
    /// Σ |normal|.
    pub(crate) sway: f64,
}

/// A corner of a lane.
fn corner(packet: &Packet, lane: usize, corner: usize) -> DVec3 {
    DVec3::from([0, 1, 2].map(|axis| f64::from(packet.corners[corner][axis][lane])))
}

/// Largest |coordinate| of a lane's corners.
pub(crate) fn reach(packet: &Packet, lane: usize) -> f64 {
    (0..3).fold(0.0f64, |reach, i| reach.max(corner(packet, lane, i).abs().max_element()))
}

/// U, V, W of a lane, each with the right sign, from the very operations of [`candidates`]: products of
/// f32 are exact in f64, and a difference of exact numbers has the right sign.
fn edges(packet: &Packet, lane: usize, shot: &Shot) -> [f64; 3] {
    let [x, y, z] = shot.axes;
    let sheared = |corner: usize| {
        let moved =
            |axis: usize| packet.corners[corner][axis][lane] - shot.origin_high[axis] - shot.origin_low[axis];
        let depth = moved(z);
        [moved(x) - shot.shear[0] * depth, moved(y) - shot.shear[1] * depth].map(f64::from)
    };
    let [a, b, c] = [sheared(0), sheared(1), sheared(2)];
    [c[0] * b[1] - c[1] * b[0], a[0] * c[1] - a[1] * c[0], b[0] * a[1] - b[1] * a[0]]
}

/// Weights of a lane's second and third corner where the line meets it: within the triangle, to f32 accuracy.
pub(crate) fn weights(packet: &Packet, lane: usize, shot: &Shot) -> [f64; 2] {
    let [u, v, w] = edges(packet, lane, shot);
    [v / (u + v + w), w / (u + v + w)]
}

/// The coordinates in which the ray is the last axis.
struct Frame<L> {
    shear: [L; 2],
    high: [L; 3],
    low: [L; 3],
}

// Functions, not closures: those would be compiled without AVX2 and called for every operation.
impl<L: Lanes> Frame<L> {
    #[inline(always)]
    fn moved<const SPLIT: bool>(&self, corner: &[f32; WIDTH], i: usize) -> L {
        let moved = L::load(corner).sub(self.high[i]);
        if SPLIT { moved.sub(self.low[i]) } else { moved }
    }

    #[inline(always)]
    fn sheared<const SPLIT: bool>(&self, corner: &[[f32; WIDTH]; 3], [x, y, z]: [usize; 3]) -> (L, L) {
        let depth = self.moved::<SPLIT>(&corner[z], 2);
        (
            self.moved::<SPLIT>(&corner[x], 0).sub(self.shear[0].mul(depth)),
            self.moved::<SPLIT>(&corner[y], 1).sub(self.shear[1].mul(depth)),
        )
    }
}

/// One bit per lane whose triangle the line may meet: all edge functions of one sign, or zero.
///
/// The second mask has those with a zero, which must be looked at again. `SPLIT` says whether the origin has a low part: subtracting 0 changes nothing.
#[inline(always)]
pub(crate) fn candidates<L: Lanes, const SPLIT: bool>(packet: &Packet, shot: &Shot) -> (u32, u32) {
    let frame = Frame::<L> {
        shear: [L::splat(shot.shear[0]), L::splat(shot.shear[1])],
        high: [L::splat(shot.high(0)), L::splat(shot.high(1)), L::splat(shot.high(2))],
        low: [L::splat(shot.low(0)), L::splat(shot.low(1)), L::splat(shot.low(2))],
    };
    let (ax, ay) = frame.sheared::<SPLIT>(&packet.corners[0], shot.axes);
    let (bx, by) = frame.sheared::<SPLIT>(&packet.corners[1], shot.axes);
    let (cx, cy) = frame.sheared::<SPLIT>(&packet.corners[2], shot.axes);
    let u = cx.mul(by).sub(cy.mul(bx));
    let v = ax.mul(cy).sub(ay.mul(cx));
    let w = bx.mul(ay).sub(by.mul(ax));
    let zero = L::splat(0.0);
    let (least, most) = (u.min(v).min(w), u.max(v).max(w));
    let inside = zero.le(least) | most.le(zero);
    // Of numbers of one sign, a zero is the least or the most.
    let zeros = (zero.le(least) & least.le(zero)) | (zero.le(most) & most.le(zero));
    (inside, inside & zeros)
}

/// The distance for one candidate lane; none when zeros turn out to be of different signs, or when the
/// triangle is seen exactly edge-on.
#[inline(always)]
pub(crate) fn cross(packet: &Packet, lane: usize, undecided: bool, shot: &Shot) -> Option<Crossing> {
    let from = [0, 1, 2].map(|i| corner(packet, lane, i) - shot.origin);
    let normal = (from[1] - from[0]).cross(from[2] - from[0]);
    let (start, speed) = (normal.dot(from[0]), normal.dot(shot.direction));
    let sway = normal.abs().element_sum();
    let mut t = start / speed;
    // Within 0.6° of edge-on, or with an edge through the ray, the signs and the corners decide.
    let grazing = speed * speed <= 1e-4 * normal.length_squared() * shot.direction.length_squared();
    if grazing || undecided {
        t = decide(edges(packet, lane, shot), from, shot.direction, t)?;
    }
    Some(Crossing { t, start, speed, sway })
}

/// Whether the line is within the triangle after all, and then its distance, never outside the depths of
/// the corners, which an edge-on triangle would allow.
#[cold]
fn decide([u, v, w]: [f64; 3], from: [DVec3; 3], direction: DVec3, t: f64) -> Option<f64> {
    let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let area = u + v + w;
    if !inside || area == 0.0 {
        return None;
    }
    let [d0, d1, d2] = from.map(|corner| corner.dot(direction) / direction.length_squared());
    let t = if t.is_finite() { t } else { (u * d0 + v * d1 + w * d2) / area };
    Some(t.max(d0.min(d1).min(d2)).min(d0.max(d1).max(d2)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::lanes::Plain;

    fn packet(corners: [[f32; 3]; 3]) -> Packet {
        let mut packet = Packet { corners: [[[f32::NAN; WIDTH]; 3]; 3] };
        for (to, from) in packet.corners.iter_mut().zip(corners) {
            (0..3).for_each(|axis| to[axis][0] = from[axis]);
        }
        packet
    }

    proptest! {
        /// A quad's two triangles around its diagonal: what aims at a point of the diagonal meets one.
        #[test]
        fn no_gap_along_a_shared_edge(
            corners in prop::array::uniform4(prop::array::uniform3(-1.0f32..1.0)),
            eye in prop::array::uniform3(2.0f32..1e3),
            along in 0.0f64..=1.0,
        ) {
            let [a, b, c, d] = corners;
            let to = |p: [f32; 3]| DVec3::from(p.map(f64::from));
            let eye = to(eye);
            let direction = to(b).lerp(to(d), along) - eye;
            let Some(shot) = Shot::new(eye, direction, 1.0) else { return Ok(()) };
            // The fold must be seen from one side, or the diagonal is a silhouette and may be passed.
            let facing = |p: [f32; 3], q: [f32; 3], r: [f32; 3]| {
                let n = (to(q) - to(p)).cross(to(r) - to(p));
                n.dot(direction) / (n.length() * direction.length())
            };
            let (one, two) = (facing(a, b, d), facing(b, c, d));
            // Beyond the rounding of the f32 direction at both triangles' own scale.
            prop_assume!(one.abs() > 1e-2 && two.abs() > 1e-2 && one.signum() == two.signum());
            // Beyond the corners at the ends of the diagonal, other triangles of the fan would be met.
            prop_assume!(along > 0.05 && along < 0.95 && (to(b) - to(d)).length() > 0.1);
            let met = |corners| candidates::<Plain, true>(&packet(corners), &shot).0 & 1 == 1
                && cross(&packet(corners), 0, true, &shot).is_some();
            prop_assert!(met([a, b, d]) || met([b, c, d]));
        }
    }

    #[test]
    fn distance_is_exact_head_on() {
        let shot = Shot::new(DVec3::new(0.25, 0.25, 5.0), DVec3::NEG_Z, 1.0);
        let packet = packet([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
        let met =
            shot.and_then(|shot| Some((cross(&packet, 0, false, &shot)?.t, weights(&packet, 0, &shot))));
        assert_eq!(met, Some((4.0, [0.25, 0.25])));
    }

    #[test]
    fn nothing_is_met_by_nan_or_by_a_ray_that_goes_nowhere() {
        assert!(Shot::new(DVec3::NAN, DVec3::X, 1.0).is_none());
        assert!(Shot::new(DVec3::ZERO, DVec3::ZERO, 1.0).is_none());
        let shot = Shot::new(DVec3::ZERO, DVec3::X, 1.0);
        let empty = Packet { corners: [[[f32::NAN; WIDTH]; 3]; 3] };
        assert_eq!(shot.map(|shot| candidates::<Plain, false>(&empty, &shot)), Some((0, 0)));
    }
}
