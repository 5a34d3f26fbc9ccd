//! Light in and through water.

pub mod daylight;
pub mod path;
pub mod phase;
mod quadrature;
pub mod quality;
pub mod scatter;

pub use daylight::{SkyBelow, SunBelow, mirrored_sun};
pub use path::{Leg, Paths, Surface, Way};
pub use phase::{Phase, PhaseError};
pub use quadrature::{Integral, Tolerance};
pub use scatter::{Scattering, ScatteredSky, ViewRay, multiple};
pub use quality::{Loss, QualityError, Scatterer, Water};
