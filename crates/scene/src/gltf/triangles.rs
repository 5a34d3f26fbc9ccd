//! Lists, strips and fans to plain triangles.

use glam::{DVec3, Vec3};
use gltf::json::mesh::Mode;

/// Triangles over `count` corners taken in order, or over what `indices` names. None for points and lines.
pub(super) fn assemble(mode: Mode, indices: Option<&[u32]>, count: u32) -> Option<Vec<[u32; 3]>> {
    let total = indices.map_or(count, |indices| u32::try_from(indices.len()).unwrap_or(u32::MAX));
    let corner = |i: u32| indices.map_or(i, |indices| indices[i as usize]);
    let rows = total.saturating_sub(2);
    // glTF 2.0, 3.7.2.1: every second triangle of a strip is turned, so that all face the same way.
    Some(match (mode, indices) {
        (Mode::Triangles, Some(indices)) => indices.as_chunks::<3>().0.to_vec(),
        (Mode::Triangles, None) => (0..total / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        (Mode::TriangleStrip, _) => {
            (0..rows).map(|i| [i, i + 1 + i % 2, i + 2 - i % 2].map(corner)).collect()
        }
        (Mode::TriangleFan, _) => (0..rows).map(|i| [i + 1, i + 2, 0].map(corner)).collect(),
        _ => return None,
    })
}

/// Takes out the triangles without area; how many there were.
pub(super) fn drop_degenerate(triangles: &mut Vec<[u32; 3]>, positions: &[Vec3]) -> u64 {
    let before = triangles.len();
    triangles.retain(|&triangle| cross(triangle, positions) != DVec3::ZERO);
    (before - triangles.len()) as u64
}

/// Twice the area times the normal, in f64: differences of f32 are (nearly always) exact there.
pub(super) fn cross(triangle: [u32; 3], positions: &[Vec3]) -> DVec3 {
    let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_facing_the_same_way() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
        let strip = assemble(Mode::TriangleStrip, None, 4).unwrap();
        assert_eq!(strip, [[0, 1, 2], [1, 3, 2]]);
        let fan = assemble(Mode::TriangleFan, Some(&[0, 1, 3, 2]), 4).unwrap();
        assert_eq!(fan, [[1, 3, 0], [3, 2, 0]]);
        for triangle in strip.into_iter().chain(fan) {
            assert_eq!(cross(triangle, &square), DVec3::Z);
        }
    }

    #[test]
    fn too_few_corners_make_nothing() {
        for mode in [Mode::Triangles, Mode::TriangleStrip, Mode::TriangleFan] {
            assert_eq!(assemble(mode, None, 2), Some(vec![]));
            assert_eq!(assemble(mode, Some(&[]), 9), Some(vec![]));
        }
        assert_eq!(assemble(Mode::Lines, None, 9), None);
    }

    #[test]
    fn only_triangles_without_area_go() {
        let positions = [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X, Vec3::new(0.0, 1e-30, 0.0)];
        let mut triangles = vec![[0, 1, 2], [0, 1, 1], [0, 1, 3]];
        assert_eq!(drop_degenerate(&mut triangles, &positions), 2);
        assert_eq!(triangles, [[0, 1, 3]]);
    }
}
