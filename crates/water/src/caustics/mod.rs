//! Light that waves gather and scatter: caustics, from beams between the wavy surface and whatever they meet.
//!
//! The surface is cut into triangles. Rays leave the three corners of each, refracted or mirrored, and carry between them what light the
//! triangle lets through: a beam. Where beams cross the horizontal plane of a receiver each is a triangle again, whose area says how
//! dense its light is: flux over area, never a derivative at a point. So all paths are found, whatever folds over whatever; what
//! goes through the surface arrives, all of it; and nothing is drawn by chance.
//!
//! A receiver is no point but a small level square about it, as wide as the sun's disc is blurred: by Σ flux · (share of the beam in
//! the square) / (area of the square) its irradiance stays finite where a beam's area is 0, and energy is kept by any width.
//!
//! **Errors.** Positions of lines: the step's square (h² k³ a/32 of the depth, h of k = 2π/λ: 2 mm in 10 m for λ/32 of 1 m waves 5 cm
//! high). Light of one beam is even. Lines are as wide as the square: that of the sun's disc, but a quarter of a step at least.
//! Waves shorter than steps are smoothed away. A leaf of 4 × 4 cells asks for shadows once.
//!
//! **Leaves out.** Shadows of waves on waves (for suns lower than waves are steep), and light that meets the surface twice.

mod clip;
mod grid;
mod lit;
mod map;
#[cfg(test)]
mod tests;
mod tree;

pub use lit::{Beams, Setting};
pub use map::{Beam, BeamMap};
