//! Luminous areas against slow references, their limits, laws and corners.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use keikan_light::{AreaLight, AreaShape, Illuminate, Occlude, Place, Ray, Spectrum, Vacuum};
use proptest::prelude::*;

/// Relative error of what is computed in f64 from f32 input and handed on as f32: |V|, its direction and their
/// product with the normal, each rounded a few times, compared with V · n; relative to |V|.
const ROUNDING: f64 = 8.0 * f32::EPSILON as f64;

fn rectangle(centre: Vec3, half_u: Vec3, half_v: Vec3) -> AreaLight {
    let shape = AreaShape::Rectangle { half_u, half_v };
    AreaLight { shape, centre, radiance: Spectrum::ONE, samples: 16 }
}

fn sphere(centre: Vec3, radius: f32) -> AreaLight {
    AreaLight { shape: AreaShape::Sphere { radius }, centre, radiance: Spectrum::ONE, samples: 16 }
}

fn place(position: Vec3, normal: Vec3) -> Place {
    Place { position, error: 0.0, normal, seed: 7 }
}

fn irradiance(light: &AreaLight, at: &Place) -> f64 {
    f64::from(light.irradiance(at, &Vacuum)[0])
}

/// Midpoint rule over n × n pieces of the rectangle: Σ cos⁺θ cos⁺θ' / r² ΔA.
fn reference(light: &AreaLight, at: &Place, n: u32) -> f64 {
    let AreaShape::Rectangle { half_u, half_v } = light.shape else { return f64::NAN };
    let (u, v, normal) = (half_u.as_dvec3(), half_v.as_dvec3(), at.normal.as_dvec3());
    let across = u.cross(v);
    let middle = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0;
    let mut sum = 0.0;
    for i in 0..n * n {
        let way = (light.centre - at.position).as_dvec3() + u * middle(i % n) + v * middle(i / n);
        let r2 = way.length_squared();
        sum += way.dot(normal).max(0.0) * (-way.dot(across)).max(0.0) / (r2 * r2);
    }
    sum * 4.0 / f64::from(n * n)
}

/// The same for a sphere of angular radius σ: over rings and sectors of the cap it covers.
fn reference_sphere(to_centre: DVec3, radius: f64, normal: DVec3, n: u32) -> f64 {
    let c = to_centre.normalize();
    let (a, b) = c.any_orthonormal_pair();
    let sigma = (radius / to_centre.length()).asin();
    let (dp, da) = (sigma / f64::from(n), 2.0 * PI / f64::from(n));
    let mut sum = 0.0;
    for i in 0..n * n {
        let (psi, alpha) = ((f64::from(i % n) + 0.5) * dp, (f64::from(i / n) + 0.5) * da);
        let omega = c * psi.cos() + (a * alpha.cos() + b * alpha.sin()) * psi.sin();
        sum += omega.dot(normal).max(0.0) * psi.sin();
    }
    sum * dp * da
}

fn unit() -> impl Strategy<Value = Vec3> {
    [-1.0..1.0f32, -1.0..1.0f32, -1.0..1.0f32]
        .prop_map(|v| Vec3::from_array(v).try_normalize().unwrap_or(Vec3::Y))
}

/// Corner of a rectangle parallel to the plane, x by y at height 1: the catalogue's view factor from an element.
fn corner(x: f64, y: f64) -> f64 {
    let (p, q) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / p * (y / p).atan() + y / q * (x / q).atan()) / (2.0 * PI)
}

#[test]
fn a_parallel_rectangle_has_the_view_factor_of_catalogues() {
    for (x, y) in [(1.0_f32, 1.0_f32), (0.01, 5.0), (30.0, 40.0), (1e-3, 1e-3)] {
        let lamp = rectangle(Vec3::new(0.5 * x, 1.0, 0.5 * y), Vec3::X * 0.5 * x, Vec3::Z * 0.5 * y);
        let expected = PI * corner(f64::from(x), f64::from(y));
        // u × v = X × Z = −Y: it shines down.
        let e = irradiance(&lamp, &place(Vec3::ZERO, Vec3::Y));
        assert!((e / expected - 1.0).abs() < 4.0 * ROUNDING, "{x} {y}: {e} {expected}");
    }
}

#[test]
fn the_frame_is_as_written() {
    // u × v = Z × X = +Y: lights what is above it, not what is below.
    let lamp = rectangle(Vec3::ZERO, Vec3::Z, Vec3::X);
    assert!(irradiance(&lamp, &place(Vec3::Y, Vec3::NEG_Y)) > 0.5);
    assert_eq!(irradiance(&lamp, &place(Vec3::NEG_Y, Vec3::Y)), 0.0);
}

