//! Nothing leaks, nothing is met twice: closed meshes, far away, tiny, huge, thin, degenerate.

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3, Vec3};
use keikan_raytrace::{BruteForce, Quality, World};
use light::{Geometry, Instance, Mesh, Nearest, Occlude, Ray};

/// A reproducible number in [0, 1) (splitmix64).
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

fn direction(state: &mut u64) -> Vec3 {
    loop {
        let at = DVec3::new(random(state), random(state), random(state)) * 2.0 - 1.0;
        if (1e-3..1.0).contains(&at.length()) {
            return at.normalize().as_vec3();
        }
    }
}

/// A sphere of `rings` × 2 `rings` quads about the origin, closed, with corners shared.
fn ball(radius: f32, rings: u32) -> Mesh {
    let around = 2 * rings;
    let mut positions = vec![Vec3::Y * radius, Vec3::NEG_Y * radius];
    for ring in 1..rings {
        for i in 0..around {
            let (polar, azimuth) = (
                f64::from(ring) / f64::from(rings) * std::f64::consts::PI,
                f64::from(i) / f64::from(rings) * std::f64::consts::PI,
            );
            let at = DVec3::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin());
            positions.push((at * f64::from(radius)).as_vec3());
        }
    }
    let at = |ring: u32, i: u32| 2 + (ring - 1) * around + i % around;
    let mut triangles = Vec::new();
    for i in 0..around {
        triangles.push([0, at(1, i + 1), at(1, i)]);
        triangles.push([1, at(rings - 1, i), at(rings - 1, i + 1)]);
        for ring in 1..rings - 1 {
            triangles.push([at(ring, i), at(ring, i + 1), at(ring + 1, i)]);
            triangles.push([at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)]);
        }
    }
    Mesh { positions, triangles, ..Mesh::default() }
}

fn geometry(mesh: Mesh, places: &[DAffine3]) -> Arc<Geometry> {
    let instances = places.iter().map(|&world_from_mesh| Instance { mesh: 0, world_from_mesh }).collect();
    Arc::new(Geometry { meshes: vec![mesh], instances })
}

/// From the middle of each placed ball: every ray must hit, wherever it aims.
fn closed(mesh: &Mesh, places: &[DAffine3], each: usize) {
    let world = World::build(geometry(mesh.clone(), places), Quality::Fast);
    let mut state = 3;
    for place in places {
        let middle = place.translation.as_vec3();
        let check = |toward: Vec3| {
            let ray = Ray::new(middle, toward);
            let hit = world.nearest(&ray);
            assert!(hit.is_some(), "leak along {toward:?} from {middle:?}");
            assert!(world.transmittance(&ray).is_zero());
        };
        for _ in 0..each {
            check(direction(&mut state));
        }
        for triangle in &mesh.triangles {
            let [a, b, _] = triangle.map(|i| place.transform_point3(mesh.positions[i as usize].as_dvec3()));
            check((a - place.translation).normalize().as_vec3());
            check(((a + b) * 0.5 - place.translation).normalize().as_vec3());
        }
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            check(axis);
            check(-axis);
        }
    }
}

#[test]
fn a_closed_mesh_is_closed_at_corners_edges_and_along_axes() {
    closed(&ball(1.0, 60), &[DAffine3::IDENTITY], 100_000);
}

#[test]
fn placed_far_away_tiny_or_huge_it_stays_closed() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let place = |size: f64, at: [f64; 3]| {
        DAffine3::from_scale_rotation_translation(DVec3::splat(size), turn, DVec3::from(at))
    };
    let places = [
        place(1.0, [0.0, 0.0, 0.0]),
        place(3.0, [1e5, -2e4, 7e4]),
        place(1e-2, [10.0, 0.0, 0.0]),
        place(1e4, [-1e6, 0.0, 3e5]),
        place(-2.0, [100.0, 0.5, 0.25]),
    ];
    let mesh = ball(1.0, 24);
    closed(&mesh, &places, 2000); // shared: 5 · 2208 triangles
    for place in places {
        closed(&mesh, &[place], 2000); // standing in world coordinates
    }
}

