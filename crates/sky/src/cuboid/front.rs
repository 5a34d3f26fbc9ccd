//! Which elements are worth asking for: those that give something and lie in front of the place's plane.

use glam::DVec3;

use super::{Coverage, Face};

/// A direction's cosine to the plane below which (scaled by its distance to the cuboid, ≤ 3) it counts as behind it: more than
/// the rounding of a normal in f32.
const BEHIND: f64 = 2e-6;

/// A face in k × k parts to an element, with those elements covered that are `dark`.
pub(super) fn known(face: &Face, parts: usize, dark: impl Fn([usize; 2]) -> bool) -> Coverage {
    let mut bits = Coverage::new(face.count.map(|count| count * parts));
    for [column, row] in face.cells().filter(|&cell| dark(cell)) {
        let first = column * parts;
        (0..parts).for_each(|part| bits.cover(row * parts + part, first, first + parts - 1));
    }
    bits
}

/// Covers what lies behind the plane of a normal in the cuboid's frame: D · n ≤ [`BEHIND`], linear along a row.
pub(super) fn hide_behind(face: &Face, bits: &mut Coverage, toward: DVec3) {
    let [columns, rows] = bits.size();
    let fine = Face { count: [columns, rows], ..*face };
    let cosine =
        |column: usize, row: usize| fine.point([column as f64 + 0.5, row as f64 + 0.5]).dot(toward) - BEHIND;
    for row in 0..rows {
        let (first, last) = (cosine(0, row), cosine(columns - 1, row));
        match (first > 0.0, last > 0.0) {
            (true, true) => {}
            (false, false) => bits.cover(row, 0, columns - 1),
            (rises, _) => {
                // The columns at least from which, or up to which, it is positive.
                let zero = first / (first - last) * (columns - 1) as f64;
                if rises {
                    bits.cover(row, (zero.ceil() as usize).min(columns - 1), columns - 1);
                } else {
                    bits.cover(row, 0, (zero.floor() as usize).min(columns - 1));
                }
            }
        }
    }
}
