mod table;

use glam::DVec3;
use light::{fresnel, refract};
use proptest::prelude::*;

use super::*;

const WATER: Surface = Surface { level: 0.0, index: 1.34 };

/// 0, and 10⁻⁶ to 10⁶ evenly in the logarithm.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 9 => (-6.0f64..6.0).prop_map(|power| 10f64.powf(power))]
}

/// What Snell and geometry ask of a path, with all inputs scaled to their largest: the worst relative violation.
fn violation(n: f64, h: f64, d: f64, r: f64, path: &Crossing) -> f64 {
    let relative = |a: f64, b: f64| if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()) };
    let mut worst = relative(path.run_air + path.run_water, r);
    worst = worst
        .max(relative(path.air, path.run_air.hypot(h)))
        .max(relative(path.water, path.run_water.hypot(d)));
    if path.air > 0.0 {
        worst = worst.max(relative(path.sin_air * path.air, path.run_air));
        worst = worst.max(relative(path.cos_air * path.air, h));
    }
    if path.water > 0.0 {
        worst = worst.max(relative(path.sin_air * path.water, n * path.run_water));
        worst = worst.max(relative(path.cos_water * path.water, d));
    }
    worst
}

#[test]
fn crossings_are_where_fermat_has_them() {
    for [n, h, d, r, x] in table::POINTS {
        let path = crossing(n, h, d, r);
        // Half a unit of the tenth decimal.
        assert!((path.run_air - x).abs() < 5.1e-11, "{n} {h} {d} {r}: {}", path.run_air);
        // Thesis 3.16 is zero there, up to rounding of terms of the size of n² r² h².
        let m = n * n - 1.0;
        let [x, terms] = [path.run_air, n * n * r * r * (h * h + r * r) + d * d * r * r];
        let quartic = m * x.powi(4) - 2.0 * m * r * x.powi(3) + (n * n * h * h - d * d + m * r * r) * x * x
            - 2.0 * r * h * h * n * n * x
            + n * n * r * r * h * h;
        assert!(quartic.abs() < 16.0 * f64::EPSILON * terms, "{quartic}");
    }
}

#[test]
fn limits_are_exact() {
    let straight = crossing(1.34, 2.0, 3.0, 0.0);
    assert_eq!((straight.air, straight.water, straight.cos_air, straight.cos_water), (2.0, 3.0, 1.0, 1.0));
    // From the surface itself, within Snell's cone and beyond it.
    let within = crossing(1.34, 0.0, 1.0, 0.5);
    assert!(within.run_air == 0.0 && (within.run_water - 0.5).abs() < 4e-16);
    let beyond = crossing(1.34, 0.0, 1.0, 5.0);
    assert_eq!((beyond.cos_air, beyond.run_air + beyond.run_water), (0.0, 5.0));
    assert!((beyond.run_water - 1.0 / (1.34f64 * 1.34 - 1.0).sqrt()).abs() < 4e-16);
    // To the surface itself; along it; nowhere.
    assert_eq!(crossing(1.34, 1.0, 0.0, 5.0).run_air, 5.0);
    assert_eq!(crossing(1.34, 0.0, 0.0, 5.0).run_air, 5.0);
    assert_eq!(crossing(1.34, 0.0, 0.0, 0.0).air, 0.0);
    // No water at all: the straight line.
    let none = crossing(1.0, 1.0, 2.0, 6.0);
    assert!((none.run_air - 2.0).abs() < 1e-15 && (none.cos_air - none.cos_water).abs() < 1e-15);
}

#[test]
fn steps_are_few() {
    let (mut most, mut sum, mut count) = (0, 0u64, 0u64);
    let lengths: Vec<f64> = (-24..=24).map(|i| 10f64.powf(f64::from(i) / 4.0)).collect();
    for &h in &lengths {
        for &d in &lengths {
            for &r in &lengths {
                let path = crossing(1.34, h, d, r);
                assert!(violation(1.34, h, d, r, &path) < 16.0 * f64::EPSILON, "{h} {d} {r}");
                (most, sum, count) = (most.max(path.steps), sum + u64::from(path.steps), count + 1);
            }
        }
    }
    println!("Newton steps: {most} at most, {:.2} on average of {count}", sum as f64 / count as f64);
    assert!(most <= 8);
}

