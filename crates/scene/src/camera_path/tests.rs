//! Laws of paths: through the keys at their times, without jumps, never without a number.

use glam::DMat3;
use proptest::prelude::*;

use super::*;

fn camera(keys: Vec<Key>, smooth: bool) -> Camera {
    Camera {
        name: "a".into(),
        position: keys[0].position,
        world_from_camera: DMat3::IDENTITY,
        projection: Projection::Perspective { tan_half_height: keys[0].half },
        aspect: None,
        near: 0.01,
        path: Some(CameraPath::new(keys, DVec3::Y, smooth)),
    }
}

fn key(time: f64, position: [f64; 3]) -> Key {
    Key { time, position: position.into(), target: DVec3::new(0.0, 0.0, -100.0), half: 0.5 }
}

fn keys() -> impl Strategy<Value = Vec<Key>> {
    let one = (
        0.01..5.0f64,
        [-50.0..50.0f64, 0.0..9.0, -50.0..50.0],
        [-9.0..9.0f64, -5.0..-1.0, -9.0..9.0],
        0.1..2.0f64,
    );
    prop::collection::vec(one, 1..7).prop_map(|list| {
        let mut now = -3.0;
        let key = |(step, position, target, half): (f64, [f64; 3], [f64; 3], f64)| {
            now += step;
            Key { time: now, position: position.into(), target: target.into(), half }
        };
        list.into_iter().map(key).collect()
    })
}

fn half(camera: &Camera) -> f64 {
    match camera.projection {
        Projection::Perspective { tan_half_height } => tan_half_height,
        Projection::Orthographic { half_height } => half_height,
    }
}

proptest! {
    #[test]
    fn it_goes_through_its_keys_at_their_times(keys in keys(), smooth: bool) {
        let camera = camera(keys.clone(), smooth);
        for key in keys {
            let there = camera.at(key.time);
            // A share of exactly 0 or 1 leaves one term, a key within; sums of two coordinates below 64.
            prop_assert!((there.position - key.position).length() <= 1e-13);
            let axis = (key.target - key.position).normalize();
            prop_assert!((there.world_from_camera * DVec3::NEG_Z - axis).length() < 1e-12);
            prop_assert!((half(&there) - key.half).abs() <= 1e-15);
        }
    }

    /// No stretch is faster than its polynomial can be: |p'| ≤ 1.5 |Δ| + |m₁| + |m₂| ≤ 7.5 |Δ|, for |m| ≤ 3 |Δ|.
    #[test]
    fn it_never_jumps(keys in keys(), smooth: bool, at in -4.0..30.0f64) {
        let camera = camera(keys.clone(), smooth);
        let fastest = keys.windows(2).map(|k| (k[1].position - k[0].position).length() / (k[1].time - k[0].time)).fold(0.0, f64::max);
        let step = 1e-4;
        let moved = (camera.at(at + step).position - camera.at(at).position).length();
        prop_assert!(moved <= 7.5 * fastest * step + 1e-12, "{moved} in {step} s at {fastest} m/s");
    }

    /// The field of view stays between those of its keys, so it is never nothing.
    #[test]
    fn zooms_do_not_overshoot(keys in keys(), at in -4.0..30.0f64) {
        let (low, high) = keys.iter().fold((f64::MAX, 0.0f64), |(a, b), key| (a.min(key.half), b.max(key.half)));
        let now = half(&camera(keys, true).at(at));
        // A cubic of four terms, each rounded.
        prop_assert!(low - 1e-14 <= now && now <= high + 1e-14);
    }
}

#[test]
fn on_a_straight_line_at_an_even_speed_the_curve_is_that_line() {
    let camera = camera((0..5).map(|i| key(f64::from(i), [2.0 * f64::from(i), 1.0, 0.0])).collect(), true);
    // The ends start and stop softly; between the second and the last but one key the speed is 2 m/s.
    for i in 0..=20 {
        let t = 1.0 + 0.1 * f64::from(i);
        assert!((camera.at(t).position - DVec3::new(2.0 * t, 1.0, 0.0)).length() < 1e-14, "{t}");
    }
}

#[test]
fn who_waits_stands_still() {
    let camera = camera(
        vec![key(0.0, [0.0; 3]), key(1.0, [5.0, 0.0, 0.0]), key(3.0, [5.0, 0.0, 0.0]), key(4.0, [0.0; 3])],
        true,
    );
    for t in [1.0, 1.3, 2.0, 2.9, 3.0] {
        assert_eq!(camera.at(t).position, DVec3::new(5.0, 0.0, 0.0), "{t}");
    }
}

#[test]
fn velocity_has_no_jump_at_a_key() {
    let camera = camera(
        vec![
            key(0.0, [0.0; 3]),
            key(1.0, [3.0, 0.0, 1.0]),
            key(1.5, [4.0, 2.0, 0.0]),
            key(4.0, [9.0, 0.0, 0.0]),
        ],
        true,
    );
    let h = 1e-6;
    for t in [1.0, 1.5] {
        let at = |t: f64| camera.at(t).position;
        let (before, after) = ((at(t) - at(t - h)) / h, (at(t + h) - at(t)) / h);
        // One-sided differences are off by h |p″| / 2; |p″| ≤ 6 |Δ| + 4 |m₁| + … over T² is below 200 here.
        assert!((before - after).length() < 200.0 * h, "{before} {after}");
    }
}

#[test]
fn odd_paths_have_no_odd_numbers() {
    let same = vec![key(1.0, [1.0; 3]), key(1.0, [1.0; 3]), key(1.0, [1.0; 3])];
    let through = vec![key(0.0, [0.0; 3]), Key { position: [0.0, 0.0, -200.0].into(), ..key(2.0, [0.0; 3]) }];
    for keys in [same, through, vec![key(0.0, [0.0; 3])]] {
        for smooth in [true, false] {
            let camera = camera(keys.clone(), smooth);
            for t in [f64::NAN, f64::NEG_INFINITY, f64::INFINITY, -1.0, 0.0, 0.5, 1.0, 1e300] {
                let there = camera.at(t);
                assert!(
                    there.position.is_finite() && there.world_from_camera.is_finite() && half(&there) > 0.0,
                    "{t}"
                );
            }
        }
    }
    let still = Camera { path: None, ..camera(vec![key(0.0, [1.0; 3])], true) };
    assert_eq!(still.at(7.0), still);
}
