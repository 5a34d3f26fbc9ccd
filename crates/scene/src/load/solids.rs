//! `[[solid]]` tables: shapes, and set operations that refer to them by name.

mod media;

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};

use super::draft::Draft;
use super::hull::{HullFault, hull, polyhedron};
use super::inline::{LONGEST, SHORTEST, prism_corners};
use super::materials::Names;
use super::{models, placement};
use crate::document::Spot;
use crate::file::SolidTable;
use crate::solid::MAX_SOLID_DEPTH;
use crate::{Error, Solid, SolidNode, SolidShape};

/// Most shapes of all solids together, each counted as often as operations use it.
const MOST_SHAPES: u64 = 1_000_000;

/// A table that was read, before operations are filled in.
struct Part {
    operand: Operand,
    /// From the table's own coordinates to those of whatever uses it.
    placement: DAffine3,
    material: Option<u32>,
}

/// What a table describes.
enum Operand {
    /// A shape, and from its coordinates to the table's.
    Shape(SolidShape, DAffine3),
    /// An operation on other tables, by index.
    Set(Operation, Vec<usize>),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Operation {
    Union,
    Intersection,
    Difference,
}

impl Operation {
    /// The key that asks for it.
    fn key(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Intersection => "intersection",
            Self::Difference => "difference",
        }
    }
}

/// Adds all solids that are seen: those that no operation uses and that are not hidden.
pub(crate) fn add(
    draft: &mut Draft,
    root: &Spot<'_>,
    tables: &[SolidTable],
    materials: &Names,
) -> Result<(), Error> {
    let all = root.key("solid");
    let names = names(&all, tables)?;
    let parts = tables
        .iter()
        .enumerate()
        .map(|(i, table)| part(&all.index(i), table, &names, materials))
        .collect::<Result<Vec<Part>, Error>>()?;
    let mut survey = Survey { all: &all, tables, parts: &parts, seen: vec![Progress::New; parts.len()] };
    let mut used = vec![false; parts.len()];
    for (i, part) in parts.iter().enumerate() {
        survey.extent(i, 1)?;
        if let Operand::Set(_, members) = &part.operand {
            members.iter().for_each(|member| used[*member] = true);
        }
    }
    let mut shapes = 0;
    for (i, table) in tables.iter().enumerate() {
        if used[i] || table.hidden {
            continue;
        }
        shapes += survey.extent(i, 1)?.shapes;
        if shapes > MOST_SHAPES {
            let what = format!("with this solid there are more than {MOST_SHAPES} shapes");
            return Err(all.index(i).error(what));
        }
        media::Media { all: &all, parts: &parts, materials: &draft.materials }.check(i)?;
        let grey = &mut || draft.grey();
        let top = match &parts[i].operand {
            Operand::Set(operation, _) => all.index(i).key(operation.key()),
            Operand::Shape(..) => all.index(i),
        };
        let node = node(&top, &parts, i, &DAffine3::IDENTITY, None, grey)?;
        let name = table.name.clone().unwrap_or_else(|| format!("solid-{}", i + 1));
        draft.solids.push(Solid { name, node });
    }
    Ok(())
}

/// Index by name; names are unique and not empty.
fn names<'t>(all: &Spot<'_>, tables: &'t [SolidTable]) -> Result<BTreeMap<&'t str, usize>, Error> {
    let mut names = BTreeMap::new();
    for (i, table) in tables.iter().enumerate() {
        let Some(name) = table.name.as_deref() else { continue };
        if name.is_empty() || names.insert(name, i).is_some() {
            let spot = all.index(i).key("name");
            return Err(spot.error(format!("{name:?} is empty or taken: names must differ")));
        }
    }
    Ok(names)
}

fn part(
    spot: &Spot<'_>,
    table: &SolidTable,
    names: &BTreeMap<&str, usize>,
    materials: &Names,
) -> Result<Part, Error> {
    spot.exactly_one(&[
        ("sphere", table.sphere.is_some()),
        ("cylinder", table.cylinder.is_some()),
        ("cone", table.cone.is_some()),
        ("frustum", table.frustum.is_some()),
        ("prism", table.prism.is_some()),
        ("box", table.cuboid.is_some()),
        ("polyhedron", table.polyhedron.is_some()),
        ("union", table.union.is_some()),
        ("intersection", table.intersection.is_some()),
        ("difference", table.difference.is_some()),
    ])?;
    let placement = placement::affine(spot, table.position, table.rotation, table.scale)?;
    let material = match &table.material {
        None => None,
        Some(name) => Some(models::material_named(spot, name, materials)?),
    };
    let operand = match round(spot, table)? {
        Some(operand) => operand,
        None => match flat(spot, table)? {
            Some(operand) => operand,
            None => set(spot, table, names)?,
        },
    };
    Ok(Part { operand, placement, material })
}

