//! What every output states: UTC, zone, place, north, where the sun stands, and the weather if a file tells it.

use scene::Scene;

/// One line: UTC, local offset, place, north, sun, weather.
pub(crate) fn describe(scene: &Scene) -> String {
    let site = &scene.site;
    let sun = scene.sun.as_ref().map_or("no sun".to_owned(), |sun| {
        let side = if sun.altitude < 0.0 { "below the horizon" } else { "high" };
        format!("sun {:.2}° {side} at azimuth {:.2}°", sun.altitude.abs(), sun.azimuth)
    });
    let weather = scene.sky.as_ref().and_then(|sky| sky.weather.as_ref()).map_or(String::new(), |weather| {
        let (direct, diffuse) = (weather.direct_normal, weather.diffuse_horizontal);
        format!("; weather of {}: {direct:.0} W/m² direct normal, {diffuse:.0} W/m² diffuse", weather.station)
    });
    format!(
        "{} UTC (local {}), latitude {:.4}°, longitude {:.4}°, {:.0} m, north {:.1}° from −Z; {sun}{weather}",
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
