//! The skies that there are, by name.

use std::sync::Arc;

use glam::Vec3;

use crate::general_sky;
use crate::scale::Scaled;
use crate::{Distribution, Luminous, Perez, Scale, Sky, diffuse_illuminance};

/// A sky that can be chosen by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// The same luminance everywhere, of daylight's colour; as bright as an overcast sky.
    Uniform,
    /// The CIE overcast sky of Moon and Spencer.
    Overcast,
    /// The CIE clear sky of 1973.
    CieClear,
    /// A standard general sky of ISO 15469, type 1 to 15.
    Cie(usize),
    /// Perez' all-weather sky, from measured irradiances.
    Perez,
}

/// Names of the fifteen general skies.
const GENERAL: [&str; 15] = [
    "cie-1", "cie-2", "cie-3", "cie-4", "cie-5", "cie-6", "cie-7", "cie-8", "cie-9", "cie-10", "cie-11",
    "cie-12", "cie-13", "cie-14", "cie-15",
];

/// What skies are made for.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Unit vector towards the sun; below the horizon is night or twilight.
    pub toward_sun: Vec3,
    /// How bright the sky is made.
    pub scale: Scale,
    /// The state of the weather that [`Model::Perez`] shows; none = a clear day's.
    pub weather: Option<Perez>,
}

impl Conditions {
    /// An ordinary day with the sun there.
    pub fn new(toward_sun: Vec3) -> Self {
        Self { toward_sun, scale: Scale::Own, weather: None }
    }

    /// Altitude of the sun \[degrees\].
    pub fn sun_altitude(&self) -> f64 {
        let [x, y, z] = self.toward_sun.to_array().map(f64::from);
        y.atan2(x.hypot(z)).to_degrees()
    }
}

impl Model {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        [Self::Overcast, Self::Uniform, Self::CieClear, Self::Perez]
            .into_iter()
            .chain((1..=15).map(Self::Cie))
    }

    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Overcast => "overcast",
            Self::CieClear => "cie-clear",
            Self::Perez => "perez",
            Self::Cie(number) => GENERAL[number.clamp(1, GENERAL.len()) - 1],
        }
    }

    /// The sky of that name.
    ///
    /// ```
    /// use keikan_sky::Model;
    /// assert_eq!(Model::named("cie-7"), Some(Model::Cie(7)));
    /// assert_eq!(Model::named("purple"), None);
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|model| model.name() == name)
    }

    /// The sky itself.
    pub fn sky(self, conditions: &Conditions) -> Arc<dyn Sky> {
        let altitude = conditions.sun_altitude();
        let toward = conditions.toward_sun;
        let luminous = |distribution: Distribution, clear: f64| {
            let sky = Arc::new(Luminous::new(distribution, toward));
            (sky as Arc<dyn Sky>, diffuse_illuminance(clear, altitude) as f32)
        };
        let (sky, own) = match self {
            Self::Uniform => luminous(Distribution::UNIFORM, 0.0),
            Self::Overcast => luminous(Distribution::MoonSpencer, 0.0),
            Self::CieClear => luminous(Distribution::CIE_CLEAR, 1.0),
            Self::Perez => luminous(Distribution::CIE_CLEAR, 1.0),
            Self::Cie(number) => luminous(
                Distribution::cie(number).unwrap_or(Distribution::UNIFORM),
                general_sky::clear_share(number).into(),
            ),
        };
        let scale = match conditions.scale {
            Scale::Own => Scale::Horizontal(own),
            stated => stated,
        };
        Arc::new(Scaled::new(sky, scale, altitude))
    }
}
