//! PNG: what a person looks at, by a stated exposure and tone curve.

use std::io::Cursor;

use glam::Vec3;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use light::colour::LUMINANCE;

use super::Picture;
use crate::args::Tone;

/// Which luminance is shown as mid grey, and how the rest follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposure {
    /// Luminance shown as 18 % of white \[cd/m²\].
    pub mid_grey: f32,
    /// Tone curve.
    pub tone: Tone,
}

/// Mid grey as a share of white: the photographer's grey card.
const GREY: f32 = 0.18;

impl Exposure {
    /// As asked, or so that the log-average luminance of the picture becomes mid grey.
    ///
    /// The darkest and the brightest 2 % do not vote: black holes, suns and lamps are not the subject.
    pub fn of(picture: &Picture, asked: Option<f32>, tone: Tone) -> Self {
        Self { mid_grey: asked.unwrap_or_else(|| log_average(&picture.luminance)), tone }
    }

    /// Display-linear colour within \[0, 1\].
    pub fn show(&self, rgb: Vec3) -> Vec3 {
        let scaled = into_gamut(rgb * (GREY / self.mid_grey));
        match self.tone {
            Tone::Linear => scaled.clamp(Vec3::ZERO, Vec3::ONE),
            Tone::Soft => soft(scaled),
        }
    }
}

fn log_average(luminance: &[f32]) -> f32 {
    let mut logs: Vec<f32> =
        luminance.iter().filter(|l| **l > 0.0 && l.is_finite()).map(|l| l.ln()).collect();
    if logs.is_empty() {
        return 1.0;
    }
    logs.sort_unstable_by(f32::total_cmp);
    let out = logs.len() / 50;
    let kept = &logs[out..logs.len() - out];
    let mean = kept.iter().map(|&l| f64::from(l)).sum::<f64>() / kept.len() as f64;
    (mean.exp() as f32).max(f32::MIN_POSITIVE)
}

/// Colours outside the gamut are moved towards grey of the same luminance until no channel is negative.
fn into_gamut(rgb: Vec3) -> Vec3 {
    let least = rgb.min_element();
    if least >= 0.0 {
        return rgb;
    }
    let grey = rgb.dot(LUMINANCE).max(0.0);
    grey + (rgb - grey) * (grey / (grey - least))
}

/// Proportional up to `START` of white; what is brighter comes closer and closer to white and is bleached on
/// the way, as the eye and film see it (the shoulder of Khronos PBR Neutral, 2024, without its toe, which
/// would darken shadows).
///
///   p' = 1 − (1 − s)²/(p + 1 − 2s)   for the largest channel p > s = START: value and slope continue there
fn soft(rgb: Vec3) -> Vec3 {
    const START: f32 = 0.7;
    const BLEACH: f32 = 0.15;
    let peak = rgb.max_element();
    if peak <= START {
        return rgb.max(Vec3::ZERO);
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let bleached = 1.0 - 1.0 / (BLEACH * (peak - new_peak) + 1.0);
    (rgb * (new_peak / peak)).lerp(Vec3::splat(new_peak), bleached).clamp(Vec3::ZERO, Vec3::ONE)
}

/// sRGB-encoded bytes, three a pixel.
pub(super) fn bytes(colours: impl Iterator<Item = Vec3>) -> Vec<u8> {
    let encode = |share: f32| (light::colour::encode_srgb(share) * 255.0 + 0.5) as u8;
    colours.flat_map(|rgb| [encode(rgb.x), encode(rgb.y), encode(rgb.z)]).collect()
}

/// The bytes of a PNG of sRGB `bytes`.
pub(super) fn png(bytes: &[u8], width: usize, height: usize) -> Result<Vec<u8>, String> {
    let mut out = Cursor::new(Vec::new());
    PngEncoder::new(&mut out)
        .write_image(bytes, width as u32, height as u32, ExtendedColorType::Rgb8)
        .map_err(|error| error.to_string())?;
    Ok(out.into_inner())
}

/// The bytes of a PNG of the picture.
///
/// # Errors
/// What the encoder refuses, as text.
pub fn encode(picture: &Picture, exposure: &Exposure) -> Result<Vec<u8>, String> {
    let shown = bytes(picture.rgb.iter().map(|&rgb| exposure.show(rgb)));
    png(&shown, picture.width, picture.height)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mid_grey_is_shown_as_mid_grey_by_the_linear_curve() {
        let exposure = Exposure { mid_grey: 4000.0, tone: Tone::Linear };
        let shown = exposure.show(Vec3::splat(4000.0));
        // One multiplication and one division: two roundings.
        assert!((shown - GREY).abs().max_element() <= 4.0 * f32::EPSILON * GREY);
    }

    #[test]
    fn curves_rise_and_stay_within_white() {
        for tone in [Tone::Linear, Tone::Soft] {
            let exposure = Exposure { mid_grey: 1.0, tone };
            let mut before = -1.0;
            for step in 0..2000 {
                let shown = exposure.show(Vec3::splat(step as f32 * 0.05)).x;
                assert!((0.0..=1.0).contains(&shown) && shown >= before, "{tone:?} at {step}: {shown}");
                before = shown;
            }
        }
    }

    #[test]
    fn out_of_gamut_keeps_its_luminance() {
        let rgb = Vec3::new(-0.2, 0.5, 0.1);
        let y = LUMINANCE;
        let moved = into_gamut(rgb);
        assert!(moved.min_element() >= -f32::EPSILON);
        // Four products and sums of numbers below 1.
        assert!((moved.dot(y) - rgb.dot(y)).abs() <= 8.0 * f32::EPSILON);
    }
}
