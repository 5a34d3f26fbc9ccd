//! Faces cut where water surfaces meet them: light above and light below do not go on into each other.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use light::{Geometry, Instance, Mesh};
use scene::Water;

/// Faces that reach no farther than this beyond a surface \[m\] are not cut.
const NEAR: f64 = 1e-4;

/// A scene's geometry whose faces end at water surfaces.
pub(super) struct Parted {
    /// The pieces, in the placements of the scene's own geometry.
    pub(super) geometry: Arc<Geometry>,
    /// By placement: where the pieces of each of its triangles begin, and the end of all; none where nothing is cut.
    starts: Vec<Option<Vec<u32>>>,
}

impl Parted {
    pub(super) fn new(geometry: &Arc<Geometry>, waters: &[Water]) -> Self {
        Self::at(geometry, &waters.iter().map(Level::of).collect::<Vec<_>>())
    }

    fn at(geometry: &Arc<Geometry>, levels: &[Level]) -> Self {
        let mut starts = vec![None; geometry.instances.len()];
        let mut cut = None;
        for (i, placed) in geometry.instances.iter().enumerate() {
            let mesh = &geometry.meshes[placed.mesh as usize];
            let Some((pieces, begins)) = parted(mesh, &placed.world_from_mesh, levels) else { continue };
            let cut = cut.get_or_insert_with(|| Geometry::clone(geometry));
            cut.instances[i] = Instance { mesh: cut.meshes.len() as u32, ..*placed };
            cut.meshes.push(pieces);
            starts[i] = Some(begins);
        }
        Self { geometry: cut.map_or_else(|| Arc::clone(geometry), Arc::new), starts }
    }

    /// The scene's face that a piece is of.
    pub(super) fn whole(&self, [instance, triangle]: [u32; 2]) -> [u32; 2] {
        match self.starts.get(instance as usize) {
            Some(Some(starts)) => [instance, starts.partition_point(|&start| start <= triangle) as u32 - 1],
            _ => [instance, triangle],
        }
    }

    /// The piece of a scene's face that a point of it lies on, or nearly so.
    pub(super) fn piece(&self, [instance, triangle]: [u32; 2], at: DVec3) -> [u32; 2] {
        let Some(Some(starts)) = self.starts.get(instance as usize) else { return [instance, triangle] };
        let Some(&[first, end]) = starts.get(triangle as usize..).and_then(|rest| rest.first_chunk()) else {
            return [instance, triangle];
        };
        let inside = |&piece: &u32| self.inside([instance, piece], at);
        let best = (first..end).max_by(|a, b| inside(a).total_cmp(&inside(b)));
        [instance, best.unwrap_or(first)]
    }

    /// The least weight of a triangle's corners at a point: negative outside.
    fn inside(&self, [instance, triangle]: [u32; 2], at: DVec3) -> f64 {
        let face = self.geometry.triangle(instance, triangle);
        let [v, w] = face.meet(at, face.cross()).map_or([f64::NEG_INFINITY; 2], |weights| weights.to_array());
        v.min(w).min(1.0 - v - w)
    }
}

/// A surface, as far as cutting cares.
struct Level {
    y: f64,
    low: DVec2,
    high: DVec2,
}

impl Level {
    fn of(water: &Water) -> Self {
        let at = |corner: &glam::Vec3| {
            let p = water.place.transform_point3(corner.as_dvec3());
            DVec2::new(p.x, p.z)
        };
        let corners = || water.surface.positions.iter().map(at);
        Self {
            y: water.level(),
            low: corners().fold(DVec2::INFINITY, DVec2::min),
            high: corners().fold(DVec2::NEG_INFINITY, DVec2::max),
        }
    }

    /// Whether it cuts a thing of these corners.
    fn cuts(&self, corners: impl Iterator<Item = DVec3>) -> bool {
        let (low, high) =
            corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        low.y < self.y - NEAR
            && high.y > self.y + NEAR
            && DVec2::new(low.x, low.z).cmple(self.high).all()
            && DVec2::new(high.x, high.z).cmpge(self.low).all()
    }
}

/// The mesh with its triangles cut, and where the pieces of each begin; none where nothing is to be cut.
fn parted(mesh: &Mesh, world_from_mesh: &DAffine3, levels: &[Level]) -> Option<(Mesh, Vec<u32>)> {
    let world = |mesh: &Mesh, i: u32| world_from_mesh.transform_point3(mesh.positions[i as usize].as_dvec3());
    let corners = || (0..mesh.positions.len() as u32).map(|i| world(mesh, i));
    let levels: Vec<&Level> = levels.iter().filter(|level| level.cuts(corners())).collect();
    if levels.is_empty() {
        return None;
    }
    let (mut cut, mut starts) = (mesh.clone(), vec![0]);
    cut.triangles.clear();
    for triangle in &mesh.triangles {
        let mut pieces = vec![*triangle];
        for level in &levels {
            for piece in std::mem::take(&mut pieces) {
                if level.cuts(piece.iter().map(|&i| world(&cut, i))) {
                    let heights = piece.map(|i| world(&cut, i).y - level.y);
                    split(&mut cut, piece, heights, &mut pieces);
                } else {
                    pieces.push(piece);
                }
            }
        }
        cut.triangles.extend(pieces);
        starts.push(cut.triangles.len() as u32);
    }
    Some((cut, starts))
}

