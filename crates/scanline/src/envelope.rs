//! The upper envelope of segments: what shows on one line.
//!
//! Segments, sorted by their left ends, are dealt out into the fewest chains whose members do not overlap
//! (as many as faces lie above one another), and chains are merged in pairs. A merge walks both chains and
//! decides each interval in which one segment of each is present: one of them is nearer throughout, or
//! they cross, and the crossing becomes a border. So faces may pass through each other and overlap
//! cyclically; n segments cost O(n log n) however deep they lie.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::cull::cull;
use crate::segment::Segment;

/// A visible part \[x0, x1\] of segment `of`.
#[derive(Clone, Copy, Debug, Default)]
struct Part {
    x0: f64,
    x1: f64,
    of: u32,
}

/// Working memory, kept between lines.
#[derive(Default)]
pub(crate) struct Envelope {
    chain_of: Vec<u32>,
    ends: Vec<f64>,
    starts: Vec<u32>,
    next_starts: Vec<u32>,
    parts: Vec<Part>,
    merged: Vec<Part>,
    deep: BinaryHeap<Reverse<(u64, u32)>>,
}

/// Chains that are tried one after the other before the heap is asked.
const SHALLOW: usize = 24;

impl Envelope {
    /// Replaces `visible` by the visible parts of `segments`, from the left; they do not overlap.
    /// `segments`, all within \[0, `width`\], come out sorted by (x0, face), less some that are hidden.
    pub(crate) fn find(&mut self, segments: &mut Vec<Segment>, width: f64, visible: &mut Vec<Segment>) {
        visible.clear();
        cull(segments, width);
        if segments.is_empty() {
            return;
        }
        sort(segments);
        self.deal(segments);
        while self.starts.len() > 2 {
            self.merge_pairs(segments);
        }
        visible.extend(self.parts.iter().map(|part| {
            let segment = segments[part.of as usize];
            Segment { x0: part.x0, x1: part.x1, w: segment.nearness(part.x0), ..segment }
        }));
    }

    /// Deals the segments out into chains: `parts` chain after chain, `starts` where each begins.
    fn deal(&mut self, segments: &[Segment]) {
        self.chain_of.clear();
        self.ends.clear();
        self.deep.clear();
        for segment in segments {
            let chain = self.free_chain(segment);
            self.chain_of.push(chain);
        }
        self.starts.clear();
        self.starts.resize(self.ends.len() + 1, 0);
        for &chain in &self.chain_of {
            self.starts[chain as usize + 1] += 1;
        }
        for i in 1..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        self.next_starts.clear();
        self.next_starts.extend_from_slice(&self.starts);
        self.parts.clear();
        self.parts.resize(segments.len(), Part::default());
        for (i, (segment, &chain)) in segments.iter().zip(&self.chain_of).enumerate() {
            let slot = &mut self.next_starts[chain as usize];
            self.parts[*slot as usize] = Part { x0: segment.x0, x1: segment.x1, of: i as u32 };
            *slot += 1;
        }
    }

    /// A chain that ends before `segment` begins, a new one only when there is none.
    fn free_chain(&mut self, segment: &Segment) -> u32 {
        let shallow = self.ends.len().min(SHALLOW);
        if let Some(chain) = self.ends[..shallow].iter().position(|&end| end <= segment.x0) {
            self.ends[chain] = segment.x1;
            return chain as u32;
        }
        // Screen positions are not negative, so that their bits sort as they do.
        let chain = match self.deep.peek() {
            Some(&Reverse((end, chain))) if f64::from_bits(end) <= segment.x0 => {
                self.deep.pop();
                self.ends[chain as usize] = segment.x1;
                chain
            }
            _ => {
                self.ends.push(segment.x1);
                self.ends.len() as u32 - 1
            }
        };
        if chain as usize >= SHALLOW {
            self.deep.push(Reverse((segment.x1.to_bits(), chain)));
        }
        chain
    }

    /// Halves the number of chains.
    fn merge_pairs(&mut self, segments: &[Segment]) {
        self.merged.clear();
        self.next_starts.clear();
        for pair in self.starts.windows(3).step_by(2) {
            self.next_starts.push(self.merged.len() as u32);
            let a = &self.parts[pair[0] as usize..pair[1] as usize];
            let b = &self.parts[pair[1] as usize..pair[2] as usize];
            merge(segments, a, b, &mut self.merged);
        }
        // An odd chain is left over.
        if self.starts.len().is_multiple_of(2) {
            let last = self.starts[self.starts.len() - 2] as usize;
            self.next_starts.push(self.merged.len() as u32);
            self.merged.extend_from_slice(&self.parts[last..]);
        }
        self.next_starts.push(self.merged.len() as u32);
        std::mem::swap(&mut self.parts, &mut self.merged);
        std::mem::swap(&mut self.starts, &mut self.next_starts);
    }
}

