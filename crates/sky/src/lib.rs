//! Sun and sky as light sources.
//!
//! **Answers.** How bright is the sky, and of what colour, in a direction ([`Sky`])? What arrives from the sun's disc
//! ([`Sun`]) and from the sky all around, as [`light::Illuminate`]: by rays ([`Dome`]), by patches that stand still while the sun moves ([`PatchSky`]), by the thesis' receiving cuboid ([`CuboidSky`]) or by the band sources
//! that this replaces ([`BandSky`]); what a clear atmosphere leaves of the
//! direct beam ([`atmosphere`]); how bright the sky is by the sun's altitude ([`diffuse_illuminance`]). Skies are
//! chosen by name ([`Model`]): light scattered by a round atmosphere of molecules, aerosol and ozone ([`AirSky`]; the thesis'
//! own single scattering among them), or a distribution of luminance ([`Distribution`]: uniform, overcast, the
//! CIE's of 1973, the fifteen of ISO 15469, Perez' all-weather sky, measured ones) with a colour ([`Luminous`]); any of
//! them may be scaled ([`Scale`]). Whatever answers for the whole sky at once ([`WholeSky`]) may be kept at points of
//! every face and looked up there ([`map`]).
//!
//! **Leaves out.** Where the sun stands at a date and place; clouds with a shape; the sun's darker limb;
//! refraction; water vapour and oxygen; polarisation; moon and stars.
//!
//! **Known to be wrong.** The clear air's diffuse illuminance lies within 15 % of the IES' medians from 5° up, at 5° 15 % below, which
//! takes air at the clean end of what occurs; below 5° the medians are higher still (by a third at 2°). By the
//! second scattering on, phase functions end with their second Legendre polynomial. Colours of standard skies are
//! borrowed from clear air and D65. Perez' model has steps between its classes. Light from below the horizon ignores
//! shadows on the ground. A place that sees little of the sky (deep under a roof, in a slit) is noisy: directions are
//! chosen by what an open place would receive, not by what is open. Edges of things below the size of a share of
//! light (1/samples) are noise too. The cuboid and the bands have no noise, but see things by elements and by lines: what
//! falls between is not there; and they see what is in the geometry and in hulls of bodies, not what an occluder knows besides.
//!
//! ```
//! use glam::Vec3;
//! use light::{Illuminate, Place, Vacuum};
//! use keikan_sky::{Conditions, DIAMETER_DEG, Description, Dome, Model, Sun, atmosphere};
//!
//! let altitude = 40.0_f64;
//! let (sin, cos) = altitude.to_radians().sin_cos();
//! let toward = Vec3::new(0.0, sin as f32, cos as f32); // in the south: north is −Z
//! let beam = atmosphere::direct_beam(altitude, 0.0, atmosphere::CLEAR_TURBIDITY);
//! let sun = Sun { toward, irradiance: beam, angular_diameter_deg: DIAMETER_DEG, samples: 16 };
//! let clear = Model::named("clear").unwrap().sky(&Conditions::new(toward));
//! let sky = Dome::new(&Description { sun_horizontal: beam * toward.y, ..Description::new(clear) });
//!
//! let lawn = Place { position: Vec3::ZERO, error: 0.0, normal: Vec3::Y, seed: 0 };
//! let [direct, diffuse] = [&sun as &dyn Illuminate, &sky].map(|s| s.irradiance(&lawn, &Vacuum).luminance());
//! assert!(direct > 40_000.0 && diffuse > 10_000.0); // lx
//! ```

mod air;
mod air_sky;
pub mod atmosphere;
mod bands;
pub mod bouguer;
mod cuboid;
mod daylight;
mod distribution;
mod dome;
mod gauss;
mod general_sky;
mod ground;
mod lru;
mod luminous;
pub mod map;
mod measured;
mod model;
mod obstacles;
mod open_sky;
mod orders;
mod patches;
mod path;
mod perez;
mod phase;
mod sampling;
mod scale;
mod sky;
mod sky_cells;
mod slant;
mod solar_spectrum;
mod sun;
mod whole_sky;

pub use air::Air;
pub use air_sky::AirSky;
pub use bands::{BANDS, BandSky};
pub use cuboid::{
    Coverage, CuboidSky, Division, Drawing, ELEMENTS, Element, Face, Layout, Optimum, Rasterise, Things,
    Viewpoint,
};
pub use daylight::diffuse_illuminance;
pub use distribution::{Distribution, Gradation};
pub use dome::{Description, Dome, GROUND_ALBEDO, SAMPLES};
pub use luminous::{Luminous, OVERCAST_TEMPERATURE};
pub use measured::{LuminanceTable, TableError};
pub use model::{Conditions, Model, measured_sky};
pub use patches::{PATCH_ROWS, PatchSky, Sight};
pub use perez::{Perez, SOLAR_CONSTANT};
pub use phase::Lobes;
pub use scale::{Scale, Scaled, horizontal_illuminance};
pub use sky::Sky;
pub use solar_spectrum::extraterrestrial;
pub use sun::{DIAMETER_DEG, Sun};
pub use whole_sky::WholeSky;
