//! `--error`: the least effort that leaves no more than so much error, found on the scene itself and checked.
//!
//! What is judged is sampling and resolution: answers against those of much more effort by the same models. What models leave out
//! is not in it (`keikan measure` and the book say that).

mod error;
mod level;
mod lux;
mod picture;
mod sample;

use std::fmt;
use std::time::Instant;

use scene::Scene;

pub(crate) use error::Off;
pub use error::Wanted;
use level::{Level, expected};
pub(crate) use lux::table;
pub(crate) use picture::shot;
use sample::Purpose;

use crate::Error;
use crate::args::View;
use crate::knobs::Settings;
use crate::plan::Plan;

/// Where the search begins: below the default, where many pictures are good enough.
const FIRST: Level = Level(2);

/// What was asked and what came of it.
#[derive(Clone, Debug, serde::Serialize)]
pub(crate) struct Verdict {
    /// The error asked for, as a share.
    pub(crate) asked: f64,
    /// What it is, by pixels or points that nothing was chosen by, made again with much more effort.
    pub(crate) reached: Off,
    /// Effort of the result: 0, 3, 6 are draft, normal, reference.
    pub(crate) effort: u8,
    /// Knobs that differ from the preset asked for.
    pub(crate) set: Vec<(String, String)>,
    /// Seconds for the result itself.
    pub(crate) seconds: f64,
    /// Seconds for choosing and for checking.
    pub(crate) seconds_besides: f64,
    /// What is made again.
    #[serde(skip)]
    what: &'static str,
}

/// What is asked for, before any effort.
struct Base<'a> {
    scene: &'a Scene,
    view: &'a View,
    settings: Settings,
}

impl<'a> Base<'a> {
    fn new(scene: &'a Scene, view: &'a View, plan: Plan) -> Self {
        Self { scene, view, settings: plan.settings }
    }

    /// What a level sets of what nobody else has.
    fn set(&self, level: Level) -> Vec<(String, String)> {
        let set = level.settings(|name| self.settings.is_set(name) || !self.matters(name));
        set.into_iter().filter(|(name, value)| self.settings.choice(name) != value).collect()
    }

    /// Whether a knob has anything to decide here.
    fn matters(&self, knob: &str) -> bool {
        let (scene, settings) = (self.scene, &self.settings);
        match knob.split_once('.').map_or(knob, |(group, _)| group) {
            "water" => !scene.waters.is_empty(),
            "trees" => !scene.trees.is_empty(),
            "lamp" => !scene.area_lights.is_empty(),
            "body" => !scene.solids.is_empty(),
            "interreflection" => settings.choice("interreflection") != "off",
            "samples" => settings.choice("visibility") == "rays",
            "sky" => match settings.choice("sky.visibility") {
                _ if knob.starts_with("sky.map.") => settings.choice("sky.map") == "on",
                "cuboid" => matches!(knob, "sky.elements" | "sky.parts"),
                "bands" => knob == "sky.bands",
                _ => matches!(knob, "sky.rays" | "sky.sensor-rays" | "sky.patches"),
            },
            _ => true,
        }
    }

    /// The view with that on top.
    fn view(&self, level: Level) -> View {
        View { set: [&self.view.set[..], &self.set(level)].concat(), ..self.view.clone() }
    }
}

/// What can be made with more or less effort.
trait Subject {
    /// The whole.
    type Whole;

    /// What is sampled: `pixels`, `sensor points`.
    const WHAT: &'static str;

    /// The highest effort it is made with.
    const TOP: Level;

    /// What it is made from.
    fn base(&self) -> &Base<'_>;

    /// A few of its numbers alone, with this effort.
    fn some(&mut self, level: Level, purpose: Purpose) -> Result<Vec<[f64; 3]>, Error>;

    /// All of it.
    fn whole(&mut self, level: Level) -> Result<Self::Whole, Error>;

    /// The same numbers of the whole.
    fn of(&self, whole: &Self::Whole, purpose: Purpose) -> Vec<[f64; 3]>;
}

/// Judges answers by those of much more effort, each asked for once.
struct Judge<'a, S> {
    subject: &'a mut S,
    kept: Vec<(Level, Purpose, Vec<[f64; 3]>)>,
}

impl<S: Subject> Judge<'_, S> {
    /// What numbers of this effort should have been: by three levels more, whose own errors are a third of theirs and less, and by the
    /// preset `reference` at least.
    fn truth(&mut self, level: Level, purpose: Purpose) -> Result<&[[f64; 3]], Error> {
        let judge = Level((level.0 + 3).max(6));
        let known = |(level, of, _): &(Level, Purpose, _)| *level == judge && *of == purpose;
        if !self.kept.iter().any(known) {
            let numbers = self.subject.some(judge, purpose)?;
            self.kept.push((judge, purpose, numbers));
        }
        Ok(self.kept.iter().find(|kept| known(kept)).map_or(&[], |(.., numbers)| numbers))
    }

    /// How far a few numbers of this effort are off.
    fn pilot(&mut self, level: Level) -> Result<f64, Error> {
        let numbers = self.subject.some(level, Purpose::Pilot)?;
        Ok(Off::new(&numbers, self.truth(level, Purpose::Pilot)?).most())
    }

    /// The least effort that the pilot finds good enough; the highest where none is.
    fn least(&mut self, wanted: f64) -> Result<Level, Error> {
        let (mut level, mut too_low) = (FIRST, None);
        loop {
            let found = self.pilot(level)?;
            let next = expected((level, S::TOP), found, wanted);
            let next = if found <= wanted {
                // Nothing that was too little before.
                too_low.map_or(next, |low: Level| next.max(Level(low.0 + 1)))
            } else {
                too_low = Some(level);
                next
            };
            if next == level || (found <= wanted && next > level) {
                return Ok(level);
            }
            level = next;
        }
    }
}

