//! A tree seen from infinitely far, by a depth buffer.

use std::ops::Range;

use glam::{DVec2, Vec2, Vec3};
use light::colour::encode_srgb;

use crate::region::random;
use crate::sheet::Sheet;
use crate::tree_mesh::{Part, TreeMesh};

/// A picture plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Unit vector along rows.
    pub(super) right: Vec3,
    /// Along columns.
    pub(super) down: Vec3,
    /// The picture's first corner, along both \[m\].
    pub(super) corner: Vec2,
    /// Size of a texel \[m\].
    pub(super) texel: Vec2,
    /// Texels in a row, and rows.
    pub(super) size: [u32; 2],
}

/// What is nearest at a sample.
#[derive(Clone, Copy)]
struct Sample {
    nearness: f32,
    colour: Vec3,
    leaf: bool,
}

/// Samples that are held at once, of 20 bytes: pictures are made in bands of so many.
const HELD: usize = 1 << 21;

/// The picture of what lies between two heights \[m\], `samples`² samples a texel; none for a frame without texels.
///
/// Takes 40 MiB besides the picture, however fine it is (a row of texels, if that is more): all triangles are looked at for
/// each band.
pub(super) fn raster(tree: &TreeMesh, frame: &Frame, samples: u32, heights: [f32; 2]) -> Option<Sheet> {
    in_bands(tree, frame, samples, (heights, HELD))
}

fn in_bands(
    tree: &TreeMesh,
    frame: &Frame,
    samples: u32,
    (heights, held): ([f32; 2], usize),
) -> Option<Sheet> {
    let row = frame.size[0] as usize * samples as usize;
    let rows = frame.size[1] as usize;
    let high = (held / (row * samples as usize).max(1)).clamp(1, rows.max(1));
    let (mut texels, mut leaves) = (Vec::new(), Vec::new());
    let nothing = Sample { nearness: f32::NEG_INFINITY, colour: Vec3::ZERO, leaf: false };
    let mut buffer = vec![nothing; row * high.min(rows) * samples as usize];
    for first in (0..rows).step_by(high) {
        let last = (first + high).min(rows);
        let lines = first * samples as usize..last * samples as usize;
        let buffer = &mut buffer[..row * lines.len()];
        buffer.fill(nothing);
        draw(tree, (frame, samples), heights, (buffer, &lines));
        resolve(buffer, frame.size[0] as usize, samples as usize, (&mut texels, &mut leaves));
    }
    Sheet::new(frame.size[0], frame.size[1], &texels, &leaves)
}

/// What is nearest at the samples of some lines of the picture.
fn draw(
    tree: &TreeMesh,
    (frame, samples): (&Frame, u32),
    heights: [f32; 2],
    (buffer, lines): (&mut [Sample], &Range<usize>),
) {
    let width = frame.size[0] as usize * samples as usize;
    for part in &tree.parts {
        for corners in &part.mesh.triangles {
            let Some(face) = face(part, *corners, frame, samples).filter(|face| face.reaches(heights)) else {
                continue;
            };
            face.fill(width, lines, |x, y, weights| {
                let position = mix(face.positions, weights);
                if position.y < 0.0 || !(heights[0]..heights[1]).contains(&position.y) {
                    return;
                }
                let slot = &mut buffer[(y - lines.start) * width + x];
                let nearness = position.dot(face.toward);
                if nearness > slot.nearness && there(part, *corners, weights, (x, y)) {
                    *slot = Sample { nearness, colour: colour(part, *corners, weights), leaf: part.leaf };
                }
            });
        }
    }
}

