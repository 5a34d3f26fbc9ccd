//! A tree seen from infinitely far, by a depth buffer.

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

/// The picture of what lies between two heights \[m\], `samples`² samples a texel; none for a frame without texels.
pub(super) fn raster(tree: &TreeMesh, frame: &Frame, samples: u32, heights: [f32; 2]) -> Option<Sheet> {
    let nothing = Sample { nearness: f32::NEG_INFINITY, colour: Vec3::ZERO, leaf: false };
    let [width, height] = frame.size.map(|count| (count * samples) as usize);
    let mut buffer = vec![nothing; width * height];
    for part in &tree.parts {
        for corners in &part.mesh.triangles {
            let Some(face) = face(part, *corners, frame, samples).filter(|face| face.reaches(heights)) else {
                continue;
            };
            face.fill([width, height], |x, y, weights| {
                let position = mix(face.positions, weights);
                if position.y < 0.0 || !(heights[0]..heights[1]).contains(&position.y) {
                    return;
                }
                let slot = &mut buffer[y * width + x];
                let nearness = position.dot(face.toward);
                if nearness > slot.nearness && there(part, *corners, weights, (x, y)) {
                    *slot = Sample { nearness, colour: colour(part, *corners, weights), leaf: part.leaf };
                }
            });
        }
    }
    resolve(&buffer, frame.size, samples as usize)
}

/// Means over texels.
fn resolve(buffer: &[Sample], [width, height]: [u32; 2], samples: usize) -> Option<Sheet> {
    let row = width as usize * samples;
    let (mut texels, mut leaves) = (Vec::new(), Vec::new());
    for i in 0..width as usize * height as usize {
        let (x, y) = (i % width as usize * samples, i / width as usize * samples);
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
    Sheet::new(width, height, &texels, &leaves)
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

    /// Samples whose centres lie inside, with their barycentric weights.
    fn fill(&self, [width, height]: [usize; 2], mut receive: impl FnMut(usize, usize, [f32; 3])) {
        let [a, b, c] = self.at;
        let area = (b - a).perp_dot(c - a);
        if area == 0.0 {
            return;
        }
        let low = a.min(b).min(c) - 0.5;
        let high = a.max(b).max(c) + 0.5;
        let range = |low: f64, high: f64, count: usize| {
            (low.max(0.0) as usize)..(high.min(count as f64).max(0.0) as usize)
        };
        for y in range(low.y, high.y, height) {
            for x in range(low.x, high.x, width) {
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
