//! Illuminance at sensors, by source and by the way its light takes.

mod buried;
mod table;

use glam::{DVec3, Vec3};
use light::{Place, rounding};
use rayon::prelude::*;
use scene::{Scene, Sensor};

use crate::assemble::{Column, Measuring, Way};
use crate::pipeline::Pipeline;

pub use buried::buried;
pub use table::{Row, Table, Uniformity};

/// How often every sensor is asked in `keikan lux`, each time with other directions: what the answers differ by says how
/// far their mean may be off.
pub const REPEATS: u32 = 4;

/// Illuminance at every sensor point of the scene by a pipeline as it is, asked once: no errors are estimated.
pub fn table(scene: &Scene, pipeline: &Pipeline) -> Table {
    let column = |name: &String| Column { source: name.clone(), way: Way::Direct };
    let columns = pipeline.sources.iter().map(|source| column(&source.name)).collect();
    Table::new(
        scene,
        columns,
        rows(scene, |sensor, point, position| Row {
            parts: by_sources(pipeline, &place(position, sensor.normal.as_vec3(), point as u32)),
            ..Row::at(sensor, point, position + scene.origin)
        }),
    )
}

/// The same by the ways that light takes, with estimated errors.
pub fn measure(scene: &Scene, measuring: &Measuring) -> Table {
    let columns = measuring.columns.clone();
    Table::new(
        scene,
        columns,
        rows(scene, |sensor, point, position| {
            let asked = |repeat: u32| {
                // Seeds of neighbouring points differ by little, those of repeats by much.
                let seed = point as u32 ^ repeat.wrapping_mul(0x9E37_79B9);
                by_sources(&measuring.pipeline, &place(position, sensor.normal.as_vec3(), seed))
            };
            let answers: Vec<Vec<f64>> = (0..REPEATS).map(asked).collect();
            let parts = (0..answers[0].len()).map(|i| mean(answers.iter().map(|answer| answer[i]))).collect();
            let sampled =
                standard_error(&answers.iter().map(|answer| answer.iter().sum()).collect::<Vec<f64>>());
            let mut row = Row { parts, ..Row::at(sensor, point, position + scene.origin) };
            let patches = measuring.coarser.as_ref().map(|coarser| {
                let place = place(position, sensor.normal.as_vec3(), point as u32);
                let coarse = coarser.light.irradiance(&place, &*measuring.pipeline.occlude).luminance();
                f64::from(coarse) - row.along(&measuring.columns, Way::Interreflected)
            });
            row.error = Some(sampled.hypot(patches.unwrap_or(0.0)));
            row
        }),
    )
}

fn rows(scene: &Scene, row: impl Fn(&Sensor, usize, DVec3) -> Row + Sync) -> Vec<Row> {
    let points: Vec<(&Sensor, usize, DVec3)> = scene
        .sensors
        .iter()
        .flat_map(|sensor| sensor.points.iter().enumerate().map(move |(i, &point)| (sensor, i, point)))
        .collect();
    points.par_iter().map(|&(sensor, point, position)| row(sensor, point, position)).collect()
}

/// Lux by each source.
fn by_sources(pipeline: &Pipeline, place: &Place) -> Vec<f64> {
    pipeline.irradiances(place).into_iter().map(|irradiance| f64::from(irradiance.luminance())).collect()
}

/// The place of a sensor point: as exact as f32 lets it be, so that it may lie on a surface.
fn place(position: DVec3, normal: Vec3, seed: u32) -> Place {
    let rounded = position.as_vec3();
    // ½ ulp for the point, and as much again for the corners of the face it may lie on.
    let error = 4.0 * rounding::UNIT * rounded.abs().max_element();
    Place { position: rounded, error, normal, seed }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1) as f64;
    values.sum::<f64>() / count
}

/// Of the mean of independent values: their standard deviation over √count.
fn standard_error(values: &[f64]) -> f64 {
    let (count, middle) = (values.len() as f64, mean(values.iter().copied()));
    let squares: f64 = values.iter().map(|value| (value - middle).powi(2)).sum();
    (squares / (count * (count - 1.0)).max(1.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_a_mean_is_that_of_the_textbook() {
        // Deviations −3, −1, 1, 3: 20/(4·3), root.
        assert!((standard_error(&[1.0, 3.0, 5.0, 7.0]) - (20.0f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(standard_error(&[2.0]), 0.0);
        assert_eq!(standard_error(&[2.0; 4]), 0.0);
    }
}
