//! What shows in a pixel, by rays that are each shaded on their own: classical supersampling.

use std::{ops::Range, sync::Arc};

use light::{Hit, Known, Nearest, Path, Piece, See, View};

use crate::rays::{position, scrambled};

/// Stratified, jittered rays through each pixel, every one shaded where it meets something.
///
/// Where [`crate::Rays`] shades a face once per pixel, this shades it once per sample: shadow edges and what
/// mirrors show are sampled as often as silhouettes, at the price of as much shading. Works on anything
/// that answers [`Nearest`], bodies included; cut-out faces are there or not, by their opacity of one half.
#[derive(Clone)]
pub struct Supersample {
    nearest: Arc<dyn Nearest>,
    view: View,
    samples: u32,
}

impl Supersample {
    /// `samples` ≥ 1 rays per pixel (0 counts as 1), where [`crate::Rays`] puts them.
    pub fn new(nearest: Arc<dyn Nearest>, view: View, samples: u32) -> Self {
        Self { nearest, view, samples: samples.max(1) }
    }

    fn sample(&self, column: u32, row: u32, index: u32) -> Option<Piece> {
        let screen = position(self.samples, column, row, index);
        let ray = self.view.ray(screen);
        let ahead = f64::from(ray.direction.as_dvec3().dot(-self.view.world_from_view.z_axis) as f32);
        // Rays begin at the near plane, as far along the ray as that is.
        let skip = (self.view.near / ahead) as f32;
        let start = light::Ray { origin: ray.at(skip), ..ray };
        let mut hit = self.nearest.nearest(&start)?;
        hit.distance += skip;
        hit.place.seed = scrambled(scrambled(scrambled(column) ^ row) ^ index);
        // The footprint of one sample, not of the pixel.
        let width = self.view.pixel_width(f64::from(hit.distance) * ahead) as f32;
        let path = Path { width: width * (self.samples as f32).sqrt().recip(), ..Path::EYE };
        let hit = Hit { path: Path::EYE, ..hit.on(path) };
        let share = f64::from(self.samples).recip() as f32;
        Some(Piece { column, share, hit, known: Known::default(), samples: 1 })
    }
}

impl See for Supersample {
    fn see(&self, rows: Range<u32>, columns: Range<u32>, receive: &mut dyn FnMut(u32, &mut Vec<Piece>)) {
        let mut pieces = Vec::new();
        for row in rows {
            for column in columns.clone() {
                pieces.extend((0..self.samples).filter_map(|index| self.sample(column, row, index)));
            }
            receive(row, &mut pieces);
            pieces.clear();
        }
    }
}