/// Sphere, cylinder, cone, truncated cone: unit shapes, stretched.
fn round(spot: &Spot<'_>, table: &SolidTable) -> Result<Option<Operand>, Error> {
    let length = |shape: &str, key: &str, value: f64| {
        let spot = spot.key(shape).key(key);
        spot.within(value, SHORTEST, LONGEST, "m")
    };
    let stretched = |shape, radius, height| {
        let by = DVec3::new(radius, height, radius);
        Ok(Some(Operand::Shape(shape, DAffine3::from_scale(by))))
    };
    if let Some(sphere) = &table.sphere {
        let radius = length("sphere", "radius", sphere.radius)?;
        return stretched(SolidShape::Sphere, radius, radius);
    }
    if let Some(c) = &table.cylinder {
        let radius = length("cylinder", "radius", c.radius)?;
        return stretched(SolidShape::Cylinder, radius, length("cylinder", "height", c.height)?);
    }
    if let Some(c) = &table.cone {
        let radius = length("cone", "radius", c.radius)?;
        return stretched(SolidShape::Cone, radius, length("cone", "height", c.height)?);
    }
    if let Some(f) = &table.frustum {
        let bottom = length("frustum", "bottom", f.bottom)?;
        let top = length("frustum", "top", f.top)? / bottom;
        // Beyond that one end is a point to the other, and the slope loses its digits.
        if !(1e-6..=1e6).contains(&top) {
            let what =
                format!("is {top} of bottom: from 1e-6 to 1e6 are possible; with a point there is cone");
            return Err(spot.key("frustum").key("top").error(what));
        }
        return stretched(SolidShape::Frustum { top }, bottom, length("frustum", "height", f.height)?);
    }
    Ok(None)
}

/// Prism, box, polyhedron, about their own middles.
fn flat(spot: &Spot<'_>, table: &SolidTable) -> Result<Option<Operand>, Error> {
    if let Some(prism) = &table.prism {
        let corners = prism_corners(&spot.key("prism"), prism)?;
        let sides = corners.len() / 2;
        // Outwards, halfway between neighbouring corners.
        let wall = |i: usize| (corners[i] + corners[(i + 1) % sides]).normalize();
        let normals: Vec<DVec3> = (0..sides).map(wall).chain([DVec3::NEG_Y, DVec3::Y]).collect();
        let shape = polyhedron(normals.into_iter(), corners);
        return Ok(Some(Operand::Shape(shape, DAffine3::IDENTITY)));
    }
    if let Some(cuboid) = &table.cuboid {
        let size = spot.key("box").key("size");
        for side in cuboid.size {
            size.within(side, SHORTEST, LONGEST, "m")?;
        }
        let [x, y, z] = cuboid.size;
        let side = |i: i32, bit: i32| if i >> bit & 1 == 0 { -0.5 } else { 0.5 };
        let corner = |i: i32| DVec3::new(side(i, 0) * x, (side(i, 1) + 0.5) * y, side(i, 2) * z);
        let normals = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let shape = polyhedron(normals.into_iter(), (0..8).map(corner).collect());
        return Ok(Some(Operand::Shape(shape, DAffine3::IDENTITY)));
    }
    let Some(table) = &table.polyhedron else { return Ok(None) };
    let spot = spot.key("polyhedron").key("points");
    let points = spot.points(&table.points)?;
    let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
    // Map coordinates would take the digits of the planes' distances.
    let middle = (0.5 * (low + high)).round();
    let own: Vec<DVec3> = points.iter().map(|point| *point - middle).collect();
    let shape = hull(&own).map_err(|fault| match fault {
        HullFault::Inside(i) => spot.index(i).error(fault.to_string()),
        _ => spot.error(fault.to_string()),
    })?;
    Ok(Some(Operand::Shape(shape, DAffine3::from_translation(middle))))
}

/// The one of the three operations that the table asks for, and the list of names.
fn asked(table: &SolidTable) -> Option<(Operation, &[String])> {
    let union = table.union.as_ref().map(|names| (Operation::Union, names));
    let intersection = || table.intersection.as_ref().map(|names| (Operation::Intersection, names));
    let difference = || table.difference.as_ref().map(|names| (Operation::Difference, names));
    union.or_else(intersection).or_else(difference).map(|(operation, names)| (operation, names.as_slice()))
}

