//! What planes of any tilt receive from the whole, unobstructed sky: a table.

use std::f32::consts::PI;
use std::f64::consts;

use glam::Vec3;
use light::Spectrum;
use light::bands::BANDS;

use crate::Sky;

/// Intervals of the table over the normal's angle from the zenith (0 to 180°), 4° each.
const TILTS: usize = 45;
/// Intervals over its azimuth (0 to 360°), 4° each.
const AZIMUTHS: usize = 90;
/// Bands of altitude of the quadrature, 1.5° each.
const ROWS: usize = 60;
/// Patches around each band, 1.5° each.
const COLUMNS: usize = 240;
/// Harmonics of azimuth that are kept. What a cosine at a plane makes of harmonic m falls as m⁻²: beyond these a
/// cusp at the sun (m⁻² itself) leaves less than 1e-4.
const HARMONICS: usize = 24;

/// Irradiance of the open sky by the plane's normal \[W m⁻² nm⁻¹\].
///
/// E(n) = ∫ L cos⁺ dω over the sky, by bands of altitude. Around each band L is a Fourier series in azimuth; cos⁺
/// is max(0, A + B cos Δ), A = cos tilt sin altitude, B = sin tilt cos altitude, whose series is known in closed
/// form; their convolution is one product per harmonic. Tabulated every 4° and linear between: 0.1 % of the
/// table's largest value off the true one at most, as its test shows.
#[derive(Clone)]
pub(crate) struct OpenSky {
    /// By tilt, then by azimuth from +X towards +Z.
    irradiance: Vec<Vec<Spectrum>>,
}

impl OpenSky {
    /// Takes some 10 ms and 14 400 questions to the sky.
    pub(crate) fn new(sky: &dyn Sky) -> Self {
        let rows: Vec<Row> = (0..ROWS).map(|row| Row::new(sky, row)).collect();
        let turns: Vec<[f64; 2]> = (0..AZIMUTHS).map(|k| cos_sin(angle(k))).collect();
        let irradiance = (0..=TILTS)
            .map(|tilt| {
                let series = series_of_tilt(&rows, angle(tilt));
                turns.iter().map(|&turn| evaluate(&series, turn)).collect()
            })
            .collect();
        Self { irradiance }
    }

    /// Irradiance on the plane of unit `normal` \[W m⁻² nm⁻¹\].
    pub(crate) fn on_plane(&self, normal: Vec3) -> Spectrum {
        let tilt = normal.x.hypot(normal.z).atan2(normal.y);
        let azimuth = normal.z.atan2(normal.x);
        let (i, u) = cell(tilt, TILTS);
        let (j, v) = cell(if azimuth < 0.0 { azimuth + 2.0 * PI } else { azimuth }, AZIMUTHS);
        let next = (j + 1) % AZIMUTHS;
        let along = |row: &[Spectrum]| row[j] + (row[next] - row[j]) * v;
        let (low, high) = (along(&self.irradiance[i]), along(&self.irradiance[i + 1]));
        low + (high - low) * u
    }

    /// Irradiance on the horizontal \[W m⁻² nm⁻¹\].
    pub(crate) fn horizontal(&self) -> Spectrum {
        self.irradiance[0][0]
    }
}

/// ∫ L sin h dω over the patches: `radiance` is any quantity by direction, the result what it gives the horizontal.
pub(crate) fn horizontal(radiance: impl Fn(Vec3) -> f64) -> f64 {
    let ring = |row: usize| {
        let (sin, cos, solid_angle) = band(row);
        let sum: f64 = (0..COLUMNS).map(|column| radiance(patch(sin, cos, column).0)).sum();
        sum * sin * solid_angle / COLUMNS as f64
    };
    (0..ROWS).map(ring).sum()
}

/// Angle of a grid line \[rad\].
fn angle(index: usize) -> f64 {
    index as f64 * (consts::PI / TILTS as f64)
}

fn cos_sin(angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos, sin]
}

/// Interval that an angle ≥ 0 lies in, and how far into it.
fn cell(angle: f32, intervals: usize) -> (usize, f32) {
    let at = (angle * (TILTS as f32 / PI)).clamp(0.0, intervals as f32);
    let index = (at as usize).min(intervals - 1);
    (index, at - index as f32)
}