/// Means over texels, after those that there are.
fn resolve(
    buffer: &[Sample],
    width: usize,
    samples: usize,
    (texels, leaves): (&mut Vec<[u8; 4]>, &mut Vec<u8>),
) {
    let row = width * samples;
    for i in 0..buffer.len() / (samples * samples) {
        let (x, y) = (i % width * samples, i / width * samples);
        let (mut count, mut leafy, mut colour) = (0, 0, Vec3::ZERO);
        for sample in (0..samples).flat_map(|v| &buffer[(y + v) * row + x..][..samples]) {
            if sample.nearness > f32::NEG_INFINITY {
                count += 1;
                leafy += usize::from(sample.leaf);
                colour += sample.colour;
            }
        }
        let code = |share: f32| (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let [r, g, b] = (colour / count.max(1) as f32).to_array().map(|share| code(encode_srgb(share)));
        texels.push([r, g, b, code(count as f32 / (samples * samples) as f32)]);
        leaves.push(if 2 * leafy >= count { 255 } else { 0 });
    }
}

/// A triangle on the picture.
struct Face {
    positions: [Vec3; 3],
    /// In samples, f64: edges shared by two triangles are the same numbers for both.
    at: [DVec2; 3],
    toward: Vec3,
}

fn face(part: &Part, corners: [u32; 3], frame: &Frame, samples: u32) -> Option<Face> {
    let [a, b, c] = corners.map(|i| part.mesh.positions.get(i as usize).copied());
    let positions = [a?, b?, c?];
    let per_metre = Vec2::splat(samples as f32) / frame.texel;
    let at = positions
        .map(|p| ((Vec2::new(p.dot(frame.right), p.dot(frame.down)) - frame.corner) * per_metre).as_dvec2());
    Some(Face { positions, at, toward: frame.down.cross(frame.right) })
}

impl Face {
    /// Whether some of it lies between two heights.
    fn reaches(&self, [low, high]: [f32; 2]) -> bool {
        let heights = self.positions.map(|position| position.y);
        heights.iter().any(|y| *y >= low) && heights.iter().any(|y| *y < high)
    }

    /// Samples of some lines whose centres lie inside, with their barycentric weights.
    fn fill(&self, width: usize, lines: &Range<usize>, mut receive: impl FnMut(usize, usize, [f32; 3])) {
        let [a, b, c] = self.at;
        let area = (b - a).perp_dot(c - a);
        if area == 0.0 {
            return;
        }
        let low = a.min(b).min(c) - 0.5;
        let high = a.max(b).max(c) + 0.5;
        let range = |low: f64, high: f64, within: &Range<usize>| {
            let [from, to] = [low, high].map(|end| end.max(0.0) as usize);
            from.max(within.start)..to.min(within.end)
        };
        for y in range(low.y, high.y, lines) {
            for x in range(low.x, high.x, &(0..width)) {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let weights = [(b - p).perp_dot(c - p), (c - p).perp_dot(a - p), (a - p).perp_dot(b - p)]
                    .map(|w| w / area);
                if weights.iter().all(|w| *w >= 0.0) {
                    receive(x, y, weights.map(|w| w as f32));
                }
            }
        }
    }
}

fn mix(of: [Vec3; 3], weights: [f32; 3]) -> Vec3 {
    of[0] * weights[0] + of[1] * weights[1] + of[2] * weights[2]
}

fn uv(part: &Part, corners: [u32; 3], weights: [f32; 3]) -> Vec2 {
    let at = |i: usize| part.mesh.uvs.get(corners[i] as usize).copied().unwrap_or_default() * weights[i];
    at(0) + at(1) + at(2)
}

/// Whether a face is there at a sample: half-transparent ones are there at as many samples.
fn there(part: &Part, corners: [u32; 3], weights: [f32; 3], (x, y): (usize, usize)) -> bool {
    let Some(opacity) = &part.mesh.opacity else { return true };
    let seed = (x as u32).wrapping_mul(0x9E37_79B9) ^ (y as u32).rotate_left(16) ^ corners[0];
    random(seed, 0) < opacity.at(uv(part, corners, weights), 0.0)
}

fn colour(part: &Part, corners: [u32; 3], weights: [f32; 3]) -> Vec3 {
    let vertex = |i: usize| part.mesh.colours.get(corners[i] as usize).copied().unwrap_or(Vec3::ONE);
    let texture =
        part.texture.as_ref().map_or(Vec3::ONE, |texture| texture.sample(uv(part, corners, weights), 0.0).0);
    part.colour * mix([vertex(0), vertex(1), vertex(2)], weights) * texture
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grow::{Form, Growth, grow};

    #[test]
    fn bands_make_the_picture_that_one_makes() {
        let tree = grow(&Growth { leaves: 300, ..Growth::usual(Form::Spreading, 9.0, 1) }).unwrap();
        let frame = Frame {
            right: Vec3::X,
            down: Vec3::NEG_Y,
            corner: Vec2::new(-5.0, -9.0),
            texel: Vec2::splat(9.0 / 61.0),
            size: [67, 61],
        };
        let picture = |held: usize| {
            let sheet = in_bands(&tree, &frame, 3, ([f32::NEG_INFINITY, f32::INFINITY], held)).unwrap();
            (sheet.texels(), sheet.leaves().to_vec())
        };
        let whole = picture(usize::MAX);
        assert!(whole.0.iter().any(|texel| texel[3] > 0));
        // Rows of 67 · 9 samples: single ones, five, and all but one.
        for held in [1, 67 * 9 * 5, 67 * 9 * 60] {
            assert!(picture(held) == whole, "{held}");
        }
    }
}
