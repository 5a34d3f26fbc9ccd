//! The judge against closed forms, and its own errors against what they claim.

mod gloss;
mod honest;
mod lamps;
mod rooms;
mod support;
mod water;
