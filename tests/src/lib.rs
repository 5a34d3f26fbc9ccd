//! Whole-pipeline tests of keikan.
