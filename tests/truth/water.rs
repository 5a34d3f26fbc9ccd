//! Light through a flat, clear water surface, against what the laws of Snell and Fresnel say by themselves.
//!
//! Only the one light path each time: nothing is reflected from floor to surface and back.

use glam::DVec3;
use keikan_tests::{luminances, lux, render};

const N: f64 = 1.33;

/// A floor of reflectance `grey` 2 m below the surface, and what else there is.
fn pool(grey: f64, more: &str) -> String {
    format!(
        r#"
        [[material]]
        name = "floor"
        colour = {grey}
        [[model]]
        plane = {{ size = [400, 400] }}
        material = "floor"
        position = [0, -2, 0]
        [sky]
        off = true
        {more}
        "#
    )
}

pub(crate) const WATER: &str = "[[water]]\nquality = 'clear'\nindex = 1.33\n\
    polygon = { points = [[-200, 0, -200], [-200, 0, 200], [200, 0, 200], [200, 0, -200]] }\n";

const DOWN: &str = "[[camera]]\nposition = [0, 5, 0]\ndirection = [0, -1, 0]\nfield_of_view = 2\n";

/// Fresnel's reflectance of a surface, as thesis 3.3 has it; not head on.
fn reflected(sin: f64, n: f64) -> f64 {
    let (i, j) = (sin.asin(), (sin / n).asin());
    let [s, p] = [(i - j).sin() / (i + j).sin(), (i - j).tan() / (i + j).tan()];
    0.5 * (s * s + p * p)
}

/// Head on.
fn head_on(n: f64) -> f64 {
    ((n - 1.0) / (n + 1.0)).powi(2)
}

#[test]
fn the_sun_on_the_floor_of_a_pool() {
    let sun = "[sun]\naltitude = 45\nazimuth = 70\nilluminance = 100000\ndiameter = 0\n";
    let sensor = "[[sensor]]\npoints = [[0.3, -1.9999, 0.2]]\n";
    let light = |water: &str| lux(&pool(0.02, &format!("{sun}{sensor}{water}")), &[])[0];
    let passes = 1.0 - reflected(45f64.to_radians().sin(), N);
    // The horizontal receives T cos θ₁/cos θ₂ · cos θ₂ = T cos θ₁. Beams are f32, and some products.
    assert!((light(WATER) / light("") / passes - 1.0).abs() < 1e-5, "{}", light(WATER) / light(""));

    let seen = |water: &str| {
        let film = render(&pool(0.02, &format!("{sun}{DOWN}{water}")), (8, 8), &[]);
        luminances(&film).iter().map(|&l| f64::from(l)).sum::<f64>() / 64.0
    };
    // Straight up again, within a degree of the vertical, where the surface's reflectance changes by 1e-6.
    let expected = passes * (1.0 - head_on(N)) / (N * N);
    assert!((seen(WATER) / seen("") / expected - 1.0).abs() < 1e-4, "{} {expected}", seen(WATER) / seen(""));
}

/// Irradiance per intensity on a plane that faces the light, by a square of rays around the one that hits: `leave` is the direction
/// from the source that reaches the receiver moved by a vector.
fn spread(leave: impl Fn(DVec3) -> DVec3, arrives: DVec3, h: f64) -> f64 {
    let across = arrives.any_orthonormal_vector();
    let other = arrives.cross(across);
    let moved = |v: DVec3| leave(v * h) - leave(v * -h);
    moved(across).cross(moved(other)).length() / (4.0 * h * h)
}

/// Where light crosses the plane y = 0 from `from` to `to` on its other side: the way of least time, found by golden sections.
fn crossing(from: DVec3, to: DVec3) -> DVec3 {
    let time = |p: DVec3| {
        let index = |end: DVec3| if end.y < 0.0 { N } else { 1.0 };
        index(from) * p.distance(from) + index(to) * p.distance(to)
    };
    let [a, b] = [from, to].map(|p| DVec3::new(p.x, 0.0, p.z));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let third = (high - low) / 3.0;
        if time(a.lerp(b, low + third)) < time(a.lerp(b, high - third)) {
            high -= third
        } else {
            low += third
        }
    }
    a.lerp(b, 0.5 * (low + high))
}

/// Illuminance per candela on a plane of this normal at `to`, of a lamp at `from` across the surface.
fn across(from: DVec3, to: DVec3, normal: DVec3) -> f64 {
    let point = crossing(from, to);
    let first = (point - from).normalize();
    let arrives = (to - point).normalize();
    let h = 1e-3;
    let per_candela = spread(|v| (crossing(from, to + v) - from).normalize(), arrives, h);
    let sin = (1.0 - first.y * first.y).sqrt();
    let eta = if from.y < 0.0 { 1.0 / N } else { N };
    per_candela * (1.0 - reflected(sin, eta)) * (-arrives).dot(normal).max(0.0)
}

fn lamp(at: DVec3) -> String {
    format!("[[light]]\nposition = [{}, {}, {}]\nintensity = 1000\n", at.x, at.y, at.z)
}

/// Crossings are found to the root of rounding, 1e-8 m, over steps of 1e-3: differences are good to some 1e-5, and second-order terms
/// to h² of a metre's curvature, 1e-6.
const DIFFERENCES: f64 = 1e-4;

