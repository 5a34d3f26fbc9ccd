//! From a loaded scene to the film of one frame: the one place where a pipeline is assembled for a picture.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use glam::Vec3;
use light::Film;
use rayon::prelude::*;
use scene::Scene;

use crate::assemble::{Maps, Standing};
use crate::output;
use crate::pipeline::{Monitor, Pipeline, Region, Source};
use crate::plan::{MOST_PIXELS, Plan};
use crate::report::Timings;
use crate::{Error, args, progress};

/// A scene, how it is looked at, and all that is kept from one frame to the next: what stands there; its lights,
/// while the sun stands still; and what is known of the sky's light.
pub struct Studio {
    scene: Scene,
    view: args::View,
    layers: bool,
    standing: Option<Standing>,
    lit: Option<Lit>,
    maps: Maps,
}

/// The sources of the frames of one time.
struct Lit {
    clock: Option<f64>,
    sources: Arc<[Source]>,
}

/// What of a scene differs from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameSpec {
    /// Where the camera is on its path \[s\]; none = as the scene has it.
    pub seconds: Option<f64>,
    /// Seconds after local midnight of the site's date; none = the site's own time.
    pub clock: Option<f64>,
}

/// A frame as it was taken.
pub struct Shot {
    /// The scene as it was then.
    pub scene: Scene,
    /// What was decided.
    pub plan: Plan,
    /// The picture.
    pub film: Film,
}

impl Studio {
    /// With `layers`, films have a further layer for every light.
    pub fn new(scene: Scene, view: args::View, layers: bool) -> Self {
        Self { scene, view, layers, standing: None, lit: None, maps: Maps::default() }
    }

    /// With what another run has kept of the sky's light.
    pub fn with_maps(self, maps: Maps) -> Self {
        Self { maps, ..self }
    }

    /// With other settings, of which what stands there and its lights know nothing.
    pub(crate) fn looking(self, view: args::View) -> Self {
        Self { view, ..self }
    }

    /// Without what is known of the lights: with other settings of them.
    pub(crate) fn lit_anew(self) -> Self {
        let standing = self.standing.map(Standing::unlinked);
        Self { standing, lit: None, maps: Maps::default(), ..self }
    }

    /// What is known of the sky's light by now.
    pub fn maps(&mut self) -> &mut Maps {
        &mut self.maps
    }

    /// The scene as it was loaded.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The scene as `spec` wants it, and what is decided for it; builds nothing.
    ///
    /// # Errors
    /// A camera, knob or size that cannot be; a time that the scene cannot have.
    pub fn set_up(&self, spec: &FrameSpec) -> Result<(Scene, Plan), Error> {
        let mut scene = match spec.clock {
            None => self.scene.clone(),
            Some(clock) => {
                let beyond =
                    || Error::Usage(format!("--time: {clock} s after midnight are beyond the calendar"));
                self.scene.at_time(self.scene.site.at_local(clock).ok_or_else(beyond)?)?
            }
        };
        let plan = Plan::new(&scene, &self.view)?;
        if let (Some(seconds), Some(camera)) = (spec.seconds, scene.cameras.get_mut(plan.eye)) {
            *camera = camera.at(seconds);
        }
        Ok((scene, plan))
    }

    /// Takes one frame; the monitor is told, and `seconds` get what its stages took.
    ///
    /// # Errors
    /// As [`Self::set_up`]; [`Error::Interrupted`] when the monitor says so.
    pub fn frame(
        &mut self,
        spec: &FrameSpec,
        monitor: &Monitor,
        seconds: &mut Timings,
    ) -> Result<Shot, Error> {
        let (scene, mut plan) = self.set_up(spec)?;
        fits(&plan, &scene, self.layers)?;
        let pipeline = self.pipeline(spec, &plan, &scene, seconds)?;
        plan.warnings.extend(self.standing.iter().flat_map(|standing| standing.warnings.iter().cloned()));
        monitor.rendering.store(true, Ordering::Relaxed);
        monitor.rows.store(0, Ordering::Relaxed);
        let film = seconds.time("render", || {
            progress::shown(monitor, plan.region.rows.len() as u64, || {
                pipeline.render(&plan.region, self.layers, monitor)
            })
        })?;
        Ok(Shot { scene, plan, film })
    }

    /// A few pixels of the frame as it stands, each by its column and row, in linear sRGB \[cd/m²\].
    ///
    /// # Errors
    /// As [`Self::frame`].
    pub(crate) fn pixels(&mut self, at: &[[u32; 2]], monitor: &Monitor) -> Result<Vec<Vec3>, Error> {
        let spec = FrameSpec::default();
        let (scene, plan) = self.set_up(&spec)?;
        let pipeline = self.pipeline(&spec, &plan, &scene, &mut Timings::default())?;
        monitor.rendering.store(true, Ordering::Relaxed);
        let pixel = |&[x, y]: &[u32; 2]| {
            let film = pipeline.render(&Region { columns: x..x + 1, rows: y..y + 1 }, false, monitor)?;
            Ok(output::develop(&film)[0].rgb[0])
        };
        at.par_iter().map(pixel).collect()
    }

    /// The stages of a frame: new ones only as far as it differs from the last.
    fn pipeline(
        &mut self,
        spec: &FrameSpec,
        plan: &Plan,
        scene: &Scene,
        seconds: &mut Timings,
    ) -> Result<Pipeline, Error> {
        let standing = match self.standing.take() {
            Some(standing) => standing,
            None => seconds.time("assemble", || Standing::new(plan, scene))?,
        };
        let standing = self.standing.insert(standing);
        let lit = match self.lit.take() {
            Some(lit) if lit.clock == spec.clock => lit,
            _ => {
                let mut sources = seconds.time("light", || standing.light(plan, scene, &mut self.maps));
                if plan.settings.choice("interreflection") != "off" {
                    let more =
                        seconds.time("interreflection", || standing.interreflected(plan, scene, &sources));
                    sources.extend(more);
                }
                Lit { clock: spec.clock, sources: sources.into() }
            }
        };
        let sources = Arc::clone(&self.lit.insert(lit).sources);
        standing.pipeline(plan, scene, sources)
    }
}

/// Whether all layers can be held in memory.
pub(crate) fn fits(plan: &Plan, scene: &Scene, layers: bool) -> Result<(), Error> {
    let layers = if layers { (scene.lights.len() + scene.area_lights.len()) as u64 + 4 } else { 1 };
    let pixels = plan.region.columns.len() as u64 * plan.region.rows.len() as u64;
    if pixels.saturating_mul(layers) > MOST_PIXELS {
        return Err(Error::Usage(format!(
            "--layers: {layers} layers of {pixels} pixels are more than {MOST_PIXELS} pixels in all; render a part with --region"
        )));
    }
    Ok(())
}
