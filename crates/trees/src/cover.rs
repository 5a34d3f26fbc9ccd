//! Alpha alone, small enough to stay in a processor's near memory: what shadow rays ask for, many times as often as the eye.

use glam::Vec2;

/// A pyramid of alphas of one byte a texel, filtered trilinearly; beyond its edges it is clear.
///
/// Each level halves the one before and covers as many texels of the finest as two to the power of its number, whatever the size.
#[derive(Clone, Debug)]
pub(crate) struct Cover {
    levels: Vec<Level>,
}

#[derive(Clone, Debug)]
struct Level {
    /// Texels in a row, with a clear one at either end.
    stride: usize,
    /// Rows with a clear one before the first and after the last.
    alphas: Vec<u8>,
}

impl Level {
    fn new([width, height]: [u32; 2], alpha: impl Fn(u32, u32) -> u8) -> Self {
        let stride = width as usize + 2;
        let mut alphas = vec![0; stride * (height as usize + 2)];
        for y in 0..height {
            for x in 0..width {
                alphas[(y as usize + 1) * stride + x as usize + 1] = alpha(x, y);
            }
        }
        Self { stride, alphas }
    }

    /// Between the four texels around a point, in texels from the corner.
    fn at(&self, at: Vec2) -> f32 {
        let corner = at + 0.5;
        let (x, y) = (corner.x as usize, corner.y as usize);
        let share = corner - Vec2::new(x as f32, y as f32);
        let first = y * self.stride + x;
        let texel = |i: usize| self.alphas.get(i).map_or(0.0, |alpha| f32::from(*alpha));
        let [a, b] = [texel(first), texel(first + 1)];
        let [c, d] = [texel(first + self.stride), texel(first + self.stride + 1)];
        let (top, bottom) = (a + share.x * (b - a), c + share.x * (d - c));
        (top + share.y * (bottom - top)) * (1.0 / 255.0)
    }
}

impl Cover {
    /// From alphas row by row, `width` in each.
    pub(crate) fn new(width: u32, alphas: &[u8]) -> Self {
        let width = width.max(1);
        let mut size = [width, alphas.len() as u32 / width];
        let mut levels = vec![Level::new(size, |x, y| alphas[(y * width + x) as usize])];
        while size.iter().any(|side| *side > 1) {
            let (finer, old) = (&levels[levels.len() - 1], size);
            size = size.map(|side| side.div_ceil(2));
            // Those beyond an odd edge are clear.
            let at = |x: u32, y: u32| finer.alphas[(y as usize + 1) * finer.stride + x as usize + 1];
            let sum = |x: u32, y: u32| {
                let pairs = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, k)| (2 * x + i, 2 * y + k));
                pairs
                    .into_iter()
                    .filter(|(x, y)| *x < old[0] && *y < old[1])
                    .map(|(x, y)| u32::from(at(x, y)))
                    .sum::<u32>()
            };
            levels.push(Level::new(size, |x, y| ((sum(x, y) + 2) / 4) as u8));
        }
        Self { levels }
    }

    /// Alpha at a point in texels of the finest level from the corner, ≥ 0, averaged over `texels` of them.
    pub(crate) fn alpha(&self, at: Vec2, texels: f32) -> f32 {
        let level = if texels > 1.0 { texels.log2() } else { 0.0 };
        let top = self.levels.len() - 1;
        let fine = (level as usize).min(top);
        // 2^−fine, exactly.
        let shrink = |level: usize| f32::from_bits((127 - level.min(126) as u32) << 23);
        let near = self.levels[fine].at(at * shrink(fine));
        let share = level - fine as f32;
        if fine == top || share <= 0.0 {
            return near;
        }
        near + share * (self.levels[fine + 1].at(at * shrink(fine + 1)) - near)
    }

    pub(crate) fn bytes(&self) -> usize {
        self.levels.iter().map(|level| level.alphas.len()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_texels_it_is_in_between_and_clear_beyond() {
        let cover = Cover::new(3, &[255, 0, 0, 0, 0, 255]);
        assert_eq!(cover.alpha(Vec2::new(0.5, 0.5), 0.0), 1.0);
        assert_eq!(cover.alpha(Vec2::new(1.0, 0.5), 0.0), 0.5);
        assert_eq!(cover.alpha(Vec2::new(0.0, 0.5), 0.0), 0.5);
        assert_eq!(cover.alpha(Vec2::new(2.5, 1.5), 1.0), 1.0);
    }

    #[test]
    fn coarse_levels_keep_what_is_covered() {
        // What an odd size leaves over counts by what of it there is.
        let (width, height) = (37u32, 21u32);
        let alphas: Vec<u8> =
            (0..width * height).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        let cover = Cover::new(width, &alphas);
        let whole: u32 = alphas.iter().map(|alpha| u32::from(*alpha)).sum();
        for (n, level) in cover.levels.iter().enumerate() {
            let sum: u32 = level.alphas.iter().map(|alpha| u32::from(*alpha)).sum();
            let texels = 4f64.powi(n as i32);
            // Rounded to a half of 255 steps on each level, by whom it goes up or down.
            let off = 0.5 * level.alphas.len() as f64 * texels * (n as f64).min(1.0);
            assert!((f64::from(sum) * texels - f64::from(whole)).abs() <= off, "{n}");
        }
    }

    #[test]
    fn nothing_jumps_from_level_to_level() {
        let alphas: Vec<u8> = (0..64 * 64u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        let cover = Cover::new(64, &alphas);
        for texels in [2.0f32, 4.0, 8.0] {
            let [below, above] = [0.9999, 1.0001].map(|by| cover.alpha(Vec2::new(20.3, 31.7), texels * by));
            // A share of 1.5e-4 of a level's step of at most 1.
            assert!((below - above).abs() < 5e-4, "{texels}: {below} {above}");
        }
    }
}
