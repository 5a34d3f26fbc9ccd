//! keikan
