//! What planes of any tilt receive from the whole, unobstructed sky: a table.

use std::f32::consts::PI;

use glam::Vec3;

use crate::Pattern;
use crate::sky::lifted;

/// Intervals of the table over the normal's angle from the zenith (0 to 180°), and over its azimuth from the
/// sun (0 to 180°): 4° each.
const STEPS: usize = 45;
/// Bands of altitude of the quadrature, 1.5° each.
const BANDS: usize = 60;

/// Irradiance of the open sky by the plane's normal, per zenith radiance \[sr\].
///
/// The integral of L/L_z cos⁺ over the sky, by the midpoint rule on 7200 patches and with the sun's vertical
/// plane as mirror plane, tabulated every 4° and linear between: 0.1 % of the table's largest value off the
/// true one at most, as its test shows.
#[derive(Clone, Debug)]
pub(crate) struct OpenSky {
    /// Unit horizontal vector towards the sun's azimuth.
    ahead: Vec3,
    /// By tilt, then by azimuth from the sun.
    irradiance: Vec<[f32; STEPS + 1]>,
}

impl OpenSky {
    pub(crate) fn new(pattern: Pattern, toward_sun: Vec3) -> Self {
        let sun = lifted(toward_sun);
        let ahead = Vec3::new(sun.x, 0.0, sun.z).try_normalize().unwrap_or(Vec3::NEG_Z);
        let patches = patches(pattern, sun, ahead);
        let side = ahead.cross(Vec3::Y);
        let row = |tilt: usize| {
            let (sin_tilt, cos_tilt) = angle(tilt).sin_cos();
            std::array::from_fn(|azimuth| {
                let (sin, cos) = angle(azimuth).sin_cos();
                let normal = (ahead * cos + side * sin) * sin_tilt + Vec3::Y * cos_tilt;
                // The patches of one half of the sky, and of its mirror image.
                let mirrored = normal - side * (2.0 * normal.dot(side));
                patches.iter().map(|patch| patch.dot(normal).max(0.0) + patch.dot(mirrored).max(0.0)).sum()
            })
        };
        Self { ahead, irradiance: (0..=STEPS).map(row).collect() }
    }

    /// Irradiance on the plane of unit `normal` per zenith radiance \[sr\].
    pub(crate) fn on_plane(&self, normal: Vec3) -> f32 {
        let horizontal = Vec3::new(normal.x, 0.0, normal.z);
        let tilt = horizontal.length().atan2(normal.y);
        let azimuth = self.ahead.cross(horizontal).length().atan2(self.ahead.dot(horizontal));
        let (i, u) = cell(tilt);
        let (j, v) = cell(azimuth);
        let along = |row: &[f32; STEPS + 1]| row[j] + v * (row[j + 1] - row[j]);
        let (low, high) = (along(&self.irradiance[i]), along(&self.irradiance[i + 1]));
        low + u * (high - low)
    }

    /// Irradiance on the horizontal per zenith radiance \[sr\].
    pub(crate) fn horizontal(&self) -> f32 {
        self.irradiance[0][0]
    }
}

/// Angle of a grid line \[rad\].
fn angle(index: usize) -> f32 {
    index as f32 * (PI / STEPS as f32)
}

/// Interval that an angle within \[0, π\] lies in, and how far into it.
fn cell(angle: f32) -> (usize, f32) {
    let at = (angle * (STEPS as f32 / PI)).clamp(0.0, STEPS as f32);
    let index = (at as usize).min(STEPS - 1);
    (index, at - index as f32)
}