#[test]
fn all_flux_arrives_on_a_sphere_around() {
    // Tilted by turns that no axis shares.
    let u = Vec3::new(0.5, 0.2, 0.1);
    let v = u.cross(Vec3::new(0.3, -0.4, 0.8)).normalize() * 0.7;
    for (lamp, half) in [(rectangle(Vec3::ZERO, u, v), true), (sphere(Vec3::ZERO, 0.8), false)] {
        let (n, radius) = (128, 3.0_f64);
        let (h, mut flux) = (PI / f64::from(n), 0.0);
        for i in 0..n * 2 * n {
            let (theta, phi) = ((f64::from(i % n) + 0.5) * h, (f64::from(i / n) + 0.5) * h);
            let out = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
            let at = place((out * radius).as_vec3(), -out.as_vec3());
            flux += irradiance(&lamp, &at) * theta.sin() * h * h * radius * radius;
        }
        let expected = PI * f64::from(lamp.area());
        // Midpoint rule: h²/24 times the second derivatives (about 4 of cos γ sin θ, over an area of π by 2π, half of
        // it lit), relative to the flux; a kink where the lit side ends costs as much again.
        let bound = if half { 2.0 } else { 1.0 } * 4.0 * h * h / 24.0 * 2.0 * PI;
        assert!((flux / expected - 1.0).abs() < bound, "{flux} {expected}");
    }
}

#[test]
fn corners_are_finite_and_never_negative() {
    let lamps = [
        rectangle(Vec3::ZERO, Vec3::Z, Vec3::X),
        rectangle(Vec3::ZERO, Vec3::ZERO, Vec3::X),
        rectangle(Vec3::splat(f32::NAN), Vec3::Z, Vec3::X),
        rectangle(Vec3::ZERO, Vec3::Z * 1e-20, Vec3::X * 1e-20),
        rectangle(Vec3::ZERO, Vec3::Z * 1e6, Vec3::X * 1e6),
        sphere(Vec3::ZERO, 1.0),
        sphere(Vec3::ZERO, 0.0),
        sphere(Vec3::ZERO, -1.0),
        sphere(Vec3::ZERO, f32::NAN),
        sphere(Vec3::ZERO, 1e6),
    ];
    let positions = [
        Vec3::ZERO,
        Vec3::X,
        Vec3::new(1.0, 0.0, 1.0),
        Vec3::new(3.0, 0.0, 0.5),
        Vec3::Y * 1e-30,
        Vec3::Y * 1e-6,
        Vec3::Y * 1e6,
        Vec3::new(1e6, 1e-3, 0.0),
        Vec3::Y * f32::INFINITY,
        Vec3::splat(f32::NAN),
    ];
    for mut lamp in lamps {
        for (position, samples) in positions.into_iter().flat_map(|p| [(p, 0), (p, 1), (p, 5)]) {
            lamp.samples = samples;
            for normal in [Vec3::Y, Vec3::NEG_Y, Vec3::X, Vec3::NEG_X, Vec3::new(0.6, -0.8, 0.0)] {
                let e = lamp.irradiance(&place(position, normal), &Vacuum);
                // No surface receives more than a sky of its radiance: π L.
                let most = PI * (1.0 + ROUNDING);
                assert!(e.is_finite() && e[0] >= 0.0 && f64::from(e[0]) <= most, "{lamp:?} {position} {e:?}");
            }
        }
    }
    // Touching the shining side: the lamp is all that is seen. π L less what passes by at the sides, h/half a side.
    let near = irradiance(&rectangle(Vec3::ZERO, Vec3::Z, Vec3::X), &place(Vec3::Y * 1e-6, Vec3::NEG_Y));
    assert!((near / PI - 1.0).abs() < 1e-6, "{near}");
    // Inside a sphere: nothing.
    assert_eq!(irradiance(&sphere(Vec3::ZERO, 1.0), &place(Vec3::X * 0.5, Vec3::Y)), 0.0);
}

/// Blocks segments that end where x is below a border.
struct Below(f32);

impl Occlude for Below {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        Spectrum::splat(f32::from(segment.at(segment.length).x >= self.0))
    }
}

