//! Where the trees of a table stand.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use light::sampling::{scramble, shift};

use super::super::missing;
use crate::document::Spot;
use crate::file::{PolygonTable, TreeTable};
use crate::{Error, PlacedTree, triangulate};

/// Trees that all tables may have together: 40 bytes each while a scene is read.
pub(crate) const MOST_TREES: usize = 20_000_000;

/// Height of trees that state none, of species that come with the program \[m\].
pub(super) const USUAL_HEIGHT: f64 = 12.0;

/// Spacing of scattered trees over their height, where none is stated.
const SPACING: f64 = 2.0 / 3.0;

/// Variation of scattered trees that state none.
const VARIATION: f64 = 0.2;

/// Share of its square of the grid within which a scattered tree stands: neighbours never touch.
const JITTER: f64 = 0.7;

/// Checks that a table says once where its trees stand, and nothing that is for others.
pub(super) fn one_source(spot: &Spot<'_>, table: &TreeTable) -> Result<(), Error> {
    spot.exactly_one(&[
        ("position", table.position.is_some()),
        ("positions", table.positions.is_some()),
        ("file", table.file.is_some()),
        ("points", table.points.is_some()),
        ("polygon", table.polygon.is_some()),
    ])?;
    if let (Some(_), None) = (table.spacing, &table.polygon) {
        return Err(spot.key("spacing").error("is for trees that are scattered over a polygon"));
    }
    if let (Some(_), None) = (table.coordinates, &table.points) {
        return Err(spot.key("coordinates").error("is for points of a GeoJSON file"));
    }
    Ok(())
}

/// What differs by chance between the trees of a table.
pub(super) struct Strewn {
    seed: u32,
    variation: f64,
    /// In degrees, of all of them.
    rotation: Option<f64>,
}

impl Strewn {
    /// As the table says.
    pub(super) fn of(spot: &Spot<'_>, table: &TreeTable) -> Result<Self, Error> {
        let variation = table.variation.unwrap_or(if table.polygon.is_some() { VARIATION } else { 0.0 });
        let variation = spot.key("variation").within(variation, 0.0, 0.9, "")?;
        let within = |degrees| spot.key("rotation").within(degrees, -3600.0, 3600.0, "°");
        let rotation = table.rotation.map(within).transpose()?;
        Ok(Self { seed: table.seed.unwrap_or(1), variation, rotation })
    }

    /// The tree of that number: with its own factor on the height and its own turn in degrees, where it has them.
    pub(super) fn tree(
        &self,
        i: usize,
        position: DVec3,
        (scale, rotation): (Option<f64>, Option<f64>),
    ) -> PlacedTree {
        let [size, turn] =
            shift(scramble(self.seed) ^ i as u32, 1).map(|bits| f64::from(bits) / 4_294_967_296.0);
        PlacedTree {
            position,
            scale: scale.unwrap_or(1.0 + self.variation * (2.0 * size - 1.0)) as f32,
            rotation: rotation.or(self.rotation).map_or(turn * TAU, f64::to_radians) as f32,
        }
    }
}

/// All trees of a table but for those of a list, about `usual` metres high, no more than are `left`.
pub(super) fn placed(
    spot: &Spot<'_>,
    table: &TreeTable,
    usual: f64,
    left: usize,
) -> Result<Vec<PlacedTree>, Error> {
    let seed = table.seed.unwrap_or(1);
    let (key, points) = match (&table.position, &table.positions, &table.file, &table.polygon) {
        (Some(at), ..) => ("position", vec![spot.key("position").point(*at)?]),
        (_, Some(all), ..) => {
            let spots = spot.key("positions");
            let points = all.iter().enumerate().map(|(i, at)| spots.index(i).point(*at));
            ("positions", points.collect::<Result<_, _>>()?)
        }
        (_, _, Some(file), _) => {
            let spot = spot.key("file");
            ("file", triangulate::read_points(&spot.file(file)).map_err(|error| missing(&spot, error))?)
        }
        (.., polygon) => {
            let spacing = spot.key("spacing");
            let apart = spacing.positive(table.spacing.unwrap_or(SPACING * usual), 1e6, "m")?;
            let polygon = polygon.as_ref().ok_or_else(|| spot.error("has no place"))?;
            ("spacing", scattered(spot, polygon, apart, (seed, left))?)
        }
    };
    if points.len() > left {
        return Err(spot.key(key).error(format!("makes {} trees: {left} more are possible", points.len())));
    }
    let strewn = Strewn::of(spot, table)?;
    Ok(points.into_iter().enumerate().map(|(i, at)| strewn.tree(i, at, (None, None))).collect())
}

/// One tree in each square of a grid, somewhere within it, if that is inside the polygon.
fn scattered(
    spot: &Spot<'_>,
    polygon: &PolygonTable,
    apart: f64,
    (seed, left): (u32, usize),
) -> Result<Vec<DVec3>, Error> {
    let spot_of = spot.key("polygon").key("points");
    if polygon.points.len() < 3 {
        return Err(spot_of.error("encloses no area: at least three corners are needed"));
    }
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for corner in &polygon.points {
        let at = spot_of.point(*corner)?;
        (low, high) = (low.min(DVec2::new(at.x, at.z)), high.max(DVec2::new(at.x, at.z)));
    }
    let [columns, rows] = ((high - low) / apart).to_array().map(|count| count.ceil().max(1.0));
    if columns * rows > 4.0 * left as f64 {
        let what = format!("{apart} m makes more trees than are possible ({left} more): make it larger");
        return Err(spot.key("spacing").error(what));
    }
    let level = polygon.points[0][1];
    let mut points = Vec::new();
    for row in 0..rows as u32 {
        if points.len() > left {
            break; // an error, which the caller words
        }
        for column in 0..columns as u32 {
            let bits = shift(scramble(seed ^ scramble(row)) ^ column, 2);
            let [u, v] = bits.map(|bits| (f64::from(bits) / 4_294_967_296.0 - 0.5) * JITTER + 0.5);
            let at = low + DVec2::new(f64::from(column) + u, f64::from(row) + v) * apart;
            if holds(&polygon.points, at) && !polygon.holes.iter().any(|hole| holds(hole, at)) {
                points.push(DVec3::new(at.x, level, at.y));
            }
        }
    }
    Ok(points)
}

/// Whether a point is inside an outline: a ray to +x crosses it an odd number of times.
fn holds(outline: &[[f64; 3]], at: DVec2) -> bool {
    let mut inside = false;
    for (i, &[x, _, z]) in outline.iter().enumerate() {
        let [px, _, pz] = outline[(i + outline.len() - 1) % outline.len()];
        if (z > at.y) != (pz > at.y) && at.x < x + (at.y - z) / (pz - z) * (px - x) {
            inside = !inside;
        }
    }
    inside
}
