//! Checks that tests of every chapter share: reciprocity of occluders, furnaces for shaders.
//!
//! They return what they found instead of asserting, so that a test can state its own bound.

use crate::{
    Arrival, Hit, Illuminate, Occlude, Path, Place, Ray, Shade, Spectrum, Surroundings, Uniform, Vacuum,
};

/// Largest difference, over bands, between a segment's transmittance and that of the segment walked
/// backwards. 0 for a reciprocal occluder (up to the rounding of end points).
pub fn reciprocity(occlude: &dyn Occlude, segment: &Ray) -> f32 {
    let back =
        Ray { origin: segment.at(segment.length), direction: -segment.direction, length: segment.length };
    let (there, back) = (occlude.transmittance(segment), occlude.transmittance(&back));
    (there - back).map(f32::abs).max()
}

/// Surroundings of one radiance from everywhere: the white furnace.
#[derive(Clone, Copy, Debug)]
pub struct Furnace {
    /// Radiance of everything around \[W m⁻² sr⁻¹ nm⁻¹\].
    pub radiance: Spectrum,
}

impl Surroundings for Furnace {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        Uniform { radiance: self.radiance }.arrivals(place, &Vacuum, receive);
    }

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        self.radiance
    }
}

/// What share of a furnace's radiance a shader sends back at `hit`, per band: 1 for a surface that
/// neither absorbs nor emits, at most 1 for any surface that does not emit.
pub fn furnace(shade: &dyn Shade, hit: &Hit) -> Spectrum {
    shade.radiance(hit, &Furnace { radiance: Spectrum::ONE })
}
