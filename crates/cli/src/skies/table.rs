//! Luminances by altitude and azimuth, as `[sky] table` reads them.

use std::fmt::Write;

use scene::Scene;

use super::direction;
use super::report::Report;
use crate::assemble::OpenSky;

/// A heading of azimuths, then a row for each altitude from 0 to 90°, every `step` degrees; cd/m² in the fewest digits
/// that are read back as the same f32.
pub(super) fn csv(scene: &Scene, sky: &OpenSky, report: &Report, step: f64) -> String {
    let mut text = format!(
        "# keikan sky: luminance [cd/m2] without the sun's disc, by altitude (rows) and azimuth (columns, clockwise from true \
         north) [degrees]\n# {}\n# {}\naltitude",
        report.site,
        report.model()
    );
    let at = |index: u32| f64::from(index) * step;
    let (rows, columns) = ((90.0 / step).round() as u32, (360.0 / step).round() as u32);
    for column in 0..columns {
        // Writing to a text cannot fail.
        let _ = write!(text, ",{}", at(column));
    }
    text.push('\n');
    for row in 0..=rows {
        let _ = write!(text, "{}", at(row));
        for column in 0..columns {
            // The zenith has every azimuth.
            let azimuth = if row == rows { 0.0 } else { at(column) };
            let luminance = sky.radiance(direction(scene, at(row).min(90.0), azimuth)).luminance();
            let _ = write!(text, ",{luminance}");
        }
        text.push('\n');
    }
    text
}
