//! stub to be fitted
/// Factor.
pub fn factor(_a: f64, _b: f64, _s: f64, _v: f64) -> f64 {
    1.0
}
