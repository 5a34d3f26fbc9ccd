//! What shows in a pixel, by rays: `visibility = rays`.

use std::{ops::Range, sync::Arc};

use glam::DVec2;
use light::{Hit, Known, Piece, See, View};

use crate::{
    query::{First, Met, weights},
    world::World,
};

/// Alpha faces behind one another are followed until less than this share is left \[1\]: below one step of a
/// 12-bit display, and what is left shows the background.
const LEAST_SHARE: f64 = 1.0 / 4096.0;

/// Stratified, jittered rays through each pixel.
///
/// The grid has as many columns as the largest divisor of the number of samples up to its root: squares
/// (4, 16, 64) are best; one sample goes through the pixel's centre. Jitter depends on the pixel and the sample
/// alone. Samples of one pixel that meet the same triangle become one piece, shaded at their mean.
#[derive(Clone, Debug)]
pub struct Rays {
    world: Arc<World>,
    view: View,
    samples: u32,
}

/// A triangle that some of a pixel's samples have met.
struct Part {
    met: Met,
    share: f64,
    /// Σ share · weights, Σ share · screen position, Σ share · depth.
    weights: DVec2,
    screen: DVec2,
    depth: f64,
}

impl Part {
    /// The part of the triangle that was met: an earlier sample's, or a new one.
    fn of(met: Met, parts: &mut Vec<Self>) -> &mut Self {
        let same = |part: &Self| (part.met.instance, part.met.triangle) == (met.instance, met.triangle);
        let index = parts.iter().position(same).unwrap_or(parts.len());
        if index == parts.len() {
            parts.push(Self { met, share: 0.0, weights: DVec2::ZERO, screen: DVec2::ZERO, depth: 0.0 });
        }
        &mut parts[index]
    }

    fn add(&mut self, share: f64, weights: DVec2, screen: DVec2, depth: f64) {
        self.share += share;
        self.weights += weights * share;
        self.screen += screen * share;
        self.depth += depth * share;
    }
}

impl Rays {
    /// `samples` ≥ 1 rays per pixel (0 counts as 1).
    pub fn new(world: Arc<World>, view: View, samples: u32) -> Self {
        Self { world, view, samples: samples.max(1) }
    }

    /// Follows one sample from face to face.
    fn sample(&self, screen: DVec2, parts: &mut Vec<Part>) {
        let line = self.view.line(screen);
        let ahead = line.1.dot(-self.view.world_from_view.z_axis);
        let near = self.view.near / ahead;
        let mut first = First { after: (near, 0, 0), least: 0.0, found: None };
        let mut left = 1.0f64;
        let floor = (near as f32).next_down().max(0.0);
        loop {
            let floor = floor.max((first.after.0 as f32).next_down());
            self.world.ask(line, floor, f32::INFINITY, &mut first);
            let Some(met) = first.found.take() else { return };
            let at = weights(&self.world.geometry, &met, line);
            let depth = met.t * ahead;
            let there = if met.alpha { self.opacity(&met, at, screen, depth) } else { 1.0 };
            let share = left * there / f64::from(self.samples);
            if share > 0.0 {
                Part::of(met, parts).add(share, at, screen, depth);
            }
            left *= 1.0 - there;
            if left < LEAST_SHARE {
                return;
            }
            first.after = met.key();
        }
    }

    /// Opacity where one sample meets a face, averaged over the sample's share of the pixel.
    fn opacity(&self, met: &Met, at: DVec2, screen: DVec2, depth: f64) -> f64 {
        let hit = self.hit(met, at, screen, depth, f64::from(self.samples).sqrt().recip());
        let geometry = &self.world.geometry;
        let mesh = &geometry.meshes[geometry.instances[met.instance as usize].mesh as usize];
        mesh.opacity.as_ref().map_or(1.0, |opacity| opacity.at(hit.uv, hit.uv_width()).into())
    }

    /// The hit seen through `screen`, with a footprint of `width` pixels.
    fn hit(&self, met: &Met, at: DVec2, screen: DVec2, depth: f64, width: f64) -> Hit {
        let pixel = (self.view.pixel_width(depth) * width) as f32;
        self.world.geometry.hit(met.instance, met.triangle, at, &self.view.ray(screen), pixel)
    }

    fn pixel(&self, column: u32, row: u32, parts: &mut Vec<Part>, pieces: &mut Vec<Piece>) {
        for index in 0..self.samples {
            self.sample(position(self.samples, column, row, index), parts);
        }
        for part in parts.drain(..) {
            let of = part.share.recip();
            let mut hit = self.hit(&part.met, part.weights * of, part.screen * of, part.depth * of, 1.0);
            hit.place.seed = scrambled(scrambled(column) ^ row);
            let share = part.share.min(1.0) as f32;
            pieces.push(Piece { column, share, hit, known: Known::default(), samples: 1 });
        }
    }
}

impl See for Rays {
    fn see(&self, rows: Range<u32>, columns: Range<u32>, receive: &mut dyn FnMut(u32, &mut Vec<Piece>)) {
        let (mut parts, mut pieces) = (Vec::new(), Vec::new());
        for row in rows {
            for column in columns.clone() {
                self.pixel(column, row, &mut parts, &mut pieces);
            }
            receive(row, &mut pieces);
            pieces.clear();
        }
    }
}

/// Where sample `index` of `samples` in a pixel goes, on the screen.
pub(crate) fn position(samples: u32, column: u32, row: u32, index: u32) -> DVec2 {
    let corner = DVec2::new(column.into(), row.into());
    if samples == 1 {
        return corner + 0.5;
    }
    let root = f64::from(samples).sqrt() as u32;
    let columns = (1..=root).rev().find(|d| samples.is_multiple_of(*d)).unwrap_or(1);
    let rows = samples / columns;
    let cell = DVec2::new((index % columns).into(), (index / columns).into());
    let seed = scrambled(scrambled(scrambled(column) ^ row) ^ index);
    let jitter = DVec2::new(unit(seed), unit(scrambled(seed ^ 0x9e37_79b9)));
    corner + (cell + jitter) / DVec2::new(columns.into(), rows.into())
}

/// A number in \[0, 1) from 32 bits.
fn unit(bits: u32) -> f64 {
    f64::from(bits) / 4_294_967_296.0
}

/// A well-mixed permutation of 32 bits (PCG-RXS-M-XS: O'Neill 2014, as Jarzynski and Olano 2020 use it).
pub(crate) fn scrambled(value: u32) -> u32 {
    let state = value.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}
