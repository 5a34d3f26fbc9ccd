//! Where on a face's line does a source's light begin and end?

use std::sync::Arc;

use glam::{DVec2, DVec3};
use light::{Known, Occlude, PointSource, Projection, Stretch, Triangle, View};

/// Who is asked, about which sources.
pub(crate) struct Shadows {
    /// Bit of the source's number in [`Known`].
    pub(crate) sources: Vec<(u64, PointSource)>,
    pub(crate) occlude: Arc<dyn Occlude>,
    /// Spans narrower than this are not cut \[pixel\].
    pub(crate) least: f64,
}

/// What a source does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reach {
    /// All of it arrives.
    Lit,
    /// Only a ray can tell.
    Ask,
    /// Nothing of it arrives.
    Dark,
}

impl Reach {
    /// Says so of the source with `bit`.
    pub(crate) fn note(self, bit: u64, known: &mut Known) {
        known.lit = if self == Self::Lit { known.lit | bit } else { known.lit & !bit };
        known.dark = if self == Self::Dark { known.dark | bit } else { known.dark & !bit };
    }
}

/// From screen x `x` on to the right (or to the next change), a source does this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Change {
    pub(crate) x: f64,
    pub(crate) reach: Reach,
}

/// A straight line on a face that shows between two x of a line of the picture.
pub(crate) struct Chord {
    x: [f64; 2],
    ends: [DVec3; 2],
    /// Depths of the ends, or 1 where the projection is parallel.
    depths: [f64; 2],
}

impl Chord {
    /// Where the plane of a face shows at height `y` from `x[0]` to `x[1]`. None for faces seen edge-on and for what
    /// lies behind the eye.
    pub(crate) fn new(view: &View, face: &Triangle, y: f64, x: [f64; 2]) -> Option<Self> {
        if x[0] >= x[1] || x[0].is_nan() || x[1].is_nan() {
            return None;
        }
        let forward = -view.world_from_view.z_axis;
        let [a, b, c] = face.0;
        let end = |x: f64| {
            let (origin, direction) = view.line(DVec2::new(x, y));
            let weights = face.meet(origin, direction)?;
            let point = a + (b - a) * weights.x + (c - a) * weights.y;
            let depth = match view.projection {
                Projection::Perspective { .. } => forward.dot(point - view.eye),
                Projection::Orthographic { .. } => 1.0,
            };
            (depth > 0.0 && depth.is_finite() && point.is_finite()).then_some((point, depth))
        };
        let (left, right) = (end(x[0])?, end(x[1])?);
        Some(Self { x, ends: [left.0, right.0], depths: [left.1, right.1] })
    }

    /// Screen x of the point at share `t` of the way: 1/depth is linear on the screen, hence with depths d₀, d₁
    /// x = x₀ + (x₁ − x₀) t d₁/((1 − t) d₀ + t d₁).
    fn x(&self, t: f64) -> f64 {
        let [near, far] = [(1.0 - t) * self.depths[0], t * self.depths[1]];
        let x = self.x[0] + (self.x[1] - self.x[0]) * (far / (near + far));
        x.clamp(self.x[0], self.x[1])
    }
}

/// Working memory.
#[derive(Default)]
pub(crate) struct Asked {
    stretches: Vec<Stretch>,
    /// (share of the way, stretches that begin less those that end: dark ones, and ones to ask about).
    events: Vec<(f64, i32, i32)>,
}

impl Asked {
    /// Replaces `out` by what `source` does along a chord: the first change stands at its left end.
    pub(crate) fn changes(
        &mut self,
        occlude: &dyn Occlude,
        source: &PointSource,
        chord: &Chord,
        out: &mut Vec<Change>,
    ) {
        out.clear();
        self.stretches.clear();
        let left = chord.x[0];
        if !occlude.shadows(source, chord.ends[0], chord.ends[1], &mut self.stretches) {
            return out.push(Change { x: left, reach: Reach::Ask });
        }
        self.events.clear();
        for stretch in &self.stretches {
            let (from, to) = (stretch.from.max(0.0), stretch.to.min(1.0));
            if from < to {
                let (dark, ask) = (i32::from(stretch.dark), i32::from(!stretch.dark));
                self.events.extend([(from, dark, ask), (to, -dark, -ask)]);
            }
        }
        self.events.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        out.push(Change { x: left, reach: Reach::Lit });
        let (mut dark, mut ask) = (0, 0);
        for (i, event) in self.events.iter().enumerate() {
            (dark, ask) = (dark + event.1, ask + event.2);
            let together = self.events.get(i + 1).is_some_and(|next| next.0 == event.0);
            if together || event.0 >= 1.0 {
                continue;
            }
            let reach = match (dark, ask) {
                (0, 0) => Reach::Lit,
                (0, _) => Reach::Ask,
                _ => Reach::Dark,
            };
            let x = chord.x(event.0);
            // What has no width on the screen does not show: neither at the end nor before the next change.
            if chord.x[1] - x > SAME {
                push(out, Change { x, reach });
            }
        }
    }
}

