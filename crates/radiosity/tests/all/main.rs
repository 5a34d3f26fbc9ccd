//! Interreflection against closed forms, a slow reference, its limits and laws.

mod form_factors;
mod groups;
mod mirrors;
mod passages;
mod patches;
mod rooms;
mod solutions;
mod stage;
