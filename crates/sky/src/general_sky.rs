//! The fifteen standard general skies of the CIE.

use crate::Gradation;

/// a, b, c, d, e of types 1 to 15.
///
/// Source: CIE S 011/E:2003 = ISO 15469:2004 (Kittler, Perez and Darula).
#[rustfmt::skip]
const TYPES: [[f64; 5]; 15] = [
    [ 4.0, -0.70,  0.0, -1.0, 0.00], // overcast, steep gradation (the CIE's standard overcast sky)
    [ 4.0, -0.70,  2.0, -1.5, 0.15], // overcast, steep, slightly brighter towards the sun
    [ 1.1, -0.80,  0.0, -1.0, 0.00], // overcast, moderate gradation
    [ 1.1, -0.80,  2.0, -1.5, 0.15], // overcast, moderate, slightly brighter towards the sun
    [ 0.0, -1.00,  0.0, -1.0, 0.00], // uniform
    [ 0.0, -1.00,  2.0, -1.5, 0.15], // partly cloudy, no gradation, slightly brighter towards the sun
    [ 0.0, -1.00,  5.0, -2.5, 0.30], // partly cloudy, no gradation, brighter around the sun
    [ 0.0, -1.00, 10.0, -3.0, 0.45], // partly cloudy, no gradation, clear corona
    [-1.0, -0.55,  2.0, -1.5, 0.15], // partly cloudy, the sun hidden
    [-1.0, -0.55,  5.0, -2.5, 0.30], // partly cloudy, brighter around the sun
    [-1.0, -0.55, 10.0, -3.0, 0.45], // white-blue, clear corona
    [-1.0, -0.32, 10.0, -3.0, 0.45], // clear, clean air (the CIE's standard clear sky)
    [-1.0, -0.32, 16.0, -3.0, 0.30], // clear, polluted air
    [-1.0, -0.15, 16.0, -3.0, 0.30], // cloudless, turbid, broad corona
    [-1.0, -0.15, 24.0, -2.8, 0.15], // white-blue, turbid, broad corona
];

/// The parameters of type `number`, 1 to 15: gradation 1 + a e^(b/cos Z), indicatrix
/// 1 + c (e^(dχ) − e^(dπ/2)) + e cos² χ.
pub(crate) fn parameters(number: usize) -> Option<Gradation> {
    let [a, b, c, d, e] = *TYPES.get(number.checked_sub(1)?)?;
    let f0 = 1.0 - c * (d * std::f64::consts::FRAC_PI_2).exp();
    Some(Gradation { a, b, f0, c, d, e })
}

/// How much of type `number` is clear sky, 0 to 1, by its description: overcast (1 to 5), partly cloudy
/// (6 to 10), clear (11 to 15).
pub(crate) fn clear_share(number: usize) -> f64 {
    match number {
        0..=5 => 0.0,
        6..=10 => 0.5,
        _ => 1.0,
    }
}
