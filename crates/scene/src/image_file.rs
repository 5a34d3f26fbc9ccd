//! PNG and JPEG to textures, within limits.

use std::io::Cursor;
use std::sync::Arc;

use image::{DynamicImage, ImageError, ImageFormat, ImageReader, Limits};
use light::colour::decode_srgb;
use light::{Texture, Wrap};

/// Texels in a row or column that an image may have.
pub(crate) const MAX_SIDE: u32 = 16_384;
/// Texels that an image may have, such as 8192 × 8192: a few kilobytes of file may stand for so many, and decoding
/// them takes 16 bytes each, 1.1 GB.
pub(crate) const MAX_IMAGE: u64 = 1 << 26;
/// Texels that all images of one file may have together: 2.9 GB at 10⅔ bytes each (with the pyramid), 4.3 GB if
/// as many as possible are being decoded at once.
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

/// Width and height, from the head of the file alone, within [`MAX_SIDE`] and [`MAX_IMAGE`].
pub(crate) fn size(bytes: &[u8]) -> Result<[u32; 2], String> {
    let (width, height) = reader(bytes)?.into_dimensions().map_err(|error| match error {
        ImageError::Limits(_) => format!("is too large: a side of 1 to {MAX_SIDE} texels is allowed"),
        other => other.to_string(),
    })?;
    if width == 0 || height == 0 {
        return Err(format!("has {width} × {height} texels"));
    }
    if u64::from(width) * u64::from(height) > MAX_IMAGE {
        return Err(format!(
            "has {width} × {height} texels; {MAX_IMAGE} are allowed in one image, such as 8192 × 8192"
        ));
    }
    Ok([width, height])
}

/// Decodes a PNG (any depth, palette, grey) or a JPEG.
///
/// Beside the file itself it takes the decoded codes (1 to 8 bytes a texel; a progressive JPEG 9 while it is being
/// decoded) and the texture's 8; the codes are gone before the pyramid is built, so 16 bytes a texel are the most.
pub(crate) fn decode(bytes: &[u8], reading: Reading) -> Result<Decoded, String> {
    let [width, height] = size(bytes)?;
    let image = reader(bytes)?.decode().map_err(|error| error.to_string())?;
    if [image.width(), image.height()] != [width, height] {
        return Err(format!("has {} × {} texels, not {width} × {height}", image.width(), image.height()));
    }
    let decoded = match image {
        DynamicImage::ImageLuma8(image) => rows::<_, 1>(image.into_raw(), [width, height], reading),
        DynamicImage::ImageLumaA8(image) => rows::<_, 2>(image.into_raw(), [width, height], reading),
        DynamicImage::ImageRgb8(image) => rows::<_, 3>(image.into_raw(), [width, height], reading),
        DynamicImage::ImageRgba8(image) => rows::<_, 4>(image.into_raw(), [width, height], reading),
        DynamicImage::ImageLuma16(image) => rows::<_, 1>(image.into_raw(), [width, height], reading),
        DynamicImage::ImageLumaA16(image) => rows::<_, 2>(image.into_raw(), [width, height], reading),
        DynamicImage::ImageRgb16(image) => rows::<_, 3>(image.into_raw(), [width, height], reading),
        DynamicImage::ImageRgba16(image) => rows::<_, 4>(image.into_raw(), [width, height], reading),
        // Neither PNG nor JPEG has others; converted, they would be right as well.
        other => rows::<_, 4>(other.into_rgba16().into_raw(), [width, height], reading),
    };
    decoded.ok_or_else(|| format!("has fewer codes than {width} × {height} texels need"))
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
    // 16-bit RGBA, and an eighth of it for the decoder's own rows and tables.
    limits.max_alloc = Some(9 * MAX_IMAGE);
    reader.limits(limits);
    Ok(reader)
}

/// A code of 8 or 16 bits.
trait Code: Copy + Into<u16> {
    /// The code of 1.
    const TOP: u16;
}

impl Code for u8 {
    const TOP: u16 = 255;
}

impl Code for u16 {
    const TOP: u16 = 65_535;
}

