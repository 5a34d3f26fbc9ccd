//! The cuboid's division under which its elements contribute most evenly (thesis 4.3.4, figures 4.7 and 4.8).

use glam::Vec3;

use super::layout::Layout;
use crate::Sky;

/// Division ratio m of top to sides and opening angle φ of the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optimum {
    /// m: how many times as wide as the top's the other elements are.
    pub ratio: f64,
    /// φ \[degrees\].
    pub opening_deg: f64,
}

/// m, φ \[degrees\] and g for the overcast sky with n = 40. From the example `optimum`:
/// `cargo run --release -p keikan-sky --example optimum`
const OVERCAST: [f64; 3] = [1.14, 75.0, 4.01];

/// The same for the CIE clear sky with the sun at altitudes of 0°, 5°, … 90°.
#[rustfmt::skip]
const CLEAR: [[f64; 3]; 19] = [
    [1.88, 60.0, 17.31],
    [1.78, 57.0, 17.08],
    [1.62, 56.0, 15.56],
    [1.46, 56.0, 13.64],
    [1.36, 56.0, 12.76],
    [1.32, 58.0, 13.00],
    [1.32, 61.0, 13.21],
    [1.28, 62.0, 13.10],
    [1.24, 63.0, 13.26],
    [1.24, 65.0, 13.04],
    [1.24, 66.0, 12.92],
    [1.24, 66.0, 12.95],
    [1.22, 68.0, 12.53],
    [1.20, 68.0, 12.35],
    [1.20, 69.0, 11.99],
    [1.20, 70.0, 11.71],
    [1.18, 70.0, 11.40],
    [1.18, 70.0, 10.86],
    [1.18, 70.0, 10.33],
];

/// Steps of the sun's altitude in the table \[degrees\].
const STEP: f64 = 5.0;
/// Divisions with which the candidates for a sky are compared.
const COARSE: u32 = 20;

impl Optimum {
    /// For the overcast sky.
    pub fn overcast() -> Self {
        Self::from_row(OVERCAST)
    }

    /// For the CIE clear sky with the sun at the altitude of the table nearest to this \[degrees\].
    pub fn clear(sun_altitude_deg: f64) -> Self {
        let row = (sun_altitude_deg.clamp(0.0, 90.0) / STEP).round();
        Self::from_row(CLEAR[(row as usize).min(CLEAR.len() - 1)])
    }

    /// For any sky: whichever of the two, with the brightest part as the sun, makes it more even.
    pub fn of(sky: &dyn Sky) -> Self {
        let toward = sky.brightest();
        let altitude = f64::from(toward.y.clamp(-1.0, 1.0)).asin().to_degrees();
        let evenness = |optimum: &Self| {
            let luminance =
                |direction: glam::DVec3| f64::from(sky.radiance(direction.as_vec3().normalize()).luminance());
            optimum.layout(toward, COARSE).evenness(luminance)
        };
        let [overcast, clear] = [Self::overcast(), Self::clear(altitude)];
        // A sky without light has no evenness: either will do.
        if evenness(&clear) < evenness(&overcast) { clear } else { overcast }
    }

    /// The layout with n = `divisions`, its top facing the unit vector `toward`.
    pub fn layout(&self, toward: Vec3, divisions: u32) -> Layout {
        Layout::new(toward, divisions, self.ratio, self.opening_deg)
    }

    fn from_row([ratio, opening_deg, _]: [f64; 3]) -> Self {
        Self { ratio, opening_deg }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::Distribution;

    fn toward(altitude: f64) -> Vec3 {
        let (sin, cos) = altitude.to_radians().sin_cos();
        Vec3::new(0.0, sin as f32, -cos as f32)
    }

    fn evenness(optimum: Optimum, sky: &Distribution, sun: Vec3) -> f64 {
        let luminance = |d: DVec3| f64::from(sky.relative_luminance(d.as_vec3().normalize(), sun));
        optimum.layout(sun, 40).evenness(luminance)
    }

    #[test]
    fn the_table_says_what_the_layouts_have_and_no_step_aside_is_better() {
        let overcast = (OVERCAST, Distribution::MoonSpencer, Vec3::Y);
        let clear = [0, 3, 9, 13, 18].map(|i| (CLEAR[i], Distribution::CIE_CLEAR, toward(STEP * i as f64)));
        for (row, sky, sun) in clear.into_iter().chain([overcast]) {
            let g = evenness(Optimum::from_row(row), &sky, sun);
            // Printed with two digits after the point.
            assert!((g - row[2]).abs() <= 0.0051, "{row:?} {g}");
            for (ratio, opening) in [(0.02, 0.0), (-0.02, 0.0), (0.0, 1.0), (0.0, -1.0)] {
                let beside = Optimum { ratio: row[0] + ratio, opening_deg: row[1] + opening };
                assert!(evenness(beside, &sky, sun) >= g, "{row:?} {beside:?}");
            }
        }
    }

    #[test]
    fn skies_find_their_division() {
        let at = |model: &Distribution, sun| crate::Luminous::new(model.clone(), sun);
        let sun = toward(31.0);
        assert_eq!(Optimum::of(&at(&Distribution::MoonSpencer, sun)), Optimum::overcast());
        assert_eq!(Optimum::of(&at(&Distribution::CIE_CLEAR, sun)), Optimum::clear(30.0));
    }
}
