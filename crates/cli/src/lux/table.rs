//! What `keikan lux` says, as CSV and JSON.

use std::fmt;

use glam::DVec3;
use scene::{Scene, Sensor};

use crate::assemble::{Column, Way};

/// Lux of one sensor point.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Row {
    /// Name of the sensor.
    pub sensor: String,
    /// Number of the point within it, from 0.
    pub point: usize,
    /// Where, in the coordinates of the file \[m\].
    pub position: [f64; 3],
    /// All together \[lx\].
    pub total: f64,
    /// Estimated standard error of that \[lx\]: what sampling leaves (sky, sun's disc, lamps with an extent), found by asking anew
    /// with other directions, and what patches leave (interreflection), found by coarser ones. Not in it: what models leave; the
    /// directions in which the sky, and the points at which lamps with an extent, are looked for *through a water surface*, which stand
    /// still; and patches where the faces alone are as many as patches may be. None where it was not asked for.
    pub error: Option<f64>,
    /// By way \[lx\], in the order of [`Table::ways`].
    pub by_way: Vec<f64>,
    /// By column \[lx\], in the order of [`Table::columns`].
    pub parts: Vec<f64>,
}

/// Lux of a scene's sensors.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Table {
    /// Ways that there are.
    pub ways: Vec<Way>,
    /// Sources, split by ways where water splits them.
    pub columns: Vec<Column>,
    /// One row per point.
    pub rows: Vec<Row>,
    /// Minimum, mean and uniformity of each sensor with several points.
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
    /// Uniformity U_o = minimum / mean (EN 12464-1); 0 where there is no light.
    pub uniformity: f64,
    /// Diversity U_d = minimum / maximum; 0 where there is no light.
    pub diversity: f64,
}

impl Row {
    /// Without any light yet; `position` as in the file.
    pub(super) fn at(sensor: &Sensor, point: usize, position: DVec3) -> Self {
        let (sensor, position) = (sensor.name.clone(), position.to_array());
        Self { sensor, point, position, total: 0.0, error: None, by_way: Vec::new(), parts: Vec::new() }
    }

    /// What comes along one way \[lx\].
    pub(super) fn along(&self, columns: &[Column], way: Way) -> f64 {
        let parts = columns.iter().zip(&self.parts);
        parts.filter(|(column, _)| column.way == way).map(|(_, part)| part).sum()
    }
}

impl Table {
    /// Of rows whose parts are known: sums them up.
    pub(super) fn new(scene: &Scene, columns: Vec<Column>, mut rows: Vec<Row>) -> Self {
        let ways: Vec<Way> =
            Way::ALL.into_iter().filter(|way| columns.iter().any(|column| column.way == *way)).collect();
        for row in &mut rows {
            row.total = row.parts.iter().sum();
            row.by_way = ways.iter().map(|way| row.along(&columns, *way)).collect();
        }
        let several = by_sensor(scene, &rows).filter(|(_, rows)| rows.len() > 1);
        let uniformity = several.map(|(sensor, rows)| Uniformity::of(&sensor.name, rows)).collect();
        Self { ways, columns, rows, uniformity }
    }

    /// Whether light may take more than one way, so that columns must say which.
    fn is_split(&self) -> bool {
        self.ways.iter().any(|way| matches!(way, Way::Reflected | Way::Through))
    }

    /// Whether the CSV has this column: interreflected light is one source and one way, and needs one column.
    fn shows(&self, column: &Column) -> bool {
        !(self.is_split() && column.way == Way::Interreflected)
    }
}

/// Each sensor with its rows, which are in the scene's order.
pub(super) fn by_sensor<'a>(
    scene: &'a Scene,
    rows: &'a [Row],
) -> impl Iterator<Item = (&'a Sensor, &'a [Row])> {
    let mut left = rows;
    scene.sensors.iter().map(move |sensor| {
        let (own, others) = left.split_at(sensor.points.len().min(left.len()));
        left = others;
        (sensor, own)
    })
}

impl Uniformity {
    fn of(name: &str, rows: &[Row]) -> Self {
        let totals: Vec<f64> = rows.iter().map(|row| row.total).collect();
        let mean = super::mean(totals.iter().copied());
        let minimum = totals.iter().copied().fold(f64::INFINITY, f64::min);
        let maximum = totals.iter().copied().fold(0.0, f64::max);
        let share = |whole: f64| if whole > 0.0 { minimum / whole } else { 0.0 };
        let (uniformity, diversity) = (share(mean), share(maximum));
        Self { sensor: name.to_owned(), minimum, mean, maximum, uniformity, diversity }
    }
}

impl fmt::Display for Uniformity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { sensor, minimum, mean, maximum, uniformity, diversity } = self;
        write!(
            f,
            "{sensor}: min {minimum:.3} lx, mean {mean:.3} lx, max {maximum:.3} lx, uniformity (min/mean) {uniformity:.3}, min/max {diversity:.3}"
        )
    }
}

impl fmt::Display for Table {
    /// CSV with a header line; numbers in lx and m.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "sensor,point,x_m,y_m,z_m,total_lx,error_lx")?;
        if self.is_split() {
            self.ways.iter().try_for_each(|way| write!(f, ",{way}_lx"))?;
        }
        for Column { source, way } in self.columns.iter().filter(|column| self.shows(column)) {
            let way = if self.is_split() { format!("_{way}") } else { String::new() };
            write!(f, ",{}", quoted(&format!("{source}{way}_lx")))?;
        }
        for row in &self.rows {
            let [x, y, z] = row.position;
            write!(f, "\n{},{},{x},{y},{z},{:.6},", quoted(&row.sensor), row.point, row.total)?;
            row.error.map_or(Ok(()), |error| write!(f, "{error:.6}"))?;
            let ways = if self.is_split() { &row.by_way[..] } else { &[] };
            let parts = self.columns.iter().zip(&row.parts).filter(|(column, _)| self.shows(column));
            ways.iter().chain(parts.map(|(_, part)| part)).try_for_each(|part| write!(f, ",{part:.6}"))?;
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
