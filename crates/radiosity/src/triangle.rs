//! Triangles as patches are made of: halves, sizes, points on them.

use glam::DVec3;

/// A one-sided triangle: its front is where its corners run counter-clockwise \[m\].
pub(crate) type Corners = [DVec3; 3];

pub(crate) fn cross([a, b, c]: &Corners) -> DVec3 {
    (*b - *a).cross(*c - *a)
}

pub(crate) fn centre(corners: &Corners) -> DVec3 {
    (corners[0] + corners[1] + corners[2]) / 3.0
}

/// Largest distance of a corner from the centre \[m\].
pub(crate) fn radius(corners: &Corners) -> f64 {
    let centre = centre(corners);
    corners.iter().map(|corner| corner.distance_squared(centre)).fold(0.0, f64::max).sqrt()
}

/// The corner across from the longest edge; among equal edges the first.
pub(crate) fn apex(corners: &Corners) -> usize {
    let length = |k: usize| corners[(k + 1) % 3].distance_squared(corners[(k + 2) % 3]);
    (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best })
}

/// The halves on both sides of the line from corner `apex` to the middle of the edge across from it, apex first.
pub(crate) fn halves(corners: &Corners, apex: usize) -> [Corners; 2] {
    let [a, b, c] = [0, 1, 2].map(|k| corners[(apex + k) % 3]);
    // The same bits whichever end comes first: neighbours halve their common edge at one point.
    let middle = (b + c) * 0.5;
    [[a, b, middle], [a, middle, c]]
}

/// The point that belongs to a point of the unit square, areas kept.
pub(crate) fn point([a, b, c]: &Corners, [u, v]: [f64; 2]) -> DVec3 {
    let root = u.sqrt();
    *a * (1.0 - root) + *b * (root * (1.0 - v)) + *c * (root * v)
}

/// A rule for the mean over a triangle, exact for polynomials of the second degree: weights ⅓ at these points.
pub(crate) fn three_points([a, b, c]: &Corners) -> [DVec3; 3] {
    let inner = |p: DVec3, q: DVec3, r: DVec3| (p * 4.0 + q + r) / 6.0;
    [inner(*a, *b, *c), inner(*b, *c, *a), inner(*c, *a, *b)]
}

/// The part of a triangle in front of another's plane, as so many of two triangles.
pub(crate) fn in_front(corners: &Corners, of: &Corners) -> ([Corners; 2], usize) {
    let across = cross(of);
    let heights = corners.map(|corner| (corner - of[0]).dot(across));
    let above = heights.iter().filter(|&&height| height > 0.0).count();
    if above == 3 || heights.iter().all(|&height| height >= 0.0) {
        return ([*corners; 2], usize::from(above > 0));
    }
    // Turned so that the one that is alone on its side comes first.
    let Some(alone) = (0..3).find(|&k| (heights[k] > 0.0) == (above == 1)) else { return ([*corners; 2], 0) };
    let [a, b, c] = [0, 1, 2].map(|k| corners[(alone + k) % 3]);
    let [ha, hb, hc] = [0, 1, 2].map(|k| heights[(alone + k) % 3]);
    let [ab, ac] = [a.lerp(b, ha / (ha - hb)), a.lerp(c, ha / (ha - hc))];
    match above {
        1 => ([[a, ab, ac]; 2], 1),
        2 => ([[ab, b, c], [ab, c, ac]], 2),
        _ => ([*corners; 2], 0),
    }
}
