//! What the elements give: running sums along their rows (thesis 4.21).

use glam::{DVec3, Vec3};
use light::Spectrum;
use light::bands::BANDS;

use super::layout::{Face, HORIZON, Layout};
use crate::ground::Surround;

/// Points across an element, in each direction, of the mean of its radiance: the sun's surroundings have a peak.
const FINE: usize = 3;
/// The same for an element across the horizon, part sky and part ground.
const FINE_AT_HORIZON: usize = 8;

/// A vector for each band.
pub(crate) type Flux = [DVec3; BANDS];

/// Running sums of L_i dS_i D_i along each row of each face, D_i the unit vector to the element's middle.
///
/// A place of normal n receives L_i dS_i cos ξ_i = (L_i dS_i D_i) · n, so that a run j1..j2 of visible elements gives
///
///   E = n · (V_j2 − V_(j1−1)),   V_k = Σ_{i≤k} L_i dS_i D_i                    (4.21 with vectors)
///
/// The thesis sums L_i dS_i cos ξ_i and keeps a table for each normal; sums of vectors serve all normals at once. They start
/// anew in each row and are in f64, so that differences keep their digits.
#[derive(Clone, Debug)]
pub(crate) struct Sums {
    faces: [FaceSums; 6],
}

#[derive(Clone, Debug)]
struct FaceSums {
    /// Entries of a row: one more than it has elements.
    stride: usize,
    running: Vec<Flux>,
}

impl Sums {
    pub(crate) fn new(layout: &Layout, around: &Surround) -> Self {
        Self { faces: layout.faces().map(|face| FaceSums::new(layout, &face, around)) }
    }

    /// Σ of the elements from `from` up to but without `to` of a row.
    pub(crate) fn run(&self, face: usize, row: usize, from: usize, to: usize) -> Flux {
        let FaceSums { stride, running } = &self.faces[face];
        let row = &running[row * stride..];
        std::array::from_fn(|band| row[to][band] - row[from][band])
    }
}

impl FaceSums {
    fn new(layout: &Layout, face: &Face, around: &Surround) -> Self {
        let [columns, rows] = face.count;
        let mut running = Vec::with_capacity(rows * (columns + 1));
        for row in 0..rows {
            let mut sum = [DVec3::ZERO; BANDS];
            running.push(sum);
            for column in 0..columns {
                let element = layout.element(face, [column, row]);
                let radiance = radiance(layout, face, [column, row], around);
                let whole = element.direction * element.solid_angle;
                for band in 0..BANDS {
                    sum[band] += whole * f64::from(radiance[band]);
                }
                running.push(sum);
            }
        }
        Self { stride: columns + 1, running }
    }
}

/// Mean radiance of an element.
fn radiance(layout: &Layout, face: &Face, [column, row]: [usize; 2], around: &Surround) -> Spectrum {
    let world_from_frame = layout.frame_from_world().transpose();
    let direction = |at: [f64; 2]| {
        let point = face.point([column as f64 + at[0], row as f64 + at[1]]);
        world_from_frame * point.normalize()
    };
    let is_ground = |direction: DVec3| direction.y < HORIZON;
    let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(|at| is_ground(direction(at)));
    let fine = if corners == [corners[0]; 4] { FINE } else { FINE_AT_HORIZON };
    let part = |index: usize| (index as f64 + 0.5) / fine as f64;
    let points = (0..fine * fine).map(|k| direction([part(k % fine), part(k / fine)]));
    let sum: Spectrum = points
        .map(|direction| match is_ground(direction) {
            true => around.ground,
            false => around.sky.radiance(direction.as_vec3().normalize()),
        })
        .sum();
    sum * (1.0 / (fine * fine) as f32)
}

/// What a plane of unit `normal` receives of it \[W m⁻² nm⁻¹\].
pub(crate) fn on_plane(flux: &Flux, normal: Vec3) -> Spectrum {
    // Differences of running sums may round below nothing.
    Spectrum(flux.map(|vector| vector.dot(normal.as_dvec3()).max(0.0) as f32))
}
