//! All faces of a world: those of its things, and those of its waters.

use std::sync::Arc;

use glam::{DMat3, DVec2, DVec3, Vec3};
use light::{Geometry, Instance, Mesh, Opacity};

use crate::solid::{End, Solid};
use crate::tree::{Line, Meeting, Tree};
use crate::water::Water;

/// What a face belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Face {
    /// Triangle of an instance.
    Thing { instance: u32, triangle: u32 },
    /// A curved body.
    Solid,
    /// The surface of a water.
    Surface(usize),
    /// The side of a water, where it ends without a surface: light passes it straight.
    Side,
}

/// A point of a face, as a line has come to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) face: Face,
    pub(crate) position: DVec3,
    /// Unit normal of the face, on the side that the line comes from.
    pub(crate) normal: DVec3,
    /// Unit normal for shading, on the same side.
    pub(crate) smooth: DVec3,
    /// Whether the line comes from the outside, where corners run counter-clockwise.
    pub(crate) front: bool,
    pub(crate) uv: DVec2,
    pub(crate) colour: Vec3,
    /// Number of its surface; of a water's, nothing.
    pub(crate) surface: u32,
    /// How far off it a line begins \[m\].
    off: f64,
}

/// What a line meets.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Met {
    Triangle(Meeting),
    Solid(End),
}

impl Met {
    pub(crate) fn distance(&self) -> f64 {
        match self {
            Self::Triangle(meeting) => meeting.distance,
            Self::Solid(end) => end.distance,
        }
    }
}

/// Faces made ready for lines.
pub(crate) struct Shape {
    geometry: Arc<Geometry>,
    /// Of things and surfaces, then of sides.
    faces: Vec<Face>,
    tree: Tree,
    sides: Tree,
    solids: Vec<Solid>,
    /// How far a line begins beyond the face that it leaves \[m\]: many times what points are off by in f64, far less than anything is thick.
    pub(crate) off: f64,
    /// Ways to lamps end so far before them \[m\]: a lamp, rounded to f32, may lie behind the face that it is set into.
    pub(crate) before: f64,
}

/// Likewise for curved bodies, whose borders are found as roots \[m\].
const OFF_SOLID: f64 = 1e-7;
/// Share of the largest coordinate.
const OFF: f64 = 1e-12;
/// Likewise: 16 roundings of f32.
const BEFORE: f64 = 1e-6;

impl Shape {
    pub(crate) fn new(geometry: Arc<Geometry>, solids: Vec<Solid>, waters: &[Water]) -> Self {
        let (mut faces, mut triangles, mut sides) = (Vec::new(), Vec::new(), Vec::new());
        for (i, instance) in geometry.instances.iter().enumerate() {
            for t in 0..geometry.meshes[instance.mesh as usize].triangles.len() {
                faces.push(Face::Thing { instance: i as u32, triangle: t as u32 });
                triangles.push(geometry.triangle(i as u32, t as u32).0);
            }
        }
        let lowest = triangles.iter().flatten().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
        for (i, water) in waters.iter().enumerate() {
            for triangle in &water.triangles {
                faces.push(Face::Surface(i));
                triangles.push(triangle.map(|at| water.at(at)));
            }
            if water.extinction().is_zero() {
                continue;
            }
            let bottom = lowest.min(water.level) - 1.0;
            for [a, b] in water.outline() {
                let [a, b] = [a, b].map(|at| water.at(at));
                let [c, d] = [b, a].map(|corner| corner.with_y(bottom));
                sides.extend([[a, b, c], [a, c, d]]);
            }
        }
        faces.resize(faces.len() + sides.len(), Face::Side);
        let tree = Tree::new(triangles);
        let reach = tree.bounds().map_or(1.0, |(low, high)| low.abs().max(high.abs()).max_element()).max(1.0);
        Self {
            geometry,
            faces,
            tree,
            sides: Tree::new(sides),
            solids,
            off: OFF * reach,
            before: BEFORE * reach,
        }
    }

    /// What a line meets first, before `length`. A side of a water within a wall is not met: whoever passes it would be beyond the wall.
    pub(crate) fn nearest(&self, line: &Line, length: f64) -> Option<Met> {
        let first = self.tree.nearest(line, length);
        let mut reach = first.map_or(length, |meeting| meeting.distance);
        let mut met = first.map(Met::Triangle);
        for solid in &self.solids {
            if let Some(end) = solid.first(line, 0.0, reach) {
                (reach, met) = (end.distance, Some(Met::Solid(end)));
            }
        }
        let before = if met.is_some() { reach - 4.0 * self.off } else { reach };
        let side = self.sides.nearest(line, before);
        let side = side.map(|side| Meeting { triangle: side.triangle + self.tree.len() as u32, ..side });
        side.map(Met::Triangle).or(met)
    }

    fn mesh(&self, instance: u32) -> &Mesh {
        &self.geometry.meshes[self.geometry.instances[instance as usize].mesh as usize]
    }

