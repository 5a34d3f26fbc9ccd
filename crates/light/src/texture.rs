//! An image on a surface.

use glam::{Vec2, Vec3};

/// What lies beyond the edge of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// It repeats.
    #[default]
    Repeat,
    /// It repeats, mirrored every other time.
    Mirror,
    /// Its last texel goes on.
    Clamp,
}

/// A pyramid of linear RGB and alpha, filtered trilinearly.
///
/// Colour is premultiplied by alpha while filtering, so that crown edges get no dark or bright rim.
#[derive(Clone, Debug)]
pub struct Texture {
    levels: Vec<Level>,
    wrap: [Wrap; 2],
}

#[derive(Clone, Debug)]
struct Level {
    width: u32,
    height: u32,
    /// Linear RGB premultiplied by alpha, and alpha, as shares of 65535, rows from v = 0.
    texels: Vec<[u16; 4]>,
}

impl Texture {
    /// From linear RGB and alpha, each within \[0, 1\], rows from v = 0 downwards (glTF's order);
    /// `texels.len()` must be `width · height`, both ≥ 1. None if not.
    pub fn new(width: u32, height: u32, texels: &[[f32; 4]], wrap: [Wrap; 2]) -> Option<Self> {
        let (columns, count) = (width as usize, (width as usize).checked_mul(height as usize)?);
        if texels.len() != count {
            return None;
        }
        Self::from_rows(width, height, wrap, |y, row| {
            row.copy_from_slice(&texels[y as usize * columns..][..columns]);
        })
    }

    /// The same without a copy of the whole image: `fill` is given every row once, from y = 0 on, as `width` texels
    /// of zeros or of the row before, to be overwritten; it is dropped, with what it holds, before the pyramid is built.
    ///
    /// None if `width` or `height` is 0. The texture has 8 bytes a texel, 10⅔ with its pyramid.
    pub fn from_rows(
        width: u32,
        height: u32,
        wrap: [Wrap; 2],
        mut fill: impl FnMut(u32, &mut [[f32; 4]]),
    ) -> Option<Self> {
        let count = (width as usize).checked_mul(height as usize)?;
        if count == 0 {
            return None;
        }
        let mut row = vec![[0.0; 4]; width as usize];
        let mut texels = Vec::with_capacity(count);
        for y in 0..height {
            fill(y, &mut row);
            texels.extend(row.iter().map(quantise));
        }
        drop(fill);
        let mut levels = vec![Level { width, height, texels }];
        while levels.last().is_some_and(|level| level.width > 1 || level.height > 1) {
            levels.push(levels[levels.len() - 1].halved());
        }
        Some(Self { levels, wrap })
    }

    /// Texels in a row and rows.
    pub fn size(&self) -> [u32; 2] {
        [self.levels[0].width, self.levels[0].height]
    }

    /// Linear RGB (not premultiplied) and alpha at `uv`, averaged over a footprint of `width` in texture
    /// coordinates (0 = between the four nearest texels only).
    pub fn sample(&self, uv: Vec2, width: f32) -> (Vec3, f32) {
        let [r, g, b, a] = self.filtered(uv, width);
        if a <= 0.0 {
            return (Vec3::ZERO, 0.0);
        }
        (Vec3::new(r, g, b) / a, a)
    }

    /// What lies beyond its edges, along u and v.
    pub fn wrap(&self) -> [Wrap; 2] {
        self.wrap
    }

    /// Alpha of each texel as a share of 65535, row by row.
    pub fn alphas(&self) -> impl Iterator<Item = u16> {
        self.levels[0].texels.iter().map(|texel| texel[3])
    }

    /// Alpha alone.
    pub fn alpha(&self, uv: Vec2, width: f32) -> f32 {
        let (fine, share) = self.level(width);
        let near = self.levels[fine].alpha(uv, self.wrap);
        if share == 0.0 {
            return near;
        }
        near + share * (self.levels[fine + 1].alpha(uv, self.wrap) - near)
    }

    fn filtered(&self, uv: Vec2, width: f32) -> [f32; 4] {
        let (fine, share) = self.level(width);
        let near = self.levels[fine].bilinear(uv, self.wrap);
        if share == 0.0 {
            return near;
        }
        let far = self.levels[fine + 1].bilinear(uv, self.wrap);
        std::array::from_fn(|i| near[i] + share * (far[i] - near[i]))
    }

