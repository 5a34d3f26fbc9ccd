//! A picture with no more than so much error.

use scene::Scene;

use super::level::Level;
use super::sample::{Purpose, pixels};
use super::{Base, Subject, Verdict, Wanted, honoured};
use crate::Error;
use crate::args::View;
use crate::output;
use crate::pipeline::{Monitor, Region};
use crate::plan::Plan;
use crate::report::Timings;
use crate::studio::{FrameSpec, Shot, Studio};

/// Pixels to choose by, and as many to check by.
const PIXELS: usize = 144;

/// A picture with no more than `wanted` error against much more effort, and what that took.
///
/// # Errors
/// As [`Studio::frame`].
pub(crate) fn shot(
    (scene, view, layers): (&Scene, &View, bool),
    wanted: Wanted,
    monitor: &Monitor,
    seconds: &mut Timings,
) -> Result<(Studio, Shot, Verdict), Error> {
    let plan = Plan::new(scene, view)?;
    let region = plan.region.clone();
    let base = Base::new(scene, view, plan);
    let mut subject = Pictured { base, layers, region, monitor, studio: None };
    let (shot, verdict) = seconds.time("error", || honoured(&mut subject, wanted))?;
    let studio = subject.studio.map(|(_, studio)| studio);
    let studio = studio.unwrap_or_else(|| Studio::new(scene.clone(), view.clone(), layers));
    Ok((studio, shot, verdict))
}

struct Pictured<'a> {
    base: Base<'a>,
    layers: bool,
    region: Region,
    monitor: &'a Monitor,
    /// The last effort that was asked for stays assembled.
    studio: Option<(Level, Studio)>,
}

impl Pictured<'_> {
    /// With the effort on top of what the view says.
    fn studio(&mut self, level: Level) -> &mut Studio {
        let last = self.studio.take().filter(|(last, _)| *last == level).map(|(_, studio)| studio);
        let new = || Studio::new(self.base.scene.clone(), self.base.view(level), self.layers);
        let studio = last.unwrap_or_else(new);
        &mut self.studio.insert((level, studio)).1
    }
}

impl Subject for Pictured<'_> {
    type Whole = Shot;
    const WHAT: &'static str = "pixels";
    const TOP: Level = Level(6);

    fn base(&self) -> &Base<'_> {
        &self.base
    }

    fn some(&mut self, level: Level, purpose: Purpose) -> Result<Vec<[f64; 3]>, Error> {
        let (at, monitor) = (pixels(&self.region, PIXELS, purpose), self.monitor);
        let found = self.studio(level).pixels(&at, monitor)?;
        Ok(found.iter().map(|rgb| rgb.to_array().map(f64::from)).collect())
    }

    fn whole(&mut self, level: Level) -> Result<Shot, Error> {
        let monitor = self.monitor;
        self.studio(level).frame(&FrameSpec::default(), monitor, &mut Timings::default())
    }

    fn of(&self, whole: &Shot, purpose: Purpose) -> Vec<[f64; 3]> {
        let developed = output::develop(&whole.film);
        let width = self.region.columns.len();
        let at = |[x, y]: [u32; 2]| {
            let i = (y - self.region.rows.start) as usize * width + (x - self.region.columns.start) as usize;
            developed[0].rgb[i].to_array().map(f64::from)
        };
        pixels(&self.region, PIXELS, purpose).into_iter().map(at).collect()
    }
}
