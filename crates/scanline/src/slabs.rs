//! Where the strips of [`crate::Rule::Exact`] begin and end.
//!
//! Between two corners edges are straight, so that a strip that holds no corner in its inside is measured
//! exactly by its middle line and the leaning of its borders. Corners at which a border bends or ends such
//! that it matters are *events*. A row is cut at its events, and the highest strips are halved until it has as
//! many as asked for. Rows with more events than the budget of lines allows are cut into equal strips: moving
//! those to some of the events was tried, and left the others worse off by more.

use glam::DVec3;

/// Pixels along a row that a corner must matter for, to be an event: of these, half a strip's height at most
/// is wrong.
const REACH: f32 = 0.02;

/// Events kept of one task's faces, for each row: more than any budget has lines for.
const KEPT: usize = 2;

/// Events nearer to each other than this are one \[row\]: what lies between them is wrong by so much at most.
const SAME: f64 = 1.0 / (1u64 << 20) as f64;

/// Lines beyond those asked for, as a share of them: what events may cost. Twice as many made pictures of terrain
/// of 10⁵ and 10⁶ faces a tenth slower.
const EXTRA: f64 = 0.125;

/// Most lines that a row may have beyond those asked for.
const MOST: usize = 16;

/// A corner at which a border bends or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Event {
    y: f64,
    /// How many pixels along the row it matters for.
    reach: f32,
}

/// Gathers events.
pub(crate) struct Gather {
    /// Height of a strip, and of the picture.
    strip: f64,
    height: f64,
    /// What is not worth keeping; rises where events are many.
    least: f32,
    room: usize,
    pub(crate) events: Vec<Event>,
}

impl Gather {
    pub(crate) fn new(strip: f64, rows: u32) -> Self {
        let room = KEPT * rows as usize;
        Self { strip, height: f64::from(rows), least: REACH, room, events: Vec::new() }
    }

    pub(crate) fn add(&mut self, corners: &[DVec3; 3]) {
        let (strip, height, least) = (self.strip, self.height, self.least);
        events(corners, strip, height, least, |event| self.events.push(event));
        while self.events.len() > self.room {
            self.least *= 2.0;
            let least = self.least;
            self.events.retain(|event| event.reach >= least);
        }
    }
}

/// Hands out the events of a face in strips of height `h`.
fn events(corners: &[DVec3; 3], h: f64, height: f64, least: f32, mut receive: impl FnMut(Event)) {
    let [a, b, c] = corners.map(|corner| corner.x);
    // Nothing in it matters for more than twice its width.
    if 2.0 * (a.max(b).max(c) - a.min(b).min(c)) < f64::from(least) {
        return;
    }
    for i in 0..3 {
        let (p, q, r) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
        if !(p.y > 0.0 && p.y < height) {
            continue;
        }
        // How far an edge gets along the row within half a strip.
        let along = |to: DVec3| (to.x - p.x) * (0.5 * h / (to.y - p.y).abs()).min(1.0);
        let (q_along, r_along) = (along(q), along(r));
        // At the top and bottom corner both edges leave to the same side; at the middle one, the border
        // goes straight on where they are opposite.
        let same_side = (q.y >= p.y) == (r.y >= p.y);
        let reach = if same_side { q_along - r_along } else { q_along + r_along }.abs() as f32;
        if reach >= least && reach < f32::INFINITY {
            receive(Event { y: p.y, reach });
        }
    }
}

/// The strips of all rows, from the top.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slabs {
    /// Where each strip begins, and the end of the last.
    borders: Vec<f64>,
    /// First strip of each row, and their number.
    rows: Vec<u32>,
}

impl Slabs {
    /// For events in any order; `strips` for each of `rows` if there are none.
    pub(crate) fn new(rows: u32, strips: u32, mut events: Vec<Event>) -> Self {
        events.sort_unstable_by(|a, b| a.y.total_cmp(&b.y).then(b.reach.total_cmp(&a.reach)));
        events.dedup_by(|next, kept| next.y - kept.y <= SAME);
        let of_row = |row: u32| {
            let from = events.partition_point(|event| event.y <= f64::from(row));
            let to = events.partition_point(|event| event.y < f64::from(row + 1));
            &events[from..to.max(from)]
        };
        let counts: Vec<usize> = (0..rows).map(|row| of_row(row).len()).collect();
        let most = most(&counts, strips as usize);
        let mut slabs = Self { borders: Vec::new(), rows: vec![0] };
        let mut cuts = Vec::new();
        for row in 0..rows {
            cut(f64::from(row), strips as usize, of_row(row), most, &mut cuts);
            slabs.borders.extend_from_slice(&cuts);
            slabs.rows.push(slabs.borders.len() as u32);
        }
        slabs.borders.push(f64::from(rows));
        slabs
    }