/// Adds a change if it is one.
fn push(out: &mut Vec<Change>, change: Change) {
    while out.last().is_some_and(|last| change.x - last.x <= SAME) && out.len() > 1 {
        out.pop();
    }
    match out.as_mut_slice() {
        [first] if change.x - first.x <= SAME => first.reach = change.reach,
        [.., last] if last.reach == change.reach => {}
        _ => out.push(change),
    }
}

/// Changes nearer to each other than this are one \[pixel\]: far more than rounding, far less than shows.
pub(crate) const SAME: f64 = 1.0 / (1u64 << 30) as f64;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Answers what it was given.
    struct Given(Vec<Stretch>);

    impl Occlude for Given {
        fn transmittance(&self, _: &light::Ray) -> light::Spectrum {
            light::Spectrum::ONE
        }

        fn shadows(&self, _: &PointSource, _: DVec3, _: DVec3, out: &mut Vec<Stretch>) -> bool {
            out.extend_from_slice(&self.0);
            true
        }
    }

    #[test]
    fn what_has_no_width_does_not_show() {
        let dark = |from: f64, to: f64| Stretch { from, to, dark: true };
        let chord = Chord { x: [3.0, 17.0], ends: [DVec3::ZERO, DVec3::X], depths: [1.0, 2.0] };
        let source = PointSource::Toward(DVec3::Y);
        for stretches in [[dark(0.0, 1e-13), dark(0.5, 0.5 + 1e-13)], [dark(1.0 - 1e-13, 1.0); 2]] {
            let mut changes = Vec::new();
            Asked::default().changes(&Given(stretches.into()), &source, &chord, &mut changes);
            assert_eq!(changes, [Change { x: 3.0, reach: Reach::Lit }]);
        }
    }

    proptest! {
        /// Whatever stretches overlap, beyond the segment, empty or reversed: dark before asked before lit, and
        /// neighbours differ.
        #[test]
        fn every_place_is_told_of(
            stretches in prop::collection::vec((-0.2f64..1.2, -0.2f64..1.2, prop::bool::ANY), 0..12),
            depths in (0.1f64..10.0, 0.1f64..10.0),
        ) {
            let stretches: Vec<Stretch> =
                stretches.iter().map(|&(from, to, dark)| Stretch { from, to, dark }).collect();
            let chord = Chord { x: [3.0, 17.0], ends: [DVec3::ZERO, DVec3::X], depths: depths.into() };
            let mut changes = Vec::new();
            let source = PointSource::Toward(DVec3::Y);
            Asked::default().changes(&Given(stretches.clone()), &source, &chord, &mut changes);
            prop_assert_eq!(changes[0].x, 3.0);
            prop_assert!(changes.windows(2).all(|w| w[0].x < w[1].x && w[0].reach != w[1].reach));
            for i in 0..97 {
                let t = (f64::from(i) + 0.5) / 97.0;
                // Ends of stretches themselves belong to neither side.
                if stretches.iter().any(|s| (s.from - t).abs() < 1e-6 || (s.to - t).abs() < 1e-6) {
                    continue;
                }
                let over = |dark| stretches.iter().any(|s| s.dark == dark && s.from < t && t < s.to);
                let expected = match (over(true), over(false)) {
                    (true, _) => Reach::Dark,
                    (false, true) => Reach::Ask,
                    _ => Reach::Lit,
                };
                let at = changes.partition_point(|change| change.x <= chord.x(t)) - 1;
                prop_assert_eq!(changes[at].reach, expected);
            }
        }
    }
}
