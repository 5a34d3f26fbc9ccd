//! One setting, run: how long it took, how much memory, and what came out.

use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Instant;

use scene::Scene;

use crate::args::{Only, View};
use crate::assemble::{Judge, Measuring, Walks};
use crate::output::{self, Picture};
use crate::pipeline::Monitor;
use crate::plan::Plan;
use crate::report::{self, Timings};
use crate::studio::{FrameSpec, Studio};
use crate::{Error, lux};

/// What a setting gives and takes.
pub(super) struct Trial {
    /// Which knobs were set to what.
    pub(super) setting: Vec<(String, String)>,
    /// What it gives.
    pub(super) answer: Answer,
    /// Seconds for the picture without loading, median; and for the sensors.
    pub(super) seconds: [Option<f64>; 2],
    /// Of each run, as it went.
    pub(super) runs: Vec<f64>,
    /// Most memory that the process held meanwhile \[MiB\], where the system tells.
    pub(super) memory_mib: Option<f64>,
    /// Of random walks: root mean square of the standard errors over the mean, of the picture and of the sensors.
    pub(super) noise: [Option<f64>; 2],
}

/// What comes out.
pub(super) struct Answer {
    /// The picture.
    pub(super) picture: Option<Picture>,
    /// Illuminance at each sensor point \[lx\]; empty without any.
    pub(super) lux: Vec<f64>,
}

/// What all trials have in common.
pub(super) struct Trials<'a> {
    pub(super) scene: &'a Scene,
    pub(super) view: &'a View,
    pub(super) only: Option<Only>,
    pub(super) runs: u16,
    pub(super) monitor: &'a Monitor,
}

impl Trials<'_> {
    /// The view with a setting on top of what it says itself.
    pub(super) fn view(&self, setting: &[(String, String)]) -> View {
        View { set: [&self.view.set, setting].concat(), ..self.view.clone() }
    }

    /// Runs one setting.
    ///
    /// # Errors
    /// What rendering or measuring says; [`Error::Interrupted`].
    pub(super) fn run(&self, setting: &[(String, String)]) -> Result<Trial, Error> {
        self.run_view(&self.view(setting), setting)
    }

    /// The same with a view as it is, which is called by the setting.
    pub(super) fn run_view(&self, view: &View, setting: &[(String, String)]) -> Result<Trial, Error> {
        let mut seconds = [Vec::new(), Vec::new()];
        let mut answer = Answer { picture: None, lux: Vec::new() };
        let forgotten = report::forget_peak_memory();
        for _ in 0..self.runs {
            if self.only != Some(Only::Lux) {
                let (picture, took) = self.picture(view)?;
                answer.picture = Some(picture);
                seconds[0].push(took);
            }
            if self.only != Some(Only::Picture) && !self.scene.sensors.is_empty() {
                let (lux, took) = self.lux(view)?;
                answer.lux = lux;
                seconds[1].push(took);
            }
        }
        let memory_mib = report::peak_memory_mib().filter(|_| forgotten);
        let runs = seconds[usize::from(seconds[0].is_empty())].clone();
        Ok(Trial {
            setting: setting.to_vec(),
            answer,
            seconds: seconds.map(median),
            runs,
            memory_mib,
            noise: [None; 2],
        })
    }

    /// What random walks say, `samples` of them from each pixel and sensor point; warns of what they do not see.
    ///
    /// # Errors
    /// As [`Judge::new`].
    pub(super) fn judge(&self, samples: u32) -> Result<Trial, Error> {
        let plan = Plan::new(self.scene, self.view)?;
        let walks = Walks { samples, seed: 1 };
        let judge = Judge::new(&plan, self.scene)?;
        judge.omitted.iter().for_each(|what| eprintln!("warning: the judge: {what}"));
        let mut answer = Answer { picture: None, lux: Vec::new() };
        let (mut seconds, mut noise) = ([None; 2], [None; 2]);
        if self.only != Some(Only::Picture) && !self.scene.sensors.is_empty() {
            let start = Instant::now();
            let judged = judge.lux(self.scene, &walks);
            seconds[1] = Some(start.elapsed().as_secs_f64());
            noise[1] = relative(
                &judged.iter().map(|point| point.error).collect::<Vec<_>>(),
                &judged.iter().map(|point| point.value).collect::<Vec<_>>(),
            );
            answer.lux = judged.iter().map(|point| point.value).collect();
        }
        if self.only != Some(Only::Lux) {
            let start = Instant::now();
            let (film, errors) = judge.picture(&plan, self.scene, &walks)?;
            seconds[0] = Some(start.elapsed().as_secs_f64());
            answer.picture = output::develop(&film).into_iter().next();
            let luminance =
                answer.picture.iter().flat_map(|picture| picture.luminance.iter().map(|y| f64::from(*y)));
            noise[0] = relative(&errors, &luminance.collect::<Vec<_>>());
        }
        self.go_on()?;
        let setting = vec![("judge".to_owned(), format!("{samples} walks"))];
        Ok(Trial { setting, answer, seconds, runs: Vec::new(), memory_mib: None, noise })
    }

    fn go_on(&self) -> Result<(), Error> {
        if self.monitor.interrupted.load(Ordering::Relaxed) { Err(Error::Interrupted) } else { Ok(()) }
    }

    fn picture(&self, view: &View) -> Result<(Picture, f64), Error> {
        let mut seconds = Timings::default();
        let mut studio = Studio::new(self.scene.clone(), view.clone(), false);
        let shot = studio.frame(&FrameSpec::default(), self.monitor, &mut seconds)?;
        let picture = output::develop(&shot.film).into_iter().next();
        let took = seconds.0.iter().map(|(_, seconds)| seconds).sum();
        picture.map(|picture| (picture, took)).ok_or_else(|| Error::Usage("there is no picture".to_owned()))
    }

    fn lux(&self, view: &View) -> Result<(Vec<f64>, f64), Error> {
        let mut seconds = Timings::default();
        let table = seconds.time("lux", || -> Result<_, Error> {
            let plan = Plan::new(self.scene, view)?.at_sensors();
            Ok(lux::measure(self.scene, &Measuring::new(&plan, self.scene)?))
        })?;
        self.go_on()?;
        Ok((table.rows.iter().map(|row| row.total).collect(), seconds.0[0].1))
    }
}

/// Root mean square of errors over the mean of values; none of none.
fn relative(errors: &[f64], values: &[f64]) -> Option<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64;
    (mean > 0.0).then(|| square.sqrt() / mean)
}

/// The middle value, or the mean of the two in the middle; none of none.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let count = values.len();
    (count > 0).then(|| 0.5 * (values[(count - 1) / 2] + values[count / 2]))
}

/// The scene's name, for files and titles.
pub(super) fn name(scene: Option<&Path>) -> String {
    scene
        .and_then(Path::file_stem)
        .map_or_else(|| "park".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// A setting in words.
pub(super) fn words(setting: &[(String, String)]) -> String {
    setting.iter().map(|(knob, value)| format!("{knob}={value}")).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(vec![4.0, 1.0]), Some(2.5));
        assert_eq!(median(Vec::new()), None);
    }
}
