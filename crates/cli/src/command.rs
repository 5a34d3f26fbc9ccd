//! What each command does, from its arguments to its last line of output.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;

use scene::Scene;

use crate::args::{self, Cli, Command};
use crate::output::{self, Exposure, Header, Picture, Scale, Target};
use crate::pipeline::Monitor;
use crate::plan::{MOST_PIXELS, Plan};
use crate::report::{self, Summary, Timings};
use crate::{Error, assemble, caption, compare, lux, progress};

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
    pool.install(|| match &cli.command {
        Command::Render(args) => render(args, cli.json),
        Command::Plan(args) => plan(args, cli.json),
        Command::Lux(args) => illuminances(args, cli.json),
        Command::Compare(args) => difference(args, cli.json),
        Command::Schema => say(&pretty(&scene::schema())),
    })
}

fn load(path: Option<&Path>) -> Result<Scene, Error> {
    Ok(match path {
        Some(path) => scene::load(path)?,
        None => scene::parse(PARK, Path::new("."), Path::new("park.toml (embedded)"))?,
    })
}

fn plan(args: &args::PlanArgs, json: bool) -> Result<(), Error> {
    let scene = load(args.view.scene.as_deref())?;
    let mut plan = Plan::new(&scene, &args.view)?;
    if !scene.solids.is_empty() {
        plan.share_of_rays = Some(assemble::assemble(&plan, &scene)?.share_of_rays());
    }
    say(&if json { pretty(&plan) } else { plan.to_string() })
}

fn illuminances(args: &args::Lux, json: bool) -> Result<(), Error> {
    let scene = load(args.view.scene.as_deref())?;
    warn(&scene);
    if scene.sensors.is_empty() {
        return Err(Error::Usage("the scene has no [[sensor]]: nothing to measure".to_owned()));
    }
    let plan = Plan::new(&scene, &args.view)?;
    let pipeline = assemble::assemble(&plan, &scene)?;
    let table = lux::table(&scene, &pipeline);
    for u in &table.uniformity {
        eprintln!(
            "{}: min {:.3} lx, mean {:.3} lx, max {:.3} lx, uniformity {:.3}",
            u.sensor, u.minimum, u.mean, u.maximum, u.uniformity
        );
    }
    say(&if json { pretty(&table) } else { table.to_string() })
}

fn difference(args: &args::Compare, json: bool) -> Result<(), Error> {
    let difference = compare::compare(&compare::read(&args.a)?, &compare::read(&args.b)?)?;
    say(&if json { pretty(&difference) } else { difference.to_string() })
}

