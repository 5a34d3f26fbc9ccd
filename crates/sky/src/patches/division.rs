//! Patches of sky and ground.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::Vec3;
use light::Spectrum;

/// Points across a patch, in each direction, of the mean of its radiance.
const FINE: usize = 4;

/// The sphere in patches of nearly even size: rows of even height between horizon and zenith, each of as many patches as
/// leave them nearly square; below the horizon half as many rows.
pub(crate) struct Division {
    patches: Vec<Patch>,
    /// The first so many are of the sky.
    sky: usize,
}

/// A patch of a row.
pub(crate) struct Patch {
    /// Where it is asked for: anywhere in it, by its number, so that no straight edge meets many of them at once.
    pub(crate) direction: Vec3,
    /// sin of the altitude at the lower edge and at the upper.
    pub(crate) heights: [f32; 2],
    /// Azimuth, from +X towards +Z, at both sides \[rad\].
    pub(crate) azimuths: [f32; 2],
}

/// Parts of the golden ratio's square and of its like in two dimensions (the plastic number's): multiples of both are spread evenly
/// over the square.
const SPREAD: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

impl Division {
    /// `rows` of sky, at least 1.
    pub(crate) fn new(rows: u32) -> Self {
        let mut patches = Vec::new();
        hemisphere(rows.max(1), 1.0, &mut patches);
        let sky = patches.len();
        hemisphere(rows.div_ceil(2).max(1), -1.0, &mut patches);
        for (i, patch) in patches.iter_mut().enumerate() {
            let at = SPREAD.map(|step| (0.5 + i as f64 * step).fract() as f32);
            patch.direction = patch.at(at);
        }
        Self { patches, sky }
    }

    pub(crate) fn patches(&self) -> &[Patch] {
        &self.patches
    }

    pub(crate) fn is_sky(&self, index: usize) -> bool {
        index < self.sky
    }
}

/// Rows from the horizon up (`side` = 1) or down (−1).
fn hemisphere(rows: u32, side: f32, patches: &mut Vec<Patch>) {
    let step = FRAC_PI_2 / rows as f32;
    for row in 0..rows {
        let [low, middle, high] = [0.0, 0.5, 1.0].map(|at| (row as f32 + at) * step);
        let count = (TAU * middle.cos() / step).round().max(3.0);
        let heights = [side * low.sin(), side * high.sin()];
        let azimuths = |k: u32| [k as f32, (k + 1) as f32].map(|k| k * (TAU / count));
        patches.extend((0..count as u32).map(|k| Patch {
            direction: Vec3::Y,
            heights,
            azimuths: azimuths(k),
        }));
    }
}

impl Patch {
    /// \[sr\]
    pub(crate) fn solid_angle(&self) -> f32 {
        (self.heights[1] - self.heights[0]).abs() * (self.azimuths[1] - self.azimuths[0])
    }

    /// The direction at shares of its azimuths and of its solid angle.
    fn at(&self, [along, up]: [f32; 2]) -> Vec3 {
        let [azimuth, y] = [(self.azimuths, along), (self.heights, up)].map(|([a, b], t)| a + (b - a) * t);
        let (sin, cos) = azimuth.sin_cos();
        let level = (1.0 - y * y).max(0.0).sqrt();
        Vec3::new(level * cos, y, level * sin)
    }

    /// The mean over its solid angle.
    pub(crate) fn mean(&self, radiance: impl Fn(Vec3) -> Spectrum) -> Spectrum {
        let middle = |index: usize| (index as f32 + 0.5) / FINE as f32;
        let points = (0..FINE * FINE).map(|k| self.at([middle(k % FINE), middle(k / FINE)]));
        points.map(radiance).sum::<Spectrum>() * (1.0 / (FINE * FINE) as f32)
    }
}