    /// Triangles of things, and the numbers of their surfaces.
    pub(crate) fn things(&self) -> impl Iterator<Item = (u32, u32)> {
        self.faces.iter().enumerate().filter_map(|(i, face)| match face {
            Face::Thing { instance, .. } => Some((i as u32, self.mesh(*instance).material)),
            _ => None,
        })
    }

    /// Twice the area of a triangle of things or surfaces, times its normal.
    pub(crate) fn cross(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.tree.triangle(triangle);
        (b - a).cross(c - a)
    }

    /// Where on a triangle of things or surfaces.
    pub(crate) fn position(&self, meeting: &Meeting) -> DVec3 {
        let ([a, b, c], [v, w]) = (self.tree.triangle(meeting.triangle), meeting.weights);
        a * (1.0 - v - w) + b * v + c * w
    }

    /// All that is known of where `line` meets something.
    pub(crate) fn point(&self, line: &Line, met: &Met) -> Point {
        let meeting = match met {
            Met::Triangle(meeting) => meeting,
            Met::Solid(end) => {
                let (position, surface) = (line.at(end.distance), end.surface);
                return Point {
                    surface,
                    off: OFF_SOLID,
                    ..self.plain(Face::Solid, line, position, end.normal)
                };
            }
        };
        let face = self.faces[meeting.triangle as usize];
        let corners = match face {
            Face::Side => self.sides.triangle(meeting.triangle - self.tree.len() as u32),
            _ => self.tree.triangle(meeting.triangle),
        };
        let [v, w] = meeting.weights;
        let weights = [1.0 - v - w, v, w];
        let position = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let outward = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or(DVec3::Y);
        let Face::Thing { instance, triangle } = face else {
            return self.plain(face, line, position, outward);
        };
        let placed = &self.geometry.instances[instance as usize];
        let turn = if placed.world_from_mesh.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        let plain = self.plain(face, line, position, outward * turn);
        let mesh = self.mesh(instance);
        let ends = mesh.triangles[triangle as usize].map(|i| i as usize);
        let colour = match mesh.colours.is_empty() {
            true => Vec3::ONE,
            false => (0..3).map(|k| mesh.colours[ends[k]] * weights[k] as f32).sum(),
        };
        let smooth = smooth(mesh, placed, ends, weights, plain.normal);
        Point { smooth, uv: uv(mesh, ends, weights), colour, surface: mesh.material, ..plain }
    }

    /// A point without more than a position and a normal outwards.
    fn plain(&self, face: Face, line: &Line, position: DVec3, outward: DVec3) -> Point {
        let front = outward.dot(line.direction) <= 0.0;
        let normal = if front { outward } else { -outward };
        let (uv, colour, surface, off) = (DVec2::ZERO, Vec3::ONE, u32::MAX, self.off);
        Point { face, position, normal, smooth: normal, front, uv, colour, surface, off }
    }

    /// How much is there where a line meets something, within \[0, 1\].
    pub(crate) fn opacity(&self, met: &Met) -> f64 {
        let Met::Triangle(meeting) = met else { return 1.0 };
        let Face::Thing { instance, triangle } = self.faces[meeting.triangle as usize] else { return 1.0 };
        let mesh = self.mesh(instance);
        let Some(opacity) = &mesh.opacity else { return 1.0 };
        let [v, w] = meeting.weights;
        let ends = mesh.triangles[triangle as usize].map(|i| i as usize);
        f64::from(there(opacity, uv(mesh, ends, [1.0 - v - w, v, w])))
    }

    /// Where a line goes on from `point` along `direction`.
    pub(crate) fn leave(&self, point: &Point, direction: DVec3) -> Line {
        let side = if direction.dot(point.normal) < 0.0 { -point.normal } else { point.normal };
        Line { origin: point.position + side * point.off, direction }
    }
}

fn there(opacity: &Opacity, uv: DVec2) -> f32 {
    opacity.at(uv.as_vec2(), 0.0).clamp(0.0, 1.0)
}

fn uv(mesh: &Mesh, ends: [usize; 3], weights: [f64; 3]) -> DVec2 {
    match mesh.uvs.is_empty() {
        true => DVec2::ZERO,
        false => (0..3).map(|k| mesh.uvs[ends[k]].as_dvec2() * weights[k]).sum(),
    }
}

/// The interpolated normal, on the side of `flat`; `flat` itself where there is none.
fn smooth(mesh: &Mesh, placed: &Instance, ends: [usize; 3], weights: [f64; 3], flat: DVec3) -> DVec3 {
    if mesh.normals.is_empty() {
        return flat;
    }
    let local: DVec3 = (0..3).map(|k| mesh.normals[ends[k]].as_dvec3() * weights[k]).sum();
    // Normals go by the inverse transpose: by its multiple, the cofactors.
    let m = placed.world_from_mesh.matrix3;
    let cofactors =
        DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    match (cofactors * local).try_normalize() {
        Some(smooth) if smooth.dot(flat) > 0.0 => smooth,
        Some(smooth) if smooth.dot(flat) < 0.0 => -smooth,
        _ => flat,
    }
}
