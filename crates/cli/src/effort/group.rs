//! Knobs that one kind of error hangs on, and how much effort each kind gets.

use std::fmt;

use super::level::Level;
use crate::knobs::{Domain, KNOBS, Knob};

/// Knobs that are raised together: what one of them leaves the others cannot make good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Group {
    /// Which share of a pixel each face has, and curved bodies.
    Edges,
    /// Whether a pixel's faces are shaded once or by spans.
    Shading,
    /// How far mirrored and refracted rays are followed.
    Depth,
    /// The sun's disc.
    Sun,
    /// Lamps with an extent.
    Lamps,
    /// How much of the sky is seen.
    Sky,
    /// Sky among leaves.
    Trees,
    /// Patches and links.
    Interreflection,
    /// Light scattered by water and arriving through it.
    Water,
    /// Light that waves gather.
    Caustics,
}

impl Group {
    /// All; those that change most of what is assembled last.
    pub(super) const ALL: [Self; 10] = [
        Self::Edges,
        Self::Shading,
        Self::Depth,
        Self::Sun,
        Self::Lamps,
        Self::Sky,
        Self::Trees,
        Self::Interreflection,
        Self::Water,
        Self::Caustics,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Edges => "edges",
            Self::Shading => "shading",
            Self::Depth => "depth",
            Self::Sun => "sun",
            Self::Lamps => "lamps",
            Self::Sky => "sky",
            Self::Interreflection => "interreflection",
            Self::Water => "water",
            Self::Caustics => "caustics",
            Self::Trees => "trees",
        }
    }

    /// What must be assembled anew when it changes.
    pub(super) fn anew(self) -> Anew {
        match self {
            Self::Edges | Self::Shading | Self::Depth => Anew::Eye,
            Self::Sun | Self::Lamps | Self::Sky | Self::Trees | Self::Interreflection => Anew::Lights,
            Self::Water | Self::Caustics => Anew::Things,
        }
    }

    /// Of a knob; none for what changes no answer (`bvh-quality`), is another model rather than more of the same (`trees.planes`), or is
    /// the same in all presets.
    pub(super) fn of(knob: &Knob) -> Option<Self> {
        let [draft, normal, reference] = knob.presets;
        if draft == normal && normal == reference {
            return None;
        }
        match knob.name {
            "sub-scanlines" | "samples" | "body.samples" | "body.tolerance" => Some(Self::Edges),
            "shading" => Some(Self::Shading),
            "ray-depth" | "ray-share" => Some(Self::Depth),
            "sun.samples" => Some(Self::Sun),
            "lamp.samples" => Some(Self::Lamps),
            "trees.sky-rays" => Some(Self::Trees),
            name if name.starts_with("sky.") => Some(Self::Sky),
            name if name.starts_with("interreflection.") => Some(Self::Interreflection),
            name if name.starts_with("water.caustics") => Some(Self::Caustics),
            name if name.starts_with("water.") => Some(Self::Water),
            _ => None,
        }
    }

    /// Whether a knob by its name is one of who finds what the eye sees, of which sensors know nothing.
    pub(super) fn of_eye(name: &str) -> bool {
        KNOBS
            .iter()
            .filter(|knob| knob.name == name)
            .filter_map(Self::of)
            .any(|group| group.anew() == Anew::Eye)
    }

    /// The next level that may change anything: where a stage has a name, that of another name.
    fn next(self, level: Level, top: Level) -> Option<Level> {
        let top = if self == Self::Interreflection { top.min(MOST_PATCHES) } else { top };
        let own = |knob: &&Knob| Self::of(knob) == Some(self);
        let mut above = (level.0 + 1..=top.0).map(Level);
        let named = |knob: &Knob| matches!(knob.domain, Domain::Choice(_));
        let renamed = |above: Level| {
            KNOBS.iter().filter(own).any(|knob| named(knob) && above.value(knob) != level.value(knob))
        };
        let by_name = above.clone().find(|above| renamed(*above));
        let only_named = KNOBS.iter().filter(own).all(named);
        if only_named { by_name } else { by_name.or_else(|| above.next()) }
    }
}

/// Patches are raised no further: what judges has three levels more, and finer ones than those take gigabytes to link.
const MOST_PATCHES: Level = Level(3);

/// What must be assembled anew for another effort; each with those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Anew {
    /// Who finds what the eye sees.
    Eye,
    /// The sources.
    Lights,
    /// What stands there.
    Things,
}

/// A level for each group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Effort([Level; Group::ALL.len()]);

/// By how much errors fall from one level to the next, about: those of edges by 1.47 (`sub-scanlines`: 0.063, 0.020 for 4, 8), the sky's by
/// 1.73 (`sky.rays`: 2.7, 0.9 % for 64, 256), those of lamps with an extent by 2.2 (`lamp.samples`: 3.1, 0.3 % for 16, 256).
const FALL: f64 = 1.5;

impl Effort {
    /// The preset draft: where the search begins.
    pub(super) const LEAST: Self = Self([Level(0); Group::ALL.len()]);

    /// Of a group.
    pub(super) fn level(&self, group: Group) -> Level {
        self.0[group as usize]
    }

    /// With another level of a group.
    pub(super) fn with(mut self, group: Group, level: Level) -> Self {
        self.0[group as usize] = level;
        self
    }

