//! The skies that there are, by name.

use std::sync::Arc;

use glam::Vec3;

use crate::general_sky;
use crate::scale::Scaled;
use crate::{
    Air, AirSky, Distribution, LuminanceTable, Luminous, Perez, SOLAR_CONSTANT, Scale, Sky, bouguer,
    diffuse_illuminance,
};

/// A sky that can be chosen by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// The same luminance everywhere, of daylight's colour; as bright as an overcast sky.
    Uniform,
    /// The CIE overcast sky of Moon and Spencer.
    Overcast,
    /// The CIE clear sky of 1973, with the colours of [`Model::Physical`].
    Clear,
    /// A standard general sky of ISO 15469, type 1 to 15.
    Cie(usize),
    /// Perez' all-weather sky, from measured irradiances.
    Perez,
    /// Light scattered by clear air, as often as it happens: [`Air::CLEAR`].
    Physical,
    /// The thesis' own: single scattering in [`Air::THESIS`].
    Thesis,
    /// The same with the repaired haze: [`Air::REPAIRED`].
    Repaired,
}

/// Names of the fifteen general skies.
const GENERAL: [&str; 15] = [
    "cie-1", "cie-2", "cie-3", "cie-4", "cie-5", "cie-6", "cie-7", "cie-8", "cie-9", "cie-10", "cie-11",
    "cie-12", "cie-13", "cie-14", "cie-15",
];

/// Water vapour above the ground where the dew point is not known \[cm\].
const PRECIPITABLE_WATER: f64 = 2.0;
/// Transmittance at the zenith that stands for a clear day where no weather is known.
const CLEAR_TRANSMITTANCE: f64 = 0.7;

/// What skies are made for.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Unit vector towards the sun; below the horizon is night or twilight.
    pub toward_sun: Vec3,
    /// How bright the sky is made.
    pub scale: Scale,
    /// Height of the observer above the sea \[m\], 0 to 50 000.
    pub elevation_m: f64,
    /// Ångström's β of the air of skies with a colour of air; none = the air's own.
    pub turbidity: Option<f64>,
    /// Column of ozone \[atm-cm\] of that air; none = the air's own.
    pub ozone: Option<f64>,
    /// Reflectance of the ground that lights the air of [`Model::Physical`] from below; none = the air's own.
    pub ground_albedo: Option<f64>,
    /// The state of the weather that [`Model::Perez`] shows; none = a clear day by Bouguer and Nagata with a
    /// transmittance of 0.7.
    pub weather: Option<Perez>,
}

impl Conditions {
    /// An ordinary day with the sun there.
    pub fn new(toward_sun: Vec3) -> Self {
        Self {
            toward_sun,
            scale: Scale::Own,
            elevation_m: 0.0,
            turbidity: None,
            ozone: None,
            ground_albedo: None,
            weather: None,
        }
    }

    /// Altitude of the sun \[degrees\].
    pub fn sun_altitude(&self) -> f64 {
        let [x, y, z] = self.toward_sun.to_array().map(f64::from);
        y.atan2(x.hypot(z)).to_degrees()
    }

    /// `air` with what is known of it here.
    fn in_air(&self, air: Air) -> AirSky {
        let air = Air {
            turbidity: self.turbidity.unwrap_or(air.turbidity),
            ozone: self.ozone.unwrap_or(air.ozone),
            ground_albedo: self.ground_albedo.unwrap_or(air.ground_albedo),
            ..air
        };
        AirSky::new(&air, self.toward_sun, self.elevation_m)
    }

    /// What [`Model::Perez`] shows: the weather, or a clear day's.
    pub fn perez(&self) -> Perez {
        let altitude = self.sun_altitude();
        self.weather.unwrap_or_else(|| {
            let direct = bouguer::direct_normal(SOLAR_CONSTANT, CLEAR_TRANSMITTANCE, altitude);
            let diffuse = bouguer::sky_horizontal(SOLAR_CONSTANT, CLEAR_TRANSMITTANCE, altitude);
            Perez::new(direct, diffuse, altitude, None)
        })
    }
}

