//! Cameras and sensors.

use glam::DVec3;
use light::Projection;

use super::paths;
use super::placement::look_along;
use crate::document::Spot;
use crate::file::{CameraTable, GridTable, LineTable, SensorTable};
use crate::{Camera, Error, Sensor};

/// Height of a photographic frame of 36 × 24 mm \[mm\].
const FRAME_HEIGHT: f64 = 24.0;

/// Most points of all sensors together.
pub(crate) const MOST_POINTS: u64 = 10_000_000;

/// The camera of one table.
pub(crate) fn camera(spot: &Spot<'_>, number: usize, table: &CameraTable) -> Result<Camera, Error> {
    let up = spot.key("up").direction(table.up.unwrap_or([0.0, 1.0, 0.0]))?;
    let aspect = table.aspect.map(|a| spot.key("aspect").within(a, 0.01, 100.0, "")).transpose()?;
    let mut camera = Camera {
        name: table.name.clone().unwrap_or_else(|| format!("camera-{number}")),
        position: DVec3::ZERO,
        world_from_camera: look_along(DVec3::NEG_Z, up),
        projection: projection(spot, table)?,
        aspect,
        near: spot.key("near").positive(table.near.unwrap_or(0.01), 1e6, "m")?,
        path: None,
    };
    if let Some(keys) = &table.path {
        let path = paths::path(spot, table, keys, up, camera.projection)?;
        let [first, _] = path.seconds();
        camera.path = Some(path);
        // A picture without a time shows where it begins.
        return Ok(camera.at(first));
    }
    if table.ease.is_some() {
        return Err(spot.key("ease").error("is for cameras with a path"));
    }
    let at = spot.key("position");
    camera.position = at.point(at.required(table.position)?)?;
    camera.world_from_camera = look_along(axis(spot, table, camera.position)?, up);
    Ok(camera)
}

/// Where a camera at `position` looks.
fn axis(spot: &Spot<'_>, table: &CameraTable, position: DVec3) -> Result<DVec3, Error> {
    match (table.target, table.direction) {
        (Some(target), None) => {
            let spot = spot.key("target");
            let way = spot.point(target)? - position;
            way.try_normalize().ok_or_else(|| spot.error(paths::ITSELF))
        }
        (None, Some(direction)) => spot.key("direction").direction(direction),
        (target, direction) => {
            spot.exactly_one(&[("target", target.is_some()), ("direction", direction.is_some())])?;
            Ok(DVec3::NEG_Z)
        }
    }
}

fn projection(spot: &Spot<'_>, table: &CameraTable) -> Result<Projection, Error> {
    let perspective = |tan_half_height| Projection::Perspective { tan_half_height };
    match (table.field_of_view, table.focal_length, table.orthographic) {
        (None, None, None) => Ok(perspective(half_of(40.0))),
        (Some(degrees), None, None) => field_of_view(spot, degrees).map(perspective),
        (None, Some(mm), None) => {
            let mm = spot.key("focal_length").within(mm, 1.0, 100_000.0, "mm")?;
            Ok(perspective(0.5 * FRAME_HEIGHT / mm))
        }
        (None, None, Some(height)) => {
            let height = spot.key("orthographic").within(height, 1e-6, 1e7, "m")?;
            Ok(Projection::Orthographic { half_height: 0.5 * height })
        }
        _ => Err(spot.error("only one of field_of_view, focal_length, orthographic is possible")),
    }
}

/// tan of half of a vertical field in degrees.
fn half_of(degrees: f64) -> f64 {
    (0.5 * degrees.to_radians()).tan()
}

/// The key `field_of_view` of this table as tan of half of it.
pub(crate) fn field_of_view(spot: &Spot<'_>, degrees: f64) -> Result<f64, Error> {
    Ok(half_of(spot.key("field_of_view").within(degrees, 0.01, 170.0, "degrees")?))
}

/// The sensor of one table, which may have at most `left` points.
pub(crate) fn sensor(
    spot: &Spot<'_>,
    number: usize,
    table: &SensorTable,
    left: u64,
) -> Result<Sensor, Error> {
    let name = table.name.clone().unwrap_or_else(|| format!("sensor-{number}"));
    let normal = spot.key("normal").direction(table.normal.unwrap_or([0.0, 1.0, 0.0]))?;
    spot.exactly_one(&[
        ("points", table.points.is_some()),
        ("line", table.line.is_some()),
        ("grid", table.grid.is_some()),
    ])?;
    let points = if let Some(points) = &table.points {
        let spot = spot.key("points");
        if points.is_empty() {
            return Err(spot.error("is empty: a sensor needs at least one point"));
        }
        spot.points(points)?
    } else if let Some(table) = &table.line {
        line(&spot.key("line"), table, left)?
    } else if let Some(table) = &table.grid {
        grid(&spot.key("grid"), table, left)?
    } else {
        Vec::new()
    };
    Ok(Sensor { name, points, normal })
}

/// Both ends included.
fn line(spot: &Spot<'_>, table: &LineTable, left: u64) -> Result<Vec<DVec3>, Error> {
    let (from, to) = (spot.key("from").point(table.from)?, spot.key("to").point(table.to)?);
    if table.count < 2 || u64::from(table.count) > left {
        let what =
            format!("{} is not within [2, {left}] (sensors have {MOST_POINTS} points at most)", table.count);
        return Err(spot.key("count").error(what));
    }
    let last = f64::from(table.count - 1);
    Ok((0..table.count).map(|i| from.lerp(to, f64::from(i) / last)).collect())
}

/// Middles of cells (as EN 12464-1 and CIE 140 lay out their grids), u fastest.
fn grid(spot: &Spot<'_>, table: &GridTable, left: u64) -> Result<Vec<DVec3>, Error> {
    let origin = spot.key("origin").point(table.origin)?;
    let (u, v) = (spot.key("u").point(table.u)?, spot.key("v").point(table.v)?);
    let [nu, nv] = table.counts;
    let count = u64::from(nu) * u64::from(nv);
    if count == 0 || count > left {
        let what =
            format!("{nu} × {nv} cells: from 1 to {left} are possible (all sensors together: {MOST_POINTS})");
        return Err(spot.key("counts").error(what));
    }
    let share = |i: u32, n: u32| (f64::from(i) + 0.5) / f64::from(n);
    let row = |j: u32| (0..nu).map(move |i| origin + u * share(i, nu) + v * share(j, nv));
    Ok((0..nv).flat_map(row).collect())
}