/// Directions to patches of that half of the sky that is right of the sun, each times L/L_z times its solid angle.
fn patches(pattern: Pattern, sun: Vec3, ahead: Vec3) -> Vec<Vec3> {
    let step = 0.5 * PI / BANDS as f32;
    let side = ahead.cross(Vec3::Y);
    let mut patches = Vec::with_capacity(BANDS * BANDS * 2);
    for band in 0..BANDS {
        let altitude = (band as f32 + 0.5) * step;
        let (sin, cos) = altitude.sin_cos();
        // The exact solid angle of the band between two circles of altitude, per radian of azimuth.
        let height = (altitude + 0.5 * step).sin() - (altitude - 0.5 * step).sin();
        for column in 0..2 * BANDS {
            let (sin_azimuth, cos_azimuth) = ((column as f32 + 0.5) * step).sin_cos();
            let direction = (ahead * cos_azimuth + side * sin_azimuth) * cos + Vec3::Y * sin;
            patches.push(direction * (pattern.relative_luminance(direction, sun) * height * step));
        }
    }
    patches
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_altitude(degrees: f32) -> Vec3 {
        let h = degrees.to_radians();
        Vec3::new(h.cos(), h.sin(), 0.0)
    }

    /// The same integral in f64 for one plane, on a grid five times finer in each direction.
    fn reference(pattern: Pattern, sun: Vec3, normal: Vec3) -> f64 {
        let bands = 300;
        let step = std::f64::consts::FRAC_PI_2 / f64::from(bands);
        let mut sum = 0.0;
        for band in 0..bands {
            let (sin, cos) = ((f64::from(band) + 0.5) * step).sin_cos();
            for column in 0..4 * bands {
                let (s, c) = ((f64::from(column) + 0.5) * step).sin_cos();
                let direction = Vec3::new((cos * c) as f32, sin as f32, (cos * s) as f32);
                let cosine = f64::from(direction.dot(normal).max(0.0));
                sum += f64::from(pattern.relative_luminance(direction, sun)) * cosine * cos * step * step;
            }
        }
        sum
    }

    #[test]
    fn horizontal_irradiance_is_that_of_the_closed_forms() {
        // Bands with exact solid angles: the midpoint rule for sin h and sin² h errs by h²/24 and h²/6.
        let rule = (1.5f32).to_radians().powi(2) / 6.0;
        let uniform = OpenSky::new(Pattern::Uniform, Vec3::Y);
        assert!((uniform.horizontal() / PI - 1.0).abs() <= rule);
        let overcast = OpenSky::new(Pattern::Overcast, Vec3::Y);
        assert!((overcast.horizontal() / (7.0 * PI / 9.0) - 1.0).abs() <= rule);
        // A vertical plane under the overcast sky receives 0.396 of it: (1/3)(π/2) + (2/3)(2/3) = π/6 + 4/9
        // against 7π/9.
        let share = overcast.on_plane(Vec3::X) / overcast.horizontal();
        let exact = (PI / 6.0 + 4.0 / 9.0) / (7.0 * PI / 9.0);
        assert!((exact - 0.396).abs() < 5e-4, "the figure of the textbooks");
        assert!((share - exact).abs() <= 2.0 * rule, "{share}");
    }

    #[test]
    fn the_clear_sky_has_its_published_integrals() {
        // E_h/L_z by 400 × 200 points of Gauss, by the sun's altitude, for type 12 of ISO 15469, which is the
        // formula of 1973 but for 0.9102 in place of 0.91: 2e-4.
        for (altitude, expected) in [
            (0.0, 6.95599),
            (10.0, 7.22935),
            (20.0, 7.05191),
            (30.0, 6.39411),
            (40.0, 5.40530),
            (50.0, 4.28122),
            (60.0, 3.19057),
            (70.0, 2.24759),
            (80.0, 1.50597),
            (90.0, 0.96736),
        ] {
            let ours = OpenSky::new(Pattern::Clear, at_altitude(altitude)).horizontal();
            // The cusp at the sun, slope 3, within cells of 1.5°: (3 · 0.026)²/12 = 5e-4 of what is near it.
            assert!((ours / expected - 1.0).abs() <= 2e-4 + 5e-4, "{altitude}: {ours}");
        }
    }

    #[test]
    fn the_table_is_within_its_stated_error_for_every_tilt() {
        for altitude in [5.0, 40.0] {
            let sun = at_altitude(altitude);
            let table = OpenSky::new(Pattern::Clear, sun);
            let largest = table.irradiance.iter().flatten().fold(0.0f32, |a, &b| a.max(b));
            for (tilt, azimuth) in
                [(2.0, 10.0), (50.0, 2.0), (86.0, 6.0), (90.0, 90.0), (94.0, 178.0), (130.0, 30.0)]
            {
                let (t, a) = (f32::to_radians(tilt), f32::to_radians(azimuth));
                for sign in [-1.0, 1.0] {
                    let normal = Vec3::new(t.sin() * a.cos(), t.cos(), sign * t.sin() * a.sin());
                    let exact = reference(Pattern::Clear, sun, normal) as f32;
                    let error = (table.on_plane(normal) - exact).abs();
                    // Linear over 4°: (0.07)²/8 = 6e-4 of a cosine, and the quadrature's 5e-4.
                    assert!(error <= 1.1e-3 * largest, "{altitude} {tilt} {azimuth}: {error}");
                }
            }
        }
    }

    #[test]
    fn a_plane_that_looks_down_receives_nothing() {
        for pattern in Pattern::ALL {
            assert!(OpenSky::new(pattern, Vec3::Y).on_plane(Vec3::NEG_Y).abs() < 1e-6);
        }
    }
}
