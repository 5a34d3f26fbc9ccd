use proptest::prelude::*;

use super::*;

#[test]
fn clearness_and_brightness_are_those_of_their_definitions() {
    // A sun 30° high, 600 W/m² direct, 100 diffuse: Z = 1.0472, 1.041 Z³ = 1.19546, ε = (7 + 1.19546)/2.19546;
    // m = 1.994 (Kasten and Young's table), Δ = 1.994 · 100/1367.
    let sky = Perez::new(600.0, 100.0, 30.0, None);
    assert!((sky.clearness() - 3.73291).abs() < 1e-4, "{}", sky.clearness());
    assert!((sky.brightness() - 1.994 * 100.0 / 1367.0).abs() < 1e-4, "{}", sky.brightness());
    // Nearest to the sun in early January: 3.4 % more outside.
    let january = Perez::new(600.0, 100.0, 30.0, Some(2));
    assert!((sky.brightness() / january.brightness() - 1.034).abs() < 1e-9);
    // Kept within the range it was fitted in.
    let bounds = |sky: Perez| (sky.clearness(), sky.brightness());
    assert_eq!(bounds(Perez::new(0.0, 0.0, 30.0, None)), (12.0, 0.01));
    assert_eq!(bounds(Perez::new(0.0, 1300.0, 30.0, None)), (1.0, 0.6));
    assert_eq!(bounds(Perez::new(f64::NAN, -3.0, 30.0, None)), (12.0, 0.01));
}

#[test]
fn parameters_are_those_of_the_printed_table() {
    // Category 6 by hand: Z = π/3, Δ = 0.145865.
    let sky = Perez::new(600.0, 100.0, 30.0, None);
    assert_eq!(sky.category(), 5);
    let (z, delta) = (std::f64::consts::FRAC_PI_3, sky.brightness());
    let g = sky.gradation();
    for (value, [x1, x2, x3, x4]) in [
        (g.a, [-1.0156, -0.3670, 1.0078, 1.4051]),
        (g.b, [0.2875, -0.5328, -3.8500, 3.3750]),
        (g.c, [14.0, -0.9999, -7.1406, 7.5469]),
        (g.d, [-3.4, -0.1078, -1.0750, 1.5702]),
        (g.e, [-0.0672, 0.4016, 0.3017, -0.4844]),
    ] {
        assert!((value - (x1 + x2 * z + delta * (x3 + x4 * z))).abs() < 1e-12, "{value}");
    }
    // The first category has its own c and d: Δ = 0.6, Z = π/3.
    let g = Perez::new(0.0, 1300.0, 30.0, None).gradation();
    let base: f64 = 0.6 * (2.8 + 0.6004 * z);
    assert!((g.c - (base.powf(1.2375).exp() - 1.0)).abs() < 1e-12);
    assert!((g.d - (0.9738 + 0.6 * 0.2809 - (0.6 * (1.8734 + 0.6297 * z)).exp())).abs() < 1e-12);
}

#[test]
fn efficacies_are_of_the_size_that_daylight_has() {
    // Littlefair 1985 and others: skies 105 to 145 lm/W, clear suns some 90 to 110.
    for (direct, diffuse, altitude) in [(0.0, 150.0, 40.0), (400.0, 200.0, 40.0), (850.0, 90.0, 50.0)] {
        let [sky, sun] = Perez::new(direct, diffuse, altitude, None).illuminances(2.0);
        assert!((105.0..145.0).contains(&(sky / diffuse)), "{}", sky / diffuse);
        assert!(direct == 0.0 || (85.0..115.0).contains(&(sun / direct)), "{}", sun / direct);
    }
}

#[test]
fn cloudier_skies_have_less_of_the_clear_sky_s_colour() {
    let share = |direct| Perez::new(direct, 100.0, 40.0, None).clear_share();
    assert_eq!(share(0.0), 0.0);
    assert_eq!(share(1000.0), 1.0);
    assert!(share(200.0) > 0.0 && share(200.0) < share(400.0));
}

proptest! {
    #[test]
    fn everything_is_finite(direct in -10.0f64..1400.0, diffuse in -10.0f64..1400.0, altitude in -90.0f64..90.0) {
        let sky = Perez::new(direct, diffuse, altitude, None);
        let g = sky.gradation();
        prop_assert!([g.a, g.b, g.c, g.d, g.e].iter().all(|x| x.is_finite()) && g.b < 0.0);
        prop_assert!(sky.illuminances(2.0).iter().all(|e| e.is_finite() && *e >= 0.0));
    }

    // Within a category; between them the model has steps.
    #[test]
    fn parameters_are_continuous_in_the_irradiances(direct in 0.0f64..1000.0, diffuse in 10.0f64..500.0, altitude in 0.0f64..89.0) {
        let (sky, near) = (Perez::new(direct, diffuse, altitude, None), Perez::new(direct, diffuse * (1.0 + 1e-9), altitude, None));
        prop_assume!(sky.category() == near.category());
        let (a, b) = (sky.gradation(), near.gradation());
        // Largest coefficient on Δ is 62 · 0.6 · 1e-9; c of the first category is e^(0.6·3.8)^1.24 ≤ 16 times its own.
        prop_assert!([(a.a, b.a), (a.b, b.b), (a.c, b.c), (a.d, b.d), (a.e, b.e)].iter().all(|(x, y)| (x - y).abs() < 1e-6));
    }
}
