//! Light through, off and under a water surface (thesis chapter 3).
//!
//! **Answers.** Where does light cross a flat surface on its way from a lamp to a place, and how much of it arrives
//! ([`path`])? What arrives at places above and under flat water, from sun, sky and lamps on either side
//! ([`flat::Lit`], an [`light::Illuminate`])? What does one see of its surface ([`flat::SurfaceShade`], a [`light::Shade`]), and
//! what is lost and added on the way under water ([`flat::Fill`], a [`light::Traverse`])?
//!
//! **Leaves out.** Waves; the phase functions of real water; scattering more than once; colours of water by name; light that crosses the
//! surface after a diffuse reflection.
//!
//! **Known to be wrong.** One index of refraction for all bands. Sky light under water comes by 256 directions, a lamp with an extent not at all.

pub mod flat;
pub mod path;
