//! How sun and sky follow from the time, so that a scene can be had at another one.

use std::path::PathBuf;
use std::sync::Arc;

use jiff::{SignedDuration, Timestamp};

use crate::weather::{Weather, Year};
use crate::{Error, Scene, Site, Warning};

/// A weather year and the file that it came from.
#[derive(Debug)]
pub(crate) struct Observed {
    pub(crate) path: PathBuf,
    pub(crate) year: Year,
}

/// What of sun and sky depends on the time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Daylight {
    /// The sun stands where place and time put it, not where the file or a model does.
    pub(crate) sun_follows: bool,
    /// The weather year that the sky follows.
    pub(crate) observed: Option<Arc<Observed>>,
}

impl Observed {
    /// The weather at the place and time of `site`, and a word if it is night.
    pub(crate) fn at(&self, site: &Site) -> Result<(Weather, Option<Warning>), Error> {
        let wrong = |what| Error::File { path: self.path.clone(), place: String::new(), what };
        let weather = self.year.at(site).map_err(wrong)?;
        let night = site.sun().filter(|sun| sun.toward.y <= 0.0).map(|sun| Warning {
            place: self.path.display().to_string(),
            what: format!(
                "the sun is {:.2}° below the horizon at {} UTC: by the weather file neither it nor the sky gives light",
                -sun.altitude,
                site.time.strftime("%Y-%m-%d %H:%M"),
            ),
        });
        Ok((weather, night))
    }
}

impl Scene {
    /// Whether anything changes with the time: the sun, unless the file puts it somewhere or a model brings it, or
    /// the weather.
    pub fn follows_time(&self) -> bool {
        self.daylight.sun_follows || self.daylight.observed.is_some()
    }

    /// The same scene at another time: the sun where it stands then (with the illuminance, colour and diameter that the
    /// file states), the weather of then. No file is read, and geometry and textures are shared. `warnings` are
    /// those of that time alone.
    ///
    /// ```
    /// let scene = keikan_scene::parse("[site]\nlatitude = 52.3\nlongitude = 4.8\ntime = 2026-06-21T10:00:00+02:00",
    ///     "".as_ref(), "a.toml".as_ref())?;
    /// let noon = scene.site.at_local(12.0 * 3600.0).unwrap();
    /// let (before, then) = (scene.sun.clone().unwrap(), scene.at_time(noon)?.sun.unwrap());
    /// assert!(then.altitude > before.altitude && then.azimuth > before.azimuth);
    /// # Ok::<(), keikan_scene::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::File`]: the weather file has nothing for that time. [`Error::Time`]: the sun's position is not known.
    pub fn at_time(&self, time: Timestamp) -> Result<Self, Error> {
        let mut scene = Self { warnings: Vec::new(), ..self.clone() };
        scene.site.time = time;
        if self.daylight.sun_follows {
            let now = scene.site.sun().ok_or(Error::Time)?;
            // What the file says about it stays.
            scene.sun = self.sun.clone().map(|sun| crate::Sun {
                toward: now.toward,
                altitude: now.altitude,
                azimuth: now.azimuth,
                ..sun
            });
        }
        if let (Some(observed), Some(sky)) = (&self.daylight.observed, &mut scene.sky) {
            let (weather, warning) = observed.at(&scene.site)?;
            sky.weather = Some(weather);
            scene.warnings.extend(warning);
        }
        Ok(scene)
    }
}

impl Site {
    /// The moment `seconds` after local midnight of this site's date, by its clock; none beyond the calendar.
    ///
    /// ```
    /// let site = keikan_scene::Site::default(); // 2026-06-21T10:00+09:00
    /// assert_eq!(site.at_local(10.0 * 3600.0), Some(site.time));
    /// ```
    pub fn at_local(&self, seconds: f64) -> Option<Timestamp> {
        let date = self.offset.to_datetime(self.time).date();
        let midnight = self.offset.to_timestamp(date.at(0, 0, 0, 0)).ok()?;
        midnight.checked_add(SignedDuration::try_from_secs_f64(seconds).ok()?).ok()
    }
}
