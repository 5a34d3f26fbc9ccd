//! How much two pictures differ.

use std::fmt;
use std::path::{Path, PathBuf};

use glam::Vec3;
use light::colour::LUMINANCE;
use palette::color_difference::Ciede2000;
use palette::convert::FromColorUnclamped;
use palette::white_point::D65;
use palette::{Lab, LinSrgb};
use rayon::prelude::*;

use crate::command::{pretty, say};
use crate::output::{self, Header, Target};
use crate::publish::{self, Unit};
use crate::{Error, args};

/// A picture read back: linear sRGB.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Linear sRGB; cd/m² from an EXR, shares of white from a PNG.
    pub rgb: Vec<Vec3>,
}

/// The difference of two pictures.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Difference {
    /// √mean (a − b)² / mean b, over pixels and channels.
    pub relative_rmse: f64,
    /// Largest |a − b| of a channel, in the pictures' unit.
    pub largest: f64,
    /// Where: column and row.
    pub largest_at: [usize; 2],
    /// Mean of a / mean of b.
    pub mean_ratio: f64,
    /// Mean CIEDE2000, both exposed alike (b's 99th percentile of luminance as white).
    pub delta_e_mean: f64,
    /// 99th percentile of CIEDE2000.
    pub delta_e_99: f64,
    /// Structural similarity of the luminance, exposed as for ΔE; 1 = the same.
    pub ssim: f64,
    /// True when every number of both is the same to the bit.
    pub identical: bool,
}

/// `keikan compare`.
///
/// # Errors
/// A picture that cannot be read, sizes that differ, a file that cannot be written.
pub(crate) fn run(args: &args::Compare, json: bool) -> Result<(), Error> {
    publish::check(&args.output, &args.develop)?;
    if args.develop.layers {
        return Err(Error::Usage("--layers: a difference has one layer".to_owned()));
    }
    let targets: Vec<Target> = args.output.iter().map(|path| Target::new(path)).collect::<Result<_, _>>()?;
    let (a, b) = (read(&args.a)?, read(&args.b)?);
    let difference = compare(&a, &b)?;
    if !targets.is_empty() {
        let picture = apart(&a, &b);
        let header = || Header {
            owner: args.develop.owner.clone(),
            comments: format!(
                "keikan: |a - b| of a = {}, b = {}, in their unit",
                args.a.display(),
                args.b.display()
            ),
            whole: [a.width as u32, a.height as u32],
            ..Header::default()
        };
        let mut said = None;
        let encoded = args.output.iter().zip(targets).map(|(path, target)| {
            let develop = (&args.develop, Unit::Plain);
            Ok((target, publish::encode(path, std::slice::from_ref(&picture), develop, header, &mut said)?))
        });
        output::write(&encoded.collect::<Result<Vec<_>, Error>>()?)?;
        said.iter().for_each(|said| eprintln!("{said}"));
        args.output.iter().for_each(|path: &PathBuf| eprintln!("wrote {}", path.display()));
    }
    say(&if json { pretty(&difference) } else { difference.to_string() })
}

/// |a − b| of every channel, and of luminance, in the pictures' unit.
fn apart(a: &Picture, b: &Picture) -> output::Picture {
    let pairs = || a.rgb.iter().zip(&b.rgb).map(|(&a, &b)| a - b);
    output::Picture {
        width: a.width,
        height: a.height,
        name: String::new(),
        rgb: pairs().map(Vec3::abs).collect(),
        luminance: pairs().map(|difference| difference.dot(LUMINANCE).abs()).collect(),
    }
}

/// Reads an EXR or PNG.
///
/// # Errors
/// [`Error::Input`] with the file and what is wrong with it.
pub fn read(path: &Path) -> Result<Picture, Error> {
    let wrong = |what: String| Error::Input { path: path.display().to_string(), what };
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    match extension.as_str() {
        "exr" => read_exr(path).map_err(wrong),
        "png" | "jpg" | "jpeg" => {
            let image = image::open(path).map_err(|error| wrong(error.to_string()))?.to_rgb32f();
            let (width, height) = (image.width() as usize, image.height() as usize);
            let rgb = image.pixels().map(|p| Vec3::from_array(p.0.map(light::colour::decode_srgb))).collect();
            Ok(Picture { width, height, rgb })
        }
        other => {
            Err(wrong(format!("\"{other}\" is not a format that can be compared; there are: exr, png, jpg")))
        }
    }
}

fn read_exr(path: &Path) -> Result<Picture, String> {
    use exr::prelude::*;
    let image = read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![Vec3::ZERO; size.width() * size.height()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = Vec3::new(r, g, b);
        },
    )
    .map_err(|error| error.to_string())?;
    let size = image.layer_data.size;
    Ok(Picture { width: size.width(), height: size.height(), rgb: image.layer_data.channel_data.pixels.1 })
}

