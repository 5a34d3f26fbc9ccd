//! Where on its image a texture is looked up: which set of coordinates, transformed how.

use glam::{Affine2, Mat2, Vec2};
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::{material, texture};
use serde::Deserialize;

use super::fault::{Checked, Fault};

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TextureUse {
    pub(super) texture: usize,
    pub(super) set: u32,
    pub(super) transform: Affine2,
}

impl TextureUse {
    pub(super) fn new(info: &texture::Info, place: &str) -> Checked<Self> {
        let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
        Self::transformed(info.index.value(), info.tex_coord, transform, place)
    }

    pub(super) fn of_normals(info: &material::NormalTexture, place: &str) -> Checked<Self> {
        let extension =
            info.extensions.as_ref().and_then(|extensions| extensions.others.get("KHR_texture_transform"));
        let transform = extension.map(TextureTransform::deserialize).transpose();
        let transform = transform.map_err(|error| Fault::new(place, error.to_string()))?;
        Self::transformed(info.index.value(), info.tex_coord, transform.as_ref(), place)
    }

    fn transformed(
        texture: usize,
        set: u32,
        transform: Option<&TextureTransform>,
        place: &str,
    ) -> Checked<Self> {
        let Some(t) = transform else { return Ok(Self { texture, set, transform: Affine2::IDENTITY }) };
        let transform = affine(t.offset.0, t.rotation.0, t.scale.0);
        if !transform.is_finite() {
            return Err(Fault::new(place, "KHR_texture_transform is not finite"));
        }
        Ok(Self { texture, set: t.tex_coord.unwrap_or(set), transform })
    }
}

/// Scale, then rotation, then offset. v points down, so that a turn which looks counter-clockwise is
/// u′ = u cos r + v sin r, v′ = −u sin r + v cos r: the extension's own example tells (its formula has the
/// other sign, which no viewer follows).
fn affine(offset: [f32; 2], rotation: f32, scale: [f32; 2]) -> Affine2 {
    let (sin, cos) = rotation.sin_cos();
    let turn = Mat2::from_cols(Vec2::new(cos, -sin), Vec2::new(sin, cos));
    Affine2::from_mat2_translation(
        turn * Mat2::from_diagonal(Vec2::from_array(scale)),
        Vec2::from_array(offset),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn example_of_the_extension_is_the_lower_left_quadrant_turned() {
        let transform = affine([0.0, 1.0], std::f32::consts::FRAC_PI_2, [0.5, 0.5]);
        for (uv, expected) in [((0.0, 0.0), (0.0, 1.0)), ((1.0, 0.0), (0.0, 0.5)), ((0.0, 1.0), (0.5, 1.0))] {
            let got = transform.transform_point2(uv.into());
            // cos of f32's π/2 is 4e-8 off zero; sums of numbers ≤ 1.
            assert!(got.abs_diff_eq(Vec2::from(expected), 4.0 * f32::EPSILON), "{uv:?} → {got}");
        }
    }
}
