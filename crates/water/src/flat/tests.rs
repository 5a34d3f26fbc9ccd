use glam::{DAffine3, DVec2, DVec3, Vec3};
use light::{Mesh, Spectrum};

use super::*;
use crate::Water;

fn square(half: f32, level: f64) -> FlatWater {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let positions = corners.map(|(x, z)| Vec3::new(x * half, 0.0, z * half)).to_vec();
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    let water = Water::new(Spectrum::ZERO, Vec::new(), 1.33).unwrap();
    FlatWater::new(water, &mesh, &DAffine3::from_translation(DVec3::new(0.0, level, 0.0)))
}

#[test]
fn depth_is_below_the_outline_only() {
    let pool = square(2.0, 1.5);
    assert_eq!(pool.depth(DVec3::new(1.0, 0.5, -1.9)), Some(1.0));
    assert_eq!(pool.depth(DVec3::new(1.0, 2.0, 0.0)), Some(-0.5));
    assert_eq!(pool.depth(DVec3::new(2.5, 0.5, 0.0)), None);
    assert!(pool.covers(DVec2::new(2.0, 2.0)));
}
