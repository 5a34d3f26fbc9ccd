//! Waves on a water, as data.

use glam::DVec2;

/// What moves a water's surface; nothing by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceWaves {
    /// Waves given one by one. Their phases count from the origin of the *file's* coordinates.
    pub each: Vec<Wave>,
    /// A wind that raises more.
    pub wind: Option<Wind>,
    /// When it is looked at \[s\].
    pub moment: f64,
}

impl SurfaceWaves {
    /// True where nothing moves the surface.
    pub fn is_calm(&self) -> bool {
        self.wind.is_none() && self.each.iter().all(|wave| wave.amplitude == 0.0)
    }
}

/// One wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// ≥ 0 \[m\].
    pub amplitude: f64,
    /// > 0 \[m\].
    pub wavelength: f64,
    /// Unit vector of x and z in the world that it runs along.
    pub toward: DVec2,
    /// \[rad\].
    pub phase: f64,
}

/// A steady wind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// 10 m above the water \[m/s\], > 0.
    pub speed: f64,
    /// How far it has blown over water \[m\], > 0.
    pub fetch: f64,
    /// Unit vector of x and z in the world that it blows along.
    pub toward: DVec2,
    /// Of the water \[m\]; none = deep.
    pub depth: Option<f64>,
    /// How many waves stand for all, ≥ 1.
    pub waves: u32,
    /// Chooses among seas that are alike.
    pub seed: u32,
}
