//! Pieces of the pixels in which bodies may show.

use std::ops::Range;
use std::sync::atomic::Ordering;

use glam::DVec2;
use light::{Hit, Piece, sampling};

use super::Localised;
use super::hulls::{Interval, Projected, unite};
use super::insert::insert;
use super::runs::{Run, Strip};
use super::sight::Sight;
use crate::pixel::{Cover, Pixel};
use crate::resolve::{Walk, at_most_one, seed};
use crate::scanline::Line;
use crate::{Rule, Shading, place};

/// How often strips are halved in which the border of a body is bent: where it is level, or ends.
const HALVED: u32 = 5;

/// A strip of a stretch, or a part of one, with the bodies in it.
struct Found {
    y: f64,
    weight: f64,
    line: Line,
    runs: Vec<Run>,
}

/// Keeps the places at which bodies are looked at apart from other random choices.
const PURPOSE: u32 = 0xB0;

/// Where to look for bodies.
struct Place<'a> {
    hulls: Vec<&'a Projected>,
    /// Left and right end of the stretch, in the wide picture.
    bounds: [f64; 2],
    width: f64,
}

impl Place<'_> {
    fn intervals(&self, y: f64) -> Vec<Interval> {
        let [left, right] = self.bounds;
        let mut all: Vec<_> = self.hulls.iter().filter_map(|hull| hull.at(y, self.width)).collect();
        // The margin is nobody's.
        all.iter_mut().for_each(|i| i.x = [i.x[0].max(left), i.x[1].min(right)]);
        all.retain(|i| i.x[0] < i.x[1]);
        unite(&mut all);
        all
    }
}

impl Localised {
    /// Adds the pieces of the columns `here` of a stretch of a row.
    pub(super) fn stretch(
        &self,
        row: u32,
        stretch: &Range<u32>,
        here: Range<u32>,
        lines: &[&Line],
        pixel: &mut Pixel,
        pieces: &mut Vec<Piece>,
    ) {
        let scanline = &*self.scanline;
        let mut sight = Sight {
            scanline,
            bodies: &*self.bodies,
            rays: 0,
            first: stretch.start + scanline.margin,
            asked: vec![false; stretch.len()],
        };
        let found = self.find(row, stretch, lines, &mut sight);
        // What is outside of the asked-for columns is looked at as well: what a stretch shows does not depend on the
        // columns.
        let asked = &sight.asked[(here.start - stretch.start) as usize..(here.end - stretch.start) as usize];
        self.pixels.fetch_add(asked.iter().filter(|asked| **asked).count() as u64, Ordering::Relaxed);
        let left = f64::from(here.start + scanline.margin);
        let walk = |found| {
            let Found { y, weight, line, .. }: &Found = found;
            Walk::new(line, *y, *weight, left)
        };
        let mut walks: Vec<Walk> = found.iter().map(walk).collect();
        let merge = scanline.knobs.shading == Shading::PerPixel;
        let mut untouched = here.start;
        for column in here.clone() {
            pixel.clear();
            walks.iter_mut().for_each(|walk| walk.add(column + scanline.margin, pixel, merge));
            if !pixel.covers.iter().any(|cover| cover.face >= self.base) {
                continue;
            }
            if untouched < column {
                scanline.resolve(row, untouched..column, lines.iter().copied(), pixel, pieces);
                pixel.clear();
                walks.iter_mut().for_each(|walk| walk.add(column + scanline.margin, pixel, merge));
            }
            untouched = column + 1;
            self.pixel([column, row], (&found, &walks), &mut sight, pixel, pieces);
        }
        if untouched < here.end {
            scanline.resolve(row, untouched..here.end, lines.iter().copied(), pixel, pieces);
        }
        self.rays.fetch_add(sight.rays, Ordering::Relaxed);
    }

    /// Finds the bodies on the lines of a stretch.
    fn find(&self, row: u32, stretch: &Range<u32>, lines: &[&Line], sight: &mut Sight) -> Vec<Found> {
        let scanline = &*self.scanline;
        let width = f64::from(scanline.view.width);
        let bounds = [stretch.start, stretch.end].map(|column| f64::from(column + scanline.margin));
        let here = |interval: &Interval| interval.x[0] < bounds[1] && interval.x[1] > bounds[0];
        let rows = [f64::from(row), f64::from(row + 1)];
        let in_row = |hull: &&Projected| hull.between(rows, width).is_some_and(|i| here(&i));
        let place = Place { hulls: self.hulls.iter().filter(in_row).collect(), bounds, width };
        let mut found = Vec::new();
        for (number, line) in scanline.grid.of_row(row).zip(lines) {
            let (y, weight) = (scanline.grid.y(number), scanline.grid.weight(row, number));
            self.strip(&place, (line, y), (y, weight), (&[], HALVED), sight, &mut found);
        }
        found
    }

