//! The vocabulary of keikan: what every chapter says to every other.
//!
//! **Answers.** What light is here ([`Spectrum`], photometry, colour), where it is asked for
//! ([`Ray`], [`Place`], [`Hit`]), what the world is made of ([`Mesh`], [`Instance`], [`Geometry`]),
//! and the three questions that chapters answer without knowing each other:
//!
//! | question | trait | null answer |
//! | --- | --- | --- |
//! | how much of the light along this segment arrives? | [`Occlude`] | [`Vacuum`] |
//! | what arrives at this place, from where? | [`Illuminate`] | [`Uniform`] |
//! | what leaves this hit towards the eye? | [`Shade`] | [`Lambert`] |
//!
//! Three further questions carry the picture itself: [`See`] (which pieces of surface show in these
//! pixels?), [`Nearest`] (what does this one ray meet first?) and [`Traverse`] (what does light lose and gain along it?).
//!
//! **Leaves out.** Files, threads, acceleration structures, polarisation, fluorescence, time of flight.
//!
//! Units everywhere: metres, W m⁻² sr⁻¹ nm⁻¹ (radiance), W m⁻² nm⁻¹ (irradiance), W sr⁻¹ nm⁻¹
//! (intensity); cd/m², lx, cd after [`Spectrum::luminance`]. Axes as glTF: right-handed, +Y up.

mod area;
pub mod bands;
mod bodies;
pub mod check;
pub mod colour;
pub mod data;
mod film;
mod hit;
mod illuminate;
pub mod interface;
mod luminaire;
mod medium;
mod mesh;
mod occlude;
mod ray;
pub mod rounding;
pub mod sampling;
mod see;
mod shade;
mod spectrum;
mod texture;
mod traverse;
mod view;

pub use area::{AreaLight, AreaShape};
pub use bodies::{Bodies, Hull};
pub use film::{Film, Layer};
pub use hit::{Hit, Path, Place};
pub use illuminate::{Arrival, Illuminate, Uniform};
pub use interface::{fresnel, fresnel_polarised, reflect, refract};
pub use luminaire::{Distribution, Luminaire};
pub use medium::Medium;
pub use mesh::{Geometry, Instance, Mesh, Opacity, Triangle};
pub use occlude::{Occlude, PointSource, Product, Stretch, Vacuum};
pub use ray::Ray;
pub use see::{First, Known, Nearest, Piece, See};
pub use shade::{Dark, Lambert, Shade, Surroundings};
pub use spectrum::Spectrum;
pub use texture::{Texture, Wrap};
pub use traverse::{Traverse, Way};
pub use view::{Projection, View};