#[test]
fn bundles_widen_as_tabulated() {
    let mut worst = [0.0f64; 2];
    for (down, rows) in [(true, &table::DOWN[..]), (false, &table::UP[..])] {
        let n = if down { 1.34 } else { 1.0 / 1.34 };
        let side = if down { 1.0 } else { -1.0 };
        for &[k, degrees, exact, thesis] in rows {
            let sin = degrees.to_radians().sin();
            let behind = k * (sin / n) / (1.0 - (sin / n) * (sin / n)).sqrt();
            let receiver = DVec3::new(degrees.to_radians().tan() + behind, -side * k, 0.0);
            for (i, (paths, expected)) in
                [(Paths::Exact, exact), (Paths::Thesis, thesis)].into_iter().enumerate()
            {
                let leg = WATER.refracted(DVec3::Y * side, receiver, paths).unwrap();
                let error = (leg.share * leg.spread / expected - 1.0).abs();
                worst[i] = worst[i].max(error);
                // Seven digits.
                assert!(
                    error < 1e-6,
                    "{down} {k} {degrees} {paths:?}: {} {expected}",
                    leg.share * leg.spread
                );
            }
        }
    }
    println!("bundles: worst relative deviation {:.1e} exact, {:.1e} thesis", worst[0], worst[1]);
}

/// Irradiance facing the ray by following four neighbours of it through the surface, with none of the code above.
fn by_neighbours(source: DVec3, leg: &Leg, receiver: DVec3) -> f64 {
    let [across, upright] = {
        let a = leg.leaving.any_orthonormal_pair();
        [a.0, a.1]
    };
    let (u, v) = leg.toward.any_orthonormal_pair();
    let hit = |direction: DVec3| {
        let normal = if direction.y < 0.0 { DVec3::Y } else { DVec3::NEG_Y };
        let eta = if direction.y < 0.0 { 1.34 } else { 1.0 / 1.34 };
        let at = source + direction * (-source.y / direction.y);
        let on = refract(direction, normal, eta).expect("within the cone");
        let end = at + on * ((receiver - at).dot(leg.toward) / on.dot(leg.toward));
        [(end - receiver).dot(u), (end - receiver).dot(v)]
    };
    let step = 1e-6;
    let slope = |way: DVec3| {
        let [a, b] =
            [hit((leg.leaving + way * step).normalize()), hit((leg.leaving - way * step).normalize())];
        [(a[0] - b[0]) / (2.0 * step), (a[1] - b[1]) / (2.0 * step)]
    };
    let (s, t) = (slope(across), slope(upright));
    leg.share / (s[0] * t[1] - s[1] * t[0]).abs()
}

#[test]
fn the_share_is_fresnels() {
    for [degrees, from_air_333, from_water_333, from_air, from_water] in table::FRESNEL {
        let (sin, cos) = degrees.to_radians().sin_cos();
        for (n, alpha) in
            [(1.333, from_air_333), (1.0 / 1.333, from_water_333), (1.34, from_air), (1.0 / 1.34, from_water)]
        {
            let other = (1.0 - (sin / n) * (sin / n)).max(0.0).sqrt();
            let passes = transmitted(n, cos, other);
            assert!((1.0 - passes - alpha).abs() < 6e-7, "{n} {degrees}: {passes}");
            assert!((1.0 - passes - fresnel(n, cos)).abs() < 1e-14);
        }
    }
}