    /// Values of all knobs that it decides, but those that are `taken`; in the order of all.
    pub(super) fn settings(&self, taken: impl Fn(&str) -> bool) -> Vec<(&'static Knob, String)> {
        let set = |knob: &'static Knob| {
            let level = self.level(Group::of(knob)?);
            (!taken(knob.name)).then(|| (knob, level.value(knob)))
        };
        KNOBS.iter().filter_map(set).collect()
    }

    /// What judges it: three levels more of everything; shading by spans; rays through glass as far as the preset `reference` follows
    /// them, but no further, because they branch. What is cheap to ask, and slow to fall from draft to normal, at least as `reference`
    /// has it.
    pub(super) fn judge(&self) -> Self {
        let above = |group: Group| {
            let level = Level(self.level(group).0 + 3);
            match group {
                Group::Shading | Group::Depth => Level(6),
                Group::Edges | Group::Water | Group::Trees => level.max(Level(6)),
                _ => level,
            }
        };
        Self(Group::ALL.map(above))
    }

    /// The effort that may be expected to leave `wanted` where this leaves `found`, of which each group has a part (`parts`, squares of
    /// errors, in any unit): whichever has most is raised, again and again. None where nothing more can be raised.
    pub(super) fn raised(
        &self,
        parts: &[(Group, f64)],
        top: Level,
        [found, wanted]: [f64; 2],
    ) -> Option<Self> {
        let whole: f64 = parts.iter().map(|(_, part)| part).sum();
        let mut raised = *self;
        let left = |effort: &Self, &(group, part): &(Group, f64)| {
            let levels = effort.level(group).0 - self.level(group).0;
            part / whole * (found / FALL.powi(i32::from(levels))).powi(2)
        };
        loop {
            let all: f64 = parts.iter().map(|part| left(&raised, part)).sum();
            let above = |group: Group| group.next(raised.level(group), top);
            let can = parts.iter().filter(|(group, part)| *part > 0.0 && above(*group).is_some());
            let most = can.max_by(|a, b| left(&raised, a).total_cmp(&left(&raised, b)));
            let most = most.filter(|part| all > wanted.powi(2) && left(&raised, part) > NEGLIGIBLE * all);
            let Some((group, level)) = most.and_then(|(group, _)| Some((*group, above(*group)?))) else {
                break;
            };
            raised = raised.with(group, level);
        }
        (raised != *self).then_some(raised)
    }
}

/// The share of all squared error below which nothing is done about a part: where what cannot be raised has the rest.
const NEGLIGIBLE: f64 = 0.02;

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let raised: Vec<String> = Group::ALL
            .into_iter()
            .filter(|group| self.level(*group) > Level(0))
            .map(|group| format!("{} {}", group.name(), self.level(group).0))
            .collect();
        if raised.is_empty() { write!(f, "0") } else { write!(f, "0, but {}", raised.join(", ")) }
    }
}

impl serde::Serialize for Effort {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(Group::ALL.map(|group| (group.name(), self.level(group).0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knobs_of_an_effort_are_those_of_their_groups() {
        let effort = Effort::LEAST.with(Group::Sky, Level(6));
        let settings = effort.settings(|name| name == "sky.patches");
        let value = |wanted: &str| {
            settings.iter().find(|(knob, _)| knob.name == wanted).map(|(_, value)| value.as_str())
        };
        assert_eq!(value("sky.rays"), Some("512"));
        assert_eq!(value("sun.samples"), Some("1"));
        assert_eq!(value("sky.patches"), None);
        assert_eq!(value("bvh-quality"), None);
    }

    #[test]
    fn what_has_most_of_the_error_is_raised() {
        let raised = |parts: &[(Group, f64)], found: f64| {
            Effort::LEAST.raised(parts, Level(6), [found, 0.02]).map(|effort| effort.to_string())
        };
        assert_eq!(raised(&[(Group::Sky, 1.0), (Group::Sun, 0.0)], 0.03), Some("0, but sky 1".to_owned()));
        assert_eq!(raised(&[(Group::Sky, 8.0), (Group::Sun, 1.0)], 0.03), Some("0, but sky 2".to_owned()));
        assert_eq!(
            raised(&[(Group::Sky, 1.0), (Group::Sun, 1.0)], 0.03),
            Some("0, but sun 1, sky 1".to_owned())
        );
        assert_eq!(raised(&[(Group::Sky, 1.0)], 1000.0), Some("0, but sky 6".to_owned()));
        assert_eq!(raised(&[], 1.0), None);
        // Where nothing helps, nothing is done.
        let full = Effort::LEAST.with(Group::Sky, Level(6));
        assert_eq!(full.raised(&[(Group::Sky, 1.0), (Group::Sun, 0.001)], Level(6), [0.5, 0.02]), None);
    }

    #[test]
    fn stages_with_names_are_raised_to_another_name() {
        assert_eq!(Group::Shading.next(Level(0), Level(6)), Some(Level(5)));
        assert_eq!(Group::Shading.next(Level(5), Level(6)), None);
        assert_eq!(Group::Caustics.next(Level(0), Level(6)), Some(Level(2)));
        assert_eq!(Group::Caustics.next(Level(2), Level(6)), Some(Level(3)));
    }

    #[test]
    fn the_judge_has_more_of_everything() {
        for level in 0..=6 {
            let effort =
                Effort(Group::ALL.map(|group| group.next(Level(level), Level(6)).unwrap_or(Level(0))));
            let judge = effort.judge();
            for group in Group::ALL {
                let values = |effort: &Effort| -> Vec<String> {
                    let own =
                        |(knob, value): (&Knob, String)| (Group::of(knob) == Some(group)).then_some(value);
                    effort.settings(|_| false).into_iter().filter_map(own).collect()
                };
                // At most as deep and by the same spans.
                let same = matches!(group, Group::Shading | Group::Depth) && effort.level(group) >= Level(5);
                assert!(same || values(&judge) != values(&effort), "{group:?} at {level}");
            }
        }
        let judge = Effort::LEAST.with(Group::Sky, Level(5)).judge();
        assert_eq!((judge.level(Group::Edges), judge.level(Group::Sky)), (Level(6), Level(8)));
    }
}
