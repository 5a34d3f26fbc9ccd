//! The picture on a plane: colour, alpha, and where there are leaves.

use glam::{Vec2, Vec3};
use light::colour::{decode_srgb, encode_srgb};
use light::{Texture, Wrap};

use crate::cover::Cover;

/// The picture on a plane of a tree: reflectance and alpha, filtered premultiplied; beyond its edges there is nothing.
///
/// Row 0 is at the top of a side view; in a view from above it is the far edge as one looks from the front.
#[derive(Clone, Debug)]
pub struct Sheet {
    texture: Texture,
    /// Its alpha once more, for shadow rays.
    cover: Cover,
    /// 255 where a texel shows leaves, 0 where it shows wood, row by row; empty: leaves everywhere.
    leaves: Vec<u8>,
}

impl Sheet {
    /// From sRGB colours (reflectances) with straight alpha, row by row from the top, and a mask of the same size: 255 where
    /// there are leaves, 0 where there is wood (empty: leaves everywhere). None where sizes do not fit or are 0.
    pub fn new(width: u32, height: u32, texels: &[[u8; 4]], leaves: &[u8]) -> Option<Self> {
        let count = (width as usize).checked_mul(height as usize)?;
        if texels.len() != count || !(leaves.is_empty() || leaves.len() == count) {
            return None;
        }
        let linear: [f32; 256] = std::array::from_fn(|code| decode_srgb(code as f32 / 255.0));
        let texture = Texture::from_rows(width, height, [Wrap::Clamp; 2], |y, row| {
            for (to, from) in row.iter_mut().zip(&texels[y as usize * width as usize..]) {
                let [r, g, b, a] = *from;
                *to = [
                    linear[usize::from(r)],
                    linear[usize::from(g)],
                    linear[usize::from(b)],
                    f32::from(a) / 255.0,
                ];
            }
        })?;
        let alphas: Vec<u8> = texels.iter().map(|texel| texel[3]).collect();
        Some(Self { texture, cover: Cover::new(width, &alphas), leaves: leaves.to_vec() })
    }

    /// Texels in a row and rows.
    pub fn size(&self) -> [u32; 2] {
        self.texture.size()
    }

    /// The picture as [`Self::new`] takes it; colours of nearly clear texels are coarser than they came.
    pub fn texels(&self) -> Vec<[u8; 4]> {
        let [width, height] = self.size();
        let code = |share: f32| (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let texel = |i: u32| {
            let at = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
            let (rgb, alpha) = self.texture.sample(at / Vec2::new(width as f32, height as f32), 0.0);
            let [r, g, b] = rgb.to_array().map(|share| code(encode_srgb(share)));
            [r, g, b, code(alpha)]
        };
        (0..width * height).map(texel).collect()
    }

    /// The mask of leaves as [`Self::new`] takes it.
    pub fn leaves(&self) -> &[u8] {
        &self.leaves
    }

    /// Bytes it takes in memory.
    pub fn bytes(&self) -> usize {
        // 8 bytes a texel, a third more for the pyramid.
        let [width, height] = self.size();
        width as usize * height as usize * 32 / 3 + self.cover.bytes() + self.leaves.len()
    }

    /// Linear colour and alpha at `uv`, averaged over `texels` texels; nothing beyond the edges.
    pub(crate) fn sample(&self, uv: Vec2, texels: f32) -> (Vec3, f32) {
        if !on(uv) {
            return (Vec3::ZERO, 0.0);
        }
        self.texture.sample(uv, self.width(texels))
    }

    /// Alpha alone.
    pub(crate) fn alpha(&self, uv: Vec2, texels: f32) -> f32 {
        let [width, height] = self.size();
        if on(uv) { self.cover.alpha(uv * Vec2::new(width as f32, height as f32), texels) } else { 0.0 }
    }

    /// True where there are leaves.
    pub(crate) fn leafy(&self, uv: Vec2) -> bool {
        let [width, height] = self.size();
        let index = |share: f32, count: u32| ((share * count as f32) as u32).min(count - 1) as usize;
        let at = index(uv.y, height) * width as usize + index(uv.x, width);
        self.leaves.get(at).is_none_or(|mask| *mask >= 128)
    }

    /// Mean linear colour of leaves, weighed with alpha; none where there are no leaves.
    pub(crate) fn mean_leaf(&self) -> Option<Vec3> {
        let (mut sum, mut weight) = (glam::DVec3::ZERO, 0.0f64);
        for (i, [r, g, b, a]) in self.texels().into_iter().enumerate() {
            if self.leaves.get(i).is_none_or(|mask| *mask >= 128) {
                let alpha = f64::from(a) / 255.0;
                let colour = Vec3::from([r, g, b].map(|code| decode_srgb(f32::from(code) / 255.0)));
                sum += colour.as_dvec3() * alpha;
                weight += alpha;
            }
        }
        (weight > 0.0).then(|| (sum / weight).as_vec3())
    }

    /// What [`Texture`] calls the width of `texels` texels.
    fn width(&self, texels: f32) -> f32 {
        let [width, height] = self.size();
        texels / width.max(height) as f32
    }
}

fn on(uv: Vec2) -> bool {
    uv.cmpge(Vec2::ZERO).all() && uv.cmple(Vec2::ONE).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_in_comes_out() {
        let texels: Vec<[u8; 4]> = (0..=255u8).map(|i| [i, 255 - i, i / 2, 255]).collect();
        let leaves: Vec<u8> = (0..=255).map(|i| if i % 3 == 0 { 255 } else { 0 }).collect();
        let sheet = Sheet::new(16, 16, &texels, &leaves).unwrap();
        assert_eq!(sheet.texels(), texels);
        assert_eq!(sheet.leaves(), leaves);
        assert!(sheet.leafy(Vec2::splat(0.01)) && !sheet.leafy(Vec2::new(0.1, 0.01)));
        assert!(Sheet::new(16, 15, &texels, &[]).is_none() && Sheet::new(0, 0, &[], &[]).is_none());
    }

    #[test]
    fn edges_get_no_rim() {
        // A white texel beside a clear black one: halfway the colour is white, only the alpha is half.
        let sheet = Sheet::new(2, 1, &[[255; 4], [0; 4]], &[]).unwrap();
        let (colour, alpha) = sheet.sample(Vec2::new(0.5, 0.5), 0.0);
        assert!((alpha - 0.5).abs() < 1e-4 && (colour - Vec3::ONE).length() < 1e-4);
        assert_eq!(sheet.sample(Vec2::new(1.01, 0.5), 0.0).1, 0.0);
    }
}
