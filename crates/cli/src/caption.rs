//! What every output states: UTC, zone, place, north, and where the sun stands.

use scene::Scene;

/// One line: UTC, local offset, place, north, sun.
pub(crate) fn describe(scene: &Scene) -> String {
    let site = &scene.site;
    let sun = scene.sun.as_ref().map_or("no sun".to_owned(), |sun| {
        let side = if sun.altitude < 0.0 { "below the horizon" } else { "high" };
        format!("sun {:.2}° {side} at azimuth {:.2}°", sun.altitude.abs(), sun.azimuth)
    });
    format!(
        "{} UTC (local {}), latitude {:.4}°, longitude {:.4}°, {:.0} m, north {:.1}° from −Z; {sun}",
        site.time.strftime("%Y-%m-%d %H:%M:%S"),
        site.offset,
        site.latitude,
        site.longitude,
        site.elevation,
        site.north,
    )
}

/// Local time in OpenEXR's form, `YYYY:MM:DD hh:mm:ss`.
pub(crate) fn local_time(scene: &Scene) -> String {
    scene.site.offset.to_datetime(scene.site.time).strftime("%Y:%m:%d %H:%M:%S").to_string()
}
