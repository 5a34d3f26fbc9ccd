//! Which water: what a scene or a command line says → what it does to light.

use std::fmt;

use light::Spectrum;
use scene::{MeasuredWater, WaterPhase, WaterQuality};
use water::quality::{FRESH, Measured, names};
use water::{Loss, Phase, PhaseError, QualityError, Water};

use crate::Error;

/// The water that absorbs and scatters nothing.
const CLEAR: &str = "clear";

/// Names of all waters.
pub(crate) fn waters() -> impl Iterator<Item = &'static str> {
    [CLEAR].into_iter().chain(names())
}

/// The water of a `[[water]]`.
///
/// # Errors
/// What makes it impossible, with the name of the table.
pub(super) fn of_scene(asked: &scene::Water) -> Result<Water, Error> {
    let fault = |error: Fault| Error::Content(format!("[[water]] {:?}: {error}", asked.name));
    let own = of(&asked.quality).map_err(fault)?;
    let times = own.with_scattering_times(asked.scattering_times);
    times.and_then(|water| with_index(water, asked.index)).map_err(|error| fault(error.into()))
}

/// What a water does to light, in plain numbers per band.
pub(crate) struct Optics {
    water: Water,
}

impl Optics {
    /// # Errors
    /// What makes the water impossible.
    pub(crate) fn of(quality: &WaterQuality) -> Result<Self, Error> {
        of(quality).map(|water| Self { water }).map_err(|fault| Error::Usage(fault.to_string()))
    }

    /// # Errors
    /// The same, with the name of the table.
    pub(crate) fn of_scene(asked: &scene::Water) -> Result<Self, Error> {
        of_scene(asked).map(|water| Self { water })
    }

    /// Index of refraction relative to air.
    pub(crate) fn index(&self) -> f64 {
        self.water.index()
    }

    /// Beyond it the surface mirrors all light from below \[rad\].
    pub(crate) fn critical_angle(&self) -> f64 {
        self.water.critical_angle()
    }

    /// Depth at which a white disc vanishes \[m\]; infinite in water that takes nothing.
    pub(crate) fn secchi_depth(&self) -> f64 {
        self.water.secchi_depth()
    }

    /// a, b, b_b, c = a + b, K = a + b_b and K_d \[1/m\], with their names.
    pub(crate) fn coefficients(&self) -> [(&'static str, Spectrum); 6] {
        let water = &self.water;
        [
            ("absorption a", water.absorption()),
            ("scattering b", water.scattering()),
            ("backscattering bb", water.backscattering()),
            ("extinction c = a+b", water.extinction()),
            ("diffuse K = a+bb", water.diffuse()),
            ("daylight Kd", water.daylight()),
        ]
    }

    /// Length over which 1/e is left of an image (1/c), and of daylight (1/K_d) \[m\]; infinite where nothing is lost.
    pub(crate) fn reaches(&self) -> [Spectrum; 2] {
        [self.water.reach(Loss::Beam), self.water.daylight().map(|k| 1.0 / k)]
    }

    /// Single-scattering albedo b/c.
    pub(crate) fn albedo(&self) -> Spectrum {
        self.water.albedo()
    }

    /// Irradiance reflectance just under the surface over a bottom of this reflectance at this depth \[m\], which may be infinite.
    pub(crate) fn reflectance(&self, bottom: Spectrum, depth: f64) -> Spectrum {
        match depth.is_finite() {
            true => self.water.reflectance_over(bottom, depth),
            false => self.water.deep_reflectance(),
        }
    }
}

/// The water that is meant.
///
/// # Errors
/// An unknown name, coefficients that cannot be (b > c), a number out of range: in words.
pub(crate) fn of(quality: &WaterQuality) -> Result<Water, Fault> {
    Ok(match quality {
        WaterQuality::Named(name) if name.eq_ignore_ascii_case(CLEAR) => {
            Water::new(Spectrum::ZERO, Vec::new(), Water::named("distilled")?.index())?
        }
        WaterQuality::Named(name) => Water::named(name)?,
        WaterQuality::Secchi(depth) => Water::of_secchi_depth(*depth)?,
        WaterQuality::Chlorophyll(chlorophyll) => Water::of_chlorophyll(*chlorophyll)?,
        WaterQuality::Measured(measured) => self::measured(measured)?,
    })
}

fn measured(asked: &MeasuredWater) -> Result<Water, Fault> {
    Ok(Water::measured(&Measured {
        absorption: asked.absorption.as_deref(),
        scattering: asked.scattering.as_deref(),
        extinction: asked.extinction.as_deref(),
        phase: phase(&asked.phase)?,
        index: FRESH,
    })?)
}

fn phase(asked: &WaterPhase) -> Result<Phase, PhaseError> {
    match asked {
        WaterPhase::Petzold => Ok(Phase::petzold()),
        WaterPhase::Molecular => Ok(Phase::water()),
        WaterPhase::Thesis => Ok(Phase::thesis()),
        WaterPhase::BeardsleyZaneveld([forward, backward]) => Phase::beardsley_zaneveld(*forward, *backward),
        WaterPhase::FournierForand([index, slope]) => Phase::fournier_forand(*index, *slope),
        WaterPhase::Table(rows) => Phase::table(rows),
    }
}

fn with_index(water: Water, index: Option<f64>) -> Result<Water, QualityError> {
    let Some(index) = index else { return Ok(water) };
    Water::new(water.absorption(), water.scatterers().to_vec(), index)
}

/// Why there is no such water.
#[derive(Debug)]
pub(crate) enum Fault {
    Quality(QualityError),
    Phase(PhaseError),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Quality(QualityError::Unknown(name)) => {
                write!(
                    f,
                    "no water is called '{name}'; there are {}",
                    waters().collect::<Vec<_>>().join(", ")
                )
            }
            Self::Quality(error) => error.fmt(f),
            Self::Phase(error) => error.fmt(f),
        }
    }
}

impl From<QualityError> for Fault {
    fn from(error: QualityError) -> Self {
        Self::Quality(error)
    }
}

impl From<PhaseError> for Fault {
    fn from(error: PhaseError) -> Self {
        Self::Phase(error)
    }
}
