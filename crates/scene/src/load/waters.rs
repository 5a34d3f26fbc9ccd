//! Bodies of water, from `[[water]]` tables.

use glam::DAffine3;

use super::{inline, waves};
use crate::document::Spot;
use crate::file::WaterTable;
use crate::{Error, Site, Water};

/// How far corners may lie off the level of the first \[m\]: what one writes with millimetres.
const UNEVEN: f64 = 1e-3;

/// What water is when nothing is said of it.
const QUALITY: &str = "pool";

/// The water of a table.
pub(crate) fn water(spot: &Spot<'_>, number: usize, table: &WaterTable, site: &Site) -> Result<Water, Error> {
    let points = spot.key("polygon").key("points");
    let level = table.polygon.points.first().map_or(0.0, |[_, y, _]| *y);
    let corners = table.polygon.points.iter().chain(table.polygon.holes.iter().flatten());
    for [x, y, z] in corners {
        if (y - level).abs() > UNEVEN {
            return Err(points.error(format!(
                "water is level: its surface lies at y = {level}, but the corner [{x}, {y}, {z}] is {:.3} m off that",
                (y - level).abs()
            )));
        }
    }
    let mut flat = inline::polygon_of(&spot.key("polygon"), &table.polygon, &mut Vec::new())?;
    // The middle is in whole metres; the level is exactly what was written.
    flat.mesh.positions.iter_mut().for_each(|corner| corner.y = 0.0);
    for [a, b, c] in &mut flat.mesh.triangles {
        let [p, q, r] = [*a, *b, *c].map(|i| flat.mesh.positions[i as usize]);
        if (q - p).cross(r - p).y < 0.0 {
            std::mem::swap(b, c);
        }
    }
    let middle = flat.middle;
    let name = table.name.clone().unwrap_or_else(|| format!("water-{number}"));
    Ok(Water {
        waves: waves::waves(spot, table, site, &name)?,
        name,
        surface: flat.mesh,
        place: DAffine3::from_translation(middle.with_y(level)),
        quality: table.quality.clone().unwrap_or_else(|| QUALITY.to_owned()),
        index: table.index.map(|index| spot.key("index").within(index, 1.0, 2.0, "")).transpose()?,
    })
}