    pub(crate) fn lines(&self) -> u32 {
        self.rows.last().copied().unwrap_or(0)
    }

    pub(crate) fn of_row(&self, row: u32) -> std::ops::Range<u32> {
        self.rows[row as usize]..self.rows[row as usize + 1]
    }

    pub(crate) fn row_of(&self, line: u32) -> u32 {
        (self.rows.partition_point(|&first| first <= line) - 1) as u32
    }

    /// Top and bottom of a strip.
    pub(crate) fn strip(&self, line: u32) -> (f64, f64) {
        (self.borders[line as usize], self.borders[line as usize + 1])
    }
}

/// The largest number of strips that rows may have such that all together keep to the budget.
fn most(counts: &[usize], strips: usize) -> usize {
    // Small pictures may have a few more in any case.
    let budget = EXTRA * (strips * counts.len()) as f64 + MOST as f64;
    let extra = |most: usize| -> usize {
        counts.iter().filter(|&&count| count < most).map(|count| (count + 1).saturating_sub(strips)).sum()
    };
    (strips..=strips + MOST).rev().find(|&most| extra(most) as f64 <= budget).unwrap_or(strips)
}

/// Where the strips of a row begin that ends at `top` + 1.
fn cut(top: f64, strips: usize, events: &[Event], most: usize, cuts: &mut Vec<f64>) {
    cuts.clear();
    cuts.push(top);
    if events.len() < most {
        cuts.extend(events.iter().map(|event| event.y));
        while cuts.len() < strips {
            halve_highest(cuts, top + 1.0);
        }
        return;
    }
    cuts.extend((1..strips).map(|i| top + i as f64 / strips as f64));
}

fn halve_highest(cuts: &mut Vec<f64>, end: f64) {
    let below = |i: usize| cuts.get(i + 1).copied().unwrap_or(end);
    let mut highest = 0;
    for i in 1..cuts.len() {
        // Strictly higher by more than rounding: equal ones are halved from the top.
        if below(i) - cuts[i] > (below(highest) - cuts[highest]) * (1.0 + 1e-9) {
            highest = i;
        }
    }
    let middle = 0.5 * (cuts[highest] + below(highest));
    cuts.insert(highest + 1, middle);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn strips_rise_fill_the_rows_and_keep_to_the_budget(
            ys in prop::collection::vec(0f64..7.0, 0..60),
            strips in 1u32..9,
        ) {
            let events = ys.iter().map(|&y| Event { y, reach: 1.0 }).collect();
            let slabs = Slabs::new(7, strips, events);
            let budget = 7.0 * f64::from(strips) * (1.0 + EXTRA) + MOST as f64;
            prop_assert!(f64::from(slabs.lines()) <= budget);
            for row in 0..7 {
                let lines = slabs.of_row(row);
                prop_assert!(lines.len() >= strips as usize);
                prop_assert_eq!(slabs.strip(lines.start).0, f64::from(row));
                prop_assert_eq!(slabs.strip(lines.end - 1).1, f64::from(row + 1));
                for line in lines {
                    let (top, bottom) = slabs.strip(line);
                    prop_assert!(top < bottom);
                    prop_assert_eq!(slabs.row_of(line), row);
                }
            }
        }
    }

    #[test]
    fn few_events_are_cut_at() {
        let events = vec![Event { y: 1.3, reach: 1.0 }, Event { y: 1.8, reach: 1.0 }];
        let slabs = Slabs::new(2, 2, events);
        let tops: Vec<f64> = (0..slabs.lines()).map(|line| slabs.strip(line).0).collect();
        assert_eq!(tops, [0.0, 0.5, 1.0, 1.3, 1.8]);
    }
}