/// Rays that leave a surface, in all directions on one side, must not meet it or its neighbours again.
#[test]
fn no_acne() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let mut state = 5;
    // A floor of two triangles and one of many, tilted and far away: all coplanar, so nothing is met again.
    for (cells, size, far) in
        [(1u32, 1.0, 0.0), (1, 1e4, 0.0), (20, 1.0, 1e5), (20, 50.0, 1e3), (60, 300.0, 0.0)]
    {
        let row = cells + 1;
        let at = |i: u32| {
            Vec3::new((i % row) as f32 - cells as f32 / 2.0, 0.0, (i / row) as f32 - cells as f32 / 2.0)
        };
        let cell = |i: u32| {
            let a = i / cells * row + i % cells;
            [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]
        };
        let mesh = Mesh {
            positions: (0..row * row).map(at).collect(),
            triangles: (0..cells * cells).flat_map(cell).collect(),
            ..Mesh::default()
        };
        let place = |shift: f64| {
            DAffine3::from_scale_rotation_translation(
                DVec3::splat(size),
                turn,
                turn * DVec3::new(far, far * shift, -far),
            )
        };
        // Many copies make it an instance; they are shifted along the normal, a kilometre and more apart.
        for count in [1, 100] {
            let places: Vec<_> = (0..count).map(|i| place(1.0 + f64::from(i) * 10.0)).collect();
            let world = World::build(
                geometry(mesh.clone(), &places[..if far > 0.0 { count as usize } else { 1 }]),
                Quality::Fast,
            );
            let normal = (turn * DVec3::Y).as_vec3();
            let mut left = 0;
            for _ in 0..5000 {
                let local =
                    DVec3::new(random(&mut state) - 0.5, 0.0, random(&mut state) - 0.5) * f64::from(cells);
                let target = places[0].transform_point3(local).as_vec3();
                // From close by, so that the viewing ray itself is exact.
                let eye = Ray::new(target + normal * (size as f32), -normal);
                let Some(hit) = world.nearest(&eye) else { continue };
                left += 1;
                let out = direction(&mut state);
                let ray = hit.place.leave(out, 0.5 * size as f32);
                let again = world.nearest(&ray);
                assert!(again.is_none(), "{cells} cells of {size} m at {far} m: {hit:?} again {again:?}");
                assert_eq!(world.transmittance(&ray).max(), 1.0);
            }
            // Only targets within rounding of the floor's rim may miss it.
            assert!(left > 4900, "{left} of 5000 met the floor");
        }
    }
}

/// A wall of 1 mm, a kilometre from the origin: what leaves one side never starts beyond the other.
#[test]
fn thin_walls_hold() {
    let quad = |x: f32| {
        [Vec3::new(x, -5.0, -5.0), Vec3::new(x, 5.0, -5.0), Vec3::new(x, 5.0, 5.0), Vec3::new(x, -5.0, 5.0)]
    };
    // f32 has steps of 6e-5 m there: 1 mm is sixteen of them.
    let positions = [quad(1000.0), quad(1000.001)].concat();
    let mesh =
        Mesh { positions, triangles: vec![[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]], ..Mesh::default() };
    let world = World::build(geometry(mesh, &[DAffine3::IDENTITY]), Quality::Fast);
    let mut state = 11;
    for _ in 0..20_000 {
        let (y, z) = (random(&mut state) * 9.0 - 4.5, random(&mut state) * 9.0 - 4.5);
        for (from, toward) in [(999.0, Vec3::X), (1001.0, Vec3::NEG_X)] {
            let hit = world.nearest(&Ray::new(Vec3::new(from, y as f32, z as f32), toward));
            let Some(hit) = hit else { panic!("the wall is there") };
            let out = direction(&mut state);
            let ray = hit.place.leave(out, f32::INFINITY);
            // Through the wall: the other face stands in the way, if the ray does not pass its rim first.
            let across = 0.01 / out.x.abs();
            let within =
                (ray.origin.y + out.y * across).abs() < 5.0 && (ray.origin.z + out.z * across).abs() < 5.0;
            let inward = out.dot(toward) > 0.0;
            if inward && within {
                assert!(world.transmittance(&ray).is_zero(), "{ray:?} passes the wall");
            } else if !inward {
                assert!(!world.transmittance(&ray).is_zero(), "{ray:?} meets the face it left");
            }
        }
    }
}