fn render(args: &args::Render, json: bool) -> Result<(), Error> {
    let monitor = progress::monitor();
    let outputs = outputs(args)?;
    let targets: Vec<Target> = outputs.iter().map(|path| Target::new(path)).collect::<Result<_, _>>()?;
    let mut seconds = Timings::default();
    let scene = seconds.time("load", || load(args.view.scene.as_deref()))?;
    let plan = Plan::new(&scene, &args.view)?;
    let layers = if args.layers { (scene.lights.len() + scene.area_lights.len()) as u64 + 4 } else { 1 };
    let pixels = plan.region.columns.len() as u64 * plan.region.rows.len() as u64;
    if pixels.saturating_mul(layers) > MOST_PIXELS {
        return Err(Error::Usage(format!(
            "--layers: {layers} layers of {pixels} pixels are more than {MOST_PIXELS} pixels in all; render a part with --region"
        )));
    }
    let pipeline = seconds.time("assemble", || assemble::assemble(&plan, &scene))?;
    monitor.rendering.store(true, Ordering::Relaxed);
    let film = seconds.time("render", || {
        progress::shown(&monitor, plan.region.rows.len() as u64, || {
            pipeline.render(&plan.region, args.layers, &monitor)
        })
    })?;
    drop(pipeline);
    let pictures = seconds.time("develop", || output::develop(&film));
    drop(film);
    let site = caption::describe(&scene);
    let exposure =
        seconds.time("write", || write(args, targets, &outputs, &pictures, &scene, &plan, &monitor))?;
    let luminance = &pictures[0].luminance;
    let mean = luminance.iter().map(|&l| f64::from(l)).sum::<f64>() / luminance.len().max(1) as f64;
    let of_scene = scene.warnings.iter().map(|w| format!("{}: {}", w.place, w.what));
    let warnings = of_scene.chain(plan.shadows.warning()).collect();
    let summary = Summary {
        plan,
        site,
        seconds,
        pieces: monitor.pieces.load(Ordering::Relaxed),
        peak_memory_mib: report::peak_memory_mib(),
        luminance: [mean as f32, luminance.iter().copied().fold(0.0, f32::max)],
        exposure,
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
    let exr = |path: &PathBuf| path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"));
    if args.layers && !args.output.iter().any(exr) {
        return Err(Error::Usage("--layers: layers need an EXR to stand in; add -o NAME.exr".to_owned()));
    }
    for (i, path) in args.output.iter().enumerate() {
        if args.output[..i].contains(path) {
            return Err(Error::Usage(format!("-o {}: given twice", path.display())));
        }
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
        if !["png", "exr"].contains(&extension.to_ascii_lowercase().as_str()) {
            return Err(Error::Usage(format!(
                "-o {}: \"{extension}\" is not a format that can be written; there are: exr, png",
                path.display()
            )));
        }
    }
    Ok(args.output.clone())
}

/// Encodes everything first and writes then, so that an error leaves no file behind.
fn write(
    args: &args::Render,
    targets: Vec<Target>,
    outputs: &[PathBuf],
    pictures: &[Picture],
    scene: &Scene,
    plan: &Plan,
    monitor: &Arc<Monitor>,
) -> Result<Option<String>, Error> {
    let whole = &pictures[0];
    let mut said = None;
    let mut files = Vec::new();
    for (path, target) in outputs.iter().zip(targets) {
        let is_exr = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"));
        let bytes = if is_exr {
            output::encode_exr(pictures, &header(args, scene, plan))
        } else if let Some(span) = args.false_colour {
            let scale = Scale::of(whole, span, args.linear);
            said = Some(format!("false colour from {:.4} to {:.4} cd/m²", scale.low, scale.high));
            output::draw_false_colour(whole, &scale)
        } else {
            let exposure = Exposure::of(whole, args.exposure, args.tone);
            said = Some(format!(
                "PNG: {:.4} cd/m² shown as mid grey, tone curve {:?}",
                exposure.mid_grey, exposure.tone
            ));
            output::encode_png(whole, &exposure)
        };
        let bytes = bytes.map_err(|what| Error::Output { path: path.display().to_string(), what })?;
        files.push((target, bytes));
    }
    if monitor.interrupted.load(Ordering::Relaxed) {
        return Err(Error::Interrupted);
    }
    output::write(&files)?;
    Ok(said)
}

fn header(args: &args::Render, scene: &Scene, plan: &Plan) -> Header {
    let made_by = serde_json::json!({
        "unit": "R G B and Y in cd/m2 (photopic, 683 lm/W)",
        "site": caption::describe(scene),
        "scene": args.view.scene.as_ref().map_or("park (embedded)".to_owned(), |path| path.display().to_string()),
        "camera": plan.camera,
        "preset": plan.preset,
        "settings": plan.settings,
    });
    Header {
        latitude: scene.site.latitude as f32,
        longitude: scene.site.longitude as f32,
        utc_offset: -(scene.site.offset.seconds() as f32),
        capture_date: caption::local_time(scene),
        owner: args.owner.clone(),
        comments: format!("keikan: absolute radiometric rendering; {}", caption::describe(scene)),
        made_by: made_by.to_string(),
        corner: [plan.region.columns.start, plan.region.rows.start],
        whole: [plan.width, plan.height],
    }
}

fn warn(scene: &Scene) {
    for warning in &scene.warnings {
        eprintln!("warning: {}: {}", warning.place, warning.what);
    }
}

fn pretty(value: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default()
}

/// Data goes to stdout. A reader that has gone away (`| head`) is no failure of ours.
fn say(text: &str) -> Result<(), Error> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::Output { path: "stdout".to_owned(), what: error.to_string() })
        }
        _ => Ok(()),
    }
}
