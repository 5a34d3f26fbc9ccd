//! The receiving cuboid: how it stands and how its faces are divided (thesis 4.3.1 to 4.3.4).

use glam::{DMat3, DVec3, Vec3};

/// A cuboid around the place that receives light, its faces divided into elements.
///
/// The centre is the place, the *top* faces the brightest part of the sky at distance 1 (nothing depends on that
/// scale), and so does the bottom below. Seen from the centre the top's opposite edges are φ apart, so that it is
/// 2a wide, a = tan(φ/2), and the sides stand at distance a. The top has n × n elements. Those of the sides and of
/// the bottom are m times as wide each way, as nearly as whole numbers of them allow: n/m across, n/(m a) up the
/// sides, which is made even so that the middle of the sides is an edge.
///
/// ```
/// use keikan_sky::Layout;
/// let layout = Layout::new(glam::Vec3::Y, 40, 1.15, 75.0);
/// let all: f64 = layout.elements().map(|element| element.solid_angle).sum();
/// assert!((all / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12); // all that there is
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    faces: [Face; 6],
    /// From the world's directions to the cuboid's, whose +z is the top.
    frame_from_world: DMat3,
}

/// One face of the cuboid, a grid of elements in the cuboid's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// The axis (0 = x, 1 = y, 2 = z) that it stands across.
    pub axis: usize,
    /// On which side of the centre, 1 or −1.
    pub sign: f64,
    /// How far from the centre.
    pub distance: f64,
    /// Half its width along the next axis, and along the one after that.
    pub half: [f64; 2],
    /// Elements along these: columns and rows.
    pub count: [usize; 2],
}

/// One element, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Unit vector from the place to its middle.
    pub direction: DVec3,
    /// Its solid angle, exactly \[sr\].
    pub solid_angle: f64,
}

impl Face {
    /// The axes along its columns and rows.
    pub fn axes(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// The point of the face `at` columns and rows from its corner (middles of elements are at halves).
    pub fn point(&self, at: [f64; 2]) -> DVec3 {
        let [i, j] = self.axes();
        let mut point = DVec3::ZERO;
        point[self.axis] = self.sign * self.distance;
        point[i] = self.along(0, at[0]);
        point[j] = self.along(1, at[1]);
        point
    }

    fn along(&self, side: usize, at: f64) -> f64 {
        self.half[side] * (2.0 * at / self.count[side] as f64 - 1.0)
    }

    /// Solid angle of an element \[sr\]: 4.17, dS = ΔS cos ψ/r², integrated over it,
    ///
    ///   Ω = Σ ± arctan( x y / (d √(x² + y² + d²)) ) over its corners.
    pub fn solid_angle(&self, [column, row]: [usize; 2]) -> f64 {
        let d = self.distance;
        let [xs, ys] = [(0, column), (1, row)]
            .map(|(side, index)| [index, index + 1].map(|edge| self.along(side, edge as f64)));
        let corner = |x: f64, y: f64| (x * y / (d * (x * x + y * y + d * d).sqrt())).atan();
        corner(xs[1], ys[1]) - corner(xs[0], ys[1]) - corner(xs[1], ys[0]) + corner(xs[0], ys[0])
    }

    /// Every element, row by row, as column and row.
    pub fn cells(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [columns, rows] = self.count;
        (0..rows).flat_map(move |row| (0..columns).map(move |column| [column, row]))
    }
}

/// Most elements along a face.
const MOST: f64 = 4096.0;

impl Layout {
    /// A cuboid whose top of n × n elements, n = `divisions` ≥ 1, faces the unit vector `toward`; m is
    /// `ratio` > 0, φ is `opening_deg` within 1° to 170°. The cuboid's x is horizontal.
    pub fn new(toward: Vec3, divisions: u32, ratio: f64, opening_deg: f64) -> Self {
        let n = f64::from(divisions.max(1)).min(MOST);
        let half = (0.5 * opening_deg.clamp(1.0, 170.0).to_radians()).tan();
        let count = |elements: f64| elements.round().clamp(1.0, MOST) as usize;
        let across = count(n / ratio);
        let up = 2 * count(0.5 * n / (ratio * half));
        let face = |axis: usize, sign: f64| {
            let extent = [half, half, 1.0];
            let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
            let divided = |k: usize| match (axis, k) {
                (2, _) if sign > 0.0 => count(n),
                (_, 2) => up,
                _ => across,
            };
            Face {
                axis,
                sign,
                distance: extent[axis],
                half: [extent[i], extent[j]],
                count: [divided(i), divided(j)],
            }
        };
        let faces = [face(2, 1.0), face(0, 1.0), face(0, -1.0), face(1, 1.0), face(1, -1.0), face(2, -1.0)];
        Self { faces, frame_from_world: frame(toward) }
    }

