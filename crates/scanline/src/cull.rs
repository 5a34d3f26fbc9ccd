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

/// Left border of a bin.
fn border(bin: usize, width: f64) -> f64 {
    bin as f64 * (width / BINS as f64)
}

/// The bin that holds x, or a neighbour where x is a border but for rounding.
fn bin(x: f64, width: f64) -> usize {
    ((x * (BINS as f64 / width)) as usize).min(BINS - 1)
}

/// How near something that covers the bin is at least.
fn nearest(segments: &[Segment], width: f64) -> [f64; BINS] {
    let mut nearest = [f64::NEG_INFINITY; BINS];
    for segment in segments {
        let (first, last) = (bin(segment.x0, width), bin(segment.x1, width));
        if last - first < 1 {
            continue;
        }
        for (i, nearest) in (first..).zip(&mut nearest[first..=last]) {
            let (l, r) = (border(i, width), border(i + 1, width));
            // The first and the last bin are touched, but covered only by chance.
            if segment.x0 <= l && r <= segment.x1 {
                let low = segment.nearness(l).min(segment.nearness(r)) - f64::from(segment.error);
                *nearest = nearest.max(low);
            }
        }
    }
    nearest
}

/// Is the segment farther than `nearest` wherever it is?
fn hidden(segment: &Segment, nearest: &[f64; BINS], width: f64) -> bool {
    // One bin more to each side where rounding may have put an end beyond a border.
    let first = bin(segment.x0, width);
    let first = if border(first, width) > segment.x0 { first.saturating_sub(1) } else { first };
    let last = bin(segment.x1, width);
    let last = if border(last + 1, width) < segment.x1 { (last + 1).min(BINS - 1) } else { last };
    (first..=last).all(|i| {
        let (l, r) = (border(i, width).max(segment.x0), border(i + 1, width).min(segment.x1));
        // Where a rounded border leaves nothing of it, l > r, both ends still bound what there is.
        let high = segment.nearness(l).max(segment.nearness(r)) + f64::from(segment.error);
        high < nearest[i]
    })
}
