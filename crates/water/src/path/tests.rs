use proptest::prelude::*;

use super::*;

/// Snell's law by plain bisection.
fn bisected(height: f64, depth: f64, apart: f64, n: f64) -> f64 {
    let [mut low, mut high] = [0.0, apart];
    for _ in 0..200 {
        let x = 0.5 * (low + high);
        let off = x / x.hypot(height) - n * (apart - x) / (apart - x).hypot(depth);
        if off < 0.0 { low = x } else { high = x }
    }
    0.5 * (low + high)
}

/// E⊥ by moving rays a little: the solid angle that a small square behind the surface fills.
fn by_differences(height: f64, depth: f64, apart: f64, n: f64) -> f64 {
    let at = |dx: f64, dz: f64, dy: f64| {
        let (r, d) = ((apart + dx).hypot(dz), depth + dy);
        let x = bisected(height, d, r, n);
        let turn = dz.atan2(apart + dx);
        // Direction that leaves the source.
        glam::DVec3::new(x * turn.cos(), -height, x * turn.sin()).normalize()
    };
    let h = 1e-4 * (apart + height + depth);
    let x = bisected(height, depth, apart, n);
    let down = glam::DVec3::new(apart - x, -depth, 0.0).normalize();
    // Two directions across the ray at the receiver.
    let across = glam::DVec3::new(-down.y, down.x, 0.0);
    let move_by = |v: glam::DVec3| at(v.x, v.z, -v.y);
    let u = move_by(across * h) - move_by(across * -h);
    let v = move_by(glam::DVec3::Z * h) - move_by(glam::DVec3::Z * -h);
    let solid_angle = u.cross(v).length() / (4.0 * h * h);
    let cos = height / x.hypot(height);
    solid_angle * (1.0 - fresnel(n, cos))
}

#[test]
fn the_bundle_is_what_neighbouring_rays_enclose() {
    for n in [1.1, 1.333, 1.5] {
        for (height, depth, apart) in [(1.0, 1.0, 0.01), (1.0, 1.0, 2.0), (3.0, 0.1, 7.0), (0.2, 5.0, 3.0)] {
            let x = refraction_point(height, depth, apart, n);
            let bundle = Bundle::new(height, x, depth, apart - x, n);
            let per_intensity = bundle.factor() / bundle.first().powi(2);
            let truth = by_differences(height, depth, apart, n);
            // Second differences of steps of 1e-4.
            assert!(
                (per_intensity / truth - 1.0).abs() < 1e-5,
                "{n} {height} {depth} {apart}: {per_intensity} {truth}"
            );
        }
    }
}

#[test]
fn both_ways_are_one_way() {
    // Reciprocity: E per intensity from air to water is η² of that from water to air between the same points.
    let (height, depth, apart, n) = (1.3, 0.7, 2.1, 1.333);
    let x = refraction_point(height, depth, apart, n);
    let [down, up] =
        [Bundle::new(height, x, depth, apart - x, n), Bundle::new(depth, apart - x, height, x, 1.0 / n)]
            .map(|bundle| bundle.factor() / bundle.first().powi(2));
    assert!((down / (n * n * up) - 1.0).abs() < 1e-12, "{down} {up}");
}

proptest! {
    #[test]
    fn the_refraction_point_is_right_to_rounding_everywhere(
        [height, depth, apart] in [-6.0f64..6.0, -6.0..6.0, -6.0..6.0], n in 1.0001f64..2.0,
    ) {
        let [height, depth, apart] = [height, depth, apart].map(|e| 10f64.powf(e));
        let x = refraction_point(height, depth, apart, n);
        prop_assert!((0.0..=apart).contains(&x));
        // The other solver is exact to 2⁻²⁰⁰ of `apart`, but for its own rounding of the law: n ulps over its slope.
        let truth = bisected(height, depth, apart, n);
        prop_assert!((x - truth).abs() <= 1e-13 * apart, "{height} {depth} {apart}: {x} {truth}");
        let bundle = Bundle::new(height, x, depth, apart - x, n);
        prop_assert!(bundle.factor().is_finite() && bundle.factor() >= 0.0);
    }

    #[test]
    fn nothing_is_no_trouble(a in prop::array::uniform3(prop_oneof![Just(0.0), Just(1e-6), Just(1.0), Just(1e6)])) {
        let [height, depth, apart] = a;
        for n in [1.333, 1.0 / 1.333] {
            let x = if n > 1.0 {
                refraction_point(height, depth, apart, n)
            } else {
                apart - refraction_point(depth, height, apart, 1.0 / n)
            };
            let factor = Bundle::new(height, x, depth, apart - x, n).factor();
            prop_assert!(x.is_finite() && factor.is_finite() && factor >= 0.0, "{a:?} {n}: {x} {factor}");
        }
    }
}
