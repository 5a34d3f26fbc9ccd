//! What holds for any light and any order.

use light::sampling::lattice;

use super::*;

/// Bytes of a map that as many threads have made.
fn made_by(threads: usize, backwards: bool) -> Vec<u8> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let map = mapped(Fake::new(wild), &still(hills(6)), Settings { inset: 0.01, ..EXACT });
    if backwards {
        let corners = |face: [u32; 2]| map.geometry.triangle(face[0], face[1]).0;
        for triangle in (0..72).rev() {
            let middle = corners([0, triangle]).iter().sum::<DVec3>() / 3.0;
            ask(&map, [0, triangle], middle.as_vec3(), Vec3::NEG_Y);
            ask(&map, [0, triangle], middle.as_vec3(), Vec3::Y);
        }
    } else {
        pool.install(|| map.prepare(&Vacuum, &[Side::Front, Side::Back]));
    }
    map.to_bytes()
}

#[test]
fn bits_are_the_same_for_any_number_of_threads_and_any_order() {
    let one = made_by(1, false);
    assert!(one == made_by(2, false));
    assert!(one == made_by(1, true));
}

#[test]
fn points_that_faces_share_are_found_once() {
    let fake = Fake::new(|_: Vec3, _: Vec3| 0.5);
    // Cells no finer than the faces: their corners alone.
    let map = mapped(fake.clone(), &still(hills(6)), Settings { least: 2.0, ..EXACT });
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| map.prepare(&Vacuum, &[Side::Front]));
    // Two corners of the hills belong to one triangle only; all 49 points are asked for once.
    assert_eq!(fake.asked.load(Ordering::Relaxed), 49);
    assert_eq!(map.size()[..2], [72, 3 * 72]);
}

#[test]
fn light_goes_on_smoothly_from_face_to_face() {
    let settings = Settings { inset: 0.01, ..EXACT };
    for mesh in [hills(4), lawn(7.0)] {
        let count = mesh.triangles.len() as u32;
        let seams = Seams::new(&mesh);
        let map = mapped(Fake::new(wild), &still(mesh), settings);
        map.prepare(&Vacuum, &[Side::Front]);
        let value = |triangle: u32, edge: usize, t: f64| {
            let mut weights = [0.0; 3];
            (weights[edge], weights[(edge + 1) % 3]) = (1.0 - t, t);
            map.faces[triangle as usize][0].get().unwrap().value(weights)
        };
        let mut met = 0;
        for (triangle, edge) in (0..count).flat_map(|t| [0, 1, 2].map(|k| (t, k))) {
            let owner = seams.edges[triangle as usize][edge];
            if owner.triangle == triangle {
                continue;
            }
            met += 1;
            for k in 0..1024 {
                let t = f64::from(k) / 1024.0;
                let other = value(owner.triangle, usize::from(owner.part), 1.0 - t);
                // Two products and a sum of numbers below 1, in another order.
                let step = (value(triangle, edge, t) - other).map(f32::abs).max();
                assert!(step <= 2.0 * f32::EPSILON, "{triangle} {edge} {t}: {step}");
            }
        }
        // Every inner edge once.
        assert_eq!(met, if count == 2 { 1 } else { 4 * 4 + 2 * 3 * 4 });
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn never_less_than_nothing_nor_more_than_the_open_sky(
        low in -1.0f32..0.5, high in 0.5f32..2.0, turn in 0.0f32..6.3, tilt in 0.0f32..1.0, back: bool,
    ) {
        // An inner stage that does not keep to its own bounds.
        let rude = move |p: Vec3, _: Vec3| if (p.x * 2.0).sin() > p.z { low } else { high };
        let map = mapped(Fake::new(rude), &still(lawn(6.0)), EXACT);
        let side = if back { -1.0 } else { 1.0 };
        let normal = Vec3::new(tilt.sin() * turn.cos(), side * tilt.cos(), tilt.sin() * turn.sin()).normalize();
        for i in 0..200 {
            let [x, z] = lattice(i, 200, [0, 0]).map(|x| 6.0 * x - 3.0);
            let e = ask(&map, [0, u32::from(x > z)], Vec3::new(x, 0.0, z), normal);
            prop_assert!(e.0.iter().zip(open(normal).0).all(|(e, open)| (0.0..=open).contains(e)));
        }
    }

    /// However far off the face a place is, it is answered from the face's edge.
    #[test]
    fn places_beside_the_face_get_what_its_edge_has(x in -1e3f32..1e3, y in -1.0f32..1.0, z in -1e3f32..1e3) {
        let map = mapped(Fake::new(wild), &still(lawn(4.0)), EXACT);
        let e = share(&map, [0, 0], Vec3::new(x, y, z), Vec3::Y);
        prop_assert!((0.0..=1.0).contains(&e));
    }
}
