//! How much of the light sent along this segment arrives?

use std::sync::Arc;

use glam::DVec3;

use crate::{Ray, Spectrum};

/// A source small enough to cast sharp shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointSource {
    /// A lamp at this point \[m\].
    At(DVec3),
    /// A sun in the direction of this unit vector.
    Toward(DVec3),
    /// Parallel light from the plane y = `level` \[m\], from where only what is below it is in the way: a sun's, beyond a
    /// horizontal surface that refracts it.
    Below {
        /// Unit vector towards where it comes from, upwards.
        toward: DVec3,
        /// Height of the plane \[m\], above the segment.
        level: f64,
    },
}

/// A stretch of a segment that a source does not simply reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Where it begins, as a share of the way along the segment, within \[0, 1\].
    pub from: f64,
    /// Where it ends, > `from`.
    pub to: f64,
    /// True where nothing of the source arrives; false where only [`Occlude::transmittance`] can tell.
    pub dark: bool,
}

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

    /// Shadow intervals: the stretches of the straight line from `a` to `b` (which lies on a surface) that
    /// `source` does not simply reach are appended to `out`, in any order, overlapping or not; what no
    /// stretch covers is reached whole. Agrees with [`Self::transmittance`] everywhere but within rounding
    /// of the stretches' ends. False (and nothing appended) when this occluder cannot tell.
    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        let _ = (source, a, b, out);
        false
    }
}

/// Nothing is ever in the way: the null answer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Vacuum;

impl Occlude for Vacuum {
    fn transmittance(&self, _: &Ray) -> Spectrum {
        Spectrum::ONE
    }

    fn shadows(&self, _: &PointSource, _: DVec3, _: DVec3, _: &mut Vec<Stretch>) -> bool {
        true
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

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        let before = out.len();
        let told = self.0.iter().all(|part| part.shadows(source, a, b, out));
        if !told {
            out.truncate(before);
        }
        told
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

    fn shadows(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        (**self).shadows(source, a, b, out)
    }
}
