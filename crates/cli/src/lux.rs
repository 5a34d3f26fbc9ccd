//! Illuminance at sensors, by source.

use std::fmt;

use glam::{DVec3, Vec3};
use light::{Place, rounding};
use rayon::prelude::*;
use scene::{Scene, Sensor};

use crate::pipeline::Pipeline;

/// Lux of one sensor point.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Row {
    /// Name of the sensor.
    pub sensor: String,
    /// Number of the point within it, from 0.
    pub point: usize,
    /// Where, in the coordinates of the file \[m\].
    pub position: [f64; 3],
    /// All sources together \[lx\].
    pub total: f64,
    /// Each source \[lx\], in the order of [`Table::sources`].
    pub parts: Vec<f64>,
}

/// Lux of a scene's sensors.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Table {
    /// Names of the sources.
    pub sources: Vec<String>,
    /// One row per point.
    pub rows: Vec<Row>,
    /// Minimum, mean and uniformity (minimum / mean) of each sensor with several points.
    pub uniformity: Vec<Uniformity>,
}

/// How even the light on a sensor is.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Uniformity {
    /// Name of the sensor.
    pub sensor: String,
    /// Smallest illuminance \[lx\].
    pub minimum: f64,
    /// Mean illuminance \[lx\].
    pub mean: f64,
    /// Largest illuminance \[lx\].
    pub maximum: f64,
    /// Minimum / mean; 0 where there is no light.
    pub uniformity: f64,
}

/// Illuminance at every sensor point of the scene.
pub fn table(scene: &Scene, pipeline: &Pipeline) -> Table {
    let points: Vec<(&Sensor, usize, DVec3)> = scene
        .sensors
        .iter()
        .flat_map(|sensor| sensor.points.iter().enumerate().map(move |(i, &point)| (sensor, i, point)))
        .collect();
    let rows: Vec<Row> = points
        .par_iter()
        .map(|&(sensor, point, position)| {
            let parts: Vec<f64> = pipeline
                .irradiances(&place(position, sensor.normal.as_vec3(), point))
                .into_iter()
                .map(|irradiance| f64::from(irradiance.luminance()))
                .collect();
            let position = (position + scene.origin).to_array();
            Row { sensor: sensor.name.clone(), point, position, total: parts.iter().sum(), parts }
        })
        .collect();
    let uniformity =
        scene.sensors.iter().filter(|s| s.points.len() > 1).map(|s| uniformity(&s.name, &rows)).collect();
    Table { sources: pipeline.sources.iter().map(|source| source.name.clone()).collect(), rows, uniformity }
}

/// The place of a sensor point: as exact as f32 lets it be, so that it may lie on a surface.
fn place(position: DVec3, normal: Vec3, point: usize) -> Place {
    let rounded = position.as_vec3();
    // ½ ulp for the point, and as much again for the corners of the face it may lie on.
    let error = 4.0 * rounding::UNIT * rounded.abs().max_element();
    Place { position: rounded, error, normal, seed: point as u32 }
}

fn uniformity(name: &str, rows: &[Row]) -> Uniformity {
    let totals: Vec<f64> = rows.iter().filter(|row| row.sensor == name).map(|row| row.total).collect();
    let mean = totals.iter().sum::<f64>() / totals.len().max(1) as f64;
    let minimum = totals.iter().copied().fold(f64::INFINITY, f64::min);
    let maximum = totals.iter().copied().fold(0.0, f64::max);
    let uniformity = if mean > 0.0 { minimum / mean } else { 0.0 };
    Uniformity { sensor: name.to_owned(), minimum, mean, maximum, uniformity }
}

impl fmt::Display for Table {
    /// CSV with a header line; numbers in lx and m.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sensor,point,x_m,y_m,z_m,total_lx")?;
        self.sources.iter().try_for_each(|source| write!(f, ",{}_lx", quoted(source)))?;
        for row in &self.rows {
            let [x, y, z] = row.position;
            write!(f, "\n{},{},{x},{y},{z},{:.6}", quoted(&row.sensor), row.point, row.total)?;
            row.parts.iter().try_for_each(|part| write!(f, ",{part:.6}"))?;
        }
        Ok(())
    }
}

/// A CSV field: quoted where it must be.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
