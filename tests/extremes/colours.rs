//! Colours: bands, sRGB, temperatures.

use glam::Vec3;
use light::Spectrum;
use light::colour::{decode_srgb, encode_srgb, srgb_from_xyz, xyz_from_srgb};

use crate::ledger::{Ledger, inputs};

#[test]
fn colours() {
    let ledger = Ledger::new("colour");
    for rgb in inputs([(0.0, 1.0); 3], 5000) {
        let linear = Vec3::from(rgb.map(|part| part as f32));
        let bands = Spectrum::reflectance(linear);
        ledger.holds("reflectances within 0 and 1", bands.0.iter().all(|b| (0.0..=1.0).contains(b)), rgb);
        let seen = srgb_from_xyz(Spectrum::light_of_colour(linear).xyz());
        let scale = seen.dot(linear) / linear.length_squared().max(1e-30);
        let off = (seen - linear * scale).length() / seen.length().max(1e-30);
        if linear.length() > 0.0 {
            ledger.note("light of a colour has that colour", f64::from(off), 1e-3, rgb);
        }
        let there = srgb_from_xyz(xyz_from_srgb(linear));
        ledger.note("sRGB to XYZ and back", f64::from((there - linear).abs().max_element()), 1e-6, rgb);
    }
    for [code] in inputs([(0.0, 1.0)], 5000) {
        let there = decode_srgb(encode_srgb(code as f32));
        ledger.note("sRGB's curve and back", (f64::from(there) - code).abs(), 1e-6, code);
    }
    // From a candle's ember to beyond any sky, and nonsense.
    let temperatures = inputs([(-1e3, 1e6)], 2000).into_iter().map(|[kelvin]| kelvin);
    for kelvin in temperatures.chain([0.0, f64::NAN, f64::INFINITY, 1667.0, 25_000.0]) {
        let bands = Spectrum::light_of_temperature(kelvin);
        let sound = bands.is_finite() && bands.0.iter().all(|b| *b >= 0.0) && bands.luminance() > 0.0;
        ledger.holds("light of a temperature is light", sound, kelvin);
    }
    ledger.close();
}
