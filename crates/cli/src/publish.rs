//! From a developed picture to its files, with all that they state about themselves.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use scene::Scene;

use crate::output::{self, Exposure, Header, Picture, Scale, Target};
use crate::pipeline::Monitor;
use crate::plan::Plan;
use crate::{Error, args, caption};

/// A picture and what made it.
pub(crate) struct Page<'a> {
    /// Where the scene came from; none = the embedded one.
    pub(crate) scene_file: Option<&'a Path>,
    /// How it becomes files.
    pub(crate) develop: &'a args::Develop,
    /// What was looked at.
    pub(crate) scene: &'a Scene,
    /// What was decided.
    pub(crate) plan: &'a Plan,
    /// The whole, then its layers.
    pub(crate) pictures: &'a [Picture],
    /// What the numbers are.
    pub(crate) content: Content,
}

/// What a picture shows, and in what unit.
#[derive(Clone, Debug)]
pub(crate) struct Content {
    /// For the EXR's comments.
    pub(crate) what: String,
    /// In words.
    pub(crate) unit: Unit,
}

/// The unit of a picture's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unit {
    /// cd/m².
    Luminance,
    /// Shares of this luminance \[cd/m²\].
    Share(f32),
    /// That of what it was made from.
    Plain,
}

impl Default for Content {
    fn default() -> Self {
        Self { what: "absolute radiometric rendering".to_owned(), unit: Unit::Luminance }
    }
}

impl Unit {
    /// After a number, in a message.
    fn suffix(self) -> String {
        match self {
            Self::Luminance => "cd/m²".to_owned(),
            Self::Share(whole) => format!("of {whole:.1} cd/m²"),
            Self::Plain => "(in the pictures' unit)".to_owned(),
        }
    }

    /// Above a legend, in ASCII.
    fn legend(self) -> &'static str {
        match self {
            Self::Luminance => "cd/m2",
            Self::Share(_) => "share",
            Self::Plain => "difference",
        }
    }

    /// cd/m² of a white of 1.
    fn white(self) -> f32 {
        match self {
            Self::Luminance | Self::Plain => 1.0,
            Self::Share(whole) => whole,
        }
    }
}

/// Whether files of these names can hold what is asked for.
///
/// # Errors
/// A usage error: a name given twice or of another kind, layers without an EXR.
pub(crate) fn check(output: &[PathBuf], develop: &args::Develop) -> Result<(), Error> {
    if develop.layers && !output.iter().any(|path| is_exr(path)) {
        return Err(Error::Usage("--layers: layers need an EXR to stand in; add -o NAME.exr".to_owned()));
    }
    for (i, path) in output.iter().enumerate() {
        if output[..i].contains(path) {
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
    Ok(())
}

fn is_exr(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"))
}

/// The bytes of one file, by the name's extension. How a PNG was exposed is said.
pub(crate) fn encode(
    path: &Path,
    pictures: &[Picture],
    (develop, unit): (&args::Develop, Unit),
    header: impl FnOnce() -> Header,
    said: &mut Option<String>,
) -> Result<Vec<u8>, Error> {
    let failed = |what| Error::Output { path: path.display().to_string(), what };
    let Some(whole) = pictures.first() else { return Err(failed("there is no picture".to_owned())) };
    if is_exr(path) {
        let header = Header { white_luminance: unit.white(), ..header() };
        return output::encode_exr(pictures, &header).map_err(failed);
    }
    let suffix = unit.suffix();
    if let Some(span) = develop.false_colour {
        let scale = Scale::of(whole, span, develop.linear);
        *said = Some(format!("false colour from {:.4} to {:.4} {suffix}", scale.low, scale.high));
        return output::draw_false_colour(whole, &scale, unit.legend()).map_err(failed);
    }
    let exposure = Exposure::of(whole, develop.exposure, develop.tone);
    *said = Some(format!(
        "PNG: {:.4} {suffix} shown as mid grey, tone curve {:?}",
        exposure.mid_grey, exposure.tone
    ));
    output::encode_png(whole, &exposure).map_err(failed)
}

impl Page<'_> {
    /// Encodes everything first and writes then, together with files that are `ready`, so that an error leaves no file
    /// behind. How a PNG was exposed comes back, in words.
    pub(crate) fn write(
        &self,
        files: Vec<(&Path, Target)>,
        ready: Vec<(Target, Vec<u8>)>,
        monitor: &Monitor,
    ) -> Result<Option<String>, Error> {
        let mut said = None;
        let mut written = ready;
        for (path, target) in files {
            let develop = (self.develop, self.content.unit);
            written.push((target, encode(path, self.pictures, develop, || self.header(), &mut said)?));
        }
        if monitor.interrupted.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        output::write(&written)?;
        Ok(said)
    }

    fn header(&self) -> Header {
        let Self { scene, plan, .. } = self;
        let named = self.scene_file.map_or("park (embedded)".to_owned(), |path| path.display().to_string());
        let unit = match self.content.unit {
            Unit::Luminance | Unit::Plain => "R G B and Y in cd/m2 (photopic, 683 lm/W)".to_owned(),
            Unit::Share(whole) => format!("R G B and Y as shares of {whole} cd/m2 (photopic, 683 lm/W)"),
        };
        let made_by = serde_json::json!({
            "unit": unit,
            "site": caption::describe(scene),
            "scene": named,
            "camera": plan.camera,
            "preset": plan.preset,
            "settings": plan.settings,
        });
        Header {
            latitude: scene.site.latitude as f32,
            longitude: scene.site.longitude as f32,
            utc_offset: -(scene.site.offset.seconds() as f32),
            capture_date: caption::local_time(scene),
            owner: self.develop.owner.clone(),
            comments: format!("keikan: {}; {}", self.content.what, caption::describe(scene)),
            made_by: made_by.to_string(),
            corner: [plan.region.columns.start, plan.region.rows.start],
            whole: [plan.width, plan.height],
            ..Header::default()
        }
    }
}
