//! IES LM-63 from arbitrary bytes: an error or a sound lamp, never a panic.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(lamp) = scene::photometry::parse(bytes, Path::new("fuzz.ies")) {
        assert!(lamp.flux.is_finite() && lamp.flux >= 0.0);
        assert!(lamp.distribution.peak().is_finite());
    }
});
