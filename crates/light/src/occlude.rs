//! How much of the light sent along this segment arrives?

use std::sync::Arc;

use crate::{Ray, Spectrum};

/// How much of the light sent along a segment arrives at its other end?
///
/// 1 per band, within \[0, 1\]; 1 = nothing in the way, 0 = blocked. Both ends are excluded. Reciprocal:
/// the segment walked the other way has the same answer (up to the rounding of its end points).
pub trait Occlude: Send + Sync {
    /// The share that arrives, per band.
    fn transmittance(&self, segment: &Ray) -> Spectrum;

    /// The same for many segments: `out[i]` answers `segments[i]`. Both slices have one length.
    fn transmittances(&self, segments: &[Ray], out: &mut [Spectrum]) {
        for (segment, out) in segments.iter().zip(out) {
            *out = self.transmittance(segment);
        }
    }
}

/// Nothing is ever in the way: the null answer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Vacuum;

impl Occlude for Vacuum {
    fn transmittance(&self, _: &Ray) -> Spectrum {
        Spectrum::ONE
    }
}

/// Several occluders in a row: transmittances multiply (thesis eq. 2.2). An empty list is [`Vacuum`].
#[derive(Default)]
pub struct Product(pub Vec<Box<dyn Occlude>>);

impl Occlude for Product {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let mut product = Spectrum::ONE;
        for part in &self.0 {
            product *= part.transmittance(segment);
            if product.is_zero() {
                break;
            }
        }
        product
    }
}

/// A shared occluder is an occluder.
impl<T: Occlude + ?Sized> Occlude for Arc<T> {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        (**self).transmittance(segment)
    }

    fn transmittances(&self, segments: &[Ray], out: &mut [Spectrum]) {
        (**self).transmittances(segments, out);
    }
}
