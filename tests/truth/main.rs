//! Closed-form truths through the real pipeline, and cross-checks of stages that answer the same question.

mod agreement;
mod cie171;
mod determinism;
mod furnace;
mod luminaires;
mod photometry;
