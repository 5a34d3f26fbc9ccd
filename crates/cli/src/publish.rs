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
    /// What was asked for.
    pub(crate) view: &'a args::View,
    /// How it becomes files.
    pub(crate) develop: &'a args::Develop,
    /// What was looked at.
    pub(crate) scene: &'a Scene,
    /// What was decided.
    pub(crate) plan: &'a Plan,
    /// The whole, then its layers.
    pub(crate) pictures: &'a [Picture],
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

impl Page<'_> {
    /// Encodes everything first and writes then, so that an error leaves no file behind. How a PNG was exposed comes
    /// back, in words.
    pub(crate) fn write(
        &self,
        files: Vec<(&Path, Target)>,
        monitor: &Monitor,
    ) -> Result<Option<String>, Error> {
        let mut said = None;
        let mut written = Vec::new();
        for (path, target) in files {
            let bytes = self.encode(path, &mut said);
            let bytes = bytes.map_err(|what| Error::Output { path: path.display().to_string(), what })?;
            written.push((target, bytes));
        }
        if monitor.interrupted.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        output::write(&written)?;
        Ok(said)
    }

    fn encode(&self, path: &Path, said: &mut Option<String>) -> Result<Vec<u8>, String> {
        let (whole, develop) = (&self.pictures[0], self.develop);
        if is_exr(path) {
            return output::encode_exr(self.pictures, &self.header());
        }
        if let Some(span) = develop.false_colour {
            let scale = Scale::of(whole, span, develop.linear);
            *said = Some(format!("false colour from {:.4} to {:.4} cd/m²", scale.low, scale.high));
            return output::draw_false_colour(whole, &scale);
        }
        let exposure = Exposure::of(whole, develop.exposure, develop.tone);
        *said = Some(format!(
            "PNG: {:.4} cd/m² shown as mid grey, tone curve {:?}",
            exposure.mid_grey, exposure.tone
        ));
        output::encode_png(whole, &exposure)
    }

    fn header(&self) -> Header {
        let Self { view, scene, plan, .. } = self;
        let named =
            view.scene.as_ref().map_or("park (embedded)".to_owned(), |path| path.display().to_string());
        let made_by = serde_json::json!({
            "unit": "R G B and Y in cd/m2 (photopic, 683 lm/W)",
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
            comments: format!("keikan: absolute radiometric rendering; {}", caption::describe(scene)),
            made_by: made_by.to_string(),
            corner: [plan.region.columns.start, plan.region.rows.start],
            whole: [plan.width, plan.height],
        }
    }
}
