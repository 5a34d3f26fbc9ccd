//! Measured skies from arbitrary bytes: an error or a sound table, never a panic.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(table) = scene::sky_table::parse(bytes, Path::new("fuzz.csv")) {
        assert_eq!(table.luminances.len(), table.altitudes.len() * table.azimuths.len());
        assert!(table.luminances.iter().all(|l| l.is_finite() && *l >= 0.0));
        assert!(table.altitudes.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(table.azimuths.windows(2).all(|pair| pair[0] < pair[1]));
    }
});
