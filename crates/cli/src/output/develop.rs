//! Spectra become colours, here and only here.

use glam::Vec3;
use light::Film;
use light::colour::srgb_from_xyz;
use rayon::prelude::*;

/// A picture in absolute linear sRGB.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `""` for the whole, or the name of the part.
    pub name: String,
    /// Linear sRGB, rows from the top: (1,1,1) is D65 white of 1 cd/m². Negative outside sRGB's gamut.
    pub rgb: Vec<Vec3>,
    /// Luminance \[cd/m²\].
    pub luminance: Vec<f32>,
}

/// Develops every layer of a film.
pub fn develop(film: &Film) -> Vec<Picture> {
    let layer = |layer: &light::Layer| {
        let xyz: Vec<Vec3> = layer.pixels.par_iter().map(|pixel| pixel.xyz()).collect();
        Picture {
            width: film.width as usize,
            height: film.height as usize,
            name: layer.name.clone(),
            rgb: xyz.par_iter().map(|&xyz| srgb_from_xyz(xyz)).collect(),
            luminance: xyz.par_iter().map(|xyz| xyz.y).collect(),
        }
    };
    film.layers.iter().map(layer).collect()
}
