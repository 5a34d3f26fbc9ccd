//! A body of water as data.

use glam::DAffine3;
use light::Mesh;

use crate::SurfaceWaves;

/// Water below a level surface, down to whatever its bottom is.
#[derive(Clone, Debug)]
pub struct Water {
    /// Its name, or `water-3`.
    pub name: String,
    /// The surface about its own middle, at y = 0, seen from above.
    pub surface: Mesh,
    /// Where that middle is in the world \[m\]; nothing is turned.
    pub place: DAffine3,
    /// Which water.
    pub quality: WaterQuality,
    /// How many times as much it scatters as that, absorbing the same; 1 = as it is.
    pub scattering_times: f64,
    /// Index of refraction relative to air; none = the water's own.
    pub index: Option<f64>,
    /// What moves the surface, which is level on average.
    pub waves: SurfaceWaves,
}

impl Water {
    /// Height y of the surface in the world \[m\].
    pub fn level(&self) -> f64 {
        self.place.translation.y
    }
}

/// Which water.
#[derive(Clone, Debug, PartialEq)]
pub enum WaterQuality {
    /// By name.
    Named(String),
    /// By the depth at which a white disc vanishes \[m\].
    Secchi(f64),
    /// By its chlorophyll \[mg/m³\].
    Chlorophyll(f64),
    /// By what was measured of it.
    Measured(MeasuredWater),
}

/// Two of the three coefficients: rows of wavelength \[nm\], rising, and coefficient \[1/m\].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasuredWater {
    /// Absorption a.
    pub absorption: Option<Vec<(f64, f64)>>,
    /// Scattering b.
    pub scattering: Option<Vec<(f64, f64)>>,
    /// Extinction c = a + b.
    pub extinction: Option<Vec<(f64, f64)>>,
    /// Where scattered light goes.
    pub phase: WaterPhase,
}

/// Where scattered light goes.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum WaterPhase {
    /// As Petzold measured it.
    #[default]
    Petzold,
    /// As molecules of water scatter.
    Molecular,
    /// As the thesis has it for sea water (A.2).
    Thesis,
    /// The function of Beardsley and Zaneveld: e_f, e_b (A.2).
    BeardsleyZaneveld([f64; 2]),
    /// The function of Fournier and Forand: relative index of the particles, slope of their sizes.
    FournierForand([f64; 2]),
    /// Rows of scattering angle \[degrees\], rising, and value in any unit.
    Table(Vec<(f64, f64)>),
}
