//! Lists of terrain points from arbitrary bytes: an error or points, and ground through them, never a panic.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use scene::triangulate::{parse_points, terrain};

fuzz_target!(|bytes: &[u8]| {
    let Ok(points) = parse_points(bytes, Path::new("fuzz.csv")) else { return };
    assert!(points.iter().all(|point| point.is_finite()));
    if let Ok(ground) = terrain(&points) {
        let corners = ground.mesh.positions.len();
        assert_eq!(corners + ground.duplicates + ground.not_finite, points.len());
        assert!(ground.mesh.positions.iter().all(|p| p.is_finite()));
        assert!(ground.mesh.triangles.as_flattened().iter().all(|&i| (i as usize) < corners));
    }
});
