//! A plane face, concave or with holes, to triangles.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::Fault;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Triangles of the face that `outer` bounds, less `holes`, as indices into the corners: those of `outer`
/// first, then those of the holes in order. They face the way `outer` goes round; holes may go either way.
///
/// The face is taken to be plane: it is triangulated as seen along its mean normal, and keeps its corners.
/// Corners given twice in a row count once.
pub fn polygon(outer: &[DVec3], holes: &[Vec<DVec3>]) -> Result<Vec<[u32; 3]>, Fault> {
    let loops: Vec<&[DVec3]> = std::iter::once(outer).chain(holes.iter().map(Vec::as_slice)).collect();
    let all = loops.concat();
    if let Some(bad) = all.iter().position(|p| !p.is_finite() || p.abs().max_element() > 1e30) {
        return Err(Fault::NotFinite(bad));
    }
    let (normal, cancels) = normal(outer).ok_or(Fault::NoArea)?;
    let flat = flatten(&all, normal);
    let edges = edges(&loops, &flat);
    // The library panics on a few inputs that its own tests do not know; here they become an error.
    let built = catch_unwind(AssertUnwindSafe(|| constrained(&flat, &edges)));
    let cdt = built.unwrap_or_else(|_| Err(Fault::Library("an inner check failed".into())))?;
    if cancels { Err(Fault::NoArea) } else { collect(&cdt, &flat, &loops) }
}

/// How far corners lie off the plane between them that is normal to the face, at most; in the unit of the corners.
/// 0 for a plane face, and for one without an area.
pub fn unevenness(outer: &[DVec3], holes: &[Vec<DVec3>]) -> f64 {
    let Some((normal, _)) = normal(outer) else { return 0.0 };
    let origin = outer.first().copied().unwrap_or_default();
    let heights = || outer.iter().chain(holes.iter().flatten()).map(|corner| normal.dot(*corner - origin));
    let (low, high) = (heights().fold(0.0, f64::min), heights().fold(0.0, f64::max));
    0.5 * (high - low)
}

/// The side from which the loop goes counter-clockwise, and whether its areas cancel: the wings of a bow tie go
/// round either way, and only their plane is known. None where all corners lie on a line.
fn normal(outer: &[DVec3]) -> Option<(DVec3, bool)> {
    let area = area_vector(outer);
    let origin = *outer.first()?;
    let farthest =
        outer.iter().map(|corner| *corner - origin).max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let widest = outer.iter().map(|corner| farthest.cross(*corner - origin));
    let widest = widest.max_by(|a, b| a.length().total_cmp(&b.length()))?;
    // What is left of areas that cancel is rounding: 10⁻¹⁶ for each corner of the triangle that spans them all.
    let cancels = area.length() <= 1e-15 * outer.len() as f64 * widest.length();
    let normal = if cancels { widest } else { area };
    Some((normal.try_normalize()?, cancels))
}

/// Newell's normal: twice the area, along the side from which the loop goes counter-clockwise.
fn area_vector(corners: &[DVec3]) -> DVec3 {
    let Some(&origin) = corners.first() else { return DVec3::ZERO };
    // About the first corner, so that large coordinates do not cancel.
    corners.windows(2).map(|w| (w[0] - origin).cross(w[1] - origin)).sum()
}

/// Drops the axis along which the normal is longest; the loop stays counter-clockwise. Coordinates are only
/// copied, so points on a line in the file stay exactly on a line.
fn flatten(all: &[DVec3], normal: DVec3) -> Vec<DVec2> {
    let size = normal.abs();
    let project = |p: &DVec3| match size {
        s if s.x >= s.y && s.x >= s.z => DVec2::new(p.y, p.z * normal.x.signum()),
        s if s.y >= s.z => DVec2::new(p.z, p.x * normal.y.signum()),
        _ => DVec2::new(p.x, p.y * normal.z.signum()),
    };
    // The library refuses numbers between 0 and 2⁻¹⁴²: they are as good as 0.
    let settle = |x: f64| if x.abs() < 1e-40 { 0.0 } else { x };
    all.iter().map(project).map(|p| DVec2::new(settle(p.x), settle(p.y))).collect()
}

/// The sides of all loops; corners that repeat their predecessor have none.
fn edges(loops: &[&[DVec3]], flat: &[DVec2]) -> Vec<[usize; 2]> {
    let mut edges = Vec::with_capacity(flat.len());
    let mut first = 0;
    for corners in loops {
        let count = corners.len();
        let mut distinct: Vec<usize> = (first..first + count).collect();
        distinct.dedup_by(|a, b| flat[*a] == flat[*b]);
        while distinct.len() > 1 && flat[distinct[0]] == flat[distinct[distinct.len() - 1]] {
            distinct.pop();
        }
        let sides = distinct.len();
        edges.extend((0..sides).map(|i| [distinct[i], distinct[(i + 1) % sides]]));
        first += count;
    }
    edges
}

