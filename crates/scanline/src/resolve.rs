//! From the spans of a row's lines to pieces of its pixels.

use std::ops::Range;

use glam::DVec2;
use light::{Hit, Piece, Ray};

use crate::area::{self, Area};
use crate::borders::Border;
use crate::pixel::{Cover, Pixel};
use crate::scanline::Line;
use crate::segment::Segment;
use crate::{Scanline, Shading, place};

/// Walks one line of a row from pixel to pixel.
pub(crate) struct Walk<'a> {
    pub(crate) line: &'a Line,
    pub(crate) y: f64,
    weight: f64,
    /// First opaque span that ends right of the pixel's left border.
    pub(crate) opaque: usize,
    /// First veil that has not begun yet.
    veil: usize,
    /// Veils that have begun and not ended.
    begun: Vec<Segment>,
}

impl<'a> Walk<'a> {
    /// From screen x `left` on, along a line at `y` that weighs `weight`.
    pub(crate) fn new(line: &'a Line, y: f64, weight: f64, left: f64) -> Self {
        Self { line, y, weight, opaque: line.first_right_of(left), veil: 0, begun: Vec::new() }
    }

    /// Adds what this line shows of pixel `column`.
    pub(crate) fn add(&mut self, column: u32, pixel: &mut Pixel, merge: bool) {
        let (left, right) = (f64::from(column), f64::from(column + 1));
        let spans = &self.line.opaque;
        while self.opaque < spans.len() && self.line.right(self.opaque) <= left {
            self.opaque += 1;
        }
        let veils = &self.line.veils;
        if self.veil < veils.len() || !self.begun.is_empty() {
            self.begun.retain(|veil| veil.x1 > left);
            while self.veil < veils.len() && veils[self.veil].x0 < right {
                if veils[self.veil].x1 > left {
                    self.begun.push(veils[self.veil]);
                }
                self.veil += 1;
            }
        }
        if self.begun.is_empty() && !self.line.sides.is_empty() {
            return self.add_leaning(left, pixel, merge);
        }
        let here = &spans[self.opaque..];
        let here = &here[..here.iter().position(|span| span.x0 >= right).unwrap_or(here.len())];
        if self.begun.is_empty() {
            for span in here {
                let (l, r) = (span.x0.max(left), span.x1.min(right));
                pixel.opaque(span, (l, r), self.y, self.weight, merge);
            }
        } else {
            pixel.layered(here, &self.begun, (left, right), (self.y, self.weight), merge);
        }
    }

    /// The same where the borders lean and no veil is.
    fn add_leaning(&self, left: f64, pixel: &mut Pixel, merge: bool) {
        let spans = self.line.opaque[self.opaque..].iter().zip(&self.line.sides[self.opaque..]);
        // What lies left of the border that was met last: most spans begin where another ends.
        let mut last = (Border::default(), Area::default());
        for (span, sides) in spans {
            if sides.left[0].min(sides.left[1]) >= left + 1.0 {
                break;
            }
            if last.0 != sides.left {
                last = (sides.left, area::left_of(sides.left, left, self.weight));
            }
            let before = last.1;
            last = (sides.right, area::left_of(sides.right, left, self.weight));
            pixel.leaning(span, last.1 - before, (left, self.y), merge);
        }
    }
}

impl Scanline {
    /// The pieces of a row in `columns`; `lines` are the row's, from the top.
    pub(crate) fn resolve<'a>(
        &self,
        row: u32,
        columns: Range<u32>,
        lines: impl Iterator<Item = &'a Line>,
        pixel: &mut Pixel,
        pieces: &mut Vec<Piece>,
    ) {
        let left = f64::from(columns.start + self.margin);
        let mut walks: Vec<_> = self
            .grid
            .of_row(row)
            .zip(lines)
            .map(|(number, line)| Walk::new(line, self.grid.y(number), self.grid.weight(row, number), left))
            .collect();
        let merge = self.knobs.shading == Shading::PerPixel;
        let mut made = Vec::new();
        for column in columns {
            pixel.clear();
            walks.iter_mut().for_each(|walk| walk.add(column + self.margin, pixel, merge));
            made.clear();
            pixel.share_out(|cover| {
                let hit = self.hit(row, column, cover);
                cover.hit = made.len() as u32;
                made.push(hit);
                self.opacity(&hit)
            });
            let first = pieces.len();
            for cover in pixel.covers.iter().filter(|cover| cover.share > 0.0) {
                let hit = made.get(cover.hit as usize).copied();
                let hit = hit.unwrap_or_else(|| {
                    let within = place::within(&walks, pixel, cover, column + self.margin);
                    self.hit(row, column, &within)
                });
                let known = pixel.table.known(cover.known);
                pieces.push(Piece { column, share: cover.share as f32, hit, known, samples: 1 });
            }
            at_most_one(&mut pieces[first..]);
        }
    }

    pub(crate) fn opacity(&self, hit: &Hit) -> f64 {
        let mesh = self.geometry.instances[hit.instance as usize].mesh;
        let opacity = self.geometry.meshes[mesh as usize].opacity.as_ref();
        opacity.map_or(1.0, |opacity| f64::from(opacity.at(hit.uv, hit.uv_width())))
    }

    /// The hit at the centroid of what shows of a face. It lies in the face, because all that shows does
    /// and a face is convex.
    pub(crate) fn hit(&self, row: u32, column: u32, cover: &Cover) -> Hit {
        let (instance, triangle) = self.face(cover.face);
        let at = DVec2::from_array(cover.moment) / cover.area;
        let (origin, direction) = self.view.line(at);
        let corners = self.geometry.triangle(instance, triangle);
        // A face seen edge-on, which has no area to speak of, is shaded at its middle.
        let weights = corners.meet(origin, direction).unwrap_or(DVec2::splat(1.0 / 3.0));
        let point = corners.0[0]
            + (corners.0[1] - corners.0[0]) * weights.x
            + (corners.0[2] - corners.0[0]) * weights.y;
        let depth = -self.view.world_from_view.z_axis.dot(point - self.view.eye);
        let pixel_width = self.view.pixel_width(depth.max(self.view.near)) as f32;
        let ray = Ray::new(origin.as_vec3(), direction.as_vec3());
        let mut hit = self.geometry.hit_on(&corners, [instance, triangle], weights, &ray, pixel_width);
        hit.place.seed = seed(column, row, cover.face);
        hit
    }
}

/// Takes what rounding to f32 added beyond 1 from the largest share.
pub(crate) fn at_most_one(pieces: &mut [Piece]) {
    let sum: f64 = pieces.iter().map(|piece| f64::from(piece.share)).sum();
    if sum > 1.0
        && let Some(largest) = pieces.iter_mut().max_by(|a, b| a.share.total_cmp(&b.share))
    {
        let left = f64::from(largest.share) - (sum - 1.0);
        let rounded = left as f32;
        largest.share = if f64::from(rounded) > left { rounded.next_down() } else { rounded };
    }
}

/// A well mixed number for a face in a pixel (the finaliser of SplitMix64).
pub(crate) fn seed(column: u32, row: u32, face: u32) -> u32 {
    let mix = |value: u64| {
        let value = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let value = (value ^ (value >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        value ^ (value >> 31)
    };
    let pixel = (u64::from(row) << 32) | u64::from(column);
    (mix(mix(pixel.wrapping_add(0x9e37_79b9_7f4a_7c15)) ^ u64::from(face)) >> 32) as u32
}
