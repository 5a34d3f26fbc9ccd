//! Diffuse interreflection.

mod balance;
mod between;
mod direct;
mod form_factor;
mod gather;
mod lambert;
mod links;
mod patch;
pub mod reference;
mod sight;
mod solve;
mod stage;
mod tree;
mod triangle;
mod vertices;

pub use between::{Absorbing, Attenuate, Between, Clear, Mirror};
pub use direct::direct;
pub use form_factor::{FormFactor, attenuated_form_factor, form_factor};
pub use lambert::point_form_factor;
pub use links::{Linking, Links};
pub use patch::{Cut, Patch, Patches, Side, Surfaces};
pub use solve::{MOST_ORDERS, Orders, Solution, Source, solve};
pub use stage::Interreflected;
