//! keikan
fn main() {}
