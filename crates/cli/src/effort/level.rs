//! How much effort one knob gets: a number from draft to reference and beyond.

use crate::knobs::{Domain, Knob};

/// Effort, from 0 on: 0, 3 and 6 are the presets draft, normal and reference; between them and beyond, numbers go in even ratios.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Level(pub(super) u8);

/// Levels from one preset to the next.
const STEP: u8 = 3;

impl Level {
    /// What a knob is set to.
    pub(super) fn value(self, knob: &Knob) -> String {
        let presets = knob.presets.map(|preset| preset.parse::<f64>().ok().filter(|value| *value > 0.0));
        match (&knob.domain, presets) {
            (Domain::Integer(low, high), [Some(a), Some(b), Some(c)]) => {
                self.between([a, b, c]).round().clamp(f64::from(*low), f64::from(*high)).to_string()
            }
            (Domain::Number(low, high) | Domain::OwnOr(low, high), [Some(a), Some(b), Some(c)]) => {
                self.between([a, b, c]).clamp(*low, *high).to_string()
            }
            // Names, and numbers of which 0 is one, have nothing in between.
            _ => knob.presets[usize::from((self.0 + 1) / STEP).min(2)].to_owned(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knobs::{KNOBS, Preset, Settings};

    #[test]
    fn every_third_level_is_a_preset() {
        for (level, preset) in [(0, Preset::Draft), (3, Preset::Normal), (6, Preset::Reference)] {
            let wanted = Settings::preset(preset);
            for knob in KNOBS {
                let value = Level(level).value(knob);
                let [a, b] = [value.as_str(), wanted.choice(knob.name)].map(|text| text.parse::<f64>());
                match (a, b) {
                    // Even ratios round.
                    (Ok(a), Ok(b)) => assert!((a - b).abs() <= 1e-12 * b, "{} {a} {b}", knob.name),
                    _ => assert_eq!(value, wanted.choice(knob.name)),
                }
            }
        }
    }

    #[test]
    fn every_level_can_be_set() {
        for level in 0..=12 {
            let mut settings = Settings::preset(Preset::Normal);
            for knob in KNOBS {
                settings.set(knob.name, &Level(level).value(knob), "a level").unwrap();
            }
        }
    }

    #[test]
    fn more_effort_asks_more_rays() {
        let knob = KNOBS.iter().find(|knob| knob.name == "sky.rays").unwrap();
        let rays = |level: u8| Level(level).value(knob).parse::<u32>().unwrap();
        assert!((1..=12).all(|level| rays(level) > rays(level - 1)));
    }
}