#[test]
fn lamps_light_through_the_surface_both_ways() {
    let floor = DVec3::new(0.4, -1.9999, 0.1);
    for from in [DVec3::new(1.0, 3.0, -0.5), DVec3::new(9.0, 1.0, 2.0), DVec3::new(0.9, 0.05, 0.0)] {
        let sensor = format!("[[sensor]]\npoints = [[{}, {}, {}]]\n", floor.x, floor.y, floor.z);
        let got = lux(&pool(0.5, &format!("{}{sensor}{WATER}", lamp(from))), &[])[0];
        let truth = 1000.0 * across(from, floor, DVec3::Y);
        println!("down from {from}: {got} {truth}");
        assert!((got / truth - 1.0).abs() < DIFFERENCES, "{from}: {got} {truth}");
    }
    let wall = DVec3::new(1.4, 1.2, 0.3);
    for from in [DVec3::new(0.4, -1.0, 0.0), DVec3::new(1.0, -0.05, 0.2), DVec3::new(-0.2, -1.5, 0.1)] {
        let sensor =
            format!("[[sensor]]\nnormal = [-1, 0, 0]\npoints = [[{}, {}, {}]]\n", wall.x, wall.y, wall.z);
        let got = lux(&pool(0.5, &format!("{}{sensor}{WATER}", lamp(from))), &[])[0];
        let truth = 1000.0 * across(from, wall, DVec3::NEG_X);
        println!("up from {from}: {got} {truth}");
        assert!((got / truth - 1.0).abs() < DIFFERENCES, "{from}: {got} {truth}");
    }
}

#[test]
fn a_lamp_and_an_eye_on_either_side_of_the_surface() {
    // Cases A and B of a lamp above or below, seen from above; W from below: luminance of the floor under the axis.
    let seen = |lamp_at: DVec3, eye: f64| {
        let camera =
            format!("[[camera]]\nposition = [0, {eye}, 0]\ndirection = [0, -1, 0]\nfield_of_view = 0.2\n");
        let film = render(&pool(0.5, &format!("{}{camera}{WATER}", lamp(lamp_at))), (4, 4), &[]);
        luminances(&film).iter().map(|&l| f64::from(l)).sum::<f64>() / 16.0
    };
    let floor = DVec3::new(0.0, -2.0, 0.0);
    let (above, below) = (DVec3::new(0.7, 3.0, 0.0), DVec3::new(0.3, -1.0, 0.0));
    let matt = 0.5 / std::f64::consts::PI * 1000.0;
    let out = (1.0 - head_on(N)) / (N * N);
    let through = matt * across(above, floor, DVec3::Y);
    let direct = {
        let way = below - floor;
        let mirrored = DVec3::new(below.x, -below.y, below.z) - floor;
        let sin = (1.0 - mirrored.normalize().y.powi(2)).sqrt();
        let of = |way: DVec3| way.normalize().y / way.length_squared();
        matt * (of(way) + reflected(sin, 1.0 / N) * of(mirrored))
    };
    for (name, got, truth) in [
        ("A", seen(above, 4.0), through * out),
        ("B", seen(below, 4.0), direct * out),
        ("W", seen(above, -0.5), through),
        ("lamp and eye below", seen(below, -0.5), direct),
    ] {
        println!("{name}: {:.6}", got / truth);
        // A field of 0.2°: the floor's light changes by its square.
        assert!((got / truth - 1.0).abs() < 2e-4, "{name}: {got} {truth}");
    }
}

/// Asserts that an eye in a furnace sees radiance l through `water`, 4° and 59° above the horizon: a sky of radiance l, a bottom that sends n² l
/// up (here by emission, so that it need not be lit), and the water between.
pub(crate) fn shines_like_its_surroundings(water: &str) {
    let l = 1000.0;
    for position in ["[0, 3, 40]", "[0, 5, 3]"] {
        let text = format!(
            r#"
            [[material]]
            name = "bottom"
            colour = 0
            emission = {}
            [[model]]
            plane = {{ size = [400, 400] }}
            material = "bottom"
            position = [0, -2, 0]
            [sun]
            off = true
            [sky]
            model = "uniform"
            illuminance = {}
            [[camera]]
            position = {position}
            target = [0, 0, 0]
            field_of_view = 2
            {water}
            "#,
            N * N * l,
            std::f64::consts::PI * l,
        );
        for luminance in luminances(&render(&text, (16, 16), &[])) {
            // The table that a stated illuminance is from is 8.6e-5 off (midpoints of 1.5°).
            assert!((f64::from(luminance) / l - 1.0).abs() < 2e-4, "{position}: {luminance}");
        }
    }
}

#[test]
fn water_that_shines_like_its_surroundings_is_not_to_be_seen() {
    shines_like_its_surroundings(WATER);
}

#[test]
fn an_even_sky_under_water() {
    // ∫ n² T cos θ′ dω′ over Snell's window, relative to π: 0.93249 for n = 1.34 by an independent quadrature.
    let at = |water: &str| {
        let text = "[sky]\nmodel = 'uniform'\nilluminance = 10000\n[sun]\noff = true\n[[sensor]]\npoints = [[0, -1, 0]]\n";
        lux(&format!("{text}{water}"), &[])[0]
    };
    let water = WATER.replace("1.33", "1.34");
    let got = at(&water) / at("");
    // 256 directions, evenly spread over the window: T falls to nothing at its rim, where 1/256 of them counts half at most; and
    // beyond 200 m nothing is water.
    assert!((got / 0.932_49 - 1.0).abs() < 2e-3, "{got}");
}
