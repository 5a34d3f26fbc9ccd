//! How much effort: one number for all knobs that trade time for accuracy.

use crate::knobs::{Domain, KNOBS, Knob};

/// Effort, from 0 on: 0, 3 and 6 are the presets draft, normal and reference; between them and beyond, numbers go in even ratios.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Level(pub(super) u8);

/// Levels from one preset to the next.
const STEP: u8 = 3;

/// Patches grow no finer than at this level: their links grow faster than errors fall.
const FINEST_PATCHES: Level = Level(5);

impl Level {
    /// Values of all knobs that it decides, but those that the user has (`taken`).
    pub(super) fn settings(self, taken: impl Fn(&str) -> bool) -> Vec<(String, String)> {
        let decides = |knob: &&Knob| {
            let [draft, normal, reference] = knob.presets;
            (draft != normal || normal != reference) && !taken(knob.name)
        };
        KNOBS.iter().filter(decides).map(|knob| (knob.name.to_owned(), self.value(knob))).collect()
    }

    fn value(self, knob: &Knob) -> String {
        let level = if knob.name.starts_with("interreflection.") { self.min(FINEST_PATCHES) } else { self };
        let presets = knob.presets.map(|preset| preset.parse::<f64>().ok().filter(|value| *value > 0.0));
        match (&knob.domain, presets) {
            (Domain::Integer(low, high), [Some(a), Some(b), Some(c)]) => {
                level.between([a, b, c]).round().clamp(f64::from(*low), f64::from(*high)).to_string()
            }
            (Domain::Number(low, high) | Domain::OwnOr(low, high), [Some(a), Some(b), Some(c)]) => {
                level.between([a, b, c]).clamp(*low, *high).to_string()
            }
            // Names, and numbers of which 0 is one, have nothing in between.
            _ => knob.presets[usize::from((level.0 + 1) / STEP).min(2)].to_owned(),
        }
    }

    /// In even ratios through the presets, and on in the ratio of the last two.
    fn between(self, [draft, normal, reference]: [f64; 3]) -> f64 {
        let share = |from: u8| (f64::from(self.0) - f64::from(from)) / f64::from(STEP);
        if self.0 < STEP {
            draft * (normal / draft).powf(share(0))
        } else {
            normal * (reference / normal).powf(share(STEP))
        }
    }
}

/// By how much errors fall from one level to the next, at least: those of edges by 1.5 (`sub-scanlines`: 0.063, 0.020 for 4, 8), the
/// sky's by 1.6 (`sky.rays`: 2.7, 0.9 % for 64, 256), those of lamps with an extent by 1.9 (`lamp.samples`: 3.1, 0.3 % for 16, 256).
const FALL: f64 = 1.5;

/// The lowest level up to `top` whose error may be expected to be `wanted` where that of `level` is `found`; at least one higher where
/// that is too much.
pub(super) fn expected((level, top): (Level, Level), found: f64, wanted: f64) -> Level {
    let steps = (found / wanted).ln() / FALL.ln();
    let steps = if found > wanted { steps.ceil().max(1.0) } else { steps.ceil() };
    Level((f64::from(level.0) + steps).clamp(0.0, f64::from(top.0)) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knobs::{Preset, Settings};

    #[test]
    fn every_third_level_is_a_preset() {
        for (level, preset) in [(0, Preset::Draft), (3, Preset::Normal), (6, Preset::Reference)] {
            let wanted = Settings::preset(preset);
            // Patches are bounded.
            for (name, value) in Level(level).settings(|name| name.starts_with("interreflection.")) {
                let [a, b] = [value.as_str(), wanted.choice(&name)].map(|text| text.parse::<f64>());
                match (a, b) {
                    // Even ratios round.
                    (Ok(a), Ok(b)) => assert!((a - b).abs() <= 1e-12 * b, "{name} {a} {b}"),
                    _ => assert_eq!(value, wanted.choice(&name)),
                }
            }
        }
    }

    #[test]
    fn every_level_can_be_set() {
        for level in 0..=9 {
            let mut settings = Settings::preset(Preset::Normal);
            for (name, value) in Level(level).settings(|_| false) {
                settings.set(&name, &value, "a level").unwrap();
            }
        }
    }

    #[test]
    fn more_effort_asks_more_rays() {
        let rays = |level: u8| {
            let settings = Level(level).settings(|_| false);
            settings.iter().find(|(name, _)| name == "sky.rays").unwrap().1.parse::<u32>().unwrap()
        };
        assert!((1..=9).all(|level| rays(level) > rays(level - 1)));
    }

    #[test]
    fn too_much_error_asks_for_more_and_little_for_less() {
        let next = |found: f64, wanted: f64| expected((Level(2), Level(7)), found, wanted).0;
        assert_eq!(next(0.02, 0.02), 2);
        assert_eq!(next(0.0201, 0.02), 3);
        assert_eq!(next(0.02 * 1.49f64.powi(3), 0.02), 5);
        assert_eq!(next(0.001, 0.02), 0);
        assert_eq!(next(1.0, 1e-6), 7);
        assert_eq!(next(0.0, 0.02), 0);
    }
}
