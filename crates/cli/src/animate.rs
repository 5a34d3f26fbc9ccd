//! `keikan animate`: frame after frame, each written whole before the next one begins.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

use scene::CameraPath;

use crate::args::Animate;
use crate::command::{load, pretty, say, studio, warn};
use crate::frames::{Frames, numbered};
use crate::output::{self, Target};
use crate::pipeline::Monitor;
use crate::publish::{self, Content, Page};
use crate::report::{self, Timings};
use crate::studio::{FrameSpec, Shot, Studio};
use crate::{Error, caption, map_file, progress};

/// A frame to make, and where.
struct Job {
    number: i32,
    spec: FrameSpec,
    files: Vec<PathBuf>,
}

/// What became of a frame.
#[derive(Clone, Debug, serde::Serialize)]
struct Frame {
    frame: i32,
    /// False = its files were there.
    written: bool,
    files: Vec<PathBuf>,
    /// From set-up to the last byte \[s\].
    seconds: f64,
    /// Seconds per stage.
    stages: Timings,
    /// Place, time and sun, in words; none if skipped.
    site: Option<String>,
    /// How the PNG was exposed, in words.
    exposure: Option<String>,
}

/// The summary of one `animate`.
#[derive(Clone, Debug, serde::Serialize)]
struct Summary {
    frames: Vec<Frame>,
    written: usize,
    skipped: usize,
    /// Reading the scene \[s\].
    load: f64,
    /// All together \[s\].
    seconds: f64,
    peak_memory_mib: Option<f64>,
    warnings: Vec<String>,
}

/// Makes all frames that are asked for and do not exist yet.
///
/// # Errors
/// The first thing that kept a frame from being written; those before it stay.
pub(crate) fn run(args: &Animate, json: bool) -> Result<(), Error> {
    let monitor = progress::monitor();
    let start = Instant::now();
    check(args)?;
    let scene = load(args.view.scene.as_deref())?;
    let loaded = start.elapsed().as_secs_f64();
    warn(&scene);
    let mut warnings: BTreeSet<String> = scene.warnings.iter().map(ToString::to_string).collect();
    let mut studio = studio(scene, &args.view, &args.develop, args.maps.as_deref())?;
    let jobs = jobs(args, &studio)?;
    // What can be known to fail fails before the first frame.
    for file in jobs.iter().flat_map(|job| &job.files) {
        Target::new(file)?;
    }
    let mut frames = Vec::new();
    for (i, job) in jobs.iter().enumerate() {
        let before = frames.iter().filter(|frame: &&Frame| frame.written).count();
        let stopped =
            |error| if matches!(error, Error::Interrupted) { Error::InterruptedAfter(before) } else { error };
        let frame = if !args.overwrite && job.files.iter().all(|file| exists(file)) {
            job.skipped()
        } else {
            let made = job.make(args, &mut studio, &monitor, &mut warnings);
            // What is known so far is right, whatever has ended the run; its own error counts for more than another's.
            if let (Err(_), Some(path)) = (&made, &args.maps) {
                let _ = map_file::write(path, studio.maps());
            }
            made.map_err(stopped)?
        };
        let done = match &frame.site {
            Some(site) => format!("{:.3} s; {site}", frame.seconds),
            None => "skipped, its files exist (--overwrite makes it again)".to_owned(),
        };
        eprintln!("frame {} ({} of {}): {done}", job.number, i + 1, jobs.len());
        frames.push(frame);
    }
    let written = frames.iter().filter(|frame| frame.written).count();
    if let Some(path) = args.maps.as_deref().filter(|_| written > 0) {
        map_file::write(path, studio.maps())?;
    }
    let summary = Summary {
        written,
        skipped: frames.len() - written,
        load: loaded,
        seconds: start.elapsed().as_secs_f64(),
        peak_memory_mib: report::peak_memory_mib(),
        warnings: warnings.into_iter().collect(),
        frames,
    };
    eprintln!("{} frames written, {} skipped, {:.3} s", written, summary.skipped, summary.seconds);
    if json { say(&pretty(&summary)) } else { Ok(()) }
}

/// What is wrong whatever the scene.
fn check(args: &Animate) -> Result<(), Error> {
    publish::check(&args.output, &args.develop)?;
    match args.output.iter().find(|path| numbered(path, 0).is_none()) {
        None => Ok(()),
        Some(path) => Err(Error::Usage(format!(
            "-o {}: the file's name has no place for the frame's number; write it like name-####.exr",
            path.display()
        ))),
    }
}

