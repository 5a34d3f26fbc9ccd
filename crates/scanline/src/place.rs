//! Where in a pixel the part of a face is shaded that has a light of its own.

use glam::DVec2;

use crate::pixel::{Cover, Pixel};
use crate::resolve::Walk;

/// How far from the borders of a part it is shaded at least \[pixel\], where it is wide enough: what is known ends
/// there but for rounding.
const INSET: f64 = 1.0 / 16.0;

/// The cover with its moment brought within it.
///
/// Where a face has one light in a pixel, that is the centroid. The dark parts of one that has several may lie on both
/// sides of a lit one, or around the corner of it, so that their centroid is lit; and what is known is certain on
/// the lines only. So the nearest place on a line is taken.
pub(crate) fn within(walks: &[Walk], pixel: &Pixel, cover: &Cover, column: u32) -> Cover {
    let cut = |other: &Cover| other.face == cover.face && other.known != cover.known;
    if !pixel.covers.iter().any(cut) {
        return *cover;
    }
    let centroid = DVec2::from_array(cover.moment) / cover.area;
    let column = f64::from(column);
    let places = walks.iter().flat_map(|walk| walk.places(cover, centroid.x, [column, column + 1.0]));
    let distance = |place: &DVec2| place.distance_squared(centroid);
    // None where all of it leans in from beside the pixel.
    let at = places.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(centroid);
    Cover { moment: (at * cover.area).into(), ..*cover }
}

impl Walk<'_> {
    /// Where the line shows this cover from `left` to `right`, as near to `x` as can be.
    fn places(&self, cover: &Cover, x: f64, [left, right]: [f64; 2]) -> impl Iterator<Item = DVec2> {
        let spans = self.line.opaque[self.opaque..].iter().take_while(move |span| span.x0 < right);
        let whose = (cover.face, cover.known);
        spans.filter(move |span| (span.face, span.known) == whose && span.x1 > left).map(move |span| {
            let (from, to) = (span.x0.max(left), span.x1.min(right));
            let inset = INSET.min(0.25 * (to - from));
            DVec2::new(x.max(from + inset).min(to - inset), self.y)
        })
    }
}
