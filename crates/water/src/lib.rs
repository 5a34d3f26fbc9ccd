//! Light in, through and off water: the physics of a horizontal or wavy surface and of the homogeneous water below it.
//!
//! **Answers.** What a water does to light ([`Water`]: by name, by measured coefficients, by chlorophyll or Secchi depth) and where
//! it scatters it ([`Phase`]). By which ways light of a point source gets to a point ([`Surface::legs`]: straight, off the surface from
//! above or below, through it) and what it brings there. What sun ([`SunBelow`], [`mirrored_sun`]) and sky ([`SkyBelow`]) give to
//! surfaces under water. How much light the water sends to the eye along a view ray ([`Scattering`]): the sun's between shadows in
//! closed form, the sky's from a table ([`ScatteredSky`]), a luminaire's to a stated error, and a factor for what is scattered more than
//! once ([`multiple`]). The thesis' own forms stay selectable where better ones are the default ([`Paths::Thesis`], [`Loss::Beam`],
//! [`scatter::Steps`], the waters `thesis-…`).
//!
//! In a scene: what arrives at places above and under flat water from any source, by parts if wanted, with shadows on every leg, and what
//! the water scatters of it towards the eye ([`flat::Lit`], an [`light::Illuminate`]); what one sees of its surface
//! ([`flat::SurfaceShade`], a [`light::Shade`]), and what is lost and added on the way under water ([`flat::Fill`], a
//! [`light::Traverse`]). With waves on it ([`waves`]): what one sees of them ([`waves::WavyShade`]), and the light that they gather
//! ([`caustics::Beams`]).
//!
//! **Leaves out.** Waves for the light of the sky, of lamps under water and of lamps with an extent; interreflection; water that changes with depth;
//! fluorescence, polarisation; one index of refraction serves all bands; the sky that a surface mirrors onto things. [`flat`] and
//! [`caustics`] ask an occluder on every leg; all else asks nobody what stands in the way: callers give lit stretches and visibility, and [`SkyBelow`] and
//! [`ScatteredSky`] know no shadows.
//!
//! **Known to be wrong.** K = a + b_b is the loss of a vertical beam scattered rarely: in coastal waters (ω0 from 0.8 to 0.95) it is
//! 0.5 to 0.9 of the attenuation that Jerlov measured; [`Water::downward`] is nearer. Scattering once misses two fifths of the radiance at ω0 = 0.9;
//! the factor of [`multiple`] makes that good within 6 % in deep water, within 11 % over a black bottom, and not for luminaires. The sky's
//! rays are 10° apart. In [`flat`] the sky's shadows are those of a few dozen directions; the sun that the water scatters is a
//! point, and a lamp with an extent one in its middle; shadows in the light of lamps that comes by way of the surface are found by
//! looking at 32 places of a view ray; what is scattered more than once knows of the bed below the middle of a view ray alone. With waves, light takes flat paths between the highest crest and as far below the level; shadows are asked for once for each 4 × 4 cells of the
//! surface.
//!
//! ```
//! use glam::DVec3;
//! use keikan_water::{Loss, Paths, Scattering, SunBelow, Surface, ViewRay, Water};
//! use light::Spectrum;
//!
//! let water = Water::named("jerlov-3C").unwrap();
//! let surface = Surface::of(&water, 0.0); // y = 0
//!
//! // A lamp of 1 W/sr 3 m above the surface lights the bottom 2 m below it.
//! let [through, none] = surface.legs(DVec3::new(0.0, 3.0, 0.0), DVec3::new(1.0, -2.0, 0.0), Paths::Exact);
//! let light = through.unwrap().irradiance(Spectrum::ONE, water.loss(Loss::Diffuse));
//! assert!(none.is_none() && light[2] > 1.5 * light[7] && light[2] < 1.0 / 20.0);
//!
//! // The sun, scattered towards an eye that looks straight down.
//! let sun = SunBelow::new(&surface, DVec3::new(0.6, 0.8, 0.0), Spectrum::ONE).unwrap();
//! let ray = ViewRay { from: DVec3::ZERO, direction: DVec3::NEG_Y, length: 2.0 };
//! let scattering = Scattering::new(water, 0.0, Loss::Diffuse);
//! assert!(scattering.sun(&sun, &ray, &[[0.0, 2.0]]).max() > 0.0);
//! ```

pub mod caustics;
pub mod daylight;
pub mod flat;
pub mod path;
pub mod phase;
mod quadrature;
pub mod quality;
pub mod scatter;
pub mod waves;

pub use daylight::{SkyBelow, SunBelow, mirrored_sun};
pub use path::{Leg, Paths, Surface, Way};
pub use phase::{Phase, PhaseError};
pub use quadrature::{Integral, Tolerance};
pub use quality::{Loss, QualityError, Scatterer, Water};
pub use scatter::{ScatteredSky, Scattering, ViewRay, multiple};