/// A file of a frame that need not be made again: renaming makes it whole or not at all.
fn exists(file: &Path) -> bool {
    fs::metadata(file).is_ok_and(|about| about.is_file() && about.len() > 0)
}

/// All frames in the order asked for.
fn jobs(args: &Animate, studio: &Studio) -> Result<Vec<Job>, Error> {
    let scene = studio.scene();
    if args.time.is_some() && !scene.follows_time() {
        return Err(Error::Usage(
            "--time: nothing changes with the time in this scene: it has no [site] with a time, or its sun is put by hand"
                .to_owned(),
        ));
    }
    let (_, plan) = studio.set_up(&FrameSpec::default())?;
    let path = plan.camera(scene).and_then(|camera| camera.path.as_ref());
    let frames = match (&args.time, path) {
        (None, None) => {
            return Err(Error::Usage(format!(
                "nothing moves: the camera {} has no path; give it one, choose one with --camera, or go through a day with --time",
                plan.camera
            )));
        }
        (Some(day), _) => whole_day(args, day.count)?,
        (None, Some(path)) => args.frames.clone().map_or_else(|| whole_path(args, path), Ok)?,
    };
    Ok(frames.0.into_iter().map(|number| Job::new(args, number)).collect())
}

/// The frames of a day: all of them, or those asked for.
fn whole_day(args: &Animate, count: usize) -> Result<Frames, Error> {
    let last = i64::from(args.first) + count as i64 - 1;
    let Some(frames) = &args.frames else { return range(i64::from(args.first), last) };
    match frames.0.iter().find(|&&number| !(i64::from(args.first)..=last).contains(&i64::from(number))) {
        None => Ok(frames.clone()),
        Some(number) => {
            Err(Error::Usage(format!("--frames {number}: the day has frames {} to {last}", args.first)))
        }
    }
}

/// From the first to the last second of a path.
fn whole_path(args: &Animate, path: &CameraPath) -> Result<Frames, Error> {
    // A thousandth of a frame forgives that times and rates have no exact numbers.
    let [from, to] = path.seconds().map(|second| second * args.fps);
    let at = |frame: f64| i64::from(args.first) + frame as i64;
    range(at((from - 1e-3).ceil()), at((to + 1e-3).floor()).max(at((from - 1e-3).ceil())))
}

fn range(from: i64, to: i64) -> Result<Frames, Error> {
    format!("{from}-{to}").parse().map_err(|what| Error::Usage(format!("frames {from} to {to}: {what}")))
}

impl Job {
    fn new(args: &Animate, number: i32) -> Self {
        let after = f64::from(number) - f64::from(args.first);
        let clock = args.time.as_ref().map(|day| day.from + day.step * after);
        let files = args.output.iter().filter_map(|pattern| numbered(pattern, number)).collect();
        Self { number, spec: FrameSpec { seconds: Some(after / args.fps), clock }, files }
    }

    fn skipped(&self) -> Frame {
        Frame {
            frame: self.number,
            written: false,
            files: self.files.clone(),
            seconds: 0.0,
            stages: Timings::default(),
            site: None,
            exposure: None,
        }
    }

    fn make(
        &self,
        args: &Animate,
        studio: &mut Studio,
        monitor: &Monitor,
        warnings: &mut BTreeSet<String>,
    ) -> Result<Frame, Error> {
        let start = Instant::now();
        let mut stages = Timings::default();
        // From here on an interruption ends tidily.
        monitor.rendering.store(true, Ordering::Relaxed);
        let Shot { scene, plan, film } = studio.frame(&self.spec, monitor, &mut stages)?;
        map_file::tell(studio.maps());
        let of_scene = scene.warnings.iter().map(ToString::to_string);
        for warning in of_scene.chain(plan.warnings.iter().cloned()) {
            if warnings.insert(warning.clone()) {
                eprintln!("warning: {warning}");
            }
        }
        let pictures = stages.time("develop", || output::develop(&film));
        drop(film);
        let targets: Vec<_> = self
            .files
            .iter()
            .map(|file| Ok((file.as_path(), Target::new(file)?)))
            .collect::<Result<_, Error>>()?;
        let page = Page {
            scene_file: args.view.scene.as_deref(),
            develop: &args.develop,
            scene: &scene,
            plan: &plan,
            pictures: &pictures,
            content: Content::default(),
        };
        let exposure = stages.time("write", || page.write(targets, Vec::new(), monitor))?;
        Ok(Frame {
            frame: self.number,
            written: true,
            files: self.files.clone(),
            seconds: start.elapsed().as_secs_f64(),
            stages,
            site: Some(caption::describe(&scene)),
            exposure,
        })
    }
}