/// Cuts a triangle where `heights` of its corners are 0: into three, one of them without an area where it goes through a corner.
fn split(mesh: &mut Mesh, triangle: [u32; 3], heights: [f64; 3], pieces: &mut Vec<[u32; 3]>) {
    let above = heights.iter().filter(|&&height| height > 0.0).count();
    // Turned so that the one that is alone on its side comes first.
    let alone = (0..3).find(|&k| (heights[k] > 0.0) == (above == 1)).unwrap_or(0);
    let [a, b, c] = [0, 1, 2].map(|k| triangle[(alone + k) % 3]);
    let [ha, hb, hc] = [0, 1, 2].map(|k| heights[(alone + k) % 3]);
    let [ab, ac] = [(b, hb), (c, hc)].map(|(other, h)| between(mesh, [a, other], [ha, h]));
    pieces.extend([[a, ab, ac], [ab, b, c], [ab, c, ac]]);
}

/// A new corner where the height along an edge is 0.
fn between(mesh: &mut Mesh, ends: [u32; 2], heights: [f64; 2]) -> u32 {
    // From the lower end up, whichever comes first: neighbours cut their common edge at one point.
    let up = heights[0] <= heights[1];
    let [low, high] = if up { ends } else { [ends[1], ends[0]] }.map(|i| i as usize);
    let [below, above] = if up { heights } else { [heights[1], heights[0]] };
    let share = (-below / (above - below)).clamp(0.0, 1.0);
    let t = share as f32;
    let position = mesh.positions[low].as_dvec3().lerp(mesh.positions[high].as_dvec3(), share).as_vec3();
    mesh.positions.push(position);
    if !mesh.normals.is_empty() {
        let normal = mesh.normals[low].lerp(mesh.normals[high], t);
        mesh.normals.push(normal.try_normalize().unwrap_or(mesh.normals[low]));
    }
    if !mesh.uvs.is_empty() {
        mesh.uvs.push(mesh.uvs[low].lerp(mesh.uvs[high], t));
    }
    if !mesh.colours.is_empty() {
        mesh.colours.push(mesh.colours[low].lerp(mesh.colours[high], t));
    }
    mesh.positions.len() as u32 - 1
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn pond(y: f64) -> Level {
        Level { y, low: DVec2::splat(-5.0), high: DVec2::splat(5.0) }
    }

    /// A wall of two triangles from y = −1 to 3, and one far away.
    fn walls() -> Arc<Geometry> {
        let corners = [[-2.0, -1.0], [2.0, -1.0], [2.0, 3.0], [-2.0, 3.0]];
        let mesh = Mesh {
            positions: corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec(),
            uvs: corners.map(|[x, y]| glam::Vec2::new(x, y)).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        };
        let at = |x: f64| Instance { mesh: 0, world_from_mesh: DAffine3::from_translation(DVec3::X * x) };
        Arc::new(Geometry { meshes: vec![mesh], instances: vec![at(0.0), at(100.0)] })
    }

    #[test]
    fn pieces_cover_their_faces_and_lie_on_one_side() {
        let walls = walls();
        let parted = Parted::at(&walls, &[pond(0.25), pond(1.5)]);
        let area = |geometry: &Geometry| -> f64 {
            let count = geometry.meshes[geometry.instances[0].mesh as usize].triangles.len() as u32;
            (0..count).map(|t| 0.5 * geometry.triangle(0, t).cross().z).sum()
        };
        // Corners are f32.
        assert!((area(&parted.geometry) - area(&walls)).abs() < 1e-5);
        let mesh = &parted.geometry.meshes[parted.geometry.instances[0].mesh as usize];
        for triangle in &mesh.triangles {
            for level in [0.25, 1.5] {
                let heights = triangle.map(|i| f64::from(mesh.positions[i as usize].y) - level);
                let up = heights.iter().filter(|&&h| h > 1e-6).count();
                let down = heights.iter().filter(|&&h| h < -1e-6).count();
                assert!(up == 0 || down == 0, "{heights:?}");
            }
            // Attributes go on as positions do.
            assert!(triangle.iter().all(|&i| {
                let i = i as usize;
                (mesh.positions[i].truncate() - mesh.uvs[i]).abs().max_element() < 1e-6
            }));
        }
    }

    #[test]
    fn pieces_and_faces_find_each_other() {
        let walls = walls();
        let parted = Parted::at(&walls, &[pond(0.25)]);
        let count = parted.geometry.meshes[parted.geometry.instances[0].mesh as usize].triangles.len();
        for piece in 0..count as u32 {
            let corners = parted.geometry.triangle(0, piece).0;
            let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
            let whole = parted.whole([0, piece]);
            assert_eq!(parted.piece(whole, centre), [0, piece]);
        }
        // What is not cut keeps its numbers.
        assert_eq!(parted.whole([1, 1]), [1, 1]);
        assert_eq!(parted.piece([1, 1], DVec3::ZERO), [1, 1]);
        assert_eq!(parted.piece([7, 9], DVec3::ZERO), [7, 9]);
        assert!(Arc::ptr_eq(&Parted::at(&walls, &[]).geometry, &walls));
    }
}
