//! Primary light on patches.

use light::{Illuminate, Occlude, Spectrum};
use rayon::prelude::*;

use crate::Patches;
use crate::patch::{place, reach};
use crate::triangle;

/// By patch, irradiance by primary light \[W m⁻² nm⁻¹\]: the mean of three points, each of them a place with a seed of its own.
pub fn direct(patches: &Patches, lights: &[&dyn Illuminate], occlude: &dyn Occlude) -> Vec<Spectrum> {
    let of = |index: usize| -> Spectrum {
        let patch = patches.patch(index);
        let normal = patch.normal();
        let points = triangle::three_points(&patch.corners).into_iter().zip(0u32..);
        let mut sum = Spectrum::ZERO;
        for (at, k) in points {
            let seed = light::sampling::scramble(index as u32 * 3 + k);
            let place = place(at, normal, reach(&patch.corners), seed);
            for light in lights {
                let receive = &mut |arrival: light::Arrival| sum += arrival.on_plane(place.normal);
                light.arrivals_on(patch.face, &place, occlude, receive);
            }
        }
        sum * (1.0 / 3.0)
    };
    (0..patches.len()).into_par_iter().map(of).collect()
}
