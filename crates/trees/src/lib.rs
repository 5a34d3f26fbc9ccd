//! Trees as turning planes, with shade and shadow.
pub mod envelope;
