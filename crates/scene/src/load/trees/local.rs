//! Longitude and latitude → metres about the scene's place.

use glam::{DVec2, DVec3};

use crate::Site;

/// WGS 84: equatorial radius \[m\] and flattening.
const RADIUS: f64 = 6_378_137.0;
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// The plane that touches the ellipsoid at the site, whose place is the origin of the scene file's coordinates.
///
/// Points are moved onto it along its own normal: distances d from the site come out shorter by d³/6R², 4 mm at 10 km and half
/// a metre at 50 km. Heights count from the site's, along the ellipsoid: the earth's curvature is left out, as everywhere.
pub(super) struct LocalPlane {
    site: DVec3,
    east: DVec3,
    north: DVec3,
    elevation: f64,
    /// Directions of east and north in x and z.
    axes: [DVec2; 2],
}

impl LocalPlane {
    pub(super) fn at(site: &Site) -> Self {
        let (sin, cos) = site.latitude.to_radians().sin_cos();
        let (sin_lon, cos_lon) = site.longitude.to_radians().sin_cos();
        let (aside, ahead) = site.north.to_radians().sin_cos();
        Self {
            site: from_centre(site.longitude, site.latitude, site.elevation),
            east: DVec3::new(-sin_lon, cos_lon, 0.0),
            north: DVec3::new(-sin * cos_lon, -sin * sin_lon, cos),
            elevation: site.elevation,
            axes: [DVec2::new(ahead, aside), DVec2::new(aside, -ahead)],
        }
    }

    /// In the scene file's coordinates \[m\]; degrees, and metres above the sea (none = as high as the site).
    pub(super) fn place(&self, longitude: f64, latitude: f64, altitude: Option<f64>) -> DVec3 {
        let away = from_centre(longitude, latitude, self.elevation) - self.site;
        let plan = self.axes[0] * away.dot(self.east) + self.axes[1] * away.dot(self.north);
        DVec3::new(plan.x, altitude.map_or(0.0, |altitude| altitude - self.elevation), plan.y)
    }
}

/// Cartesian coordinates about the earth's centre \[m\], +Z through the north pole, +X through longitude 0:
///
///   ((N + h) cos φ cos λ, (N + h) cos φ sin λ, (N (1 − e²) + h) sin φ),   N = a / √(1 − e² sin² φ),   e² = f (2 − f)
fn from_centre(longitude: f64, latitude: f64, height: f64) -> DVec3 {
    let (sin, cos) = latitude.to_radians().sin_cos();
    let (sin_lon, cos_lon) = longitude.to_radians().sin_cos();
    let e2 = FLATTENING * (2.0 - FLATTENING);
    let n = RADIUS / (1.0 - e2 * sin * sin).sqrt();
    DVec3::new((n + height) * cos * cos_lon, (n + height) * cos * sin_lon, (n * (1.0 - e2) + height) * sin)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn site(latitude: f64, longitude: f64, north: f64) -> Site {
        Site { latitude, longitude, north, elevation: 0.0, ..Site::default() }
    }

    /// Equirectangular about the site, with the ellipsoid's radii of curvature there.
    fn equirectangular(site: &Site, longitude: f64, latitude: f64) -> DVec3 {
        let (sin, cos) = site.latitude.to_radians().sin_cos();
        let e2 = 0.006_694_379_990_14;
        let root = (1.0 - e2 * sin * sin).sqrt();
        let (across, along) = (6_378_137.0 / root, 6_378_137.0 * (1.0 - e2) / root.powi(3));
        let east = (longitude - site.longitude).to_radians() * across * cos;
        DVec3::new(east, 0.0, -(latitude - site.latitude).to_radians() * along)
    }

    proptest! {
        #[test]
        fn near_the_site_it_is_the_equirectangular_projection(
            latitude in -75.0..75.0f64, longitude in -179.0..179.0f64, by in [-0.02..0.02f64, -0.02..0.02],
        ) {
            let site = site(latitude, longitude, 0.0);
            let (lon, lat) = (longitude + by[0], latitude + by[1]);
            let expected = equirectangular(&site, lon, lat);
            let found = LocalPlane::at(&site).place(lon, lat, None);
            // The equirectangular projection is off by x (y, x/2) tan φ/R, at most 0.58 d² tan |φ|/R; 10 % for third orders, and
            // 1 mm for those and rounding (10⁻⁹ m of 10⁷).
            let d = expected.length();
            let bound = 1.1 * 0.58 * d * d * latitude.abs().to_radians().tan() / 6.36e6 + d.powi(3) / 4e13 + 1e-3;
            prop_assert!((found - expected).length() <= bound, "{found} {expected} {bound}");
        }

        #[test]
        fn north_turns_the_scene(north in -360.0..360.0f64, by in [-0.02..0.02f64, -0.02..0.02]) {
            let place = |north: f64| LocalPlane::at(&site(35.0, 139.0, north)).place(139.0 + by[0], 35.0 + by[1], Some(7.0));
            let (sin, cos) = north.to_radians().sin_cos();
            let level = place(0.0);
            // Clockwise seen from above, where −Z is up and +X right.
            let turned = DVec3::new(level.x * cos - level.z * sin, 7.0, level.z * cos + level.x * sin);
            prop_assert!((place(north) - turned).length() < 1e-6);
        }
    }

    #[test]
    fn a_minute_of_latitude_is_a_nautical_mile() {
        let at = LocalPlane::at(&site(45.0, 7.0, 0.0)).place(7.0, 45.0 + 1.0 / 60.0, None);
        // 1852.2 m at 45°, by the definition of the metre and of the ellipsoid.
        assert!(at.x.abs() < 1e-6 && (at.z + 1852.2).abs() < 0.1, "{at}");
    }
}
