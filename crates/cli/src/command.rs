//! What each command does, from its arguments to its last line of output.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use scene::Scene;

use crate::args::{self, Cli, Command};
use crate::output::{self, Target};
use crate::plan::Plan;
use crate::publish::{self, Content, Page};
use crate::report::{self, Summary, Timings};
use crate::studio::{FrameSpec, Shot, Studio};
use crate::{
    Error, animate, assemble, caption, compare, effort, gallery, lux, map_file, measure, progress, skies,
    species, waters,
};

/// The scene that is rendered when none is named.
const PARK: &str = include_str!("../scenes/park.toml");

/// Runs one command line.
///
/// # Errors
/// Whatever kept it from doing all that was asked; [`Error::exit_code`] tells the exit code.
pub fn run(cli: &Cli) -> Result<(), Error> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(cli.threads)
        .build()
        .map_err(|error| Error::Usage(format!("--threads {}: {error}", cli.threads)))?;
    pool.install(|| dispatch(&cli.command, cli.json))
}

/// Runs one command on the threads that there are.
///
/// # Errors
/// As [`run`].
pub(crate) fn dispatch(command: &Command, json: bool) -> Result<(), Error> {
    match command {
        Command::Render(args) => render(args, json),
        Command::Animate(args) => animate::run(args, json),
        Command::Plan(args) => plan(args, json),
        Command::Lux(args) => illuminances(args, json),
        Command::Sky(args) => skies::run(args, json),
        Command::Water(args) => waters::run(args, json),
        Command::Tree(args) => species::run(args, json),
        Command::Measure(args) => measure::run(args, json),
        Command::Compare(args) => compare::run(args, json),
        Command::Gallery(args) => gallery::run(args),
        Command::Schema => say(&pretty(&scene::schema())),
    }
}

/// The scene that is asked for, or the embedded one.
pub(crate) fn load(path: Option<&Path>) -> Result<Scene, Error> {
    Ok(match path {
        Some(path) => scene::load(path)?,
        None => scene::parse(PARK, Path::new("."), Path::new("park.toml (embedded)"))?,
    })
}

/// The same at a time of day.
pub(crate) fn load_at(path: Option<&Path>, moment: args::Moment) -> Result<Scene, Error> {
    let scene = load(path)?;
    let Some(clock) = moment.time else { return Ok(scene) };
    if !scene.follows_time() {
        let what = "--time: nothing changes with the time in this scene: its sun is not placed by [site]";
        return Err(Error::Usage(what.to_owned()));
    }
    let beyond = || Error::Usage(format!("--time: {clock} s after midnight are beyond the calendar"));
    let mut then = scene.at_time(scene.site.at_local(clock).ok_or_else(beyond)?)?;
    // Those of the time alone come with it.
    then.warnings.splice(0..0, scene.warnings);
    Ok(then)
}

fn plan(args: &args::PlanArgs, json: bool) -> Result<(), Error> {
    let scene = load_at(args.view.scene.as_deref(), args.moment)?;
    warn(&scene);
    let mut plan = Plan::new(&scene, &args.view)?;
    caution(&plan);
    if !scene.solids.is_empty() {
        plan.share_of_rays = Some(assemble::assemble(&plan, &scene)?.share_of_rays());
    }
    say(&if json { pretty(&plan) } else { plan.to_string() })
}

fn illuminances(args: &args::Lux, json: bool) -> Result<(), Error> {
    let scene = load_at(args.view.scene.as_deref(), args.moment)?;
    warn(&scene);
    if scene.sensors.is_empty() {
        return Err(Error::Usage("the scene has no [[sensor]]: nothing to measure".to_owned()));
    }
    let plan = Plan::new(&scene, &args.view)?.at_sensors();
    caution(&plan);
    let (table, measuring, verdict) = match args.error {
        Some(wanted) => {
            let (table, measuring, verdict) = effort::table(&scene, &args.view, wanted)?;
            (table, measuring, Some(verdict))
        }
        None => {
            let measuring = assemble::Measuring::new(&plan, &scene)?;
            (lux::measure(&scene, &measuring), measuring, None)
        }
    };
    let buried = lux::buried(&scene, &*measuring.dry, &table);
    for warning in measuring.warnings.iter().chain(&buried) {
        eprintln!("warning: {warning}");
    }
    table.uniformity.iter().for_each(|sensor| eprintln!("{sensor}"));
    verdict.iter().for_each(|verdict| eprintln!("{verdict}"));
    say(&if json { pretty(&Measured { table: &table, error: verdict }) } else { table.to_string() })
}