#[test]
fn one_sample_is_a_sharp_shadow_and_many_are_a_share() {
    let lamp = rectangle(Vec3::Y * 2.0, Vec3::X, Vec3::Z);
    let at = place(Vec3::ZERO, Vec3::Y);
    let whole = irradiance(&lamp, &at);
    let seen = |samples: u32, seed: u32, border: f32| -> f64 {
        let lamp = AreaLight { samples, ..lamp };
        f64::from(lamp.irradiance(&Place { seed, ..at }, &Below(border))[0]) / whole
    };
    assert_eq!((seen(1, 0, -0.01), seen(1, 0, 0.01)), (1.0, 0.0));
    // Half of it from x = 0 on, by symmetry; and the part beyond x = ½ is a lamp of its own.
    let beyond = rectangle(Vec3::new(0.75, 2.0, 0.0), Vec3::X * 0.25, Vec3::Z);
    let beyond = irradiance(&beyond, &at) / whole;
    for (border, expected) in [(0.0, 0.5), (0.5, beyond), (-1.5, 1.0), (1.5, 0.0)] {
        for seed in 0..16 {
            for samples in [16_u32, 64, 256] {
                // The border meets fewer than 2 √n of n evenly spread samples, and on them alone can the count be
                // wrong, by half of them; weights differ by (1 + ½)² over the lamp at most.
                let bound = 2.25 / f64::from(samples).sqrt();
                let share = seen(samples, seed, border);
                assert!((share - expected).abs() <= bound, "{border} {samples}: {share} {expected}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_rectangle_is_what_quadrature_says(
        centre in unit(), away in 1.5..4.0f32, u in unit(), v in unit(), normal in unit(), [a, b] in [0.1..0.5f32, 0.1..0.5],
    ) {
        let lamp = rectangle(centre * away, u * a, v * b);
        let at = place(Vec3::ZERO, normal);
        let n = 160;
        let (coarse, fine) = (reference(&lamp, &at, n), reference(&lamp, &at, 2 * n));
        // Smooth parts: the error falls with h², so a halved step shows three quarters of it. Cells that the horizon
        // cuts: at most 4n of 4n², in each the integrand is below (side of a cell)/r³ with r ≥ 0.5.
        let cut = 4.0 * f64::from(a) * f64::from(b) / f64::from(n) * (1.0 / f64::from(n)) / 0.125;
        let bound = (coarse - fine).abs() + cut + ROUNDING * 4.0 * f64::from(a * b) / 0.25;
        let closed = irradiance(&lamp, &at);
        prop_assert!((closed - fine).abs() <= bound, "{closed} {fine} {bound}");
    }

    #[test]
    fn a_sphere_is_what_quadrature_says(centre in unit(), away in 1.01..5.0f32, normal in unit()) {
        let to_centre = centre * away;
        let closed = irradiance(&sphere(to_centre, 1.0), &place(Vec3::ZERO, normal));
        let reference = |n| reference_sphere(to_centre.as_dvec3(), 1.0, normal.as_dvec3(), n);
        let (coarse, fine) = (reference(200), reference(400));
        // As above; what the horizon cuts: 800 of 400² cells of Δω ≤ π²/400² · ½, cos θ ≤ 2π/400 in them.
        let cut = 800.0 * PI * PI / (2.0 * 160_000.0) * 2.0 * PI / 400.0 / 2.0;
        prop_assert!((closed - fine).abs() <= (coarse - fine).abs() + cut + ROUNDING * PI, "{closed} {fine}");
    }

    #[test]
    fn far_away_it_is_a_point(toward in unit(), normal in unit(), distance in 100.0..1e6f32, ball in any::<bool>()) {
        let position = toward * distance;
        let lamp = if ball { sphere(Vec3::ZERO, 0.5) } else { rectangle(Vec3::ZERO, Vec3::Z * 0.5, Vec3::X * 0.5) };
        let (cos, d) = (-f64::from(toward.dot(normal)), f64::from(position.length()));
        let cos_source = f64::from(toward.y).max(0.0);
        let projected = if ball { PI * 0.25 } else { cos_source };
        let expected = projected * cos.max(0.0) / (d * d);
        // Size over distance: horizon and cosines are blurred by ½ √½ / d, squares of it elsewhere.
        let bound = (projected + 1.0 / d) / (d * d) * (1.0 / d + 4.0 * ROUNDING);
        prop_assert!((irradiance(&lamp, &place(position, normal)) - expected).abs() <= bound);
    }

    #[test]
    fn nearer_is_brighter(a in 1.1..50.0f32, step in 1.01..2.0f32, side in -0.4..0.4f32) {
        // Straight below a point of the lamp, a receiver that faces it sees more the nearer it is.
        for lamp in [rectangle(Vec3::ZERO, Vec3::X, Vec3::Z), sphere(Vec3::ZERO, 1.0)] {
            let e = |y: f32| irradiance(&lamp, &place(Vec3::new(side, -y, 0.0), Vec3::Y));
            prop_assert!(e(a) > e(a * step));
        }
    }

    #[test]
    fn hidden_light_is_never_more(normal in unit(), seed in any::<u32>(), border in -1.0..1.0f32, samples in 1..100u32) {
        let lamp = AreaLight { samples, ..rectangle(Vec3::Y * 2.0, Vec3::X, Vec3::Z) };
        let at = Place { seed, ..place(Vec3::ZERO, normal) };
        let (part, whole) = (lamp.irradiance(&at, &Below(border))[0], lamp.irradiance(&at, &Vacuum)[0]);
        prop_assert!((0.0..=whole).contains(&part));
    }
}