#[test]
fn mirrors_at_the_surface() {
    let source = DVec3::new(0.0, 1.0, 0.0);
    let receiver = DVec3::new(4.0, 2.0, 0.0);
    let [direct, mirrored] = WATER.legs(source, receiver, Paths::Exact).map(|leg| leg.unwrap());
    assert_eq!((direct.spread, mirrored.spread), (1.0 / 17.0, 1.0 / 25.0));
    assert!(mirrored.leaving.distance(DVec3::new(0.8, -0.6, 0.0)) < 1e-15);
    assert!(mirrored.toward.distance(DVec3::new(-0.8, -0.6, 0.0)) < 1e-15);
    assert!(mirrored.at_surface.unwrap().distance(DVec3::new(4.0 / 3.0, 0.0, 0.0)) < 1e-15);
    assert_eq!(mirrored.share, fresnel(1.34, 0.6));
    // Under water at 60° all is mirrored.
    let below = WATER.mirrored(DVec3::new(0.0, -1.0, 0.0), DVec3::new(12f64.sqrt(), -1.0, 0.0)).unwrap();
    assert_eq!((below.share, below.air), (1.0, 0.0));
    assert!((below.water - 4.0).abs() < 1e-15);
    assert!(WATER.legs(source, source, Paths::Exact)[0].is_none());
}

#[test]
fn far_from_the_origin_it_is_the_same() {
    let shift = DVec3::new(1e6, -3e5, 2e6);
    let far = Surface { level: shift.y, ..WATER };
    for (source, receiver) in [
        ([0.0, 2.0, 0.0], [3.0, -1.0, 1.0]),
        ([0.0, -2.0, 0.0], [1.0, 1.0, 0.5]),
        ([0.0, -2.0, 0.0], [3.0, -1.0, 1.0]),
    ] {
        let (source, receiver) = (DVec3::from(source), DVec3::from(receiver));
        let [here, there] = [
            WATER.legs(source, receiver, Paths::Exact),
            far.legs(source + shift, receiver + shift, Paths::Exact),
        ];
        for (a, b) in here.iter().flatten().zip(there.iter().flatten()) {
            // Coordinates of 2e6 m end with 2.3e-10 m.
            assert!(
                (a.share * a.spread / (b.share * b.spread) - 1.0).abs() < 1e-8
                    && a.toward.distance(b.toward) < 1e-9
            );
            assert!(a.at_surface.zip(b.at_surface).is_none_or(|(a, b)| (b - shift).distance(a) < 1e-9));
        }
    }
}

#[test]
fn far_away_it_is_the_sun() {
    let height = 1e6;
    let leg =
        WATER.refracted(DVec3::new(-height, height, 0.0), DVec3::new(0.0, -2.0, 0.0), Paths::Exact).unwrap();
    let sun = leg.share * leg.path_ratio() / (2.0 * height * height);
    // Two metres of water next to 10⁶ m of air change the distance by 2e-6, its square by twice as much.
    assert!((leg.share * leg.spread / sun - 1.0).abs() < 1e-5);
}

impl Leg {
    /// cos θ₁/cos θ₂ of a refracted leg.
    fn path_ratio(&self) -> f64 {
        (self.leaving.y / self.toward.y).abs()
    }
}

