//! Types A and B of LM-63, whose planes do not meet in the lamp's axis, on the grid of type C.
//!
//! Where the types' angles point, in the frame of [`light::Distribution`], as LM-63-2002 defines them
//! (photometric zero is nadir and has H = 0, V = 0 in type B but V = −90° in type A; photometric horizontal
//! has H = 0, V = 90° in type B but V = 0 in type A; horizontal angles run clockwise in both):
//!
//! - **B** (floodlights): the polar axis lies across the lamp (Y), V turns about it from nadir towards C = 0,
//!   H is the latitude: d = (cos H sin V, −sin H, −cos H cos V). But for the sense of H this is CIE 121's
//!   (B, β): tan B = cos C tan γ, sin β = sin C sin γ. The beam's axis H = V = 0 is the lamp's axis.
//! - **A** (headlamps, signals): the polar axis is vertical, H is the azimuth, V the elevation:
//!   d = (cos V cos H, −cos V sin H, sin V). The beam's axis H = V = 0 is C = 0, γ = 90°.
//!
//! Earlier editions leave both to the handbook and are read alike.

use super::planes::Table;

/// How the angles of a goniometer point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Polar axis vertical.
    A,
    /// Polar axis across the lamp.
    B,
}

/// A table of type A or B.
pub(super) struct Goniometer {
    pub(super) kind: Kind,
    /// Horizontal angles \[degrees\]; from 0 to 90 they hold on both sides.
    pub(super) horizontal: Vec<f32>,
    /// Vertical angles \[degrees\].
    pub(super) vertical: Vec<f32>,
    /// Intensities, vertical angles running fastest.
    pub(super) intensity: Vec<f32>,
}

/// Bounds of the grid's step \[degrees\]: finer than 0.5° would hold more than any goniometer's file,
/// coarser than 2.5° would blunt beams that the file's interpolation still has.
const STEP: std::ops::RangeInclusive<f32> = 0.5..=2.5;

impl Goniometer {
    /// The same lamp by C and γ.
    ///
    /// Every node of the new grid is the exact direction looked up in the old table (linear in V, then in
    /// H; 0 outside), so nodes are as true as the file. Between nodes the step is half the finest of the
    /// file (within 0.5 to 2.5°): the error there is at most h²/8 times the second derivative of I, and an edge of
    /// the measured field is blurred over one step.
    pub(super) fn by_c_and_gamma(&self) -> Table {
        let finest = |angles: &[f32]| angles.windows(2).map(|w| w[1] - w[0]).fold(f32::INFINITY, f32::min);
        let step = 0.5 * finest(&self.horizontal).min(finest(&self.vertical));
        let half = (180.0 / step.clamp(*STEP.start(), *STEP.end())).ceil() as usize;
        let angle = |i: usize| (180.0 * i as f64 / half as f64) as f32;
        let c: Vec<f32> = (0..=2 * half).map(angle).collect();
        let gamma: Vec<f32> = (0..=half).map(angle).collect();
        let mut intensity = Vec::with_capacity(c.len() * gamma.len());
        for plane in 0..c.len() {
            // The plane at 360° is that at 0 to the last bit.
            let (sin_c, cos_c) = f64::from(c[plane % (2 * half)]).to_radians().sin_cos();
            for (i, &g) in gamma.iter().enumerate() {
                let (sin, cos) = f64::from(g).to_radians().sin_cos();
                // At the poles the direction must not depend on C, not even by rounding.
                let sin = if i == 0 || i == half { 0.0 } else { sin };
                intensity.push(self.intensity(sin * cos_c, sin * sin_c, -cos));
            }
        }
        Table { c, gamma, intensity }
    }

    /// Intensity along a unit direction in the frame of [`light::Distribution`].
    fn intensity(&self, x: f64, y: f64, z: f64) -> f32 {
        let (h, v) = match self.kind {
            Kind::A => ((-y).atan2(x), z.atan2(x.hypot(y))),
            Kind::B => ((-y).atan2(x.hypot(z)), x.atan2(-z)),
        };
        let (h, v) = (h.to_degrees() as f32, v.to_degrees() as f32);
        let h = if self.horizontal[0] >= 0.0 { h.abs() } else { h };
        let (Some((h0, h1, across)), Some((v0, v1, along))) =
            (bracket(&self.horizontal, h), bracket(&self.vertical, v))
        else {
            return 0.0;
        };
        let in_plane = |plane: usize| {
            let row = &self.intensity[plane * self.vertical.len()..][..self.vertical.len()];
            row[v0] + along * (row[v1] - row[v0])
        };
        in_plane(h0) + across * (in_plane(h1) - in_plane(h0))
    }
}

/// Indices around `x` in the rising `table` and the share of the second; None outside.
fn bracket(table: &[f32], x: f32) -> Option<(usize, usize, f32)> {
    let slack = 1e-4; // degrees: the rounding of an angle must not put out the edge of the measured field
    let last = table.len() - 1;
    if x < table[0] - slack || x > table[last] + slack {
        return None;
    }
    let after = table.partition_point(|&t| t <= x).clamp(1, last);
    let share = (x - table[after - 1]) / (table[after] - table[after - 1]);
    Some((after - 1, after, share.clamp(0.0, 1.0)))
}
