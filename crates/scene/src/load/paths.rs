//! Paths of cameras.

use glam::DVec3;
use light::Projection;

use super::eyes;
use crate::camera_path::{CameraPath, Key};
use crate::document::Spot;
use crate::file::{CameraTable, KeyTable};
use crate::{Error, file};

/// What is wrong with a camera that looks at nothing but itself.
pub(crate) const ITSELF: &str = "is the camera's own position: look at another point";

/// Most keys of a path: an hour with one for every frame.
const MOST_KEYS: usize = 100_000;

/// Longest time of a key \[s\]: a year.
const LATEST: f64 = 3.2e7;

/// The path of a `[[camera]]` table.
pub(crate) fn path(
    spot: &Spot<'_>,
    table: &CameraTable,
    keys: &[KeyTable],
    up: DVec3,
    projection: Projection,
) -> Result<CameraPath, Error> {
    if table.position.is_some() {
        return Err(spot
            .key("position")
            .error("is not possible beside path: its keys say where the camera is"));
    }
    if table.target.is_some() && table.direction.is_some() {
        spot.exactly_one(&[("target", true), ("direction", true)])?;
    }
    let spots = spot.key("path");
    if keys.is_empty() || keys.len() > MOST_KEYS {
        return Err(spots.error(format!("{} keys: from 1 to {MOST_KEYS} are possible", keys.len())));
    }
    let mut made: Vec<Key> = Vec::with_capacity(keys.len());
    for (i, key) in keys.iter().enumerate() {
        let made_key = self::key(spot, &spots.index(i), table, key, projection)?;
        if let Some(before) = made.last().filter(|before| made_key.time <= before.time) {
            let what = format!("{} does not rise above {}", key.time, before.time);
            return Err(spots.index(i).key("time").error(what));
        }
        made.push(made_key);
    }
    Ok(CameraPath::new(made, up, table.ease.unwrap_or_default() == file::Ease::Smooth))
}

/// One key of a path; what it leaves out is the camera's.
fn key(
    camera: &Spot<'_>,
    spot: &Spot<'_>,
    table: &CameraTable,
    key: &KeyTable,
    projection: Projection,
) -> Result<Key, Error> {
    let time = spot.key("time").within(key.time, -LATEST, LATEST, "s")?;
    let position = spot.key("position").point(key.position)?;
    let (target, at) = match (key.target, table.target, table.direction) {
        (Some(target), ..) => (spot.key("target").point(target)?, spot.key("target")),
        (None, Some(target), _) => (camera.key("target").point(target)?, spot.key("position")),
        (None, None, Some(way)) => (position + camera.key("direction").direction(way)?, spot.key("position")),
        (None, None, None) => {
            let what = "is required, here or for the whole camera (target or direction)";
            return Err(spot.key("target").error(what));
        }
    };
    if (target - position).try_normalize().is_none() {
        return Err(at.error(ITSELF));
    }
    let half = match (key.field_of_view, projection) {
        (None, Projection::Perspective { tan_half_height }) => tan_half_height,
        (None, Projection::Orthographic { half_height }) => half_height,
        (Some(degrees), Projection::Perspective { .. }) => eyes::field_of_view(spot, degrees)?,
        (Some(_), Projection::Orthographic { .. }) => {
            return Err(spot.key("field_of_view").error("is not possible for an orthographic camera"));
        }
    };
    Ok(Key { time, position, target, half })
}
