//! Means of many walks, and how far they may be off.

use glam::{DVec2, DVec3};
use light::{Film, Layer, View};
use rayon::prelude::*;

use crate::bands::Bands;
use crate::dice::Dice;
use crate::look::Looking;
use crate::tree::Line;
use crate::walk::{Since, Walk};
use crate::world::World;

/// How much is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Walks for each sensor or pixel, ≥ 1; errors fall with their root.
    pub samples: u32,
    /// How many faces may send light on after it has left its source and before it arrives, 0 being the light of lamps and sky alone; none = as
    /// many as do. Mirrors, glass and water surfaces do not count, nor does water that scatters; a face that emits light sends it.
    pub faces: Option<u32>,
    /// Decides every random number: two of the same seed are the same to the bit.
    pub seed: u64,
}

/// A mean and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean per band.
    pub mean: Bands,
    /// Standard error of that per band.
    pub error: Bands,
    /// Luminance of the mean: lx of an irradiance, cd/m² of a radiance.
    pub luminance: f64,
    /// Standard error of that.
    pub luminance_error: f64,
}

/// A picture of radiances.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Means.
    pub film: Film,
    /// Standard error of each pixel's luminance \[cd/m²\].
    pub errors: Vec<f64>,
}

/// Walks in a batch, whose sums are added in order.
const BATCH: u32 = 256;

/// Σ x, Σ x² per band and of luminances.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    sum: Bands,
    squares: Bands,
    luminance: [f64; 2],
}

impl Sums {
    fn add(&mut self, value: Bands) {
        let luminance = value.luminance();
        self.count += 1.0;
        self.sum += value;
        self.squares += value * value;
        self.luminance = [self.luminance[0] + luminance, self.luminance[1] + luminance * luminance];
    }

    fn and(mut self, other: &Self) -> Self {
        self.count += other.count;
        self.sum += other.sum;
        self.squares += other.squares;
        self.luminance = [0, 1].map(|k| self.luminance[k] + other.luminance[k]);
        self
    }

    fn estimate(&self) -> Estimate {
        let n = self.count;
        let error = |sum: f64, squares: f64| {
            // Infinite where one walk cannot tell.
            let spread = (squares - sum * sum / n).max(0.0) / (n - 1.0);
            if n > 1.0 { (spread / n).sqrt() } else { f64::INFINITY }
        };
        Estimate {
            mean: self.sum * (1.0 / n),
            error: Bands(std::array::from_fn(|b| error(self.sum[b], self.squares[b]))),
            luminance: self.luminance[0] / n,
            luminance_error: error(self.luminance[0], self.luminance[1]),
        }
    }
}

/// Radiance that one walk finds along the line from `from` in the unit direction `toward`, right on average \[W m⁻² sr⁻¹ nm⁻¹\]. The eye sees the
/// sun's disc, but no lamp itself.
pub fn radiance(world: &World, [from, toward]: [DVec3; 2], seed: u64, sample: u64) -> Bands {
    let line = Line { origin: from, direction: toward };
    Walk::new(world, line, Since::Eye, None, &mut Dice::new(seed, sample)).radiance()
}

/// Irradiance on the plane through `at` of unit `normal` \[W m⁻² nm⁻¹\], over as many walks as `effort` says.
pub fn irradiance(world: &World, at: DVec3, normal: DVec3, effort: &Effort) -> Estimate {
    let batches: Vec<Sums> = (0..effort.samples.max(1).div_ceil(BATCH))
        .into_par_iter()
        .map(|batch| {
            let mut sums = Sums::default();
            for sample in batch * BATCH..((batch + 1) * BATCH).min(effort.samples.max(1)) {
                sums.add(received(world, at, normal, effort, u64::from(sample)));
            }
            sums
        })
        .collect();
    batches.iter().fold(Sums::default(), |sum, batch| sum.and(batch)).estimate()
}

/// Irradiance that one walk finds.
fn received(world: &World, at: DVec3, normal: DVec3, effort: &Effort, sample: u64) -> Bands {
    use std::f64::consts::{FRAC_1_PI, PI};
    let mut dice = Dice::new(effort.seed, sample);
    // What faces a direction counts with its cosine, whose density is cos/π.
    let receives = |toward: DVec3| {
        let cos = toward.dot(normal).max(0.0);
        (Bands::splat(cos), cos * FRAC_1_PI)
    };
    let place = Looking { position: at, leave: &|_| at, scatters: &receives, glow: effort.faces != Some(0) };
    let lamps = world.look_for_lamps(&place, &mut dice);
    let toward = dice.cosine(normal);
    let since = Since::Scattered(at, receives(toward).1);
    let line = Line { origin: at, direction: toward };
    lamps + Walk::new(world, line, since, effort.faces, &mut dice).radiance() * PI
}

/// The picture that an eye sees: each pixel the mean over its square.
pub fn picture(world: &World, view: &View, effort: &Effort) -> Picture {
    let pixels: Vec<(Bands, f64)> = (0..u64::from(view.width) * u64::from(view.height))
        .into_par_iter()
        .map(|pixel| {
            let estimate = seen(world, view, pixel, effort);
            (estimate.mean, estimate.luminance_error)
        })
        .collect();
    let layer =
        Layer { name: String::new(), pixels: pixels.iter().map(|(mean, _)| mean.spectrum()).collect() };
    let film = Film { width: view.width, height: view.height, layers: vec![layer] };
    Picture { film, errors: pixels.into_iter().map(|(_, error)| error).collect() }
}

fn seen(world: &World, view: &View, pixel: u64, effort: &Effort) -> Estimate {
    let corner = DVec2::new((pixel % u64::from(view.width)) as f64, (pixel / u64::from(view.width)) as f64);
    let forward = -view.world_from_view.z_axis;
    let mut sums = Sums::default();
    for sample in 0..effort.samples.max(1) {
        let mut dice = Dice::new(effort.seed ^ pixel.rotate_left(32), u64::from(sample));
        let (eye, direction) = view.line(corner + DVec2::from(dice.pair()));
        let origin = eye + direction * (view.near / direction.dot(forward));
        let line = Line { origin, direction };
        sums.add(Walk::new(world, line, Since::Eye, effort.faces, &mut dice).radiance());
    }
    sums.estimate()
}
