//! Shadow intervals: where along a segment on a surface does the light of a point source not arrive?
//!
//! The source S and the segment a–b span a triangle, the *fan* (for a sun, a strip without end). Its plane cuts
//! every triangle of the scene in a straight piece or not at all, and seen from S each piece covers one interval of
//! a–b if it lies within the fan. Their union is the shadow, exactly, without samples.
//!
//! It is the set that thesis 2.3.2 wants, which intersects the line "scan plane ∩ face" with shadow volumes. The
//! volume of a body is the union of the volumes of its faces; the volume of one face is all that lies beyond it
//! as seen from S, so a point P of a–b is in it exactly if the way P–S meets the face, that is, if the fan's cut
//! through the face meets that way. What it saves: no silhouettes, no volumes to build, store and sort, no
//! case by case rules. It needs no closed mesh; the source may be inside a body, a face edge-on. And the
//! hierarchy of the rays serves here too: boxes that the fan misses are never opened.
//!
//! *Both ends of the way to the source* are excluded, as for rays. A face whose plane passes the covered part of
//! a–b by no more than what [`light::Hit`] says of positions (4 u of the coordinates, u = 2⁻²⁴) is where the
//! segment lies, or coplanar with it: it casts nothing on it. So every answer is right for some point within
//! that distance of the true one, and a–b may have been rounded to f32. A face that merely touches a–b is no
//! such face: its shadow starts where it stands. A face whose plane passes the source as closely hides nothing.
//!
//! *Ends of stretches* are computed in f64 from corners in f64. Where two faces share an edge, both compute the
//! same bits from it: no gap opens between them and none has to be closed by a tolerance. Corners exactly in the
//! fan's plane count as above it, for all faces that share them.
//!
//! *Cost* (`benches/shadows.rs`, one thread, AVX2): a segment of a pixel's size takes 0.4 to 0.8 µs in scenes of
//! 500 to 20 000 triangles and 2.5 µs on a terrain of a million, as much as 3 to 4 shadow rays take there. One
//! across a quarter of the scene takes as much as 10 to 20, 50 to 90 and 70 to 120 rays, for hundreds of pixels.

mod frame;
mod gather;
mod sieve;
#[cfg(test)]
mod tests;
mod union;

use glam::DVec3;
use light::{PointSource, Stretch};

use crate::world::World;
use frame::Fan;
use gather::{Gather, Told};

/// Coordinates beyond this \[m\] are not told about: that is where faces stop taking part.
const FARTHEST: f64 = 1e9;

/// Faces in the fan \[1\] beyond which intervals are not worth their while: the whole segment is then reported
/// as one that rays have to look at. A face costs 0.1 µs (0.4 µs where corners are not in the cache), half a shadow
/// ray: a segment that sees so many costs as much as rays at two thousand places of it.
const MOST: usize = 4096;

/// The whole segment.
const WHOLE: Stretch = Stretch { from: 0.0, to: 1.0, dark: false };

impl World {
    /// See [`light::Occlude::shadows`].
    ///
    /// One stretch over all that only rays can tell about is the answer where more than [`MOST`] faces lie in
    /// the fan, and where the source lies on the segment's own line (light along the surface). False only for
    /// input that is not finite or beyond [`FARTHEST`].
    pub(crate) fn cut(&self, source: &PointSource, a: DVec3, b: DVec3, out: &mut Vec<Stretch>) -> bool {
        let (PointSource::At(at) | PointSource::Toward(at) | PointSource::Below { toward: at, .. }) = *source;
        // Said so that NaN is out of bounds too.
        let near = |p: DVec3| p.abs().max_element() <= FARTHEST && p.is_finite();
        if !(near(a) && near(b) && near(at)) {
            return false;
        }
        let Some(fan) = Fan::new(source, a, b) else {
            out.push(WHOLE);
            return true;
        };
        let mut gather = Gather::new(self, &fan);
        match gather.all(source) {
            Told::All => gather.report(out),
            Told::Dark => out.push(Stretch { dark: true, ..WHOLE }),
            Told::TooMany => out.push(WHOLE),
        }
        true
    }
}
