//! `keikan measure`: what a knob costs and what it is off by, on the user's own scene.

mod html;
mod plot;
mod sweep;
mod table;
mod trial;

use std::path::{Path, PathBuf};

pub use sweep::Sweep;

use crate::args::{self, Against, Size};
use crate::command::{self, pretty, say};
use crate::knobs::Preset;
use crate::output::{self, Target};
use crate::plan::Plan;
use crate::{Error, caption, progress};
use html::Report;
use table::{Row, Table};
use trial::{Trial, Trials, words};

/// Most settings of one command.
const MOST: usize = 1000;

/// Pixels in a row where nobody says.
const WIDTH: u32 = 480;

/// What formats there are.
const FORMATS: [&str; 4] = ["html", "csv", "json", "svg"];

/// Runs the command.
///
/// # Errors
/// Knobs, values or files that cannot be, before anything runs; what rendering says.
pub(crate) fn run(args: &args::Measure, json: bool) -> Result<(), Error> {
    let monitor = progress::monitor();
    let name = trial::name(args.view.scene.as_deref());
    let outputs = outputs(args, &name)?;
    let targets = outputs.iter().map(|path| Target::new(path)).collect::<Result<Vec<_>, _>>()?;
    let scene = command::load_at(args.view.scene.as_deref(), args.moment)?;
    command::warn(&scene);
    let mut view = args.view.clone();
    view.size = view.size.or(Some(Size { width: WIDTH, height: None }));
    let trials = Trials { scene: &scene, view: &view, only: args.only, runs: args.runs, monitor: &monitor };
    count(args)?;
    let settings = sweep::settings(&args.knob, args.each);
    check(args, &settings, &trials)?;

    let (done, truth) = all(args, &settings, &trials)?;
    let measure = truth.as_ref().unwrap_or(&done[done.len() - 1]);
    let mut rows =
        done.iter().map(|trial| Row::new(trial, &measure.answer)).collect::<Result<Vec<_>, _>>()?;
    table::mark_best(&mut rows);
    let plot = plot::svg(&rows).map_err(Error::Usage)?;
    let report = Report {
        title: format!("keikan measure: {name}"),
        facts: facts(args, &caption::describe(&scene), measure),
        rows: &rows,
        trials: &done,
        truth: &measure.answer,
        truth_name: words(&measure.setting),
        plot: &plot,
    };
    let files = targets.into_iter().zip(&outputs).map(|(target, path)| Ok((target, encode(path, &report)?)));
    output::write(&files.collect::<Result<Vec<_>, Error>>()?)?;
    outputs.iter().for_each(|path| eprintln!("wrote {}", path.display()));
    say(&if json { pretty(&rows) } else { Table(&rows).to_string() })
}

/// All trials, and what they are measured by where that is none of them.
fn all(
    args: &args::Measure,
    settings: &[Vec<(String, String)>],
    trials: &Trials,
) -> Result<(Vec<Trial>, Option<Trial>), Error> {
    let mut done = Vec::with_capacity(settings.len());
    for (i, setting) in settings.iter().enumerate() {
        eprintln!("{} of {}: {}", i + 1, settings.len(), words(setting));
        done.push(trials.run(setting)?);
    }
    let truth = match args.against {
        Against::Best if args.each && args.knob.len() > 1 => {
            let best = sweep::best(&args.knob);
            eprintln!("all at their last: {}", words(&best));
            Some(trials.run(&best)?)
        }
        Against::Best => None,
        Against::Reference => {
            eprintln!("the reference");
            let view = args::View { preset: Preset::Reference, ..trials.view.clone() };
            let once = Trials { runs: 1, ..*trials };
            Some(once.run_view(&view, &[("preset".to_owned(), "reference".to_owned())])?)
        }
        Against::Judge => {
            eprintln!("the judge");
            Some(trials.judge(args.walks)?)
        }
    };
    Ok((done, truth))
}

/// Whether they are not too many, before they are listed.
fn count(args: &args::Measure) -> Result<(), Error> {
    let counts = args.knob.iter().map(|sweep| sweep.values.len());
    let count = if args.each { counts.sum() } else { counts.fold(1usize, usize::saturating_mul) };
    if count > MOST {
        return Err(Error::Usage(format!(
            "--knob: {count} settings are more than {MOST}; --each turns one knob at a time"
        )));
    }
    Ok(())
}

/// Whether every setting can be, before the first runs.
fn check(args: &args::Measure, settings: &[Vec<(String, String)>], trials: &Trials) -> Result<(), Error> {
    if args.against == Against::Judge && args.view.region.is_some() {
        return Err(Error::Usage(
            "--region: the judge makes whole pictures; leave it out, or --size smaller".to_owned(),
        ));
    }
    if trials.only == Some(args::Only::Lux) && trials.scene.sensors.is_empty() {
        return Err(Error::Usage("--only lux: the scene has no [[sensor]]".to_owned()));
    }
    settings.iter().try_for_each(|setting| Plan::new(trials.scene, &trials.view(setting)).map(|_| ()))
}

/// Where to write: as asked, or by the scene's name in the current folder.
fn outputs(args: &args::Measure, name: &str) -> Result<Vec<PathBuf>, Error> {
    if args.output.is_empty() {
        return Ok(["html", "csv"]
            .map(|extension| PathBuf::from(format!("{name}-measured.{extension}")))
            .to_vec());
    }
    for (i, path) in args.output.iter().enumerate() {
        if args.output[..i].contains(path) {
            return Err(Error::Usage(format!("-o {}: given twice", path.display())));
        }
        if !FORMATS.contains(&extension(path).as_str()) {
            return Err(Error::Usage(format!(
                "-o {}: \"{}\" is not a format that can be written; there are: {}",
                path.display(),
                extension(path),
                FORMATS.join(", ")
            )));
        }
    }
    Ok(args.output.clone())
}

fn extension(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

fn encode(path: &Path, report: &Report) -> Result<Vec<u8>, Error> {
    let failed = |what: String| Error::Output { path: path.display().to_string(), what };
    Ok(match extension(path).as_str() {
        "html" => report.html().map_err(failed)?,
        "json" => pretty(&report.rows),
        "svg" => report.plot.to_owned(),
        _ => Table(report.rows).csv(),
    }
    .into_bytes())
}

/// What the report says before its table.
fn facts(args: &args::Measure, site: &str, measure: &Trial) -> Vec<String> {
    let set: Vec<String> = args.view.set.iter().map(|(knob, value)| format!("{knob}={value}")).collect();
    let set = if set.is_empty() { String::new() } else { format!(", with {}", set.join(" ")) };
    let (name, took) = (words(&measure.setting), measure.seconds.iter().flatten().sum::<f64>());
    let noise = ["picture", "sensors"].into_iter().zip(measure.noise).filter_map(|(what, noise)| {
        noise.map(|noise| format!("{:.2} % of the mean ({what})", 100.0 * noise))
    });
    let noise = noise.collect::<Vec<_>>().join(", ");
    let own = match noise.as_str() {
        "" => "its own error is not in them".to_owned(),
        noise => format!("its own noise is {noise}"),
    };
    vec![
        format!("keikan {}. {site}", env!("CARGO_PKG_VERSION")),
        format!(
            "Preset {:?}{set}. Times are without loading, medians of {} runs.",
            args.view.preset, args.runs
        ),
        format!("Errors are differences to {name}, which took {took:.2} s; {own}."),
    ]
}
