//! PNG and JPEG to textures, within limits.

use std::io::Cursor;
use std::sync::Arc;

use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use light::{Texture, Wrap};

/// Texels in a row or column that an image may have.
pub(crate) const MAX_SIDE: u32 = 16_384;
/// Texels that all images of one file may have together: at 11 bytes each (with the pyramid) 2.9 GB.
pub(crate) const MAX_TEXELS: u64 = 1 << 28;

/// What the numbers of an image are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Encoding {
    /// Colour for the eye: decoded to linear.
    Srgb,
    /// Numbers as they are.
    Linear,
}

/// How to read an image.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading {
    /// What its red, green and blue are (alpha is always linear).
    pub(crate) encoding: Encoding,
    /// Whether alpha counts; if not, it is 1 and the colour below it is kept.
    pub(crate) alpha: bool,
    /// What lies beyond its edges.
    pub(crate) wrap: [Wrap; 2],
}

/// A decoded image.
#[derive(Clone, Debug)]
pub(crate) struct Decoded {
    /// The pyramid.
    pub(crate) texture: Arc<Texture>,
    /// The least alpha of all texels, 1 where there is none.
    pub(crate) least_alpha: f32,
}

/// Width and height, from the head of the file alone, within [`MAX_SIDE`].
pub(crate) fn size(bytes: &[u8]) -> Result<[u32; 2], String> {
    let (width, height) = reader(bytes)?.into_dimensions().map_err(|error| error.to_string())?;
    if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
        return Err(format!("has {width} × {height} texels; 1 × 1 to {MAX_SIDE} × {MAX_SIDE} are allowed"));
    }
    Ok([width, height])
}

/// Decodes a PNG (any depth, palette, grey) or a JPEG.
pub(crate) fn decode(bytes: &[u8], reading: Reading) -> Result<Decoded, String> {
    let [width, height] = size(bytes)?;
    let image = reader(bytes)?.decode().map_err(|error| error.to_string())?;
    let texels = texels(image, reading);
    let least_alpha = texels.iter().fold(1.0f32, |least, texel| least.min(texel[3]));
    let texture = Texture::new(width, height, &texels, reading.wrap)
        .ok_or_else(|| format!("has {} texels, not {width} × {height}", texels.len()))?;
    Ok(Decoded { texture: Arc::new(texture), least_alpha })
}

fn reader(bytes: &[u8]) -> Result<ImageReader<Cursor<&[u8]>>, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes));
    match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => reader.set_format(format),
        Ok(other) => return Err(format!("is {other:?}; PNG or JPEG is needed")),
        Err(_) => return Err("is neither PNG nor JPEG".into()),
    }
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MAX_SIDE), Some(MAX_SIDE));
    // 16-bit RGBA, and as much again for the decoder's own rows.
    limits.max_alloc = Some(2 * 8 * MAX_TEXELS);
    reader.limits(limits);
    Ok(reader)
}

/// Linear RGB and alpha within \[0, 1\], by a table of all codes: exact, and free of `powf` per texel.
fn texels(image: DynamicImage, reading: Reading) -> Vec<[f32; 4]> {
    let deep = matches!(
        image,
        DynamicImage::ImageLuma16(_)
            | DynamicImage::ImageLumaA16(_)
            | DynamicImage::ImageRgb16(_)
            | DynamicImage::ImageRgba16(_)
    );
    let top: u16 = if deep { u16::MAX } else { u8::MAX.into() };
    let share = |code: u16| f32::from(code) / f32::from(top);
    let table: Vec<f32> = (0..=top)
        .map(|code| match reading.encoding {
            Encoding::Srgb => linear(f64::from(code) / f64::from(top)) as f32,
            Encoding::Linear => share(code),
        })
        .collect();
    let texel = |[r, g, b, a]: [u16; 4]| {
        let [r, g, b] = [r, g, b].map(|code| table[code as usize]);
        [r, g, b, if reading.alpha { share(a) } else { 1.0 }]
    };
    if deep {
        image.into_rgba16().pixels().map(|pixel| texel(pixel.0)).collect()
    } else {
        image.into_rgba8().pixels().map(|pixel| texel(pixel.0.map(u16::from))).collect()
    }
}

/// sRGB (IEC 61966-2-1) to linear, both within \[0, 1\].
fn linear(code: f64) -> f64 {
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}