/// Compares `a` with the reference `b`.
///
/// # Errors
/// A usage error when their sizes differ.
pub fn compare(a: &Picture, b: &Picture) -> Result<Difference, Error> {
    if (a.width, a.height) != (b.width, b.height) {
        return Err(Error::Usage(format!(
            "pictures of {}x{} and {}x{} cannot be compared",
            a.width, a.height, b.width, b.height
        )));
    }
    let count = 3.0 * a.rgb.len().max(1) as f64;
    let sum = |f: &dyn Fn(Vec3, Vec3) -> Vec3| -> f64 {
        a.rgb.iter().zip(&b.rgb).map(|(&a, &b)| f64::from(f(a, b).element_sum())).sum()
    };
    let mean_b = sum(&|_, b| b) / count;
    let mean_a = sum(&|a, _| a) / count;
    let rmse = (sum(&|a, b| (a - b) * (a - b)) / count).sqrt();
    let (worst, largest) = a
        .rgb
        .iter()
        .zip(&b.rgb)
        .map(|(a, b)| (*a - *b).abs().max_element())
        .enumerate()
        // A difference that is no number is the largest of all.
        .fold((0, 0.0), |best: (usize, f32), (i, d)| if d > best.1 || d.is_nan() { (i, d) } else { best });
    let white = white(b);
    let mut delta_e: Vec<f32> =
        a.rgb.par_iter().zip(&b.rgb).map(|(&a, &b)| lab(a / white).difference(lab(b / white))).collect();
    delta_e.sort_unstable_by(f32::total_cmp);
    let mean_delta = delta_e.iter().map(|&d| f64::from(d)).sum::<f64>() / delta_e.len().max(1) as f64;
    let delta_e_99 = delta_e.get(delta_e.len() * 99 / 100).copied().unwrap_or(0.0);
    Ok(Difference {
        relative_rmse: ratio(rmse, mean_b),
        largest: f64::from(largest),
        largest_at: [worst % a.width.max(1), worst / a.width.max(1)],
        mean_ratio: ratio(mean_a, mean_b),
        delta_e_mean: mean_delta,
        delta_e_99: f64::from(delta_e_99),
        ssim: ssim(a, b, white)?,
        identical: a
            .rgb
            .iter()
            .zip(&b.rgb)
            .all(|(a, b)| a.to_array().map(f32::to_bits) == b.to_array().map(f32::to_bits)),
    })
}

fn ratio(value: f64, of: f64) -> f64 {
    if value == of { if of == 0.0 { 0.0 } else { 1.0 } } else { value / of }
}

/// The 99th percentile of the luminance.
fn white(picture: &Picture) -> f32 {
    let mut y: Vec<f32> = picture.rgb.iter().map(|rgb| rgb.dot(LUMINANCE)).collect();
    y.sort_unstable_by(f32::total_cmp);
    y.get(y.len() * 99 / 100).copied().filter(|w| *w > 0.0).unwrap_or(1.0)
}

fn lab(rgb: Vec3) -> Lab<D65, f32> {
    Lab::from_color_unclamped(LinSrgb::new(rgb.x, rgb.y, rgb.z))
}

fn ssim(a: &Picture, b: &Picture, white: f32) -> Result<f64, Error> {
    let grey = |picture: &Picture| {
        let bytes = picture.rgb.iter().map(|rgb| {
            let y = rgb.dot(LUMINANCE) / white;
            (light::colour::encode_srgb(y.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8
        });
        image::GrayImage::from_raw(picture.width as u32, picture.height as u32, bytes.collect())
    };
    let (Some(a), Some(b)) = (grey(a), grey(b)) else { return Ok(1.0) };
    image_compare::gray_similarity_structure(&image_compare::Algorithm::MSSIMSimple, &a, &b)
        .map(|similarity| similarity.score)
        .map_err(|error| Error::Usage(error.to_string()))
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "relative RMSE   {:.6}", self.relative_rmse)?;
        writeln!(f, "mean ratio      {:.6}", self.mean_ratio)?;
        writeln!(f, "largest         {:.6} at {}, {}", self.largest, self.largest_at[0], self.largest_at[1])?;
        writeln!(f, "ΔE2000          {:.4} mean, {:.4} 99th percentile", self.delta_e_mean, self.delta_e_99)?;
        writeln!(f, "SSIM            {:.6}", self.ssim)?;
        write!(f, "identical       {}", if self.identical { "to the bit" } else { "no" })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(value: f32) -> Picture {
        Picture { width: 16, height: 16, rgb: vec![Vec3::splat(value); 256] }
    }

    #[test]
    fn a_picture_is_like_itself_and_unlike_another() {
        let same = compare(&flat(3.0), &flat(3.0)).unwrap();
        assert!(same.identical && same.relative_rmse == 0.0 && same.delta_e_mean == 0.0);
        let other = compare(&flat(3.3), &flat(3.0)).unwrap();
        // |3.3 − 3| / 3, both rounded to f32.
        assert!((other.relative_rmse - 0.1).abs() < 4.0 * f64::from(f32::EPSILON));
        assert!(!other.identical && other.delta_e_mean > 1.0);
    }

    #[test]
    fn the_difference_is_absolute_and_of_luminance_first() {
        let mut other = flat(3.0);
        other.rgb[5] = Vec3::new(1.0, 5.0, 3.0);
        let apart = apart(&flat(3.0), &other);
        assert_eq!(apart.rgb[5], Vec3::new(2.0, 2.0, 0.0));
        // Red and green cancel in part: 2 · (0.7152 − 0.2126).
        assert!((apart.luminance[5] - 2.0 * (LUMINANCE.y - LUMINANCE.x)).abs() <= 4.0 * f32::EPSILON);
        assert!(apart.luminance.iter().enumerate().all(|(i, &y)| i == 5 || y == 0.0));
    }

    #[test]
    fn sizes_must_match() {
        let wide = Picture { width: 32, height: 8, rgb: vec![Vec3::ONE; 256] };
        assert_eq!(compare(&wide, &flat(1.0)).unwrap_err().exit_code(), 2);
    }
}
