use glam::{DAffine3, Vec3};
use light::Instance;

use super::*;

/// Takes everything whose box meets the half-space x > 0.
#[derive(Default)]
struct Right(Vec<[DVec3; 3]>);

impl Visit for Right {
    fn wants(&mut self, bounds: &Bounds, solid: &Oriented) -> bool {
        assert!(
            solid
                .corners()
                .iter()
                .all(|c| c.cmpge(bounds.low - 1e-9).all() && c.cmple(bounds.high + 1e-9).all())
        );
        solid.most(DVec3::X) > 0.0
    }
    fn triangle(&mut self, corners: [DVec3; 3]) {
        if corners.iter().any(|corner| corner.x > 0.0) {
            self.0.push(corners);
        }
    }
}

/// Slivers in a row, placed three times (once mirrored) besides once flattened.
fn geometry() -> Geometry {
    let corner = |i: u32, k: u32| Vec3::new(i as f32 * 0.7 + k as f32 * 0.1, (k * k) as f32, (i % 5) as f32);
    let mesh = Mesh {
        positions: (0..40).flat_map(|i| (0..3).map(move |k| corner(i, k))).collect(),
        triangles: (0..40).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    };
    let placed = |scale: DVec3, x: f64| Instance {
        mesh: 0,
        world_from_mesh: DAffine3::from_translation(DVec3::new(x, 1.0, -2.0))
            * DAffine3::from_rotation_y(0.3 * x)
            * DAffine3::from_scale(scale),
    };
    let instances = vec![
        placed(DVec3::new(1.0, 0.0, 1.0), 1.0),
        placed(DVec3::ONE, 3.0),
        placed(DVec3::new(-1.0, 2.0, 1.0), -9.0),
        placed(DVec3::splat(0.5), -20.0),
    ];
    Geometry { meshes: vec![mesh], instances }
}

#[test]
fn every_wanted_triangle_is_shown_once_where_it_stands() {
    let geometry = geometry();
    let frame = DMat3::from_rotation_z(0.4) * DMat3::from_rotation_x(-1.0);
    let obstacles = Obstacles::new(&geometry, |_| true, None);
    for x in [-40.0, -10.0, 0.0, 13.0, 60.0] {
        let origin = DVec3::new(x, 0.5, 0.25);
        let mut right = Right::default();
        obstacles.walk(frame, frame.transpose() * origin, &mut right);
        let all = (0..4).flat_map(|i| (0..40).map(move |t| (i, t)));
        let mut expected: Vec<[DVec3; 3]> = all
            .map(|(i, t)| geometry.triangle(i, t).0.map(|corner| frame * corner - origin))
            .filter(|corners| corners.iter().any(|corner| corner.x > 0.0))
            .collect();
        let key = |c: &[DVec3; 3]| c.map(|p| (p.element_sum() * 1e6).round() as i64);
        right.0.sort_by_key(key);
        expected.sort_by_key(key);
        assert_eq!(right.0.len(), expected.len(), "{x}");
        for (a, b) in right.0.iter().zip(&expected) {
            // Roundings of coordinates below 100 in a product of three transformations.
            assert!((0..3).all(|k| (a[k] - b[k]).length() < 1e-12), "{a:?} {b:?}");
        }
    }
}

#[test]
fn clipping_keeps_what_is_above() {
    let corners = [DVec3::new(0.0, -1.0, 0.0), DVec3::new(4.0, 3.0, 0.0), DVec3::new(0.0, 3.0, 0.0)];
    let area = |floor: f64| {
        let (polygon, count) = above(corners, DVec3::Y, floor);
        let fan =
            (2..count).map(|k| 0.5 * (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]).length());
        fan.sum::<f64>()
    };
    // Height 4 in all; what is cut off below is similar to the whole.
    for floor in [-2.0, -1.0, 0.0, 1.0, 2.5, 3.0, 4.0f64] {
        let below = ((floor + 1.0) / 4.0).clamp(0.0, 1.0);
        assert!((area(floor) - 8.0 * (1.0 - below * below)).abs() < 1e-12, "{floor}");
    }
}
