//! The program: arguments → plan → pipeline → picture or lux.
//!
//! **Answers.** `render`, `animate`, `plan`, `lux`, `sky`, `water`, `tree`, `measure`, `compare`, `gallery`, `schema`. [`assemble`] is the only place that
//! names chapters; [`pipeline`] composes them through their questions alone; [`output`] writes files,
//! each whole or not at all.
//!
//! **Leaves out.** Any model of light: those are the chapters'.

mod animate;
pub mod args;
pub mod assemble;
mod caption;
mod caution;
mod command;
pub mod compare;
pub mod effort;
mod error;
pub mod frames;
mod gallery;
pub mod knobs;
mod looks;
pub mod lux;
mod map_file;
pub mod measure;
pub mod output;
pub mod pipeline;
pub mod plan;
mod progress;
mod publish;
pub mod report;
pub mod shadows;
mod skies;
mod species;
pub mod studio;
mod waters;

pub use command::run;
pub use error::Error;
