//! Interreflection against closed forms, a slow reference, its limits and laws.

mod form_factors;
mod patches;
mod rooms;
mod solutions;
