//! Scenes and pictures that several tests use.
#![allow(dead_code, reason = "each test file uses its own part")]

use std::ops::Range;
use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use keikan_scanline::{Knobs, Scanline};
use light::{Geometry, Instance, Mesh, Piece, See, View};

/// One mesh, placed once.
pub(crate) fn placed(mesh: Mesh) -> Geometry {
    let instances = vec![Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY }];
    Geometry { meshes: vec![mesh], instances }
}

/// Triangles that share no corners.
pub(crate) fn soup(triangles: &[[Vec3; 3]]) -> Mesh {
    let count = triangles.len() as u32;
    Mesh {
        positions: triangles.iter().flatten().copied().collect(),
        triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    }
}

/// A height field of 2 n² triangles over the square of `size` metres around (0, 0), y = height(x, z).
pub(crate) fn terrain(n: u32, size: f32, height: impl Fn(f32, f32) -> f32) -> Mesh {
    let mut mesh = Mesh::default();
    let at = |i: u32| (i as f32 / n as f32 - 0.5) * size;
    for j in 0..=n {
        for i in 0..=n {
            mesh.positions.push(Vec3::new(at(i), height(at(i), at(j)), at(j)));
        }
    }
    for j in 0..n {
        for i in 0..n {
            let a = j * (n + 1) + i;
            let c = a + n + 1;
            mesh.triangles.extend([[a, c, a + 1], [a + 1, c, c + 1]]);
        }
    }
    mesh
}

/// From the origin down −Z, square, 60°.
pub(crate) fn ahead(size: u32) -> View {
    View::look_at(DVec3::ZERO, -DVec3::Z, 60.0, size, size)
}

pub(crate) fn stage(geometry: Geometry, view: View, knobs: Knobs) -> Scanline {
    Scanline::new(Arc::new(geometry), view, knobs)
}

/// All pieces of a part of the picture, row by row.
pub(crate) fn picture(stage: &Scanline, rows: Range<u32>, columns: Range<u32>) -> Vec<(u32, Piece)> {
    let mut all = Vec::new();
    stage.see(rows, columns, &mut |row, pieces| all.extend(pieces.drain(..).map(|piece| (row, piece))));
    all
}

/// Sum of shares per pixel.
pub(crate) fn totals(stage: &Scanline, width: u32, height: u32) -> Vec<f64> {
    let mut totals = vec![0.0; (width * height) as usize];
    for (row, piece) in picture(stage, 0..height, 0..width) {
        totals[(row * width + piece.column) as usize] += f64::from(piece.share);
    }
    totals
}
