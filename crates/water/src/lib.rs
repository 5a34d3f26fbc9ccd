//! Light in and through water.

pub mod phase;
mod quadrature;

pub use phase::{Phase, PhaseError};
pub use quadrature::{Integral, Tolerance};
