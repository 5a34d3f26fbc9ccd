//! What the whole-pipeline tests share: from the text of a scene file to lux and pictures.

use std::path::Path;

use keikan::args::View;
use keikan::pipeline::{Monitor, Pipeline};
use keikan::plan::Plan;
use keikan::{assemble, lux};
use light::Film;

/// A scene file's text → its plan and pipeline, with `--set` as given.
///
/// # Panics
/// When the scene is wrong: the test's own fault.
pub fn pipeline(text: &str, size: (u32, u32), set: &[(&str, &str)]) -> (Plan, Pipeline) {
    let scene = scene::parse(text, Path::new("."), Path::new("test.toml")).expect("a sound scene");
    build(&scene, size, set)
}

/// A scene → its plan and pipeline.
///
/// # Panics
/// When the plan cannot be made.
pub fn build(scene: &scene::Scene, size: (u32, u32), set: &[(&str, &str)]) -> (Plan, Pipeline) {
    let view = View {
        size: Some(keikan::args::Size { width: size.0, height: Some(size.1) }),
        set: set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect(),
        ..View::default()
    };
    let plan = Plan::new(scene, &view).expect("a sound plan");
    let pipeline = assemble::assemble(&plan, scene).expect("stages that exist");
    (plan, pipeline)
}

/// Renders a scene file's text.
///
/// # Panics
/// When the scene is wrong.
pub fn render(text: &str, size: (u32, u32), set: &[(&str, &str)]) -> Film {
    let (plan, pipeline) = pipeline(text, size, set);
    pipeline.render(&plan.region, false, &Monitor::default()).expect("nobody interrupts")
}

/// Total lux at every sensor point of a scene file's text, in order.
///
/// # Panics
/// When the scene is wrong.
pub fn lux(text: &str, set: &[(&str, &str)]) -> Vec<f64> {
    let scene = scene::parse(text, Path::new("."), Path::new("test.toml")).expect("a sound scene");
    let (_, pipeline) = build(&scene, (8, 8), set);
    lux::table(&scene, &pipeline).rows.iter().map(|row| row.total).collect()
}

/// Luminance of every pixel \[cd/m²\], rows from the top.
pub fn luminances(film: &Film) -> Vec<f32> {
    film.layers[0].pixels.iter().map(|pixel| pixel.luminance()).collect()
}
