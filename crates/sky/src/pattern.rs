//! How luminance is spread over the sky: standard distributions, relative to the zenith.

use glam::Vec3;

use crate::sky::lifted;

/// A standard distribution of luminance over the sky.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// The same luminance everywhere.
    Uniform,
    /// The CIE overcast sky of Moon and Spencer (the 16th of ISO 15469): three times as bright at the zenith
    /// as at the horizon, the same in every direction of the compass.
    Overcast,
    /// The CIE clear sky of 1973 (Kittler; type 12 of ISO 15469 to 0.02 %): bright around the sun and towards
    /// the horizon, darkest across the zenith from the sun.
    Clear,
}

impl Pattern {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Uniform, Self::Overcast, Self::Clear];

    /// Its name in scene files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Overcast => "overcast",
            Self::Clear => "clear",
        }
    }

    /// The distribution of that name.
    ///
    /// ```
    /// use keikan_sky::Pattern;
    /// assert_eq!(Pattern::named("overcast"), Some(Pattern::Overcast));
    /// assert_eq!(Pattern::named("purple"), None);
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|pattern| pattern.name() == name)
    }

    /// Luminance along the unit vector `direction` as a multiple of that at the zenith; 0 below the horizon.
    ///
    /// With Z and Z_s the angles of the direction and of the sun from the zenith and γ the angle between:
    ///
    ///   overcast   L/L_z = (1 + 2 cos Z)/3
    ///   clear      L/L_z = f(γ) φ(Z) / (f(Z_s) φ(0)),   f(γ) = 0.91 + 10 e^(−3γ) + 0.45 cos² γ,
    ///                                                   φ(Z) = 1 − e^(−0.32/cos Z)
    ///
    /// `toward_sun` is a unit vector; a sun below the horizon counts as on it.
    pub fn relative_luminance(self, direction: Vec3, toward_sun: Vec3) -> f32 {
        if direction.y < 0.0 {
            return 0.0;
        }
        let sun = lifted(toward_sun);
        self.shape(direction, sun) / self.shape(Vec3::Y, sun)
    }

    /// The same but for a factor that depends on the sun alone; direction and sun are not below the horizon.
    pub(crate) fn shape(self, direction: Vec3, sun: Vec3) -> f32 {
        match self {
            Self::Uniform => 1.0,
            Self::Overcast => (1.0 + 2.0 * direction.y) / 3.0,
            Self::Clear => indicatrix(direction, sun) * (1.0 - (-0.32 / direction.y).exp()),
        }
    }
}

/// f(γ) of the clear sky.
fn indicatrix(direction: Vec3, sun: Vec3) -> f32 {
    // The chord between unit vectors, 2 sin(γ/2), keeps its digits at the cusp γ = 0.
    let half_chord = (0.5 * direction.distance(sun)).min(1.0);
    let cos = 1.0 - 2.0 * half_chord * half_chord;
    0.91 + 10.0 * (-6.0 * half_chord.asin()).exp() + 0.45 * cos * cos
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(altitude: f32, azimuth: f32) -> Vec3 {
        let (h, a) = (altitude.to_radians(), azimuth.to_radians());
        Vec3::new(h.cos() * a.sin(), h.sin(), -h.cos() * a.cos())
    }

    #[test]
    fn the_clear_sky_has_the_values_of_its_formula() {
        // (sun's altitude, altitude, azimuth from the sun) → L/L_z, evaluated in f64 to five decimals.
        for (sun, altitude, azimuth, expected) in [
            (10.0, 90.0, 0.0, 1.00000),
            (10.0, 75.0, 45.0, 1.17359),
            (10.0, 30.0, 0.0, 7.73249),
            (10.0, 5.0, 0.0, 29.96432),
            (10.0, 1.0, 180.0, 4.56803),
            (20.0, 60.0, 90.0, 1.08389),
            (20.0, 45.0, 0.0, 4.34160),
        ] {
            let value = Pattern::Clear.relative_luminance(direction(altitude, azimuth), direction(sun, 0.0));
            // Half of the last decimal, and some 20 f32 operations of at most ±60 ulp through the exponent.
            assert!(
                (value - expected).abs() <= 0.5e-5 + 4e-6 * expected,
                "{sun} {altitude} {azimuth}: {value}"
            );
        }
    }

    #[test]
    fn every_sky_is_one_at_the_zenith_positive_above_the_horizon_and_zero_below() {
        for pattern in Pattern::ALL {
            for sun in -90..=90 {
                let sun = direction(sun as f32, 123.0);
                let zenith = pattern.relative_luminance(Vec3::Y, sun);
                assert!((zenith - 1.0).abs() <= 4.0 * f32::EPSILON, "the same expression twice: {zenith}");
                for altitude in -90..=90 {
                    let value = pattern.relative_luminance(direction(altitude as f32, 77.0), sun);
                    let above = altitude >= 0;
                    assert!(
                        value.is_finite() && if above { value > 0.0 } else { value == 0.0 },
                        "{altitude}"
                    );
                }
            }
        }
    }

    #[test]
    fn names_are_their_own() {
        for pattern in Pattern::ALL {
            assert_eq!(Pattern::named(pattern.name()), Some(pattern));
        }
    }
}