/// What `keikan lux --json` says.
#[derive(serde::Serialize)]
struct Measured<'a> {
    #[serde(flatten)]
    table: &'a lux::Table,
    /// What error was asked for and what came of it; left out where none was.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<effort::Verdict>,
}

fn render(args: &args::Render, json: bool) -> Result<(), Error> {
    let monitor = progress::monitor();
    let outputs = outputs(args)?;
    let targets: Vec<Target> = outputs.iter().map(|path| Target::new(path)).collect::<Result<_, _>>()?;
    let mut seconds = Timings::default();
    let scene = seconds.time("load", || load_at(args.view.scene.as_deref(), args.moment))?;
    // Maps are kept of knobs that do not change under way.
    let (mut studio, shot, error) = match args.error {
        Some(wanted) => {
            let asked = (&scene, &args.view, args.develop.layers);
            let (shot, verdict) = effort::shot(asked, wanted, &monitor, &mut seconds)?;
            (None, shot, Some(verdict))
        }
        None => {
            let mut studio = studio(scene, &args.view, &args.develop, args.maps.as_deref())?;
            let shot = studio.frame(&FrameSpec::default(), &monitor, &mut seconds)?;
            (Some(studio), shot, None)
        }
    };
    let Shot { scene, plan, film } = shot;
    studio.iter_mut().for_each(|studio| map_file::tell(studio.maps()));
    let pictures = seconds.time("develop", || output::develop(&film));
    drop(film);
    let site = caption::describe(&scene);
    let files: Vec<_> = outputs.iter().map(PathBuf::as_path).zip(targets).collect();
    let page = Page {
        scene_file: args.view.scene.as_deref(),
        develop: &args.develop,
        scene: &scene,
        plan: &plan,
        pictures: &pictures,
        content: Content::default(),
    };
    let exposure = seconds.time("write", || page.write(files, Vec::new(), &monitor))?;
    if let Some((path, studio)) = args.maps.as_ref().zip(studio.as_mut()) {
        seconds.time("maps", || map_file::write(path, studio.maps()))?;
    }
    let luminance = &pictures[0].luminance;
    let mean = luminance.iter().map(|&l| f64::from(l)).sum::<f64>() / luminance.len().max(1) as f64;
    let of_scene = scene.warnings.iter().map(ToString::to_string);
    let warnings = of_scene.chain(plan.warnings.iter().cloned()).collect();
    let summary = Summary {
        plan,
        site,
        seconds,
        pieces: monitor.pieces.load(Ordering::Relaxed),
        peak_memory_mib: report::peak_memory_mib(),
        luminance: [mean as f32, luminance.iter().copied().fold(0.0, f32::max)],
        exposure,
        error,
        warnings,
        written: outputs,
    };
    if json {
        say(&pretty(&summary))
    } else {
        eprintln!("{summary}");
        Ok(())
    }
}

/// A studio for a scene, with the maps that `--maps` names.
pub(crate) fn studio(
    scene: Scene,
    view: &args::View,
    develop: &args::Develop,
    maps: Option<&Path>,
) -> Result<Studio, Error> {
    let studio = Studio::new(scene, view.clone(), develop.layers);
    let Some(path) = maps else { return Ok(studio) };
    let (_, plan) = studio.set_up(&FrameSpec::default())?;
    Ok(studio.with_maps(map_file::read(path, &plan)?))
}

/// Where to write: as asked, or the scene's own name as .png and .exr in the current folder.
fn outputs(args: &args::Render) -> Result<Vec<PathBuf>, Error> {
    if args.output.is_empty() {
        let stem = args.view.scene.as_deref().and_then(Path::file_stem).unwrap_or("park".as_ref());
        let named = |extension: &str| {
            let mut name = stem.to_owned();
            name.push(extension);
            PathBuf::from(name)
        };
        return Ok(vec![named(".png"), named(".exr")]);
    }
    publish::check(&args.output, &args.develop)?;
    Ok(args.output.clone())
}

pub(crate) fn warn(scene: &Scene) {
    for warning in &scene.warnings {
        eprintln!("warning: {warning}");
    }
}

pub(crate) fn caution(plan: &Plan) {
    for warning in &plan.warnings {
        eprintln!("warning: {warning}");
    }
}

pub(crate) fn pretty(value: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default()
}

/// Data goes to stdout. A reader that has gone away (`| head`) is no failure of ours.
pub(crate) fn say(text: &str) -> Result<(), Error> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::Output { path: "stdout".to_owned(), what: error.to_string() })
        }
        _ => Ok(()),
    }
}
