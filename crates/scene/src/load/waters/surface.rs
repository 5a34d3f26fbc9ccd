//! Where the surface of a water is: a polygon, or a node of a model.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3, Vec3};
use light::Mesh;

use super::super::inline;
use super::super::models::{Claim, Claims, UNEVEN, Wanted, list};
use crate::Error;
use crate::document::Spot;
use crate::file::{PolygonTable, WaterTable};

/// Corners that make no triangle.
const EMPTY: &str = "has no face that one could see from above: nothing there can be a water's surface";

/// Which faces of models the waters claim as their surfaces.
pub(crate) fn claims(root: &Spot<'_>, tables: &[WaterTable]) -> Result<Claims, Error> {
    let mut claims = Claims::default();
    for (i, table) in tables.iter().enumerate() {
        let spot = root.key("water").index(i);
        spot.exactly_one(&[
            ("polygon", table.polygon.is_some()),
            ("node", table.node.is_some()),
            ("material", table.material.is_some()),
        ])?;
        let node = table.node.clone().map(Wanted::Node);
        match (node.or_else(|| table.material.clone().map(Wanted::Material)), &table.model) {
            (Some(wanted), model) => {
                let name = name(table, i + 1);
                claims.of.push(Claim { water: i, name, model: model.clone(), wanted });
            }
            (None, Some(_)) => {
                let what = "says which model a node or a material is in, but the water names none";
                return Err(spot.key("model").error(what));
            }
            (None, None) => {}
        }
    }
    Ok(claims)
}

/// What the water of a table is called, which is number `number` (from 1).
pub(super) fn name(table: &WaterTable, number: usize) -> String {
    table.name.clone().unwrap_or_else(|| format!("water-{number}"))
}

/// A surface that is drawn as a polygon, about its middle, with where that is.
pub(super) fn drawn(spot: &Spot<'_>, polygon: &PolygonTable) -> Result<(Mesh, DAffine3), Error> {
    let level = polygon.points.first().map_or(0.0, |[_, y, _]| *y);
    let corners = polygon.points.iter().chain(polygon.holes.iter().flatten());
    for corner in corners {
        level_with(&spot.key("points"), level, DVec3::from_array(*corner))?;
    }
    let flat = inline::polygon_of(spot, polygon, &mut Vec::new())?;
    // The middle is in whole metres; the level is exactly what was written.
    Ok((facing_up(flat.mesh), DAffine3::from_translation(flat.middle.with_y(level))))
}

/// The surface that water number `water` (from 0) has claimed of the models.
pub(super) fn of_model(spot: &Spot<'_>, water: usize, claims: &Claims) -> Result<(Mesh, DAffine3), Error> {
    let wanted = claims.of.iter().find(|claim| claim.water == water).map(|claim| &claim.wanted);
    let is_node = !matches!(wanted, Some(Wanted::Material(_)));
    let spot = spot.key(if is_node { "node" } else { "material" });
    let parts: Vec<_> = claims.found.iter().filter(|found| found.water == water).collect();
    if parts.is_empty() {
        if let Some([first, second]) = twice(water, claims) {
            return Err(spot.error(format!(
                "the waters {first} and {second} claim the same faces: a surface is that of one water"
            )));
        }
        let (what, names) = if is_node { ("node", &claims.names[0]) } else { ("material", &claims.names[1]) };
        let known = list(names.iter().map(|name| &**name));
        return Err(spot.error(format!("no model shows a {what} of that name; there are {known}")));
    }
    let corners: Vec<DVec3> = parts.iter().flat_map(|part| part.corners()).collect();
    let Some(&first) = corners.first() else { return Err(spot.error(EMPTY)) };
    for corner in &corners {
        level_with(&spot, first.y, *corner)?;
    }
    let sum: DVec3 = corners.iter().sum();
    let middle = (sum / corners.len() as f64).round().with_y(first.y);
    let mesh = facing_up(welded(corners.iter().map(|c| (*c - middle).as_vec3().with_y(0.0))));
    if mesh.triangles.is_empty() {
        return Err(spot.error(EMPTY));
    }
    Ok((mesh, DAffine3::from_translation(middle)))
}

/// The names of another water that has got what water number `water` wants, and of that one.
fn twice(water: usize, claims: &Claims) -> Option<[String; 2]> {
    let own = claims.of.iter().find(|claim| claim.water == water)?;
    let alike = |other: &&Claim| {
        let model = other.model == own.model || other.model.is_none() || own.model.is_none();
        other.water != water && model && other.wanted == own.wanted
    };
    let got = |other: &&Claim| claims.found.iter().any(|found| found.water == other.water);
    let other = claims.of.iter().filter(alike).find(got)?;
    Some([other, own].map(|claim| format!("{:?}", claim.name)))
}

/// Triangles of level corners, three by three, as a mesh in which those at the same x and z are one: edges that two triangles share are no
/// outline.
fn welded(corners: impl Iterator<Item = Vec3>) -> Mesh {
    let (mut numbers, mut positions) = (BTreeMap::new(), Vec::new());
    let number = |corner: Vec3| {
        // −0 is 0.
        let place = [corner.x + 0.0, corner.z + 0.0].map(f32::to_bits);
        *numbers.entry(place).or_insert_with(|| {
            positions.push(corner);
            positions.len() as u32 - 1
        })
    };
    let all: Vec<u32> = corners.map(number).collect();
    let triangles = all.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

fn level_with(spot: &Spot<'_>, level: f64, corner: DVec3) -> Result<(), Error> {
    let off = (corner.y - level).abs();
    if off <= UNEVEN {
        return Ok(());
    }
    let DVec3 { x, y, z } = corner;
    Err(spot.error(format!(
        "water is level: its surface lies at y = {level}, but the corner [{x}, {y}, {z}] is {off:.3} m off that"
    )))
}

/// The same at y = 0, every triangle seen from above; those without an area are left out.
fn facing_up(mut mesh: Mesh) -> Mesh {
    mesh.positions.iter_mut().for_each(|corner| corner.y = 0.0);
    let positions = &mesh.positions;
    mesh.triangles.retain_mut(|[a, b, c]| {
        let [p, q, r] = [*a, *b, *c].map(|i| positions[i as usize].as_dvec3());
        let up = (q - p).cross(r - p).y;
        if up < 0.0 {
            std::mem::swap(b, c);
        }
        up != 0.0
    });
    mesh
}