    /// The faces, the top first and the bottom last.
    pub fn faces(&self) -> &[Face; 6] {
        &self.faces
    }

    /// From the world's directions to the cuboid's: a rotation.
    pub fn frame_from_world(&self) -> DMat3 {
        self.frame_from_world
    }

    /// One element of a face.
    pub fn element(&self, face: &Face, cell: [usize; 2]) -> Element {
        let middle = face.point(cell.map(|index| index as f64 + 0.5));
        Element {
            direction: (self.frame_from_world.transpose() * middle).normalize(),
            solid_angle: face.solid_angle(cell),
        }
    }

    /// All elements, face by face and row by row.
    pub fn elements(&self) -> impl Iterator<Item = Element> {
        self.faces.iter().flat_map(move |face| face.cells().map(move |cell| self.element(face, cell)))
    }

    /// Evenness g = C_max/C_min of the contributions (4.18, 4.19) of the elements above the horizon, for any
    /// quantity `luminance` by direction; ∞ where something contributes nothing.
    pub fn evenness(&self, luminance: impl Fn(DVec3) -> f64) -> f64 {
        let above = self.elements().filter(|element| element.direction.y > HORIZON);
        let contributions = above.map(|e| luminance(e.direction) * e.solid_angle);
        let [least, most] =
            contributions.fold([f64::INFINITY, 0.0], |[least, most], c| [c.min(least), c.max(most)]);
        most / least
    }
}

/// Height of a unit vector below which it leads to the ground: rounding must not tell which of those on the horizon do.
pub(crate) const HORIZON: f64 = 1e-9;

/// Rows: horizontal x, y, and z = `toward`.
fn frame(toward: Vec3) -> DMat3 {
    let z = toward.as_dvec3().try_normalize().unwrap_or(DVec3::Y);
    // Up to a rounding of the zenith itself any bearing is as good.
    let (x, z) = match DVec3::Y.cross(z) {
        across if across.length() < 1e-6 => (DVec3::X, DVec3::Y * z.y.signum()),
        across => (across.normalize(), z),
    };
    DMat3::from_cols(x, z.cross(x), z).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zenith_layout_stands_on_the_horizon() {
        let layout = Layout::new(Vec3::Y, 40, 1.15, 75.0);
        assert_eq!(layout.faces()[0].count, [40, 40]);
        // 40/1.15 = 34.8 across; 40/(1.15 tan 37.5°) = 45.3 up, made even.
        assert_eq!(layout.faces()[5].count, [35, 35]);
        assert!(layout.faces()[1..5].iter().all(|face| face.count[0] * face.count[1] == 35 * 46));
        // None lies across the horizon, and those above it are half of all that there is.
        let above: f64 = layout.elements().filter(|e| e.direction.y > HORIZON).map(|e| e.solid_angle).sum();
        assert!((above / std::f64::consts::TAU - 1.0).abs() < 1e-12, "{above}");
    }

    #[test]
    fn solid_angles_are_those_of_4_17_for_small_elements() {
        let layout = Layout::new(Vec3::new(0.6, 0.64, -0.48), 64, 1.3, 70.0);
        for face in layout.faces() {
            for cell in face.cells() {
                let point = face.point(cell.map(|i| i as f64 + 0.5));
                let width = [0, 1].map(|k| 2.0 * face.half[k] / face.count[k] as f64);
                let by_hand = width[0] * width[1] * face.distance / point.length().powi(3);
                // Second derivatives of d/r³ are at most 12/d² of it (at r = d: −3, off it less than 15 − 3).
                let bound = 12.0 / 24.0 * (width[0].powi(2) + width[1].powi(2)) / face.distance.powi(2);
                assert!((face.solid_angle(cell) / by_hand - 1.0).abs() < bound);
            }
        }
    }

    #[test]
    fn the_frame_is_a_rotation_with_its_top_where_asked() {
        for toward in
            [Vec3::Y, Vec3::NEG_Z, Vec3::new(0.6, 0.64, -0.48), Vec3::new(1e-4, 1.0, 0.0), Vec3::ZERO]
        {
            let frame = frame(toward);
            assert!((frame.determinant() - 1.0).abs() < 1e-12);
            let top = frame * toward.as_dvec3().try_normalize().unwrap_or(DVec3::Y);
            // Within 1e-6 of the zenith the top faces the zenith itself.
            assert!((top - DVec3::Z).length() < 2e-6, "{toward}: {top}");
        }
    }
}
