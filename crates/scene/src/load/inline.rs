//! Geometry that the scene file itself describes: boxes, prisms, planes, polygons, terrain.

use glam::{DAffine3, DVec3};
use light::Mesh;

use super::placement;
use crate::document::Spot;
use crate::file::{ModelTable, PolygonTable, PrismTable, TerrainTable};
use crate::{Error, Warning, triangulate};

/// Longest side of a box, plane or solid \[m\].
pub(crate) const LONGEST: f64 = 1e7;

/// Shortest side or radius of a solid or prism \[m\]: a nanometre. Shorter ones have no inverse that f64 holds.
pub(crate) const SHORTEST: f64 = 1e-9;

/// Most sides of a prism: its corners are those of a polyhedron, which has 128 at most.
const MOST_SIDES: f64 = 64.0;

/// Corners of a polygon that are farther off their plane than this share of its size are worth a word.
const UNEVEN: f64 = 1e-3;

/// Triangles about their own middle, so that f32 keeps them exact, and where that middle is.
pub(crate) struct Inline {
    pub(crate) mesh: Mesh,
    pub(crate) middle: DVec3,
}

impl Inline {
    /// From corners in f64: moved to their middle first, rounded after.
    fn new(corners: &[DVec3], triangles: Vec<[u32; 3]>) -> Self {
        let low = corners.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = corners.iter().copied().reduce(DVec3::max).unwrap_or_default();
        // Whole metres: coordinates that were short decimals stay short.
        let middle = (0.5 * (low + high)).round();
        let positions = corners.iter().map(|corner| (corner - middle).as_vec3()).collect();
        Self { mesh: Mesh { positions, triangles, ..Mesh::default() }, middle }
    }

    /// From the mesh to the file's coordinates when the model is placed by `placement`.
    pub(crate) fn placed(&self, placement: &DAffine3) -> DAffine3 {
        *placement * DAffine3::from_translation(self.middle)
    }
}

/// The geometry of a model table that names no file; none if it describes none either.
pub(crate) fn geometry(
    spot: &Spot<'_>,
    table: &ModelTable,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Inline>, Error> {
    if let Some(cuboid) = &table.cuboid {
        let spot = spot.key("box").key("size");
        let [x, y, z] = cuboid.size;
        for side in [x, y, z] {
            spot.positive(side, LONGEST, "m")?;
        }
        return Ok(Some(cuboid_of(DVec3::new(x, y, z))));
    }
    if let Some(prism) = &table.prism {
        return Ok(Some(prism_of(&prism_corners(&spot.key("prism"), prism)?)));
    }
    if let Some(plane) = &table.plane {
        let spot = spot.key("plane").key("size");
        let [x, z] = plane.size;
        spot.positive(x, LONGEST, "m")?;
        spot.positive(z, LONGEST, "m")?;
        let corners = [[-x, z], [x, z], [x, -z], [-x, -z]].map(|[x, z]| DVec3::new(0.5 * x, 0.0, 0.5 * z));
        return Ok(Some(Inline::new(&corners, vec![[0, 1, 2], [0, 2, 3]])));
    }
    if let Some(polygon) = &table.polygon {
        return polygon_of(&spot.key("polygon"), polygon, warnings).map(Some);
    }
    if let Some(terrain) = &table.terrain {
        return terrain_of(&spot.key("terrain"), terrain, warnings).map(Some);
    }
    Ok(None)
}

/// A box on y = 0, its faces seen from outside; every face has its own corners.
fn cuboid_of(size: DVec3) -> Inline {
    let half = 0.5 * size;
    let mut corners = Vec::with_capacity(24);
    let mut triangles = Vec::with_capacity(12);
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            // Right-handed: u × v points along the axis, so u → v turns counter-clockwise seen from outside.
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let first = corners.len() as u32;
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                let mut corner = DVec3::ZERO;
                corner[axis] = sign * half[axis];
                corner[u] = a * sign * half[u];
                corner[v] = b * half[v];
                corners.push(corner + DVec3::Y * half.y);
            }
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    Inline::new(&corners, triangles)
}

/// Corners of a regular prism on y = 0: those of its base, counter-clockwise seen from above from the one at
/// +x on, then those above them.
pub(crate) fn prism_corners(spot: &Spot<'_>, table: &PrismTable) -> Result<Vec<DVec3>, Error> {
    let sides = spot.key("sides").within(f64::from(table.sides), 3.0, MOST_SIDES, "")?;
    let radius = spot.key("radius").within(table.radius, SHORTEST, LONGEST, "m")?;
    let height = spot.key("height").within(table.height, SHORTEST, LONGEST, "m")?;
    let corner = |i: u32| placement::rotation([0.0, 360.0 * f64::from(i) / sides, 0.0]) * DVec3::X * radius;
    let base: Vec<DVec3> = (0..table.sides).map(corner).collect();
    Ok(base.iter().copied().chain(base.iter().map(|c| *c + DVec3::Y * height)).collect())
}

