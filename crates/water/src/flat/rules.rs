//! How light in flat water is reckoned.

use crate::scatter::LAMP_TOLERANCE;
use crate::{Paths, Tolerance};

/// What of the light that the water scatters towards the eye is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scattered {
    /// Nothing.
    Off,
    /// What is scattered once, with the loss of quasi-single scattering.
    Once,
    /// The same, with what [`crate::multiple`] adds to the light of sun and sky.
    #[default]
    Often,
}

/// How the scattered light of a luminaire is summed up along a view ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// To a stated error.
    Quadrature(Tolerance),
    /// By the thesis' steps, none longer than this \[m\]; a twentieth of it at least.
    Steps(f64),
}

/// How light in flat water is reckoned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// How lamps' light widens beyond the surface.
    pub paths: Paths,
    /// What the water scatters towards the eye.
    pub scattered: Scattered,
    /// Luminaires along view rays.
    pub along: Along,
    /// Directions through Snell's window in which a surface under water looks for the sky; 0 = nothing hides it (thesis).
    pub window: u32,
    /// Whether these are the same at every place, for pictures without noise; else the place's seed decides, for sensors that are asked several times.
    pub still: bool,
    /// The same from all of a view ray, each with the stretches of it that it reaches.
    pub shafts: u32,
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            paths: Paths::Exact,
            scattered: Scattered::Often,
            along: Along::Quadrature(LAMP_TOLERANCE),
            window: 64,
            still: true,
            shafts: 8,
        }
    }
}
