//! Laws, and places at the edge of what can be.

use std::sync::LazyLock;

use super::*;

fn random_place(geometry_width: f32) -> impl Strategy<Value = Place> {
    let along = -0.5f32..0.5;
    let normal = (-1.0f32..1.0, 0.0f32..2.0 * PI);
    (along.clone(), 0.0f32..12.0, along, normal).prop_map(move |(x, y, z, (height, turn))| {
        let across = (1.0 - height * height).sqrt();
        let normal = Vec3::new(across * turn.cos(), height, across * turn.sin()).normalize();
        place(Vec3::new(x * geometry_width, y, z * geometry_width), normal)
    })
}

/// The same sky over nothing, some houses, and more besides; whole elements and 2 × 2 parts.
static FILLING: LazyLock<[[CuboidSky; 3]; 2]> = LazyLock::new(|| {
    let description = luminous(Distribution::CIE_CLEAR, 40.0);
    let more = town(30, 40.0, 5);
    let fewer = Geometry { instances: more.instances[..12].to_vec(), ..more.clone() };
    [1, 2].map(|parts| {
        [&Geometry::default(), &fewer, &more].map(|scene| cuboid(&description, scene, 12, parts))
    })
});

/// A round sky over houses, and over the same turned by a right angle.
static TURNED: LazyLock<[CuboidSky; 2]> = LazyLock::new(|| {
    let description = luminous(Distribution::MoonSpencer, 90.0);
    let geometry = town(12, 30.0, 2);
    let quarter = glam::DAffine3::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let mut turned = geometry.clone();
    for instance in &mut turned.instances {
        instance.world_from_mesh = quarter * instance.world_from_mesh;
    }
    [geometry, turned].map(|geometry| cuboid(&description, &geometry, 16, 1))
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn more_in_the_way_never_lets_more_through(at in random_place(30.0), parts in 1usize..3) {
        let [open, some, many] = &FILLING[parts - 1];
        let unhidden = some.open_irradiance(at.normal);
        let [open, some, many] = [open, some, many].map(|sky| sky.irradiance(&at, &Vacuum));
        for band in 0..BANDS {
            // Sums in f64, rounded once.
            let over = 1.0 + f32::EPSILON;
            prop_assert!(0.0 <= many[band] && many[band] <= some[band] * over && some[band] <= open[band] * over);
        }
        prop_assert_eq!(open, unhidden);
    }

    #[test]
    fn turning_everything_by_a_right_angle_changes_nothing(at in random_place(30.0)) {
        // The cuboid of a round sky has that symmetry itself: only rounding is left, but for elements on an edge.
        let turn = |v: Vec3| Vec3::new(v.z, v.y, -v.x);
        let there = Place { position: turn(at.position), normal: turn(at.normal), ..at };
        let [here, there] = [(&TURNED[0], at), (&TURNED[1], there)].map(|(sky, at)| sky.irradiance(&at, &Vacuum));
        // The largest element a side has, on which the plane's edge or the skyline may fall: one of each.
        let largest = TURNED[0].layout().elements().map(|e| e.solid_angle).fold(0.0, f64::max) as f32;
        let radiance = TURNED[0].radiance(&Ray::new(Vec3::ZERO, Vec3::Y)).max();
        prop_assert!((here - there).map(f32::abs).max() <= 2.0 * largest * radiance);
    }

    #[test]
    fn culling_changes_no_answer(at in random_place(60.0), seed: u32) {
        let geometry = town(10, 40.0, seed % 50);
        let description = Description { ground_height: Some(1.5), ..luminous(Distribution::CIE_CLEAR, 20.0) };
        let sky = cuboid(&description, &geometry, 8, 1);
        let drawing = Drawing::new(sky.layout(), 1, &geometry, None);
        compare_bits(&sky, &drawing, &geometry, &at);
    }
}

#[test]
fn degenerate_triangles_and_nothings_hide_nothing() {
    let mut geometry = boxes([(DVec3::ZERO, DVec3::new(3.0, 0.0, 0.0), 0.0), (DVec3::ONE, DVec3::ZERO, 1.0)]);
    geometry.meshes[0].positions.push(Vec3::new(f32::NAN, 2.0, f32::INFINITY));
    geometry.meshes[0].triangles.extend([[0, 0, 1], [0, 1, 8], [8, 8, 8]]);
    geometry.instances.push(light::Instance {
        mesh: 0,
        world_from_mesh: glam::DAffine3::from_translation(DVec3::new(0.0, 1e6, 0.0)),
    });
    let sky = cuboid(&luminous(Distribution::CIE_CLEAR, 30.0), &geometry, 20, 2);
    let at = place(Vec3::new(0.2, -1.0, 0.3), Vec3::Y);
    // The last box, 1 m wide at 10⁶ m, covers the middle of an element or of none.
    let (e, open) = (sky.irradiance(&at, &Vacuum), sky.open_irradiance(Vec3::Y));
    assert!(e.is_finite() && e[0] <= open[0] && e[0] > 0.9 * open[0], "{e:?} {open:?}");
}

#[test]
fn places_on_in_and_far_away_are_finite_and_never_hidden_by_their_own_face() {
    let description = luminous(Distribution::CIE_CLEAR, 30.0);
    for far in [0.0, 1e3, 1e6f32] {
        // A box of 8 m (on numbers that f32 has), and the places on the middle, an edge and a corner of its roof.
        let middle = DVec3::new(f64::from(far), 0.0, f64::from(-far));
        let geometry = boxes([(middle, DVec3::splat(8.0), 0.0)]);
        let sky = cuboid(&description, &geometry, 20, 1);
        let open = sky.open_irradiance(Vec3::Y);
        for (x, z) in [(0.0, 0.0), (4.0, 1.0), (4.0, -4.0)] {
            let roof = place(Vec3::new(far + x, 4.0, z - far), Vec3::Y);
            assert_eq!(sky.irradiance(&roof, &Vacuum), open, "{far} {x}");
            let under = sky.irradiance(&roof.flipped(), &Vacuum);
            assert!(under.is_finite() && under.0.iter().all(|&band| band >= 0.0));
        }
        // Inside everything is hidden.
        let inside = place(Vec3::new(far + 0.5, 1.0, 0.5 - far), Vec3::Y);
        assert_eq!(sky.irradiance(&inside, &Vacuum), Spectrum::ZERO, "{far}");
    }
    let sky = cuboid(&description, &canyon(), 8, 1);
    for normal in [Vec3::ZERO, Vec3::NAN, Vec3::NEG_Y] {
        for position in [Vec3::ZERO, Vec3::NAN, Vec3::splat(1e30)] {
            let e = sky.irradiance(&place(position, normal), &Vacuum);
            assert!(e.is_finite() && e.0.iter().all(|&band| band >= 0.0), "{position} {normal}");
        }
    }
}

#[test]
fn threads_and_order_change_nothing() {
    let geometry = town(30, 40.0, 8);
    let sky = cuboid(&luminous(Distribution::CIE_CLEAR, 50.0), &geometry, 16, 1);
    let normals = [Vec3::Y, Vec3::X, Vec3::new(0.6, 0.0, 0.8), Vec3::NEG_Y];
    let places: Vec<Place> =
        (0..40).map(|i| place(Vec3::new(0.1 * i as f32, (i % 7) as f32, 0.3), normals[i % 4])).collect();
    let forward: Vec<Spectrum> = places.iter().map(|at| sky.irradiance(at, &Vacuum)).collect();
    std::thread::scope(|scope| {
        let threads = [0, 1].map(|half| {
            let (sky, places) = (&sky, &places);
            scope.spawn(move || {
                let mine = (0..40).rev().filter(|i| i % 2 == half);
                mine.map(|i| (i, sky.irradiance(&places[i], &Vacuum))).collect::<Vec<_>>()
            })
        });
        for (i, e) in threads.into_iter().flat_map(|thread| thread.join().unwrap()) {
            assert_eq!(e, forward[i]);
        }
    });
    let reseeded = Place { seed: 99, ..places[5] };
    assert_eq!(sky.irradiance(&reseeded, &Vacuum), forward[5]);
}