proptest! {
    #[test]
    fn paths_are_right_to_rounding(n in 1.0f64..1.6, h in length(), d in length(), r in length()) {
        let path = crossing(n, h, d, r);
        // Some ten roundings each; where the way in air begins at the surface its angle is told by the water alone.
        let skip = h == 0.0 && path.air == 0.0;
        let bound = if skip { 64.0 } else { 16.0 };
        prop_assert!(violation(n, h, d, r, &path) <= bound * f64::EPSILON, "{:?}", path);
        prop_assert!(path.steps <= 12);
    }

    #[test]
    fn the_thesis_iteration_ends_at_the_same_point(
        h in (-3.0f64..3.0).prop_map(|p| 10f64.powf(p)),
        d in (-3.0f64..3.0).prop_map(|p| 10f64.powf(p)),
        r in (-3.0f64..3.0).prop_map(|p| 10f64.powf(p)),
    ) {
        let reference = crossing_thesis(1.34, h, d, r, 2000);
        // The thesis' difference of sines is lost in rounding where it hardly changes with x: where the path is steep, over its
        // length; where it grazes, over the square of its length by h or d.
        let length = (h + d + r).powi(3) / (h * h).min(d * d);
        prop_assert!((crossing(1.34, h, d, r).run_air - reference).abs() <= 8.0 * f64::EPSILON * length);
    }

    #[test]
    fn grazing_paths_are_right_to_rounding(angle in 1e-6f64..1e-3, d in length(), air in 1e-3f64..1e3) {
        let (sin, cos) = angle.sin_cos();
        let under = d * (cos / 1.34) / (1.0 - (cos / 1.34) * (cos / 1.34)).sqrt();
        let path = crossing(1.34, air * sin, d, air * cos + under);
        // The angle is as ill-conditioned as the distance beyond the cone: r u / (r − cone).
        let bound = 16.0 * f64::EPSILON * (air + under) / air;
        prop_assert!((path.cos_air / sin - 1.0).abs() <= bound, "{} {}", path.cos_air, sin);
    }

    #[test]
    fn what_arrives_is_finite_continuous_and_the_same_backwards(
        h in length(), d in length(), r in length(), turn in 0.0f64..std::f64::consts::TAU, shift in -1.0f64..1.0,
    ) {
        let air = DVec3::new(0.0, h, 0.0);
        let water = DVec3::new(r * turn.cos(), -d, r * turn.sin());
        prop_assume!(d > 0.0);
        let down = WATER.refracted(air, water, Paths::Exact).unwrap();
        let up = WATER.refracted(water, air, Paths::Exact);
        let e = down.share * down.spread;
        prop_assert!(e.is_finite() && e >= 0.0 && (0.0..=1.0).contains(&down.share));
        prop_assert!(down.leaving.is_finite() && down.toward.is_finite());
        prop_assert!((down.leaving.length() - 1.0).abs() < 1e-15 * 8.0 && (down.toward.length() - 1.0).abs() < 8e-15);
        // Radiance over n² is kept, so E = T n² … one way and T … /n² the other, from the same denominator.
        if let Some(up) = up {
            let back = up.share * up.spread * 1.34 * 1.34;
            prop_assert!((back - e).abs() <= 64.0 * f64::EPSILON * e.max(back), "{} {}", back, e);
        }
        // A step of 1e-9 of everything: E is homogeneous of degree −2, and its slopes in the logarithms are below 10 where light
        // is not grazing.
        let near = WATER.refracted(air, water * (1.0 + 1e-9 * shift), Paths::Exact).unwrap();
        let bound = 1e-9 * (10.0 + 10.0 * (h + d + r) / (h + 1e-30).min(1e20)) * e.max(near.share * near.spread);
        prop_assert!((near.share * near.spread - e).abs() <= bound);
    }

    #[test]
    fn bundles_widen_as_their_neighbours_do(h in 0.1f64..10.0, d in 0.1f64..10.0, r in 0.0f64..20.0, up in any::<bool>()) {
        let (air, water) = (DVec3::new(0.0, h, 0.0), DVec3::new(r, -d, 0.0));
        let (source, receiver) = if up { (water, air) } else { (air, water) };
        let leg = WATER.refracted(source, receiver, Paths::Exact).unwrap();
        let reference = by_neighbours(source, &leg, receiver);
        let exact = leg.share * leg.spread;
        // Central differences of 1e-6: rounding of 1e-16 · distance over a step, times the tangents of grazing paths.
        let grazing = (leg.leaving.y.abs().min(leg.toward.y.abs())).powi(3);
        prop_assert!((reference / exact - 1.0).abs() < 1e-8 / grazing, "{} {}", reference, exact);
    }
}
