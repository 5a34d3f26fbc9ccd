//! A function of the scattering angle by a table.

use super::PEAK;

/// Positive values at rising angles: cubic in the logarithms between them, so that integrals over angles meet no kinks; a power of
/// the angle below the first, constant beyond the last.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Angles {
    /// ln θ \[rad\], ln p and its slope at each angle: that of the parabola through it and its neighbours.
    logarithms: Vec<[f64; 3]>,
    /// Slope of ln p over ln θ below the first angle.
    slope: f64,
}

impl Angles {
    /// Rows of angle \[degrees\], rising from above 0, and value, above 0.
    pub(super) fn new(rows: &[(f64, f64)], slope: f64) -> Self {
        let points: Vec<[f64; 2]> =
            rows.iter().map(|(angle, p)| [angle.to_radians().max(PEAK).ln(), p.ln()]).collect();
        let between = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]);
        let sloped = |i: usize| {
            let point = points[i];
            let own = match (i.checked_sub(1).map(|i| points[i]), points.get(i + 1)) {
                (Some(a), Some(&b)) => {
                    let (before, after) = (point[0] - a[0], b[0] - point[0]);
                    let (left, right) = (between(a, point), between(point, b));
                    let parabola = (left * after + right * before) / (before + after);
                    // Steeper than three times a chord, the curve would overshoot beside it (Fritsch and Carlson 1980).
                    let most = 3.0 * left.abs().min(right.abs());
                    if left * right > 0.0 { parabola.clamp(-most, most) } else { parabola }
                }
                (Some(a), None) => between(a, point),
                (None, _) => slope,
            };
            [point[0], point[1], own]
        };
        Self { logarithms: (0..points.len()).map(sloped).collect(), slope }
    }

    /// The angles of the table \[rad\], rising.
    pub(super) fn angles(&self) -> impl Iterator<Item = f64> {
        self.logarithms.iter().map(|row| row[0].exp())
    }

    /// The value at s = sin²(θ/2).
    pub(super) fn at(&self, s: f64) -> f64 {
        let table = &self.logarithms;
        let angle = (2.0 * s.sqrt().asin()).max(PEAK).ln();
        let after = table.partition_point(|row| row[0] <= angle);
        let log = match (after.checked_sub(1).map(|i| table[i]), table.get(after)) {
            (None, Some(first)) => first[1] + self.slope * (angle - first[0]),
            (Some([x, y, slope]), Some(b)) => {
                let width = b[0] - x;
                let t = (angle - x) / width;
                // Hermite: the chord, and what the slopes at both ends differ from it.
                let chord = b[1] - y;
                let (start, end) = (slope * width - chord, chord - b[2] * width);
                y + t * chord + t * (1.0 - t) * ((1.0 - t) * start + t * end)
            }
            (Some(last), None) => last[1],
            (None, None) => f64::NEG_INFINITY,
        };
        log.exp()
    }
}
