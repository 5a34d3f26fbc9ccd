//! `keikan sky`: what the sky of a place and time is, in numbers, as a table and as a picture.

mod picture;
mod report;
mod table;

use std::path::{Path, PathBuf};

use scene::Scene;

use crate::args::{self, Sky, When};
use crate::assemble::OpenSky;
use crate::command::{caution, load, pretty, say, warn};
use crate::output::Target;
use crate::plan::Plan;
use crate::publish::{self, Page};
use crate::{Error, progress};
use report::Report;

/// Where a table goes.
enum Destination {
    Nowhere,
    Stdout,
    File(Target),
}

/// Shows the sky.
///
/// # Errors
/// Arguments that do not go together, a scene without a sky, a file that cannot be written: then none is.
pub(crate) fn run(args: &Sky, json: bool) -> Result<(), Error> {
    let monitor = progress::monitor();
    publish::check(&args.output, &args.develop)?;
    let destination = check(args, json)?;
    let targets: Vec<Target> = args.output.iter().map(|path| Target::new(path)).collect::<Result<_, _>>()?;
    let scene = scene(args)?;
    if args.place.is_none() && args.sun.is_none() {
        warn(&scene);
    }
    let mut plan = Plan::new(&scene, &view(args))?;
    caution(&plan);
    let none = "the scene has no sky to show; --model NAME gives it one (keikan plan lists the names)";
    let sky = OpenSky::of(&plan, &scene).ok_or_else(|| Error::Content(none.to_owned()))?;
    let mut report = Report::new(&plan, &scene, &sky);
    let (pictures, content) = match targets.is_empty() {
        true => (Vec::new(), publish::Content::default()),
        false => picture::draw(args, &scene, &sky, report.sky.largest_above_10_deg),
    };
    // What looks is no camera of the scene.
    plan.camera.clone_from(&content.what);
    let mut ready = Vec::new();
    let table = args.table.as_ref().map(|_| table::csv(&scene, &sky, &report, args.step));
    if let (Destination::File(target), Some(table)) = (destination, &table) {
        ready.push((target, table.clone().into_bytes()));
    }
    report.written =
        args.output.iter().chain(args.table.iter().filter(|path| !is_stdout(path))).cloned().collect();
    let page = Page {
        scene_file: args.scene.as_deref(),
        develop: &args.develop,
        scene: &scene,
        plan: &plan,
        pictures: &pictures,
        content,
    };
    let files = args.output.iter().map(PathBuf::as_path).zip(targets).collect();
    report.exposure = page.write(files, ready, &monitor)?;
    match table.filter(|_| args.table.as_deref().is_some_and(is_stdout)) {
        // Data alone on stdout.
        Some(table) => {
            eprintln!("{report}");
            say(table.trim_end())
        }
        None => say(&if json { pretty(&report) } else { report.to_string() }),
    }
}

fn is_stdout(path: impl AsRef<Path>) -> bool {
    path.as_ref() == Path::new("-")
}

/// What does not go together whatever the scene, and where the table goes.
fn check(args: &Sky, json: bool) -> Result<Destination, Error> {
    let usage = |what: &str| Err(Error::Usage(what.to_owned()));
    if args.develop.layers {
        return usage("--layers: a sky has one layer");
    }
    if args.place.is_some() && args.time.is_none() && args.sun.is_none() {
        return usage("--place: a time is needed as well (--time), or where the sun stands (--sun)");
    }
    if args.place.is_some() && matches!(args.time, Some(When::Clock(_))) {
        return usage(
            "--time: the date and the offset from UTC are missing; write it like 2026-06-21T10:00:00+09:00",
        );
    }
    match &args.table {
        None => Ok(Destination::Nowhere),
        Some(path) if is_stdout(path) && json => {
            usage("--table -: stdout holds either the table or the JSON; name a file for the table")
        }
        Some(path) if is_stdout(path) => Ok(Destination::Stdout),
        Some(path) if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv")) => {
            usage("--table: a table's name ends in .csv; - writes it to stdout")
        }
        Some(path) => Ok(Destination::File(Target::new(path)?)),
    }
}

/// The same question as other commands ask.
fn view(args: &Sky) -> args::View {
    let model = args.model.iter().map(|name| ("sky.model".to_owned(), name.clone()));
    args::View {
        scene: args.scene.clone(),
        size: Some(args::Size { width: args.size, height: Some(args.size) }),
        set: args.set.iter().cloned().chain(model).collect(),
        ..args::View::default()
    }
}

/// The scene that is asked for, at the time that is asked for; an empty one for a place or a sun.
fn scene(args: &Sky) -> Result<Scene, Error> {
    if args.place.is_some() || args.sun.is_some() {
        return Ok(scene::parse(&empty(args), Path::new(""), Path::new("the arguments"))?);
    }
    let scene = load(args.scene.as_deref())?;
    let Some(when) = &args.time else { return Ok(scene) };
    if !scene.follows_time() {
        return Err(Error::Usage(
            "--time: nothing changes with the time in this scene: it has no [site] with a time, or its sun is put by hand"
                .to_owned(),
        ));
    }
    let time = match when {
        When::Moment(text) => scene::moment(text).map_err(Error::Usage)?.0,
        When::Clock(seconds) => {
            let beyond = || Error::Usage("--time: is beyond the calendar".to_owned());
            scene.site.at_local(*seconds).ok_or_else(beyond)?
        }
    };
    Ok(scene.at_time(time)?)
}

/// A scene file of nothing but sun and sky; all values are checked already.
fn empty(args: &Sky) -> String {
    let mut text = "[sky]\nmodel = \"clear\"\n".to_owned();
    let place = args.place.unwrap_or(args::Place { latitude: 0.0, longitude: 0.0, elevation: 0.0 });
    let args::Place { latitude, longitude, elevation } = place;
    text +=
        &format!("[site]\nlatitude = {latitude:?}\nlongitude = {longitude:?}\nelevation = {elevation:?}\n");
    if let Some(When::Moment(time)) = &args.time {
        text += &format!("time = {time:?}\n");
    }
    if let Some(args::Toward { altitude, azimuth }) = args.sun {
        text += &format!("[sun]\naltitude = {altitude:?}\nazimuth = {azimuth:?}\n");
    }
    text
}

/// Unit vector at `altitude` and `azimuth` from true north, in degrees.
fn direction(scene: &Scene, altitude: f64, azimuth: f64) -> glam::Vec3 {
    scene.site.direction(altitude, azimuth).as_vec3()
}