    /// The level for a footprint of `width`, and the share of the next coarser one.
    fn level(&self, width: f32) -> (usize, f32) {
        let texels = width * self.levels[0].width.max(self.levels[0].height) as f32;
        let level = if texels > 1.0 { texels.log2() } else { 0.0 };
        let top = self.levels.len() - 1;
        let fine = (level as usize).min(top);
        (fine, if fine == top { 0.0 } else { (level - fine as f32).clamp(0.0, 1.0) })
    }
}

/// Linear RGB and alpha to premultiplied shares of 65535.
fn quantise(t: &[f32; 4]) -> [u16; 4] {
    let share = |value: f32| (value.clamp(0.0, 1.0) * 65535.0 + 0.5) as u16;
    [share(t[0] * t[3]), share(t[1] * t[3]), share(t[2] * t[3]), share(t[3])]
}

impl Level {
    /// The next coarser level: means over the texels each new one covers.
    fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        // Odd sizes: the new texel i covers old texels ⌊i W/w⌋ … ⌈(i+1) W/w⌉, each counted whole.
        let span = |i: u32, old: u32, new: u32| {
            let (i, old, new) = (u64::from(i), u64::from(old), u64::from(new));
            ((i * old / new) as u32)..(((i + 1) * old).div_ceil(new) as u32)
        };
        let mut texels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let (rows, columns) = (span(y, self.height, height), span(x, self.width, width));
                let count = (rows.len() * columns.len()) as u32;
                let mut sum = [0u32; 4];
                for row in rows {
                    for column in columns.clone() {
                        let texel = self.texels[row as usize * self.width as usize + column as usize];
                        (0..4).for_each(|i| sum[i] += u32::from(texel[i]));
                    }
                }
                texels.push(sum.map(|s| ((s + count / 2) / count) as u16));
            }
        }
        Self { width, height, texels }
    }

    /// Alpha alone of [`Self::bilinear`].
    fn alpha(&self, uv: Vec2, wrap: [Wrap; 2]) -> f32 {
        let (x0, x1, fx) = neighbours(uv.x, self.width, wrap[0]);
        let (y0, y1, fy) = neighbours(uv.y, self.height, wrap[1]);
        let texel = |x: u32, y: u32| f32::from(self.texels[y as usize * self.width as usize + x as usize][3]);
        let (a, b, c, d) = (texel(x0, y0), texel(x1, y0), texel(x0, y1), texel(x1, y1));
        let (top, bottom) = (a + fx * (b - a), c + fx * (d - c));
        (top + fy * (bottom - top)) / 65535.0
    }

    fn bilinear(&self, uv: Vec2, wrap: [Wrap; 2]) -> [f32; 4] {
        let (x0, x1, fx) = neighbours(uv.x, self.width, wrap[0]);
        let (y0, y1, fy) = neighbours(uv.y, self.height, wrap[1]);
        let texel =
            |x: u32, y: u32| self.texels[y as usize * self.width as usize + x as usize].map(f32::from);
        let (a, b, c, d) = (texel(x0, y0), texel(x1, y0), texel(x0, y1), texel(x1, y1));
        std::array::from_fn(|i| {
            let top = a[i] + fx * (b[i] - a[i]);
            let bottom = c[i] + fx * (d[i] - c[i]);
            (top + fy * (bottom - top)) / 65535.0
        })
    }
}

/// The two texels around coordinate `t` and the share of the second.
fn neighbours(t: f32, count: u32, wrap: Wrap) -> (u32, u32, f32) {
    let n = count as f32;
    let t = if t.is_finite() { t } else { 0.0 };
    let t = match wrap {
        Wrap::Repeat => t - t.floor(),
        Wrap::Mirror => 1.0 - (t * 0.5 - (t * 0.5).floor() - 0.5).abs() * 2.0,
        Wrap::Clamp => t.clamp(0.0, 1.0),
    };
    let position = t * n - 0.5;
    let first = position.floor();
    let share = position - first;
    let index = |i: f32| match wrap {
        Wrap::Repeat => (i as i64).rem_euclid(i64::from(count)) as u32,
        Wrap::Mirror | Wrap::Clamp => (i as i64).clamp(0, i64::from(count) - 1) as u32,
    };
    (index(first), index(first + 1.0), share)
}
