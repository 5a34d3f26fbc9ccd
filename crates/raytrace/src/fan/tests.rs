//! The hierarchy and eight lanes at once change nothing: bit for bit what all faces give one after the other.

use std::sync::Arc;

use glam::{DAffine3, DQuat};
use light::{Geometry, Instance, Mesh};

use super::*;
use crate::Quality;

/// A reproducible number in [−½, ½).
fn random(state: &mut u32) -> f64 {
    *state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    f64::from(*state >> 8) / f64::from(1u32 << 24) - 0.5
}

fn point(state: &mut u32, size: f64) -> DVec3 {
    DVec3::new(random(state), random(state), random(state)) * size
}

fn soup(faces: u32, state: &mut u32) -> Mesh {
    let mut positions = Vec::new();
    for _ in 0..faces {
        let at = point(state, 10.0);
        positions.extend((0..3).map(|_| (at + point(state, 0.6)).as_vec3()));
    }
    let triangles = (0..faces).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

/// All faces, in order.
fn plainly(geometry: &Geometry, fan: &Fan) -> Vec<Stretch> {
    let mut dark = Vec::new();
    for (i, instance) in geometry.instances.iter().enumerate() {
        for t in 0..geometry.meshes[instance.mesh as usize].triangles.len() {
            dark.extend(fan.hidden(&geometry.triangle(i as u32, t as u32)));
        }
    }
    let mut out = Vec::new();
    union::union(&mut dark, true, &mut out);
    out
}

#[test]
fn nothing_is_overlooked() {
    let mut state = 1;
    for (far, copies) in [(0.0, 1), (0.0, 6), (1e5, 1), (1e6, 6)] {
        let places = (0..copies).map(|i| {
            let turn = DQuat::from_rotation_x(f64::from(i)) * DQuat::from_rotation_y(0.3);
            let stretch = DVec3::new(1.0, 0.5, if i % 2 == 0 { 2.0 } else { -2.0 });
            let at = DVec3::new(far + 8.0 * f64::from(i % 3), far, -8.0 * f64::from(i / 3));
            DAffine3::from_scale_rotation_translation(stretch, turn, at)
        });
        let instances = places.map(|world_from_mesh| Instance { mesh: 0, world_from_mesh }).collect();
        let geometry = Arc::new(Geometry { meshes: vec![soup(1500, &mut state)], instances });
        let world = World::build(geometry.clone(), Quality::Medium);
        assert_eq!(world.stats().placements > 0, copies > 1);
        let (mut some, mut whole) = (0, 0);
        for n in 0..300 {
            let middle = DVec3::new(far, far, 0.0);
            let long = if n % 2 == 0 { 10.0 } else { 0.1 };
            let a = middle + point(&mut state, 12.0);
            let b = a + point(&mut state, long);
            let source = match n % 4 {
                0 => PointSource::Toward(point(&mut state, 1.0)),
                // Straight along an axis, with zeros in every gradient.
                1 => PointSource::Toward(DVec3::AXES[n % 12 / 4]),
                2 => {
                    let toward = point(&mut state, 1.0);
                    PointSource::Below { toward: toward.with_y(toward.y.abs()), level: a.y.max(b.y) + 1.0 }
                }
                _ => PointSource::At(middle + point(&mut state, 20.0)),
            };
            let Some(fan) = Fan::new(&source, a, b) else { panic!("a fan of some size") };
            let mut found = Vec::new();
            assert!(world.cut(&source, a, b, &mut found));
            assert_eq!(found, plainly(&geometry, &fan));
            some += usize::from(!found.is_empty());
            whole += usize::from(found.iter().any(|stretch| stretch.from == 0.0 && stretch.to == 1.0));
        }
        assert!(some > 100 && whole > 10, "{some} {whole}: nothing was tested");
    }
}

#[test]
fn plain_and_avx2_sieves_are_the_same() {
    let mut state = 7;
    let mesh = soup(3000, &mut state);
    let once = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
    let geometry = Arc::new(Geometry { meshes: vec![mesh], instances: vec![once] });
    let world = World::build(geometry, Quality::Medium);
    let faces = &world.standing;
    for _ in 0..100 {
        let (a, b, lamp) = (point(&mut state, 9.0), point(&mut state, 9.0), point(&mut state, 9.0));
        let Some(fan) = Fan::new(&PointSource::At(lamp), a, b) else { panic!("a fan of some size") };
        let sieve = sieve::Sieve::new(&fan, DVec3::ZERO, faces.tree.reach);
        for node in &faces.tree.nodes {
            assert_eq!(sieve.boxes(node), sieve.boxes_plain(node));
        }
        for packet in &faces.packets {
            assert_eq!(sieve.triangles(packet), sieve.triangles_plain(packet));
        }
    }
}
