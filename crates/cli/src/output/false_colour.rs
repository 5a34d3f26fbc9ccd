//! Luminance in false colour, with isolines and a legend in cd/m².

use font8x8::{BASIC_FONTS, UnicodeFonts};

use super::{Picture, png_file};
use crate::args::Span;

/// Which luminances the palette spans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// cd/m² of the palette's dark end.
    pub low: f32,
    /// cd/m² of its bright end.
    pub high: f32,
    /// Equal ratios have equal steps; otherwise equal differences.
    pub logarithmic: bool,
}

/// Steps of the legend, which are the isolines of the picture.
const STEPS: usize = 8;
/// Pixels: width of the legend, height of its characters.
const LEGEND: usize = 120;
const GLYPH: usize = 8;

impl Scale {
    /// As asked, or from the 1st to the 99th percentile of the picture.
    pub fn of(picture: &Picture, asked: Span, linear: bool) -> Self {
        let (low, high) = match asked {
            Span::Fixed(low, high) => (low, high),
            Span::Auto => percentiles(&picture.luminance),
        };
        // A logarithmic scale has no zero: four decades are more than a picture needs.
        let low = if linear { low } else { low.max(high * 1e-4) };
        Self { low, high, logarithmic: !linear }
    }

    /// Where on the palette `luminance` lies, within \[0, 1\].
    pub fn share(&self, luminance: f32) -> f32 {
        let share = if self.logarithmic {
            (luminance / self.low).ln() / (self.high / self.low).ln()
        } else {
            (luminance - self.low) / (self.high - self.low)
        };
        if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) }
    }

    /// The luminance at `share` of the palette \[cd/m²\].
    pub fn luminance(&self, share: f32) -> f32 {
        if self.logarithmic {
            self.low * (self.high / self.low).powf(share)
        } else {
            self.low + (self.high - self.low) * share
        }
    }
}

fn percentiles(luminance: &[f32]) -> (f32, f32) {
    let mut sorted: Vec<f32> = luminance.iter().copied().filter(|l| l.is_finite()).collect();
    sorted.sort_unstable_by(f32::total_cmp);
    let at =
        |share: f64| sorted.get((share * (sorted.len().max(1) - 1) as f64) as usize).copied().unwrap_or(0.0);
    let (low, high) = (at(0.01).max(0.0), at(0.99));
    if high > low { (low, high) } else { (0.0, high.max(1.0)) }
}

fn palette(share: f32) -> [u8; 3] {
    let c = colorous::VIRIDIS.eval_continuous(f64::from(share));
    [c.r, c.g, c.b]
}

/// The bytes of a PNG: the picture in false colour with isolines, the legend to its right below its `unit` (ASCII).
///
/// # Errors
/// What the encoder refuses, as text.
pub fn draw(picture: &Picture, scale: &Scale, unit: &str) -> Result<Vec<u8>, String> {
    let (width, height) = (picture.width + LEGEND, picture.height);
    let mut canvas = vec![[24u8; 3]; width * height];
    let step = |x: usize, y: usize| {
        (scale.share(picture.luminance[y * picture.width + x]) * STEPS as f32).floor() as i32
    };
    for y in 0..height {
        for x in 0..picture.width {
            let own = step(x, y);
            let crossed =
                (x + 1 < picture.width && step(x + 1, y) != own) || (y + 1 < height && step(x, y + 1) != own);
            let colour = palette(scale.share(picture.luminance[y * picture.width + x]));
            canvas[y * width + x] = if crossed { colour.map(|c| c / 3) } else { colour };
        }
    }
    legend(&mut canvas, [width, height], picture.width, scale, unit);
    png_file::png(canvas.as_flattened(), width, height)
}

fn legend(canvas: &mut [[u8; 3]], [width, height]: [usize; 2], left: usize, scale: &Scale, unit: &str) {
    let (top, bottom) = (3 * GLYPH, height.saturating_sub(2 * GLYPH));
    for y in top..bottom {
        let share = 1.0 - (y - top) as f32 / (bottom - top).max(1) as f32;
        for x in left + GLYPH..left + 3 * GLYPH {
            canvas[y * width + x] = palette(share);
        }
    }
    text(canvas, width, height, left + GLYPH, GLYPH, unit);
    // Small pictures have room for few numbers.
    let room = bottom.saturating_sub(top);
    let fits = |every: &usize| STEPS.is_multiple_of(*every) && room * every / STEPS > GLYPH;
    let every = (1..STEPS).find(fits).unwrap_or(STEPS);
    for i in (0..=STEPS).step_by(every) {
        let share = i as f32 / STEPS as f32;
        let y = bottom as f32 - share * room as f32;
        let label = number(scale.luminance(share));
        text(canvas, width, height, left + 4 * GLYPH, (y as usize).saturating_sub(GLYPH / 2), &label);
    }
}

/// Three significant digits.
fn number(value: f32) -> String {
    let digits = if value > 0.0 { 2 - value.log10().floor() as i32 } else { 0 };
    format!("{value:.*}", digits.clamp(0, 6) as usize)
}

fn text(canvas: &mut [[u8; 3]], width: usize, height: usize, left: usize, top: usize, text: &str) {
    for (i, character) in text.chars().enumerate() {
        let Some(glyph) = BASIC_FONTS.get(character) else { continue };
        for (dy, bits) in glyph.into_iter().enumerate() {
            for dx in (0..GLYPH).filter(|dx| bits & (1 << dx) != 0) {
                let (x, y) = (left + i * GLYPH + dx, top + dy);
                if x < width && y < height {
                    canvas[y * width + x] = [235; 3];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legend_and_picture_speak_of_the_same_luminance() {
        for logarithmic in [true, false] {
            let scale = Scale { low: 2.0, high: 2000.0, logarithmic };
            for i in 0..=STEPS {
                let share = i as f32 / STEPS as f32;
                // exp and ln each cost an ulp of their argument (ln 1000 ≈ 7).
                assert!((scale.share(scale.luminance(share)) - share).abs() < 16.0 * f32::EPSILON);
            }
        }
    }

    #[test]
    fn odd_values_have_a_place() {
        let scale = Scale { low: 1.0, high: 10.0, logarithmic: true };
        for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!((0.0..=1.0).contains(&scale.share(value)));
        }
    }
}
