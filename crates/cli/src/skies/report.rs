//! What the sky is, in numbers.

use std::fmt;
use std::path::PathBuf;

use glam::Vec3;
use light::Spectrum;
use light::colour::chromaticity;
use scene::Scene;

use super::direction;
use crate::assemble::OpenSky;
use crate::caption;
use crate::plan::{Plan, sky_model};

/// The answer of `keikan sky`.
#[derive(Clone, Debug, serde::Serialize)]
pub(super) struct Report {
    /// Time, place, north and sun, in words.
    pub(super) site: String,
    /// None where the sun was put by hand.
    time: Option<Time>,
    /// None where there is no sun at all.
    sun: Option<Sun>,
    pub(super) sky: Sky,
    /// Sun and sky on the horizontal \[lx\].
    global_lux: f32,
    warnings: Vec<String>,
    /// How a PNG was exposed, in words.
    pub(super) exposure: Option<String>,
    pub(super) written: Vec<PathBuf>,
}

#[derive(Clone, Debug, serde::Serialize)]
struct Time {
    utc: String,
    /// The local clock's offset, and what it shows.
    zone: String,
    local: String,
    latitude: f64,
    longitude: f64,
    elevation: f64,
}

#[derive(Clone, Debug, serde::Serialize)]
struct Sun {
    /// Degrees, apparent: as refraction lifts it.
    altitude: f64,
    /// Degrees clockwise from true north.
    azimuth: f64,
    /// On a plane that faces it \[lx\].
    normal_lux: f32,
    horizontal_lux: f32,
    /// CIE 1931; none without light.
    chromaticity: Option<[f32; 2]>,
}

/// All without the sun's disc.
#[derive(Clone, Debug, serde::Serialize)]
pub(super) struct Sky {
    model: String,
    /// cd/m².
    zenith_luminance: f32,
    /// cd/m², the sun's disc not counted.
    pub(super) largest_above_10_deg: f32,
    /// On the horizontal \[lx\].
    horizontal_lux: f32,
    /// CIE 1931, of the zenith; none without light.
    zenith_chromaticity: Option<[f32; 2]>,
    /// CIE 1931, of what the horizontal receives.
    diffuse_chromaticity: Option<[f32; 2]>,
    /// What the model is made of.
    traits: std::collections::BTreeMap<&'static str, f64>,
}

impl Report {
    pub(super) fn new(plan: &Plan, scene: &Scene, sky: &OpenSky) -> Self {
        let site = &scene.site;
        let by_time = scene.follows_time();
        let time = by_time.then(|| Time {
            utc: site.time.strftime("%Y-%m-%dT%H:%M:%SZ").to_string(),
            zone: site.offset.to_string(),
            local: site.offset.to_datetime(site.time).strftime("%Y-%m-%dT%H:%M:%S").to_string(),
            latitude: site.latitude,
            longitude: site.longitude,
            elevation: site.elevation,
        });
        let sun = scene.sun.as_ref().map(|sun| Sun {
            altitude: sun.altitude,
            azimuth: sun.azimuth,
            normal_lux: sky.sun_facing.luminance(),
            horizontal_lux: sky.sun_horizontal.luminance(),
            chromaticity: colour(sky.sun_facing),
        });
        let zenith = sky.radiance(Vec3::Y);
        Self {
            site: if by_time { caption::describe(scene) } else { by_hand(scene) },
            time,
            sun,
            sky: Sky {
                model: sky_model(scene, &plan.settings).to_owned(),
                zenith_luminance: zenith.luminance(),
                largest_above_10_deg: largest(scene, sky),
                horizontal_lux: sky.diffuse.luminance(),
                zenith_chromaticity: colour(zenith),
                diffuse_chromaticity: colour(sky.diffuse),
                traits: sky.traits.iter().copied().collect(),
            },
            global_lux: sky.diffuse.luminance() + sky.sun_horizontal.luminance(),
            warnings: scene.warnings.iter().map(ToString::to_string).chain(plan.warnings.clone()).collect(),
            exposure: None,
            written: Vec::new(),
        }
    }

    /// The model and what it is made of, in words.
    pub(super) fn model(&self) -> String {
        let traits = self.sky.traits.iter().map(|(name, value)| format!("; {name} {value:.3}"));
        format!("sky {}{}", self.sky.model, traits.collect::<String>())
    }
}

/// Where the sun was put.
fn by_hand(scene: &Scene) -> String {
    let sun = scene.sun.as_ref().map_or("no sun".to_owned(), |sun| {
        format!("sun put {:.2}° high at azimuth {:.2}°", sun.altitude, sun.azimuth)
    });
    format!("no time; {:.0} m, north {:.1}° from −Z; {sun}", scene.site.elevation, scene.site.north)
}

/// The largest luminance above 10° of altitude \[cd/m²\]: of directions a degree apart, and of the sky's brightest.
fn largest(scene: &Scene, sky: &OpenSky) -> f32 {
    const LOWEST: u32 = 10;
    let degrees = (LOWEST..=90).flat_map(|altitude| (0..360).map(move |azimuth| (altitude, azimuth)));
    let directions =
        degrees.map(|(altitude, azimuth)| direction(scene, f64::from(altitude), f64::from(azimuth)));
    let brightest =
        Some(sky.brightest()).filter(|direction| direction.y >= f64::from(LOWEST).to_radians().sin() as f32);
    directions.chain(brightest).map(|direction| sky.radiance(direction).luminance()).fold(0.0, f32::max)
}

fn colour(spectrum: Spectrum) -> Option<[f32; 2]> {
    (!spectrum.is_zero()).then(|| chromaticity(spectrum.xyz()).to_array())
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let xy = |colour: Option<[f32; 2]>| match colour {
            Some([x, y]) => format!("x {x:.4}, y {y:.4}"),
            None => "no light".to_owned(),
        };
        writeln!(f, "{}\n{}\n", self.site, self.model())?;
        writeln!(
            f,
            "zenith           {:12.1} cd/m²   {}",
            self.sky.zenith_luminance,
            xy(self.sky.zenith_chromaticity)
        )?;
        writeln!(
            f,
            "above 10°        {:12.1} cd/m² at most, the sun's disc not counted",
            self.sky.largest_above_10_deg
        )?;
        writeln!(
            f,
            "sky, horizontal  {:12.1} lx      {}",
            self.sky.horizontal_lux,
            xy(self.sky.diffuse_chromaticity)
        )?;
        match &self.sun {
            Some(sun) => {
                writeln!(f, "sun, horizontal  {:12.1} lx", sun.horizontal_lux)?;
                writeln!(f, "sun, facing it   {:12.1} lx      {}", sun.normal_lux, xy(sun.chromaticity))?;
            }
            None => writeln!(f, "sun                      none")?,
        }
        write!(f, "both, horizontal {:12.1} lx", self.global_lux)?;
        if let Some(exposure) = &self.exposure {
            write!(f, "\n\n{exposure}")?;
        }
        self.written.iter().try_for_each(|path| write!(f, "\nwrote {}", path.display()))
    }
}