/// By left end, then by face: an order that depends on nothing but the segments.
pub(crate) fn sort(segments: &mut [Segment]) {
    segments
        .sort_unstable_by(|a, b| a.x0.total_cmp(&b.x0).then(a.face.cmp(&b.face)).then(a.x1.total_cmp(&b.x1)));
}

/// Merges two envelopes onto the end of `out`.
fn merge(segments: &[Segment], mut a: &[Part], mut b: &[Part], out: &mut Vec<Part>) {
    let floor = out.len();
    // Everything left of x is decided.
    let mut x = 0.0f64;
    while let ([p, a_rest @ ..], [q, b_rest @ ..]) = (a, b) {
        let (p0, q0) = (p.x0.max(x), q.x0.max(x));
        // One alone, up to its end or to the beginning of the other.
        if p0 < q0 {
            x = p.x1.min(q0);
            push(out, floor, Part { x0: p0, x1: x, of: p.of });
        } else if q0 < p0 {
            x = q.x1.min(p0);
            push(out, floor, Part { x0: q0, x1: x, of: q.of });
        } else {
            x = p.x1.min(q.x1);
            decide(segments, [p.of, q.of], p0, x, |part| push(out, floor, part));
        }
        if p.x1 <= x {
            a = a_rest;
        }
        if q.x1 <= x {
            b = b_rest;
        }
    }
    for part in a.iter().chain(b) {
        push(out, floor, Part { x0: part.x0.max(x), ..*part });
    }
}

/// Adds a part; one that goes on where the last of the same segment ended makes that longer.
fn push(out: &mut Vec<Part>, floor: usize, part: Part) {
    if part.x0 >= part.x1 {
        return;
    }
    if out.len() > floor
        && let Some(last) = out.last_mut()
        && last.of == part.of
        && last.x1 == part.x0
    {
        last.x1 = part.x1;
        return;
    }
    out.push(part);
}

/// Which of two segments shows on \[l, r\], where both are present?
fn decide(segments: &[Segment], of: [u32; 2], l: f64, r: f64, mut receive: impl FnMut(Part)) {
    let (s, t) = (&segments[of[0] as usize], &segments[of[1] as usize]);
    let at_l = s.nearness(l) - t.nearness(l);
    let at_r = s.nearness(r) - t.nearness(r);
    let mut part = |x0, x1, first: bool| receive(Part { x0, x1, of: of[usize::from(!first)] });
    let error = f64::from(s.error) + f64::from(t.error);
    let sign = |d: f64| i32::from(d > error) - i32::from(d < -error);
    match (sign(at_l), sign(at_r)) {
        // They lie in one plane as far as can be told: the first face shows, wherever this is asked.
        (0, 0) => part(l, r, s.face < t.face || (s.face == t.face && of[0] < of[1])),
        (1, -1) | (-1, 1) => {
            let x = (l + (r - l) * (at_l / (at_l - at_r))).clamp(l, r);
            part(l, x, at_l > 0.0);
            part(x, r, at_r > 0.0);
        }
        (left, right) => part(l, r, left + right > 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WIDTH: f64 = 64.0;

    fn segment(face: u32, x0: f64, length: f64, w: f64, slope: f64) -> Segment {
        Segment { x0, x1: (x0 + length).min(WIDTH), w, slope, error: 1e-13, face, ..Segment::default() }
    }

    fn nearest(segments: &[Segment], x: f64) -> Option<f64> {
        let here = segments.iter().filter(|s| s.x0 <= x && x <= s.x1);
        here.map(|s| s.nearness(x)).max_by(f64::total_cmp)
    }

    proptest! {
        /// 60 long segments are deep enough to be culled; few and short ones are not.
        #[test]
        fn the_nearest_shows_everywhere(
            numbers in prop::collection::vec((0f64..60.0, 0.01f64..64.0, 0f64..1.0, -0.01f64..0.01), 0..120),
            shrink in prop::bool::ANY,
        ) {
            let scale = if shrink { 0.05 } else { 1.0 };
            let all: Vec<_> = (0u32..).zip(&numbers)
                .map(|(face, &(x, length, w, slope))| segment(face, x, length * scale, w, slope))
                .collect();
            let mut visible = Vec::new();
            Envelope::default().find(&mut all.clone(), WIDTH, &mut visible);
            for pair in visible.windows(2) {
                prop_assert!(pair[0].x1 <= pair[1].x0);
            }
            for i in 0..640 {
                let x = f64::from(i) * 0.1 + 0.0123;
                let shown = visible.iter().find(|s| s.x0 <= x && x <= s.x1).map(|s| s.nearness(x));
                match (shown, nearest(&all, x)) {
                    // Two errors of 1e-13, and as much again for a border between two equal ones.
                    (Some(shown), Some(nearest)) => prop_assert!((shown - nearest).abs() <= 4e-13),
                    (shown, nearest) => prop_assert_eq!(shown, nearest),
                }
            }
        }
    }
}
