//! Closed-form truths through the real pipeline, and cross-checks of stages that answer the same question.

mod agreement;
mod cie171;
mod cie171_area;
mod cie171_daylight;
mod cie171_glass;
mod cut_faces;
mod determinism;
mod furnace;
mod furnace_solids;
mod interreflection;
mod judged;
mod luminaires;
mod night;
mod open_sky;
mod photometry;
mod table_2_1;
mod water;
mod water_pictures;
mod waves;