fn set(spot: &Spot<'_>, table: &SolidTable, names: &BTreeMap<&str, usize>) -> Result<Operand, Error> {
    let Some((operation, members)) = asked(table) else {
        return Err(spot.error("describes no shape"));
    };
    let spot = spot.key(operation.key());
    if members.len() < 2 {
        return Err(spot.error(format!("has {} names: two or more are possible", members.len())));
    }
    let index = |(i, name): (usize, &String)| {
        names.get(name.as_str()).copied().ok_or_else(|| {
            let known = models::list(names.keys().copied());
            spot.index(i).error(format!("{name:?} is unknown; named [[solid]] tables are {known}"))
        })
    };
    Ok(Operand::Set(operation, members.iter().enumerate().map(index).collect::<Result<_, _>>()?))
}

/// How much a table stands for.
#[derive(Clone, Copy)]
struct Extent {
    /// Shapes, each as often as it is used.
    shapes: u64,
    /// Levels, a shape being 1.
    depth: usize,
}

#[derive(Clone, Copy)]
enum Progress {
    New,
    /// Its members are being looked at: to meet it again is a circle.
    Open,
    Done(Extent),
}

/// Looks at each table once, before operations are filled in: a few lines may stand for 2⁶⁰ shapes.
struct Survey<'s> {
    all: &'s Spot<'s>,
    tables: &'s [SolidTable],
    parts: &'s [Part],
    seen: Vec<Progress>,
}

impl Survey<'_> {
    /// Extent of table `i`, which is met on the level `level` of an operation.
    fn extent(&mut self, i: usize, level: usize) -> Result<Extent, Error> {
        if let Progress::Done(extent) = self.seen[i] {
            return Ok(extent);
        }
        let Operand::Set(operation, members) = &self.parts[i].operand else {
            let extent = Extent { shapes: 1, depth: 1 };
            self.seen[i] = Progress::Done(extent);
            return Ok(extent);
        };
        let spot = self.all.index(i).key(operation.key());
        let mut extent = Extent { shapes: 0, depth: 1 };
        self.seen[i] = Progress::Open;
        for (at, member) in members.iter().enumerate() {
            if matches!(self.seen[*member], Progress::Open) {
                let name = self.tables[*member].name.as_deref().unwrap_or_default();
                let what = format!("{name:?} refers to itself by way of this operation");
                return Err(spot.index(at).error(what));
            }
            if level >= MAX_SOLID_DEPTH {
                return Err(spot.error(too_deep()));
            }
            let own = self.extent(*member, level + 1)?;
            extent.shapes = extent.shapes.saturating_add(own.shapes);
            extent.depth = extent.depth.max(own.depth + 1);
        }
        if extent.depth > MAX_SOLID_DEPTH {
            return Err(spot.error(too_deep()));
        }
        self.seen[i] = Progress::Done(extent);
        Ok(extent)
    }
}

fn too_deep() -> String {
    format!("operations within operations are possible to {MAX_SOLID_DEPTH} levels")
}

/// Table `i` with its operations filled in. `outer` leads from its coordinates to the file's, `inherited` is
/// what those are made of that name no material; `top` is for messages.
fn node(
    top: &Spot<'_>,
    parts: &[Part],
    i: usize,
    outer: &DAffine3,
    inherited: Option<u32>,
    grey: &mut dyn FnMut() -> u32,
) -> Result<SolidNode, Error> {
    let part = &parts[i];
    let placement = *outer * part.placement;
    let material = part.material.or(inherited);
    match &part.operand {
        Operand::Shape(shape, within) => {
            let world_from_solid = placement * *within;
            if !invertible(&world_from_solid) {
                let what = format!("the placements together make [[solid]] {} flat or far away", i + 1);
                return Err(top.error(what));
            }
            let material = material.unwrap_or_else(grey);
            Ok(SolidNode::Shape { shape: shape.clone(), world_from_solid, material })
        }
        Operand::Set(operation, members) => {
            let mut nodes = members
                .iter()
                .map(|member| node(top, parts, *member, &placement, material, grey))
                .collect::<Result<Vec<SolidNode>, Error>>()?;
            Ok(match operation {
                Operation::Union => SolidNode::Union(nodes),
                Operation::Intersection => SolidNode::Intersection(nodes),
                Operation::Difference => {
                    let others = nodes.split_off(1);
                    let whole = nodes.swap_remove(0);
                    SolidNode::Difference(Box::new(whole), others)
                }
            })
        }
    }
}

/// Whether f64 holds the placement and its inverse.
fn invertible(placement: &DAffine3) -> bool {
    placement.is_finite()
        && placement.inverse().is_finite()
        && placement.translation.abs().max_element() < 1e9
}
