//! Closed-form truths through the real pipeline, and cross-checks of stages that answer the same question.

mod agreement;
mod cie171;
mod cie171_area;
mod cie171_glass;
mod determinism;
mod furnace;
mod luminaires;
mod night;
mod photometry;
