//! A picture with no more than so much error.

use std::sync::atomic::Ordering;

use scene::Scene;

use super::group::{Anew, Effort};
use super::level::Level;
use super::sample::{Purpose, pixels};
use super::strata::{Part, strata};
use super::{Base, Subject, Verdict, Wanted, honoured};
use crate::Error;
use crate::args::View;
use crate::output;
use crate::pipeline::{Monitor, Region};
use crate::plan::Plan;
use crate::report::Timings;
use crate::studio::{self, FrameSpec, Shot, Studio};

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
) -> Result<(Shot, Verdict), Error> {
    let plan = Plan::new(scene, view)?;
    studio::fits(&plan, scene, layers)?;
    let region = plan.region.clone();
    let base = Base::new(scene, view, plan, false);
    let mut subject = Pictured { base, layers, region, monitor, studio: None };
    seconds.time("error", || honoured(&mut subject, wanted))
}

struct Pictured<'a> {
    base: Base<'a>,
    layers: bool,
    region: Region,
    monitor: &'a Monitor,
    /// The last effort that was asked for stays assembled.
    studio: Option<(Effort, Studio)>,
}

impl Pictured<'_> {
    /// With the effort on top of what the view says.
    fn studio(&mut self, effort: &Effort) -> &mut Studio {
        let view = self.base.view(effort);
        let studio = match self.studio.take() {
            None => Studio::new(self.base.scene.clone(), view, self.layers),
            Some((last, studio)) => match self.base.anew([&last, effort]) {
                None => studio,
                Some(Anew::Eye) => studio.looking(view),
                Some(Anew::Lights) => studio.looking(view).lit_anew(),
                Some(Anew::Things) => Studio::new(self.base.scene.clone(), view, self.layers),
            },
        };
        &mut self.studio.insert((*effort, studio)).1
    }
}

impl Subject for Pictured<'_> {
    type Whole = Shot;
    type Place = [u32; 2];
    const WHAT: &'static str = "pixels";
    const TOP: Level = Level(6);

    fn base(&self) -> &Base<'_> {
        &self.base
    }

    fn sample(&self, purpose: Purpose) -> Vec<[u32; 2]> {
        pixels(&self.region, PIXELS, purpose)
    }

    fn some(&mut self, effort: &Effort, places: &[[u32; 2]]) -> Result<Vec<[f64; 3]>, Error> {
        let monitor = self.monitor;
        let found = self.studio(effort).pixels(places, monitor)?;
        Ok(found.iter().map(|rgb| rgb.to_array().map(f64::from)).collect())
    }

    fn whole(&mut self, effort: &Effort) -> Result<Shot, Error> {
        let monitor = self.monitor;
        monitor.pieces.store(0, Ordering::Relaxed);
        self.studio(effort).frame(&FrameSpec::default(), monitor, &mut Timings::default())
    }

    fn of(&self, whole: &Shot, places: &[[u32; 2]]) -> Vec<[f64; 3]> {
        let developed = output::develop(&whole.film);
        let width = self.region.columns.len();
        let at = |&[x, y]: &[u32; 2]| {
            let i = (y - self.region.rows.start) as usize * width + (x - self.region.columns.start) as usize;
            developed[0].rgb[i].to_array().map(f64::from)
        };
        places.iter().map(at).collect()
    }

    fn parts(&self, whole: &Shot, purpose: Purpose) -> Vec<Part<[u32; 2]>> {
        let luminance: Vec<f32> = whole.film.layers[0].pixels.iter().map(|pixel| pixel.luminance()).collect();
        let width = self.region.columns.len();
        let pixel = |&i: &usize| {
            [self.region.columns.start + (i % width) as u32, self.region.rows.start + (i / width) as u32]
        };
        let parts = strata(&luminance, width, purpose).into_iter();
        parts
            .map(|Part { share, all, places }| Part {
                share,
                all,
                places: places.iter().map(pixel).collect(),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::group::Group;
    use super::*;

    /// All that efforts are spent on.
    const EVERYTHING: &str = r#"
        [sun]
        altitude = 40
        azimuth = 200
        [sky]
        model = "clear"
        [settings]
        interreflection = "patches"
        "interreflection.patch" = 4
        [[material]]
        name = "glass"
        colour = 1
        transmission = 1
        ior = 1.5
        [[model]]
        plane = { size = [8, 8] }
        position = [0, -1, 0]
        [[model]]
        box = { size = [2, 2, 0.2] }
        position = [-2, 0, -1]
        [[water]]
        name = "pond"
        polygon = { points = [[-4, -0.2, 4], [4, -0.2, 4], [4, -0.2, -4], [-4, -0.2, -4]] }
        waves = [{ amplitude = 0.02, wavelength = 1.5, direction = 30 }]
        [[solid]]
        sphere = { radius = 0.5 }
        position = [1, 0.8, 1]
        material = "glass"
        [[light]]
        name = "panel"
        position = [0, 3, 0]
        direction = [0, -1, 0]
        rectangle = { size = [1, 1] }
        luminance = 20000
        [[tree]]
        species = "broadleaf"
        position = [2, -1, -2]
        height = 4
        [[camera]]
        position = [3, 2, 6]
        target = [0, 0, 0]
    "#;

    #[test]
    fn what_is_kept_answers_as_if_it_were_new() {
        let scene = scene::parse(EVERYTHING, Path::new("."), Path::new("test.toml")).unwrap();
        let view = View { size: Some("12x8".parse().unwrap()), ..View::default() };
        let monitor = Monitor::default();
        let subject = || {
            let plan = Plan::new(&scene, &view).unwrap();
            let region = plan.region.clone();
            let base = Base::new(&scene, &view, plan, false);
            Pictured { base, layers: false, region, monitor: &monitor, studio: None }
        };
        let places = [[2, 2], [5, 3], [6, 5], [8, 4], [10, 6]];
        let mut kept = subject();
        let first = kept.some(&Effort::LEAST, &places).unwrap();
        let mut changed = 0;
        for group in Group::ALL {
            let effort = Effort::LEAST.with(group, Effort::LEAST.judge().level(group));
            let answers = kept.some(&effort, &places).unwrap();
            assert_eq!(answers, subject().some(&effort, &places).unwrap(), "{group:?}");
            changed += usize::from(answers != first);
        }
        // Or nothing has been shown.
        assert!(changed >= 7, "{changed}");
        assert_eq!(kept.some(&Effort::LEAST, &places).unwrap(), first);
    }
}