/// Closed, faces seen from outside.
fn prism_of(corners: &[DVec3]) -> Inline {
    let sides = corners.len() as u32 / 2;
    let caps = (1..sides - 1).flat_map(|i| [[0, i + 1, i], [sides, sides + i, sides + i + 1]]);
    let walls = (0..sides).flat_map(|i| {
        let next = (i + 1) % sides;
        [[i, next, sides + next], [i, sides + next, sides + i]]
    });
    Inline::new(corners, caps.chain(walls).collect())
}

pub(crate) fn polygon_of(
    spot: &Spot<'_>,
    table: &PolygonTable,
    warnings: &mut Vec<Warning>,
) -> Result<Inline, Error> {
    let outline = spot.key("points").points(&table.points)?;
    let holes = spot.key("holes");
    let holes: Vec<Vec<DVec3>> = table
        .holes
        .iter()
        .enumerate()
        .map(|(i, hole)| holes.index(i).points(hole))
        .collect::<Result<_, _>>()?;
    let triangles = triangulate::polygon(&outline, &holes).map_err(|fault| spot.error(fault.to_string()))?;
    let off = triangulate::unevenness(&outline, &holes);
    let low = outline.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = outline.iter().copied().reduce(DVec3::max).unwrap_or_default();
    if off > UNEVEN * (high - low).length() {
        warnings.push(spot.warning(format!(
            "corners lie up to {off:.3} m off their plane: the face is folded along lines that the file does not say"
        )));
    }
    let corners: Vec<DVec3> = outline.into_iter().chain(holes.into_iter().flatten()).collect();
    Ok(Inline::new(&corners, triangles))
}

fn terrain_of(spot: &Spot<'_>, table: &TerrainTable, warnings: &mut Vec<Warning>) -> Result<Inline, Error> {
    spot.exactly_one(&[("file", table.file.is_some()), ("points", table.points.is_some())])?;
    let points = match &table.file {
        Some(name) => {
            let spot = spot.key("file");
            triangulate::read_points(&spot.file(name)).map_err(|error| super::missing(&spot, error))?
        }
        None => spot.key("points").points(table.points.as_deref().unwrap_or_default())?,
    };
    let terrain = triangulate::terrain(&points).map_err(|fault| spot.error(fault.to_string()))?;
    for (count, what) in [
        (terrain.not_finite, "points are not finite or absurdly far; they are left out"),
        (terrain.duplicates, "points stand where an earlier one stands; the earlier one counts"),
    ] {
        if count > 0 {
            warnings.push(spot.warning(format!("{count} {what}")));
        }
    }
    Ok(Inline { mesh: terrain.mesh, middle: terrain.origin })
}

#[cfg(test)]
mod tests {
    use light::{Geometry, Instance};

    use super::*;

    /// A prism over a square of radius 1 (area 2), 3 m high; corners of a quarter turn are exact.
    #[test]
    fn a_prism_is_closed_and_faces_outwards() {
        let (x, z, up) = (DVec3::X, DVec3::Z, DVec3::Y * 3.0);
        let base = [x, -z, -x, z];
        let corners: Vec<DVec3> = base.into_iter().chain(base.map(|c| c + up)).collect();
        let inline = prism_of(&corners);
        let instance = Instance { mesh: 0, world_from_mesh: inline.placed(&DAffine3::IDENTITY) };
        let geometry = Geometry { meshes: vec![inline.mesh], instances: vec![instance] };
        let volume: f64 = (0..12).map(|i| geometry.triangle(0, i)).map(|t| t.0[0].dot(t.cross()) / 6.0).sum();
        assert_eq!(volume, 6.0);
        let area = (0..12).fold(DVec3::ZERO, |sum, i| sum + geometry.triangle(0, i).cross());
        assert_eq!(area, DVec3::ZERO);
    }

    #[test]
    fn a_box_is_closed_and_faces_outwards() {
        let inline = cuboid_of(DVec3::new(2.0, 3.0, 4.0));
        let instance = Instance { mesh: 0, world_from_mesh: inline.placed(&DAffine3::IDENTITY) };
        let geometry = Geometry { meshes: vec![inline.mesh], instances: vec![instance] };
        assert_eq!(geometry.bounds(), Some((DVec3::new(-1.0, 0.0, -2.0), DVec3::new(1.0, 3.0, 2.0))));
        // Divergence theorem: Σ (a · cross) / 6 is the volume if all faces look outwards.
        let volume: f64 = (0..12).map(|i| geometry.triangle(0, i)).map(|t| t.0[0].dot(t.cross()) / 6.0).sum();
        assert_eq!(volume, 24.0);
        let area = (0..12).fold(DVec3::ZERO, |sum, i| sum + geometry.triangle(0, i).cross());
        assert_eq!(area, DVec3::ZERO);
    }
}