    /// Finds the bodies on a strip (middle, height), a part of that of `line` at `faces_y`. `hints` are places
    /// where they were met nearby.
    fn strip(
        &self,
        place: &Place,
        (line, faces_y): (&Line, f64),
        (y, weight): (f64, f64),
        (hints, halved): (&[f64], u32),
        sight: &mut Sight,
        found: &mut Vec<Found>,
    ) {
        let leaning = self.scanline.grid.rule == Rule::Exact;
        let height = if leaning { weight } else { 0.0 };
        let at = |share: f64| if leaning { place.intervals(y + share * height) } else { Vec::new() };
        let intervals = [place.intervals(y), at(-0.5), at(0.5)];
        let strip = Strip { line, y, faces_y, height, intervals, bounds: place.bounds, hints };
        let bodies = strip.find(sight);
        if bodies.is_straight || halved == 0 {
            let runs = bodies.runs;
            let line = insert(line, (&runs, &bodies.nears), self.base, place.bounds, leaning);
            found.push(Found { y, weight, line, runs });
            return;
        }
        let hints = [hints, &bodies.hints].concat();
        for half in 0..2 {
            let y = y + [-0.25, 0.25][half] * height;
            let line = line.half(half);
            self.strip(place, (&line, faces_y), (y, 0.5 * weight), (&hints, halved - 1), sight, found);
        }
    }

    /// Adds the pieces of a pixel in which a body shows.
    fn pixel(
        &self,
        [column, row]: [u32; 2],
        (found, walks): (&[Found], &[Walk]),
        sight: &mut Sight,
        pixel: &mut Pixel,
        pieces: &mut Vec<Piece>,
    ) {
        let scanline = &*self.scanline;
        let mut made = Vec::new();
        pixel.share_out(|cover| {
            let hit = scanline.hit(row, column, cover);
            cover.hit = made.len() as u32;
            made.push(hit);
            scanline.opacity(&hit)
        });
        let first = pieces.len();
        for cover in pixel.covers.iter().filter(|cover| cover.share > 0.0) {
            let hit = match made.get(cover.hit as usize) {
                Some(hit) => Some(*hit),
                None if cover.face < self.base => {
                    let within = place::within(walks, pixel, cover, column + scanline.margin);
                    Some(scanline.hit(row, column, &within))
                }
                None => self.body_hit([column, row], cover, found, sight),
            };
            let Some(hit) = hit else { continue };
            let known = pixel.table.known(cover.known);
            let spread = if cover.face >= self.base && self.samples > 1 {
                self.spread([column, row], cover, found, sight)
            } else {
                Vec::new()
            };
            if spread.is_empty() {
                pieces.push(Piece { column, share: cover.share as f32, hit, known, samples: 1 });
            }
            for (number, (part, hit)) in (0..).zip(&spread) {
                let samples = if number == 0 { spread.len() as u16 } else { 1 };
                pieces.push(Piece { column, share: (cover.share * part) as f32, hit: *hit, known, samples });
            }
        }
        at_most_one(&mut pieces[first..]);
    }

