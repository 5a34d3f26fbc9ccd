//! Petzold's average particle.

use std::sync::LazyLock;

use super::PEAK;

/// Slope of ln p over ln θ below the first angle (Mobley 1994).
const SLOPE: f64 = -1.346;

/// Scattering angle \[degrees\] and p \[1/sr\]: average-particle column of the Ocean Optics Web Book, after Petzold 1972 and Mobley 1994
/// (table 3.10). The 0.501° entry printed in 1993 and 1994 (218.8) is a misprint.
#[rustfmt::skip]
const TABLE: [(f64, f64); 55] = [
    (0.1, 1772.0), (0.126, 1299.0), (0.158, 952.9), (0.2, 701.1), (0.251, 515.1),
    (0.316, 377.4), (0.398, 277.1), (0.501, 201.8), (0.631, 144.8), (0.794, 102.5),
    (1.0, 71.81), (1.259, 49.72), (1.585, 34.05), (1.995, 22.88), (2.512, 15.21),
    (3.162, 10.04), (3.981, 6.598), (5.012, 4.307), (6.31, 2.815), (7.943, 1.824),
    (10.0, 1.156), (15.0, 0.4907), (20.0, 0.2451), (25.0, 0.1476), (30.0, 0.08633),
    (35.0, 0.05948), (40.0, 0.04222), (45.0, 0.03076), (50.0, 0.02282), (55.0, 0.01704),
    (60.0, 0.01316), (65.0, 0.01049), (70.0, 0.008512), (75.0, 0.006996), (80.0, 0.005859),
    (85.0, 0.004967), (90.0, 0.004305), (95.0, 0.003792), (100.0, 0.003414), (105.0, 0.003125),
    (110.0, 0.00292), (115.0, 0.002805), (120.0, 0.002693), (125.0, 0.002579), (130.0, 0.002483),
    (135.0, 0.002383), (140.0, 0.002336), (145.0, 0.00232), (150.0, 0.002371), (155.0, 0.002513),
    (160.0, 0.002669), (165.0, 0.002843), (170.0, 0.003039), (175.0, 0.003101), (180.0, 0.003163),
];

/// ln θ \[rad\], ln p and its slope at each angle: that of the parabola through it and its neighbours.
static LOGARITHMS: LazyLock<[[f64; 3]; TABLE.len()]> = LazyLock::new(|| {
    let logarithms = TABLE.map(|(angle, p)| [angle.to_radians().ln(), p.ln()]);
    std::array::from_fn(|i| {
        let [x, y] = logarithms[i];
        let slope = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]);
        let slope = match (i.checked_sub(1).map(|i| logarithms[i]), logarithms.get(i + 1)) {
            (Some(a), Some(&b)) => {
                let (before, after) = (x - a[0], b[0] - x);
                (slope(a, [x, y]) * after + slope([x, y], b) * before) / (before + after)
            }
            (Some(a), None) => slope(a, [x, y]),
            (None, _) => SLOPE,
        };
        [x, y, slope]
    })
});

/// The angles of the table \[rad\], rising.
pub(super) fn angles() -> impl Iterator<Item = f64> {
    TABLE.iter().map(|row| row.0.to_radians())
}

/// The table at s = sin²(θ/2): cubic in the logarithms between its angles, with the slopes of [`LOGARITHMS`], so that integrals
/// over angles meet no kinks.
pub(super) fn at(s: f64) -> f64 {
    let table = &*LOGARITHMS;
    let angle = (2.0 * s.sqrt().asin()).max(PEAK).ln();
    let after = table.partition_point(|row| row[0] <= angle);
    let log = match (after.checked_sub(1).map(|i| table[i]), table.get(after)) {
        (None, Some(first)) => first[1] + SLOPE * (angle - first[0]),
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
