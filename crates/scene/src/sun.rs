//! Where the sun stands, and directions over the horizon.

use glam::DVec3;
use solar_positioning::time::JulianDate;
use solar_positioning::{Location, RefractionCorrection, SolarPositions, delta_t};

use crate::{Site, Sun};

/// Mean diameter of the sun's disc as seen from the earth in degrees (0.524 in July to 0.542 in January).
pub const SUN_DIAMETER: f64 = 0.533;

impl Default for Site {
    /// Tokyo, 2026-06-21 at ten in the morning: where a model without a place is shown.
    fn default() -> Self {
        Self {
            latitude: 35.68,
            longitude: 139.77,
            elevation: 0.0,
            // 2026-06-21T01:00:00Z in seconds since 1970; a constant within range.
            time: jiff::Timestamp::constant(1_782_003_600, 0),
            offset: jiff::tz::Offset::constant(9),
            north: 0.0,
        }
    }
}

impl Site {
    /// The sun at this place and time; none where the algorithm does not reach (years outside −500 to 3000).
    ///
    /// NREL's Solar Position Algorithm (Reda and Andreas 2004, ±0.0003°), seen from the place itself
    /// (parallax) at its height. Altitude is *apparent*: refraction by Sæmundsson's formula as SPA has it,
    /// with pressure and temperature of the standard atmosphere at the elevation. Below −0.833°, where SPA
    /// ends it at a stroke, it fades to nothing over 3°: twilight has no step.
    /// UTC is taken for UT1 (< 0.9 s apart: < 0.004°); ΔT by Espenak and Meeus' polynomials as continued
    /// in the library. May be below the horizon.
    ///
    /// ```
    /// let sun = keikan_scene::Site::default().sun().unwrap();
    /// // By hand: declination 23.44°, hour angle −25.7° (solar time 10:17).
    /// assert!((sun.altitude - 64.7).abs() < 0.05 && (sun.azimuth - 111.8).abs() < 0.05);
    /// ```
    pub fn sun(&self) -> Option<Sun> {
        let air = standard_air(self.elevation)?;
        let (straight, azimuth) = self.solar_angles(None)?;
        let altitude = if straight < SET {
            straight + refraction(SET, &air) * (1.0 - (SET - straight) / FADE).max(0.0)
        } else {
            self.solar_angles(Some(air))?.0
        };
        let toward = self.direction(altitude, azimuth);
        Some(Sun { toward, altitude, azimuth, illuminance: None, spectrum: None, diameter: SUN_DIAMETER })
    }

    /// Altitude and azimuth of the sun in degrees.
    fn solar_angles(&self, refraction: Option<RefractionCorrection>) -> Option<(f64, f64)> {
        const UNIX_EPOCH: f64 = 2_440_587.5; // as a Julian date
        let days = self.time.as_nanosecond() as f64 / 86_400e9;
        // Julian date 2451544.5 is the beginning of the year 2000.
        let year = 2000.0 + (UNIX_EPOCH + days - 2_451_544.5) / 365.2425;
        let time = JulianDate::new(UNIX_EPOCH + days, delta_t::estimate(year).ok()?).ok()?;
        let place = Location { latitude: self.latitude, longitude: self.longitude };
        let position = SolarPositions::new().at_from_julian(time, place, self.elevation, refraction).ok()?;
        Some((position.elevation_angle(), position.azimuth()))
    }

    /// Unit vector in the world at `altitude` above the horizon and `azimuth` clockwise from true north, in
    /// degrees.
    ///
    /// North lies `north` degrees clockwise of −Z, so seen from above the direction is `north + azimuth`
    /// degrees clockwise from −Z, where +X is at 90°.
    ///
    /// ```
    /// let site = keikan_scene::Site::default();
    /// let east = site.direction(0.0, 90.0);
    /// assert!((east - glam::DVec3::X).length() < 1e-15); // cos 90° in f64 is 6e-17
    /// ```
    pub fn direction(&self, altitude: f64, azimuth: f64) -> DVec3 {
        let (up, level) = altitude.to_radians().sin_cos();
        let (east, north) = (self.north + azimuth).to_radians().sin_cos();
        DVec3::new(level * east, up, -level * north)
    }

    /// Altitude and azimuth (within \[0, 360)) in degrees of a direction in the world: the inverse of
    /// [`Self::direction`]. Straight up or down, the azimuth is that of −Z.
    pub fn angles(&self, direction: DVec3) -> (f64, f64) {
        let level = direction.x.hypot(direction.z);
        let altitude = direction.y.atan2(level).to_degrees();
        let azimuth = direction.x.atan2(-direction.z).to_degrees() - self.north;
        (altitude, azimuth.rem_euclid(360.0))
    }
}

/// True altitude of the sun's centre at which SPA takes its disc for set and refraction for nothing, degrees.
const SET: f64 = -0.833_67;

/// Degrees below that over which refraction fades: slowly enough that the sun still sinks.
const FADE: f64 = 3.0;

/// Refraction at true altitude `h`, degrees: Sæmundsson's formula as SPA has it (Reda and Andreas 2004, eq. 42).
fn refraction(h: f64, air: &RefractionCorrection) -> f64 {
    let standard = 1.02 / (60.0 * (h + 10.3 / (h + 5.11)).to_radians().tan());
    standard * (air.pressure() / 1010.0) * (283.0 / (273.0 + air.temperature()))
}

/// Pressure and temperature of the standard atmosphere (ISO 2533) at `height` metres above the sea; they
/// change refraction (0.5° at the horizon) by a few hundredths of a degree at most.
fn standard_air(height: f64) -> Option<RefractionCorrection> {
    let pressure = 1013.25 * (1.0 - 2.255_77e-5 * height).max(0.0).powf(5.255_88);
    RefractionCorrection::new(pressure, 15.0 - 0.0065 * height).ok()
}

#[cfg(test)]
mod tests;