/// Finds the effort by a pilot of a few numbers, makes the whole and judges it by others; again with more while that, with its own
/// uncertainty, is too much.
fn honoured<S: Subject>(subject: &mut S, wanted: Wanted) -> Result<(S::Whole, Verdict), Error> {
    let start = Instant::now();
    let mut judge = Judge { subject, kept: Vec::new() };
    let mut level = judge.least(wanted.0)?;
    loop {
        let begun = Instant::now();
        let whole = judge.subject.whole(level)?;
        let seconds = begun.elapsed().as_secs_f64();
        let numbers = judge.subject.of(&whole, Purpose::Check);
        let reached = Off::new(&numbers, judge.truth(level, Purpose::Check)?);
        if reached.most() <= wanted.0 || level == S::TOP {
            let seconds_besides = start.elapsed().as_secs_f64() - seconds;
            let (asked, effort, set) = (wanted.0, level.0, judge.subject.base().set(level));
            return Ok((
                whole,
                Verdict { asked, reached, effort, set, seconds, seconds_besides, what: S::WHAT },
            ));
        }
        level = expected((level, S::TOP), reached.most(), wanted.0);
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { asked, reached, effort, seconds, seconds_besides, what, .. } = self;
        let missed = match (reached.relative_rmse > *asked, reached.most() > *asked) {
            (true, _) => ", not reached",
            (_, true) => ", perhaps not reached",
            _ => "",
        };
        writeln!(
            f,
            "error: asked {:.2} %, found {reached}{missed} ({} {what} made again with much more effort)",
            100.0 * asked,
            reached.count
        )?;
        let set: Vec<String> = self.set.iter().map(|(knob, value)| format!("{knob}={value}")).collect();
        writeln!(f, "effort {effort} (3 = normal, 6 = reference): {}", set.join(" "))?;
        write!(f, "{seconds:.2} s for the result, {seconds_besides:.2} s to choose and to check")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whose error falls by `fall` a level from what it is at level 0, as pilot and check see it.
    struct Falling<'a> {
        base: Base<'a>,
        pilot: f64,
        check: f64,
        fall: f64,
        made: Vec<u8>,
    }

    impl Falling<'_> {
        fn error(&self, level: Level, purpose: Purpose) -> Vec<[f64; 3]> {
            let first = if purpose == Purpose::Pilot { self.pilot } else { self.check };
            let off = first / self.fall.powi(i32::from(level.0));
            vec![[1.0 + off; 3]; 4]
        }
    }

    impl Subject for Falling<'_> {
        type Whole = Level;
        const WHAT: &'static str = "numbers";
        const TOP: Level = Level(6);

        fn base(&self) -> &Base<'_> {
            &self.base
        }

        fn some(&mut self, level: Level, purpose: Purpose) -> Result<Vec<[f64; 3]>, Error> {
            Ok(self.error(level, purpose))
        }

        fn whole(&mut self, level: Level) -> Result<Level, Error> {
            self.made.push(level.0);
            Ok(level)
        }

        fn of(&self, level: &Level, purpose: Purpose) -> Vec<[f64; 3]> {
            self.error(*level, purpose)
        }
    }

    fn asked(pilot: f64, check: f64, fall: f64) -> (Verdict, Vec<u8>) {
        let scene = crate::command::load(None).unwrap();
        let view = View::default();
        let base = Base::new(&scene, &view, Plan::new(&scene, &view).unwrap());
        let mut subject = Falling { base, pilot, check, fall, made: Vec::new() };
        let (_, verdict) = honoured(&mut subject, Wanted(0.02)).unwrap();
        (verdict, subject.made)
    }

    #[test]
    fn the_least_effort_is_found() {
        for (first, fall) in [(0.2, 1.5), (0.3, 2.5), (0.05, 1.3), (0.019, 1.5), (0.3, 8.0)] {
            let (verdict, made) = asked(first, first, fall);
            // What judges has an error too: of the same sign here, so that differences are smaller.
            let found = |level: u8| {
                let at = |level: u8| first / f64::powi(fall, i32::from(level));
                let truth = at((level + 3).max(6));
                (at(level) - truth) / (1.0 + truth)
            };
            let least = (0..=6).find(|level| found(*level) <= 0.02).unwrap();
            assert!(verdict.reached.relative_rmse <= 0.02, "{verdict}");
            // Errors that fall faster than is expected may leave it one too high.
            assert!(
                verdict.effort >= least && verdict.effort <= least + 1,
                "{first} {fall}: {} {least}",
                verdict.effort
            );
            assert_eq!(made, [verdict.effort]);
        }
    }

    #[test]
    fn a_check_that_says_more_is_believed() {
        let (verdict, made) = asked(0.03, 0.09, 1.5);
        assert!(verdict.reached.relative_rmse <= 0.02 && made.len() > 1);
    }

    #[test]
    fn what_cannot_be_reached_is_said() {
        let (verdict, _) = asked(3.0, 3.0, 1.2);
        assert_eq!(verdict.effort, 6);
        assert!(verdict.to_string().contains("not reached"));
    }
}
