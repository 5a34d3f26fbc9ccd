//! EPW weather from arbitrary bytes: an error or a year whose every moment is sound, never a panic.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(year) = scene::weather::parse(bytes, Path::new("fuzz.epw")) {
        if let Ok(now) = year.at(&scene::Site::default()) {
            assert!(now.direct_normal.is_finite() && now.direct_normal >= 0.0);
            assert!(now.diffuse_horizontal.is_finite() && now.diffuse_horizontal >= 0.0);
        }
    }
});
