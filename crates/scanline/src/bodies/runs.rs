//! The parts of a line in which bodies show.

use super::hulls::{Interval, stretches};
use super::sight::{Scene, Shown, Sight};
use crate::borders::Border;
use crate::scanline::Line;
use crate::segment::Segment;

/// Borders are found to within this \[pixel\].
const EXACT: f64 = 1.0 / 8192.0;

/// Borders that are farther than this from a straight one in the middle of the strip are bent \[pixel\].
const BENT: f64 = 1.0 / 32.0;

/// Objects looked for between two samples.
const BETWEEN: u32 = 8;

/// A part of a line in which one body shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    pub(crate) body: u32,
    pub(crate) x: [f64; 2],
    /// Left and right border, from the top of the strip to its bottom.
    pub(crate) borders: [Border; 2],
    /// A place on the line where the body is met.
    pub(crate) sure: f64,
}

/// What shows in a strip.
pub(crate) struct Found {
    pub(crate) runs: Vec<Run>,
    /// What is known of the bodies' nearness, where veils need it: pieces that go straight from sample to sample.
    pub(crate) nears: Vec<Segment>,
    /// Where to look in its halves.
    pub(crate) hints: Vec<f64>,
    /// All borders go straight through the strip, from its top to its bottom.
    pub(crate) is_straight: bool,
}

/// A strip and its line: where to look for bodies on it.
pub(crate) struct Strip<'a> {
    pub(crate) line: &'a Line,
    pub(crate) y: f64,
    /// The line on which the faces' nearness is known.
    pub(crate) faces_y: f64,
    /// Height; 0 where borders are taken to be upright.
    pub(crate) height: f64,
    /// At the line, the top and the bottom.
    pub(crate) intervals: [Vec<Interval>; 3],
    /// Left and right end of the stretch that is looked at.
    pub(crate) bounds: [f64; 2],
    /// Places on the line at which to look as well.
    pub(crate) hints: &'a [f64],
}

/// Where what is seen changes.
struct Cut {
    x: f64,
    /// The bodies on its left and right, if any.
    left: Option<u32>,
    right: Option<u32>,
}

type Sample = (f64, Option<Shown>);

fn body(shown: Option<Shown>) -> Option<u32> {
    shown.map(|shown| shown.body)
}