    /// Hits spread over what shows of a body in a pixel, with their parts of its share, which sum to one. What bodies
    /// show has edges of its own: creases, shadows, all that mirrors and glass show.
    ///
    /// Points of Sobol's sequence, scrambled by the pixel, are laid over the strips, one below the other, so that equal
    /// areas have equal numbers and the first few are spread over the pixel as well.
    fn spread(
        &self,
        [column, row]: [u32; 2],
        cover: &Cover,
        found: &[Found],
        sight: &mut Sight,
    ) -> Vec<(f64, Hit)> {
        let body = cover.face - self.base;
        let left = f64::from(column + self.scanline.margin);
        let mut total = 0.0;
        // With the area of all before it.
        let strips: Vec<(f64, &Found, &Run)> = found
            .iter()
            .flat_map(|found| found.runs.iter().map(move |run| (found, run)))
            .filter(|(_, run)| run.body == body)
            .filter_map(|(found, run)| {
                let area = (run.x[1].min(left + 1.0) - run.x[0].max(left)) * found.weight;
                (area > 0.0).then(|| {
                    total += area;
                    (total - area, found, run)
                })
            })
            .collect();
        let own = seed(column, row, cover.face);
        let mut hits = Vec::new();
        for i in 0..self.samples {
            let [across, down] = sampling::sobol(i, sampling::shift(own, PURPOSE));
            let at = down * total;
            let number = strips.partition_point(|(before, ..)| *before <= at);
            let Some(&(before, found, run)) = strips.get(number.wrapping_sub(1)) else { break };
            let end = strips.get(number).map_or(total, |(before, ..)| *before);
            let along = (at - before) / (end - before);
            if let Some((at, distance)) = self.sample(body, (found, run), left, [across, along], sight) {
                let mut hit = self.hit_at(body, at, distance);
                hit.place.seed = own ^ i.wrapping_mul(0x9e37_79b9);
                hits.push(hit);
            }
        }
        let part = (hits.len() as f64).recip();
        let narrower = |hit: Hit| Hit { width: hit.width * part.sqrt() as f32, ..hit };
        hits.into_iter().map(|hit| (part, narrower(hit))).collect()
    }

    /// Where a body is met in a strip, at shares of the way across and along what shows of it in the pixel from `left`
    /// on; on the line itself where it is not met off it.
    fn sample(
        &self,
        body: u32,
        (found, run): (&Found, &Run),
        left: f64,
        [across, along]: [f64; 2],
        sight: &mut Sight,
    ) -> Option<(DVec2, f64)> {
        let inside = |[l, r]: [f64; 2], y: f64| {
            let (l, r) = (l.max(left), r.min(left + 1.0));
            (l < r).then(|| DVec2::new(l + (r - l) * across, y))
        };
        let height = if self.scanline.grid.rule == Rule::Exact { found.weight } else { 0.0 };
        let border = |[top, bottom]: [f64; 2]| top + (bottom - top) * along;
        let off = inside(run.borders.map(border), found.y + (along - 0.5) * height);
        let places = [off, inside(run.x, found.y)];
        places.into_iter().flatten().find_map(|at| {
            let (distance, _) = sight.meet(body, at.x, at.y)?;
            Some((at, distance))
        })
    }

    /// The hit on a body that is met at `distance` along the line through `at`.
    fn hit_at(&self, body: u32, at: DVec2, distance: f64) -> Hit {
        let view = &self.scanline.view;
        let line = view.line(at);
        let depth = -distance * line.1.dot(view.world_from_view.z_axis);
        let pixel_width = view.pixel_width(depth.max(view.near)) as f32;
        self.bodies.hit(body, line, distance, &view.ray(at), pixel_width)
    }

    /// The hit at the centroid of what shows of a body; where that is not on the body, at the nearest place on a line
    /// that is, or at one where it was met already.
    fn body_hit(
        &self,
        [column, row]: [u32; 2],
        cover: &Cover,
        found: &[Found],
        sight: &mut Sight,
    ) -> Option<Hit> {
        let body = cover.face - self.base;
        let centroid = DVec2::from_array(cover.moment) / cover.area;
        let mut places = vec![centroid];
        let on_lines = found.iter().flat_map(|found| {
            let runs = found.runs.iter().filter(|run| run.body == body);
            runs.flat_map(|run| {
                // Not on the border itself, which is known to within less than this.
                let inset = (0.25 * (run.x[1] - run.x[0])).min(1.0 / 1024.0);
                let x = centroid.x.clamp(run.x[0] + inset, run.x[1] - inset);
                [DVec2::new(x, found.y), DVec2::new(run.sure, found.y)]
            })
        });
        places.extend(on_lines);
        places[1..].sort_by(|a, b| a.distance_squared(centroid).total_cmp(&b.distance_squared(centroid)));
        let (at, distance) = places
            .into_iter()
            .find_map(|at| sight.meet(body, at.x, at.y).map(|(distance, _)| (at, distance)))?;
        let mut hit = self.hit_at(body, at, distance);
        hit.place.seed = seed(column, row, cover.face);
        Some(hit)
    }
}