/// A texture of `codes`, N to a texel: grey, grey and alpha, RGB, or RGB and alpha. None if there are too few.
fn rows<C: Code, const N: usize>(
    codes: Vec<C>,
    [width, height]: [u32; 2],
    reading: Reading,
) -> Option<Decoded> {
    let columns = width as usize * N;
    if codes.len() < columns * height as usize {
        return None;
    }
    let share = |code: u16| f32::from(code) / f32::from(C::TOP);
    // A table of all codes: exact, and free of `powf` per texel.
    let table: Vec<f32> = (0..=C::TOP)
        .map(|code| match reading.encoding {
            Encoding::Srgb => decode_srgb(share(code)),
            Encoding::Linear => share(code),
        })
        .collect();
    let colour = |code: C| table[usize::from(code.into())];
    let texel = |code: [C; N]| {
        let [r, g, b] = if N < 3 { [code[0]; 3] } else { [code[0], code[1], code[2]] }.map(colour);
        let alpha = if N.is_multiple_of(2) && reading.alpha { share(code[N - 1].into()) } else { 1.0 };
        [r, g, b, alpha]
    };
    let mut least_alpha = 1.0f32;
    let least = &mut least_alpha;
    // The codes go into the function that reads them, and with it.
    let texture = Texture::from_rows(width, height, reading.wrap, move |y, row| {
        let (texels, _) = codes[y as usize * columns..][..columns].as_chunks();
        for (texel_of_row, code) in row.iter_mut().zip(texels) {
            *texel_of_row = texel(*code);
            *least = least.min(texel_of_row[3]);
        }
    })?;
    Some(Decoded { texture: Arc::new(texture), least_alpha })
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use image::DynamicImage as Image;
    use image::ImageBuffer;

    use super::*;

    fn kinds() -> [Image; 8] {
        // Codes of all sizes; the last of each texel, its alpha if it has any, is above one half.
        fn codes<C: Code>(per_texel: usize, of: impl Fn(u32) -> C) -> Vec<C> {
            let half = u32::from(C::TOP) / 2;
            let code = |i: usize| {
                let own = (i as u32 * 7919 + 13) % half;
                of(if (i + 1).is_multiple_of(per_texel) { own + half } else { own })
            };
            (0..6 * per_texel).map(code).collect()
        }
        let eight = |n: usize| codes(n, |code| code as u8);
        let sixteen = |n: usize| codes(n, |code| code as u16);
        [
            Image::ImageLuma8(ImageBuffer::from_raw(3, 2, eight(1)).unwrap()),
            Image::ImageLumaA8(ImageBuffer::from_raw(3, 2, eight(2)).unwrap()),
            Image::ImageRgb8(ImageBuffer::from_raw(3, 2, eight(3)).unwrap()),
            Image::ImageRgba8(ImageBuffer::from_raw(3, 2, eight(4)).unwrap()),
            Image::ImageLuma16(ImageBuffer::from_raw(3, 2, sixteen(1)).unwrap()),
            Image::ImageLumaA16(ImageBuffer::from_raw(3, 2, sixteen(2)).unwrap()),
            Image::ImageRgb16(ImageBuffer::from_raw(3, 2, sixteen(3)).unwrap()),
            Image::ImageRgba16(ImageBuffer::from_raw(3, 2, sixteen(4)).unwrap()),
        ]
    }

    /// The library's own conversion to 16-bit RGBA is the reference.
    #[test]
    fn every_kind_of_image_gives_its_texels() {
        for image in kinds() {
            let mut bytes = Cursor::new(Vec::new());
            image.write_to(&mut bytes, ImageFormat::Png).unwrap();
            let reading = Reading { encoding: Encoding::Linear, alpha: true, wrap: [Wrap::Clamp; 2] };
            let decoded = decode(bytes.get_ref(), reading).unwrap();
            let expected = image.to_rgba16();
            let mut least = 1.0f32;
            for (x, y, pixel) in expected.enumerate_pixels() {
                let [r, g, b, a] = pixel.0.map(|code| f32::from(code) / 65535.0);
                let at = Vec2::new((x as f32 + 0.5) / 3.0, (y as f32 + 0.5) / 2.0);
                let (colour, alpha) = decoded.texture.sample(at, 0.0);
                // Colour × alpha and alpha are rounded to ½/65535 each, then divided by an alpha of ½ at least; that
                // one third of f32 is not 1/3 moves the place by 2⁻²⁴, and so the rest.
                let bound = 2.1 / 65535.0;
                assert!(colour.abs_diff_eq(glam::Vec3::new(r, g, b), bound), "{:?} {x} {y}", image.color());
                assert!((alpha - a).abs() < bound);
                least = least.min(a);
            }
            // The same quotient of whole numbers; in 16 bits 257 times both.
            assert!((decoded.least_alpha - least).abs() <= f32::EPSILON);
        }
    }

    #[test]
    fn alpha_that_does_not_count_is_one() {
        let mut bytes = Cursor::new(Vec::new());
        kinds()[3].write_to(&mut bytes, ImageFormat::Png).unwrap();
        let reading = Reading { encoding: Encoding::Srgb, alpha: false, wrap: [Wrap::Repeat; 2] };
        let decoded = decode(bytes.get_ref(), reading).unwrap();
        assert_eq!((decoded.least_alpha, decoded.texture.alpha(Vec2::ZERO, 0.0)), (1.0, 1.0));
    }
}