impl Model {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        [
            Self::Clear,
            Self::Overcast,
            Self::Uniform,
            Self::Physical,
            Self::Thesis,
            Self::Repaired,
            Self::Perez,
        ]
        .into_iter()
        .chain((1..=15).map(Self::Cie))
    }

    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Overcast => "overcast",
            Self::Clear => "clear",
            Self::Perez => "perez",
            Self::Physical => "physical",
            Self::Thesis => "thesis",
            Self::Repaired => "repaired",
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

    /// The sky itself. Those with a clear sky's colours take some 0.2 s to make, the others nothing.
    pub fn sky(self, conditions: &Conditions) -> Arc<dyn Sky> {
        let altitude = conditions.sun_altitude();
        let (sky, own): (Arc<dyn Sky>, Scale) = match self.air() {
            Some(air) => (Arc::new(conditions.in_air(air)), Scale::Own),
            None => self.luminous(conditions),
        };
        let scale = if conditions.scale == Scale::Own { own } else { conditions.scale };
        Arc::new(Scaled::new(sky, scale, altitude))
    }

    /// A distribution of luminance with its colour, and how bright it is by itself.
    fn luminous(self, conditions: &Conditions) -> (Arc<dyn Sky>, Scale) {
        let altitude = conditions.sun_altitude();
        let ies = |clear: f64| Scale::Horizontal(diffuse_illuminance(clear, altitude) as f32);
        let (distribution, clear, own) = match self {
            Self::Cie(number) => {
                let clear = general_sky::clear_share(number);
                (Distribution::cie(number).unwrap_or(Distribution::UNIFORM), clear, ies(clear))
            }
            Self::Perez => {
                let weather = conditions.perez();
                let clear = weather.clear_share();
                let own = match conditions.weather {
                    Some(_) => Scale::Horizontal(weather.illuminances(PRECIPITABLE_WATER)[0] as f32),
                    None => ies(clear),
                };
                (Distribution::perez(&weather), clear, own)
            }
            Self::Uniform => (Distribution::UNIFORM, 0.0, ies(0.0)),
            Self::Overcast => (Distribution::MoonSpencer, 0.0, ies(0.0)),
            _ => (Distribution::CIE_CLEAR, 1.0, ies(1.0)),
        };
        (coloured(distribution, clear, conditions), own)
    }

    /// The air that scatters its light, if its luminance is computed from air.
    pub fn air(self) -> Option<Air> {
        match self {
            Self::Physical => Some(Air::CLEAR),
            Self::Thesis => Some(Air::THESIS),
            Self::Repaired => Some(Air::REPAIRED),
            _ => None,
        }
    }
}

/// The sky of measured luminances, as bright as they are unless `conditions` scale it. A table has no spectrum: it
/// gets one as other distributions do ([`Luminous`]), clear air's for `clear_share` of its light, within \[0, 1\].
///
/// ```
/// use std::sync::Arc;
/// use glam::Vec3;
/// use keikan_sky::{Conditions, LuminanceTable, measured_sky};
/// let table = LuminanceTable::new(vec![0.0, 90.0], vec![0.0], vec![500.0, 2000.0]).unwrap();
/// let sky = measured_sky(Arc::new(table), 0.0, &Conditions::new(Vec3::Y));
/// assert!((sky.radiance(Vec3::Y).luminance() / 2000.0 - 1.0).abs() < 1e-6); // rounding of eight bands
/// ```
pub fn measured_sky(table: Arc<LuminanceTable>, clear_share: f64, conditions: &Conditions) -> Arc<dyn Sky> {
    let sky = coloured(Distribution::Measured(table), clear_share, conditions);
    Arc::new(Scaled::new(sky, conditions.scale, conditions.sun_altitude()))
}

/// A distribution with the colour of clear air for a share of its light, of clouds for the rest.
fn coloured(distribution: Distribution, clear: f64, conditions: &Conditions) -> Arc<dyn Sky> {
    let sky = Luminous::new(distribution, conditions.toward_sun);
    if clear == 0.0 {
        return Arc::new(sky);
    }
    Arc::new(sky.coloured(Arc::new(conditions.in_air(Air::CLEAR)), clear as f32))
}

#[cfg(test)]
mod tests;
