//! Drops segments that are hidden for certain, before the envelope is asked.
//!
//! Only where a line is deep: the faces that lie far behind then outnumber the visible ones by far. The
//! line is divided into bins; each learns how near something that covers it whole is at least. What is
//! farther than that in every bin it touches can show nowhere.

use crate::segment::Segment;

/// Bins across the picture. More would find smaller occluders, but cost each long segment as many steps.
const BINS: usize = 64;

/// Mean number of faces above one another from which culling pays for itself: below about this, merging
/// the chains costs no more than asking the bins.
const DEEP: f64 = 12.0;

/// Removes from `segments`, which lie within \[0, `width`\], such as are hidden wholly.
pub(crate) fn cull(segments: &mut Vec<Segment>, width: f64) {
    let covered: f64 = segments.iter().map(|segment| segment.x1 - segment.x0).sum();
    if covered > DEEP * width {
        let nearest = nearest(segments, width);
        segments.retain(|segment| !hidden(segment, &nearest, width));
    }
}

/// The bin that holds x, or a neighbour where x is a border but for rounding.
fn bin(x: f64, width: f64) -> usize {
    ((x * (BINS as f64 / width)) as usize).min(BINS - 1)
}

/// A segment, prolonged over whole bins: at the left border of bin i its nearness is start + i · step.
struct Ramp {
    start: f64,
    step: f64,
    /// Bound on the error of that: the segment's own, and four roundings of x · slope.
    error: f64,
}

impl Ramp {
    fn new(segment: &Segment, width: f64) -> Self {
        let rounding = 2.0 * f64::EPSILON * width * segment.slope.abs();
        Self {
            start: segment.nearness(0.0),
            step: segment.slope * (width / BINS as f64),
            error: f64::from(segment.error) + rounding,
        }
    }

    /// Nearness at the left border of bin `first` and on, of which `side` is added to each.
    fn along(&self, first: usize, side: f64) -> impl Iterator<Item = f64> {
        let start = self.start + side;
        (first..).map(move |i| start + i as f64 * self.step)
    }
}

/// How near something that covers the bin is at least.
fn nearest(segments: &[Segment], width: f64) -> [f64; BINS] {
    let mut nearest = [f64::NEG_INFINITY; BINS];
    for segment in segments {
        // The bins of the ends are touched, but covered only by chance: without them.
        let (first, end) = (bin(segment.x0, width) + 1, bin(segment.x1, width));
        let first = if segment.x0 <= 0.0 { 0 } else { first };
        let end = if segment.x1 >= width { BINS } else { end };
        // Rounding may have put an end into the bin beside its own: one bin less on either side.
        let first = if first > 0 { first + 1 } else { 0 };
        let end = if end < BINS { end.saturating_sub(1) } else { BINS };
        if first >= end {
            continue;
        }
        let ramp = Ramp::new(segment, width);
        let lows = ramp.along(first, ramp.step.min(0.0) - ramp.error);
        for (nearest, low) in nearest[first..end].iter_mut().zip(lows) {
            *nearest = if low > *nearest { low } else { *nearest };
        }
    }
    nearest
}

/// Is the segment farther than `nearest` wherever it is?
fn hidden(segment: &Segment, nearest: &[f64; BINS], width: f64) -> bool {
    let (first, last) = (bin(segment.x0, width), bin(segment.x1, width));
    // One bin more on both sides, where rounding may have put an end beyond a border.
    let (first, last) = (first.saturating_sub(1), (last + 1).min(BINS - 1));
    let ramp = Ramp::new(segment, width);
    // Above the segment itself at its ends, where it does not fill the bin.
    let highs = ramp.along(first, ramp.step.max(0.0) + ramp.error);
    nearest[first..=last].iter().zip(highs).all(|(nearest, high)| high < *nearest)
}