/// The triangulation with all sides in it; an error where sides meet other than at their ends.
fn constrained(flat: &[DVec2], edges: &[[usize; 2]]) -> Result<Cdt, Fault> {
    let mut cdt = Cdt::new();
    let mut handles = HashMap::with_capacity(edges.len());
    let mut owner = HashMap::with_capacity(edges.len());
    for &[corner, _] in edges {
        let p = flat[corner];
        let handle = cdt.insert(Point2::new(p.x, p.y)).map_err(|error| Fault::Library(error.to_string()))?;
        // Two corners in one place: the outline touches itself there.
        if let Some(other) = owner.insert(handle, corner) {
            return Err(Fault::Crossing(other, corner));
        }
        handles.insert(corner, handle);
    }
    for &[from, to] in edges {
        let (a, b) = (handles[&from], handles[&to]);
        // A side through another corner would be cut in two without a word.
        let before = cdt.num_constraints();
        let sound = a != b && cdt.can_add_constraint(a, b) && cdt.add_constraint(a, b);
        if !sound || cdt.num_constraints() != before + 1 || !cdt.exists_constraint(a, b) {
            return Err(Fault::Crossing(from, to));
        }
    }
    Ok(cdt)
}

/// The triangles inside: those that lie one side deep.
fn collect(cdt: &Cdt, flat: &[DVec2], loops: &[&[DVec3]]) -> Result<Vec<[u32; 3]>, Fault> {
    let depth = depths(cdt);
    // Backwards, so that of corners in one place the first counts.
    let corner: HashMap<[u64; 2], usize> = flat.iter().enumerate().rev().map(|(i, &p)| (key(p), i)).collect();
    let corner_at = |p: Point2<f64>| corner[&key(DVec2::new(p.x, p.y))];
    let mut starts = vec![0];
    starts.extend(loops.iter().scan(0, |end, corners| {
        *end += corners.len();
        Some(*end)
    }));
    // On both sides of a hole: the face (one side deep) and the hole (two).
    for edge in cdt.undirected_edges().filter(|edge| edge.is_constraint_edge()) {
        let owner = starts.partition_point(|&start| start <= corner_at(edge.positions()[0])) - 1;
        let directed = edge.as_directed();
        let mut sides = [directed, directed.rev()].map(|edge| depth[edge.face().fix().index()]);
        sides.sort_unstable();
        if owner > 0 && sides != [1, 2] {
            return Err(Fault::HoleOutside(starts[owner]));
        }
    }
    let inside = cdt.inner_faces().filter(|face| depth[face.fix().index()] == 1);
    let triangles: Vec<_> =
        inside.map(|face| face.vertices().map(|vertex| corner_at(vertex.position()) as u32)).collect();
    if triangles.is_empty() { Err(Fault::NoArea) } else { Ok(triangles) }
}

/// How many sides lie between each face and the outside, at least: a flood, one depth after the other.
fn depths(cdt: &Cdt) -> Vec<u32> {
    const UNSEEN: u32 = u32::MAX;
    let mut depth = vec![UNSEEN; cdt.num_all_faces()];
    let mut open: Vec<_> = cdt.convex_hull().flat_map(|edge| [edge, edge.rev()]).collect();
    depth[cdt.outer_face().fix().index()] = 0;
    // An edge waits here for the faces on its left; the hull's stand for the outside itself.
    let mut here = 0;
    while !open.is_empty() {
        let mut deeper = Vec::new();
        while let Some(edge) = open.pop() {
            let crosses =
                here == 0 && edge.is_constraint_edge() && depth[edge.rev().face().fix().index()] == 0;
            if crosses {
                deeper.push(edge);
                continue;
            }
            let face = edge.face();
            if depth[face.fix().index()] != UNSEEN {
                continue;
            }
            depth[face.fix().index()] = here;
            for side in face.as_inner().map(|inner| inner.adjacent_edges()).into_iter().flatten() {
                if side.is_constraint_edge() {
                    deeper.push(side.rev());
                } else {
                    open.push(side.rev());
                }
            }
        }
        open = deeper;
        here += 1;
    }
    depth
}

/// −0 and 0 are the same place.
fn key(p: DVec2) -> [u64; 2] {
    [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]
}