impl Strip<'_> {
    fn scene(&self, place: usize) -> Scene<'_> {
        let y = self.y + [0.0, -0.5, 0.5][place] * self.height;
        Scene { y, intervals: &self.intervals[place], opaque: &self.line.opaque, faces_y: self.faces_y }
    }

    /// Finds all runs.
    pub(crate) fn find(&self, sight: &mut Sight) -> Found {
        let (mut runs, mut nears, mut tips) = (Vec::new(), Vec::new(), Vec::new());
        let mut is_straight = true;
        for stretch in stretches(&self.intervals[0]) {
            let samples = self.samples(sight, stretch);
            let mut known = samples.clone();
            let cuts = self.cuts(sight, &samples, stretch, &mut known);
            known.sort_by(|a, b| a.0.total_cmp(&b.0));
            if !self.line.veils.is_empty() {
                straight(&known, &mut nears);
            }
            let mut border = |cut| self.border(sight, cut, &mut is_straight);
            let borders: Vec<(f64, Border)> = cuts.iter().map(&mut border).collect();
            for i in 1..cuts.len() {
                let x = [borders[i - 1].0, borders[i].0];
                let Some(body) = cuts[i].left.filter(|_| x[0] < x[1]) else { continue };
                let within = |(at, shown): &&Sample| {
                    shown.is_some_and(|shown| shown.body == body)
                        && cuts[i - 1].x - EXACT <= *at
                        && *at <= cuts[i].x + EXACT
                };
                if let Some((sure, _)) = known.iter().find(within) {
                    let borders = [borders[i - 1].1, borders[i].1];
                    runs.push(Run { body, x, borders, sure: *sure });
                }
            }
        }
        for place in 1..3 {
            self.missed(sight, place, &runs, &mut tips);
        }
        let is_straight = is_straight && tips.is_empty();
        tips.extend(runs.iter().map(|run| 0.5 * (run.x[0] + run.x[1])));
        Found { runs, nears, hints: tips, is_straight }
    }

    /// Bodies that show at the top (1) or bottom (2) of the strip, but not on the line: one place of each.
    fn missed(&self, sight: &mut Sight, place: usize, runs: &[Run], tips: &mut Vec<f64>) {
        let scene = self.scene(place);
        for interval in &self.intervals[place] {
            if !runs.iter().any(|run| run.body == interval.body) {
                let xs = self.places(interval.x, std::slice::from_ref(interval));
                let shows = |x: &f64| body(sight.shown(*x, &scene)) == Some(interval.body);
                tips.extend(xs.into_iter().find(shows));
            }
        }
    }

    /// Primary samples (thesis 2.3.3): at the middle of each part that lies in one pixel and before one face, and
    /// at both ends.
    fn samples(&self, sight: &mut Sight, stretch: [f64; 2]) -> Vec<Sample> {
        let scene = self.scene(0);
        let places = self.places(stretch, &self.intervals[0]);
        places.into_iter().map(|x| (x, sight.shown(x, &scene))).collect()
    }

    fn places(&self, [left, right]: [f64; 2], intervals: &[Interval]) -> Vec<f64> {
        let mut cuts = vec![left, right];
        let inside = |x: &f64| left < *x && *x < right;
        cuts.extend((left as u32 + 1..=right as u32).map(f64::from).filter(inside));
        cuts.extend(intervals.iter().flat_map(|interval| interval.x).filter(inside));
        let opaque = &self.line.opaque;
        let first = opaque.partition_point(|span| span.x1 <= left);
        let here = opaque[first..].iter().take_while(|span| span.x0 < right);
        cuts.extend(here.flat_map(|span| [span.x0, span.x1]).filter(inside));
        cuts.sort_unstable_by(f64::total_cmp);
        cuts.dedup();
        let mut xs = vec![left];
        xs.extend(cuts.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        // A tip may lie between two pixels' samples: as a rule it is in the middle.
        let middles = intervals.iter().map(|interval| 0.5 * (interval.x[0] + interval.x[1]));
        xs.extend(self.hints.iter().copied().chain(middles).filter(inside));
        xs.push(right);
        xs.sort_unstable_by(f64::total_cmp);
        xs
    }

    /// Where the body that shows changes between samples: by halving.
    fn cuts(
        &self,
        sight: &mut Sight,
        samples: &[Sample],
        [left, right]: [f64; 2],
        known: &mut Vec<Sample>,
    ) -> Vec<Cut> {
        let scene = self.scene(0);
        let mut cuts = Vec::new();
        if let Some(first) = samples.first().and_then(|sample| body(sample.1)) {
            cuts.push(Cut { x: left, left: None, right: Some(first) });
        }
        for pair in samples.windows(2) {
            let (mut x, mut from) = (pair[0].0, body(pair[0].1));
            for _ in 0..BETWEEN {
                if from == body(pair[1].1) {
                    break;
                }
                let (mut beyond, mut shown) = pair[1];
                while beyond - x > EXACT {
                    let middle = 0.5 * (x + beyond);
                    let there = sight.shown(middle, &scene);
                    known.push((middle, there));
                    if body(there) == from {
                        x = middle;
                    } else {
                        (beyond, shown) = (middle, there);
                    }
                }
                cuts.push(Cut { x: 0.5 * (x + beyond), left: from, right: body(shown) });
                (x, from) = (beyond, body(shown));
            }
        }
        if let Some(last) = samples.last().and_then(|sample| body(sample.1)) {
            cuts.push(Cut { x: right, left: Some(last), right: None });
        }
        cuts
    }

    /// A cut's x and border. One at the end of a visible face is the face's own.
    fn border(&self, sight: &mut Sight, cut: &Cut, is_straight: &mut bool) -> (f64, Border) {
        let opaque = &self.line.opaque;
        let near = opaque.partition_point(|span| span.x1 < cut.x - 2.0 * EXACT);
        for (i, span) in opaque.iter().enumerate().skip(near).take(2) {
            let sides = self.line.sides.get(i);
            if (span.x0 - cut.x).abs() <= 2.0 * EXACT {
                return (span.x0, sides.map_or([span.x0; 2], |sides| sides.left));
            }
            if (span.x1 - cut.x).abs() <= 2.0 * EXACT {
                return (span.x1, sides.map_or([span.x1; 2], |sides| sides.right));
            }
        }
        if self.height == 0.0 || cut.x <= self.bounds[0] || cut.x >= self.bounds[1] {
            return (cut.x, [cut.x; 2]);
        }
        let top = self.follow(sight, cut, 1, (cut.x, 0.25 * self.height));
        // Mostly it goes straight on.
        let guess = top.map_or((cut.x, 0.25 * self.height), |top| (2.0 * cut.x - top, 4.0 * EXACT));
        let bottom = self.follow(sight, cut, 2, guess);
        let bent = |(top, bottom): (f64, f64)| (0.5 * (top + bottom) - cut.x).abs() > BENT;
        if top.zip(bottom).is_none_or(bent) {
            *is_straight = false;
        }
        (cut.x, lean(cut.x, top, bottom))
    }

    /// x of a cut's continuation at the top (1) or bottom (2) of the strip, looked for from a guess on by steps that
    /// double.
    fn follow(
        &self,
        sight: &mut Sight,
        cut: &Cut,
        place: usize,
        (guess, mut step): (f64, f64),
    ) -> Option<f64> {
        let scene = self.scene(place);
        let at = |sight: &mut Sight, x: f64| body(sight.shown(x, &scene));
        let start = guess.clamp(self.bounds[0], self.bounds[1]);
        let mut here = at(sight, start);
        let on_left = here == cut.left;
        let way = if on_left { 1.0 } else { -1.0 };
        let mut same = start;
        let (mut other, mut there) = loop {
            let x = (start + way * step).clamp(self.bounds[0], self.bounds[1]);
            if x == same {
                return None;
            }
            let there = at(sight, x);
            if (there == cut.left) != on_left {
                break (x, there);
            }
            (same, here) = (x, there);
            step *= 2.0;
        };
        while (other - same).abs() > EXACT {
            let middle = 0.5 * (same + other);
            let shown = at(sight, middle);
            if (shown == cut.left) == on_left {
                (same, here) = (middle, shown);
            } else {
                (other, there) = (middle, shown);
            }
        }
        // It may be another border of the same body.
        let beyond = if on_left { there } else { here };
        (beyond == cut.right).then_some(0.5 * (same + other))
    }
}

/// The straight border that has as much to its left as the parabola through three points: its mean is
/// (top + 4 x + bottom)/6. One that ends within the strip goes on as at its other end.
fn lean(x: f64, top: Option<f64>, bottom: Option<f64>) -> Border {
    match (top, bottom) {
        (Some(top), Some(bottom)) => {
            let mean = (top + 4.0 * x + bottom) / 6.0;
            [mean - 0.5 * (bottom - top), mean + 0.5 * (bottom - top)]
        }
        (Some(top), None) => [top, 2.0 * x - top],
        (None, Some(bottom)) => [2.0 * x - bottom, bottom],
        (None, None) => [x; 2],
    }
}

/// Straight pieces of nearness between neighbouring samples that show one body.
fn straight(samples: &[Sample], nears: &mut Vec<Segment>) {
    for pair in samples.windows(2) {
        let ((x0, Some(a)), (x1, Some(b))) = (pair[0], pair[1]) else { continue };
        if a.body == b.body && x0 < x1 {
            let slope = (b.nearness - a.nearness) / (x1 - x0);
            nears.push(Segment { x0, x1, w: a.nearness, slope, ..Segment::default() });
        }
    }
}