/// sin and cos of the altitude in the middle of a band, and the exact solid angle between its two edges \[sr\].
fn band(index: usize) -> (f64, f64, f64) {
    let step = consts::FRAC_PI_2 / ROWS as f64;
    let altitude = (index as f64 + 0.5) * step;
    let (sin, cos) = altitude.sin_cos();
    (sin, cos, 2.0 * consts::PI * ((altitude + 0.5 * step).sin() - (altitude - 0.5 * step).sin()))
}

/// The direction to the middle of a patch, and cos and sin of its azimuth.
fn patch(sin: f64, cos: f64, column: usize) -> (Vec3, [f64; 2]) {
    let [c, s] = cos_sin((column as f64 + 0.5) * (2.0 * consts::PI / COLUMNS as f64));
    (Vec3::new((cos * c) as f32, sin as f32, (cos * s) as f32), [c, s])
}

/// A spectrum in f64: sums of thousands of terms.
type Wide = [f64; BANDS];

/// One band of altitude: cosine and sine series of ∫ L dω over azimuth.
struct Row {
    sin: f64,
    cos: f64,
    /// Solid angle of the band times mean, and twice the mean, of L · (cos mφ, sin mφ).
    series: [[Wide; 2]; HARMONICS + 1],
}

impl Row {
    fn new(sky: &dyn Sky, index: usize) -> Self {
        let (sin, cos, solid_angle) = band(index);
        let mut series = [[[0.0; BANDS]; 2]; HARMONICS + 1];
        for column in 0..COLUMNS {
            let (direction, [c, s]) = patch(sin, cos, column);
            let radiance = sky.radiance(direction).0.map(f64::from);
            // cos mφ and sin mφ by turning on.
            let [mut re, mut im] = [1.0, 0.0];
            for [by_cos, by_sin] in &mut series {
                for band in 0..BANDS {
                    by_cos[band] += radiance[band] * re;
                    by_sin[band] += radiance[band] * im;
                }
                [re, im] = [re * c - im * s, re * s + im * c];
            }
        }
        for (m, harmonic) in series.iter_mut().enumerate() {
            let scale = if m == 0 { 1.0 } else { 2.0 } * solid_angle / COLUMNS as f64;
            harmonic.iter_mut().flatten().for_each(|term| *term *= scale);
        }
        Self { sin, cos, series }
    }
}

/// E by the azimuth of planes of one tilt, as a series.
fn series_of_tilt(rows: &[Row], tilt: f64) -> [[Wide; 2]; HARMONICS + 1] {
    let (sin_tilt, cos_tilt) = tilt.sin_cos();
    let mut sums = [[[0.0; BANDS]; 2]; HARMONICS + 1];
    for row in rows {
        let kernel = clamped_cosine(cos_tilt * row.sin, sin_tilt * row.cos);
        for ((sum, harmonic), k) in sums.iter_mut().zip(&row.series).zip(kernel) {
            for part in 0..2 {
                for band in 0..BANDS {
                    sum[part][band] += harmonic[part][band] * k;
                }
            }
        }
    }
    sums
}

fn evaluate(series: &[[Wide; 2]; HARMONICS + 1], [c, s]: [f64; 2]) -> Spectrum {
    let mut sum = [0.0; BANDS];
    let [mut re, mut im] = [1.0, 0.0];
    for [by_cos, by_sin] in series {
        for band in 0..BANDS {
            sum[band] += by_cos[band] * re + by_sin[band] * im;
        }
        [re, im] = [re * c - im * s, re * s + im * c];
    }
    // A series cut short may swing below zero where there is nothing.
    Spectrum(sum.map(|band| band.max(0.0) as f32))
}

/// Mean over azimuth of max(0, a + b cos Δ) cos mΔ, b ≥ 0: what is left of harmonic m.
///
/// With Δ₀ = acos(−a/b), where the plane cuts through the circle of altitude:
///
///   π k_m = a sin(mΔ₀)/m + (b/2) (sin((m−1)Δ₀)/(m−1) + sin((m+1)Δ₀)/(m+1)),   sin(0 Δ₀)/0 = Δ₀
fn clamped_cosine(a: f64, b: f64) -> [f64; HARMONICS + 1] {
    let edge = if a >= b { consts::PI } else { (-a / b).clamp(-1.0, 1.0).acos() };
    let part = |m: usize| if m == 0 { edge } else { (m as f64 * edge).sin() / m as f64 };
    std::array::from_fn(|m| {
        let beside = part(m.abs_diff(1)) + part(m + 1);
        (a * part(m) + 0.5 * b * beside) / consts::PI
    })
}

#[cfg(test)]
mod tests;
