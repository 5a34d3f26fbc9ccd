//! Every public model through its whole range, corners included: finite, never negative, no more energy out than in, continuous,
//! and each fast way beside a slow one of its own. What came nearest to its bound is printed per model:
//!
//! `cargo test --test extremes -- --nocapture --test-threads 1`

mod colours;
mod form_factors;
mod interface;
mod lamps;
mod ledger;
mod rays;
mod skies;
mod trees;
mod waters;
mod waves;
