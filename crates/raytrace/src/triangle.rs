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
    /// Weights of the second and third corner, within the triangle.
    pub(crate) weights: [f64; 2],
    /// Twice the area times the normal.
    pub(crate) normal: DVec3,
    /// First corner, relative to the ray's origin.
    pub(crate) corner: DVec3,
    /// Σ |normal| · largest |coordinate|: by how much of this times u the plane shifts (in units of
    /// `normal · displacement`) when each coordinate of each corner is off by u of itself.
    pub(crate) sway: f64,
}

/// One bit per lane whose triangle the line may meet: all edge functions of one sign, or zero.
#[inline(always)]
pub(crate) fn candidates<L: Lanes>(packet: &Packet, shot: &Shot) -> u32 {
    let [x, y, z] = shot.axes;
    let shear = shot.shear.map(L::splat);
    let high = shot.axes.map(|axis| L::splat(shot.origin_high[axis]));
    let low = shot.axes.map(|axis| L::splat(shot.origin_low[axis]));
    let sheared = |corner: &[[f32; WIDTH]; 3]| {
        let depth = L::load(&corner[z]).sub(high[2]).sub(low[2]);
        let across =
            |axis: usize, i: usize| L::load(&corner[axis]).sub(high[i]).sub(low[i]).sub(shear[i].mul(depth));
        (across(x, 0), across(y, 1))
    };
    let ((ax, ay), (bx, by), (cx, cy)) =
        (sheared(&packet.corners[0]), sheared(&packet.corners[1]), sheared(&packet.corners[2]));
    let u = cx.mul(by).sub(cy.mul(bx));
    let v = ax.mul(cy).sub(ay.mul(cx));
    let w = bx.mul(ay).sub(by.mul(ax));
    let zero = L::splat(0.0);
    zero.le(u.min(v).min(w)) | u.max(v).max(w).le(zero)
}

/// The exact answer for one candidate lane; none when the zeros turn out to be of different signs, or the
/// triangle is seen exactly edge-on.
pub(crate) fn cross(packet: &Packet, lane: usize, shot: &Shot) -> Option<Crossing> {
    let at = |corner: usize, axis: usize| packet.corners[corner][axis][lane];
    let [x, y, z] = shot.axes;
    // The very operations of `candidates`, so that the two agree.
    let sheared = |corner: usize| {
        let moved = |axis: usize| at(corner, axis) - shot.origin_high[axis] - shot.origin_low[axis];
        let depth = moved(z);
        [moved(x) - shot.shear[0] * depth, moved(y) - shot.shear[1] * depth].map(f64::from)
    };
    let [a, b, c] = [sheared(0), sheared(1), sheared(2)];
    // In f64 throughout: products of f32 are exact, and the difference of two exact numbers has the right sign.
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let area = u + v + w;
    if !inside || area == 0.0 {
        return None;
    }
    let corner = |i: usize| DVec3::new(at(i, 0).into(), at(i, 1).into(), at(i, 2).into());
    let corners = [corner(0), corner(1), corner(2)];
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let from = corners.map(|corner| corner - shot.origin);
    let weights = [v / area, w / area];
    let depth = from.map(|corner| corner.dot(shot.direction) / shot.direction.length_squared());
    // Plane and line; never outside the depths of the corners, which an edge-on triangle would allow.
    let exact = normal.dot(from[0]) / normal.dot(shot.direction);
    let mixed = (u * depth[0] + v * depth[1] + w * depth[2]) / area;
    let t = if exact.is_finite() { exact } else { mixed };
    let [d0, d1, d2] = depth;
    let reach = corners.iter().fold(0.0f64, |reach, corner| reach.max(corner.abs().max_element()));
    Some(Crossing {
        t: t.max(d0.min(d1).min(d2)).min(d0.max(d1).max(d2)),
        weights,
        normal,
        corner: from[0],
        sway: normal.abs().element_sum() * reach,
    })
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
            let met = |corners| candidates::<Plain>(&packet(corners), &shot) & 1 == 1
                && cross(&packet(corners), 0, &shot).is_some();
            prop_assert!(met([a, b, d]) || met([b, c, d]));
        }
    }

    #[test]
    fn distance_is_exact_head_on() {
        let shot = Shot::new(DVec3::new(0.25, 0.25, 5.0), DVec3::NEG_Z, 1.0);
        let packet = packet([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
        let met = shot.and_then(|shot| cross(&packet, 0, &shot));
        assert_eq!(met.map(|met| (met.t, met.weights)), Some((4.0, [0.25, 0.25])));
    }

    #[test]
    fn nothing_is_met_by_nan_or_by_a_ray_that_goes_nowhere() {
        assert!(Shot::new(DVec3::NAN, DVec3::X, 1.0).is_none());
        assert!(Shot::new(DVec3::ZERO, DVec3::ZERO, 1.0).is_none());
        let shot = Shot::new(DVec3::ZERO, DVec3::X, 1.0);
        let empty = Packet { corners: [[[f32::NAN; WIDTH]; 3]; 3] };
        assert_eq!(shot.map(|shot| candidates::<Plain>(&empty, &shot)), Some(0));
    }
}