/// The position of a hit is off the true surface and the true ray by no more than it says.
#[test]
fn errors_are_bounded_in_instances_too() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let places: Vec<_> = (0..200)
        .map(|i| {
            DAffine3::from_scale_rotation_translation(
                DVec3::new(1.0, 0.5, 2.0) * (1.0 + f64::from(i)),
                turn * DQuat::from_rotation_y(f64::from(i)),
                DVec3::new(f64::from(i * i) * 20.0, f64::from(i) * 3.0, f64::from(i % 7) * -1e3),
            )
        })
        .collect();
    let geometry = geometry(ball(1.0, 12), &places);
    let world = World::build(geometry.clone(), Quality::Medium);
    assert_eq!(world.stats().placements, 200);
    let slow = BruteForce::new(geometry.clone());
    let mut state = 13;
    for place in places.iter().step_by(20) {
        for _ in 0..20 {
            let from = place.translation.as_vec3() + direction(&mut state) * 500.0;
            let toward = (place.translation.as_vec3() - from).normalize();
            let ray = Ray::new(from, toward);
            let (Some(hit), Some(exact)) = (world.nearest(&ray), slow.nearest(&ray)) else {
                panic!("aimed at it")
            };
            assert_eq!((hit.instance, hit.triangle), (exact.instance, exact.triangle));
            let corners = geometry.triangle(hit.instance, hit.triangle);
            let normal = corners.cross().normalize();
            let off = normal.dot(hit.place.position.as_dvec3() - corners.0[0]).abs();
            assert!(off <= f64::from(hit.place.error), "{off} m off, said {}", hit.place.error);
        }
    }
}

#[test]
fn nothing_strange_does_harm() {
    let empty = World::build(Arc::default(), Quality::Medium);
    assert!(empty.nearest(&Ray::new(Vec3::ZERO, Vec3::X)).is_none());
    let positions = vec![
        Vec3::ZERO,
        Vec3::X,
        Vec3::Y,
        Vec3::NAN,
        Vec3::splat(f32::INFINITY),
        Vec3::splat(1e30),
        Vec3::X * 2.0,
    ];
    let triangles = vec![[0, 1, 2], [0, 0, 0], [0, 1, 1], [0, 1, 6], [0, 1, 3], [0, 1, 4], [0, 1, 5]];
    let singular = DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0));
    let mesh = Mesh { positions, triangles, ..Mesh::default() };
    let world = World::build(geometry(mesh, &[DAffine3::IDENTITY, singular]), Quality::Medium);
    assert_eq!(world.stats().dropped, 13);
    let hit = world.nearest(&Ray::new(Vec3::new(0.25, 0.25, 1.0), Vec3::NEG_Z));
    assert_eq!(hit.map(|hit| (hit.instance, hit.triangle, hit.distance)), Some((0, 0, 1.0)));
    for odd in [Vec3::NAN, Vec3::INFINITY, Vec3::ZERO] {
        assert!(world.nearest(&Ray::new(Vec3::splat(0.1), odd)).is_none());
        assert!(world.nearest(&Ray::new(odd + f32::INFINITY, Vec3::X)).is_none());
    }
    // Sizes that double from one to the next make the deepest hierarchies; coincident ones the most ties.
    let corner =
        |i: u32, j: u32| Vec3::new(j as f32 - 1.0, (j % 2) as f32, 1.0) * 1.5f32.powi(i as i32 - 100);
    let positions = (0..150).flat_map(|i| (0..3).map(move |j| corner(i, j))).collect();
    let triangles = (0..5000).map(|i| [i % 150 * 3, i % 150 * 3 + 1, i % 150 * 3 + 2]).collect();
    let deep = World::build(
        geometry(Mesh { positions, triangles, ..Mesh::default() }, &[DAffine3::IDENTITY]),
        Quality::Medium,
    );
    let hit = deep.nearest(&Ray::new(Vec3::new(0.0, 0.3, 0.0), Vec3::Z));
    assert!(hit.is_some_and(|hit| hit.triangle < 150), "of coincident faces the first is met: {hit:?}");
}
