//! Light in and through water (thesis chapter 3).
//!
//! **Answers.** What does a water do to light, by name or by measurement ([`Water`], [`Phase`])? Where does light cross a flat
//! surface on its way from a lamp to a place, and how much of it arrives ([`Surface`], [`Leg`]; the sun and the sky: [`daylight`])? What
//! arrives at places above and under flat water from any source, with shadows on every leg ([`flat::Lit`], an
//! [`light::Illuminate`])? What does one see of its surface ([`flat::SurfaceShade`], a [`light::Shade`]), and what is lost and
//! added on the way under water ([`flat::Fill`], a [`light::Traverse`])?
//!
//! **Leaves out.** Waves; light that is reflected from the bottom to the surface and back; light that crosses the surface after a diffuse
//! reflection.
//!
//! **Known to be wrong.** One index of refraction for all bands. Light is scattered once. A lamp with an extent shines through water as through air.

pub mod daylight;
pub mod flat;
pub mod path;
pub mod phase;
mod quadrature;
pub mod quality;
pub mod scatter;

pub use daylight::{SkyBelow, SunBelow, mirrored_sun};
pub use path::{Leg, Paths, Surface, Way};
pub use phase::{Phase, PhaseError};
pub use quadrature::{Integral, Tolerance};
pub use quality::{Loss, QualityError, Scatterer, Water};
pub use scatter::{ScatteredSky, Scattering, ViewRay, multiple};
