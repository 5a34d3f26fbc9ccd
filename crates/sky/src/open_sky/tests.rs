use super::*;
use crate::luminous::tests::standard;

fn lux(e: Spectrum) -> f32 {
    e.luminance()
}

/// The same integral in f64 for one plane, on a grid five times finer in each direction.
fn reference(sky: &dyn Sky, normal: Vec3) -> f64 {
    let bands = 300;
    let step = std::f64::consts::FRAC_PI_2 / f64::from(bands);
    let mut sum = 0.0;
    for band in 0..bands {
        let (sin, cos) = ((f64::from(band) + 0.5) * step).sin_cos();
        for column in 0..4 * bands {
            let (s, c) = ((f64::from(column) + 0.5) * step).sin_cos();
            let direction = Vec3::new((cos * c) as f32, sin as f32, (cos * s) as f32);
            let cosine = f64::from(direction.dot(normal).max(0.0));
            sum += f64::from(sky.radiance(direction).luminance()) * cosine * cos * step * step;
        }
    }
    sum
}

#[test]
fn horizontal_irradiance_is_that_of_the_closed_forms() {
    // Bands with exact solid angles: the midpoint rule for sin h and sin² h errs by h²/24 and h²/6.
    let rule = (1.5f32).to_radians().powi(2) / 6.0;
    let uniform = OpenSky::new(&standard("uniform", 90.0));
    assert!((lux(uniform.horizontal()) / PI - 1.0).abs() <= rule);
    let overcast = OpenSky::new(&standard("overcast", 90.0));
    assert!((lux(overcast.horizontal()) / (7.0 * PI / 9.0) - 1.0).abs() <= rule);
    // A vertical plane under the overcast sky receives 0.396 of it: (1/3)(π/2) + (2/3)(2/3) = π/6 + 4/9
    // against 7π/9.
    let share = lux(overcast.on_plane(Vec3::X)) / lux(overcast.horizontal());
    let exact = (PI / 6.0 + 4.0 / 9.0) / (7.0 * PI / 9.0);
    assert!((exact - 0.396).abs() < 5e-4, "the figure of the textbooks");
    assert!((share - exact).abs() <= 2.0 * rule, "{share}");
}

#[test]
fn the_clear_sky_has_its_published_integrals() {
    // E_h/L_z by 400 × 200 points of Gauss, by the sun's altitude, for type 12 of ISO 15469, which is the
    // formula of 1973 but for 0.9102 in place of 0.91: 2e-4.
    for (altitude, expected) in [
        (0.0, 6.95599),
        (10.0, 7.22935),
        (20.0, 7.05191),
        (30.0, 6.39411),
        (40.0, 5.40530),
        (50.0, 4.28122),
        (60.0, 3.19057),
        (70.0, 2.24759),
        (80.0, 1.50597),
        (90.0, 0.96736),
    ] {
        let ours = lux(OpenSky::new(&standard("clear", altitude)).horizontal());
        // The cusp at the sun, slope 3, within cells of 1.5°: (3 · 0.026)²/12 = 5e-4 of what is near it.
        assert!((ours / expected - 1.0).abs() <= 2e-4 + 5e-4, "{altitude}: {ours}");
    }
}

#[test]
fn the_table_is_within_its_stated_error_for_every_tilt() {
    for altitude in [5.0, 40.0] {
        let sky = standard("clear", altitude);
        let table = OpenSky::new(&sky);
        let largest = table.irradiance.iter().flatten().fold(0.0f32, |a, &b| a.max(lux(b)));
        for (tilt, azimuth) in
            [(2.0, 10.0), (50.0, 2.0), (86.0, 6.0), (90.0, 90.0), (94.0, 178.0), (130.0, 30.0)]
        {
            let (t, a) = (f32::to_radians(tilt), f32::to_radians(azimuth));
            for sign in [-1.0, 1.0] {
                let normal = Vec3::new(t.sin() * a.cos(), t.cos(), sign * t.sin() * a.sin());
                let exact = reference(&sky, normal) as f32;
                let error = (lux(table.on_plane(normal)) - exact).abs();
                // Linear over 4°: (0.07)²/8 = 6e-4 of a cosine, and the quadrature's 5e-4.
                assert!(error <= 1.1e-3 * largest, "{altitude} {tilt} {azimuth}: {error}");
            }
        }
    }
}

#[test]
fn a_plane_that_looks_down_receives_nothing() {
    for name in ["uniform", "overcast", "clear"] {
        // Of light of 1 cd/m² at the zenith, f64 rounding.
        assert!(lux(OpenSky::new(&standard(name, 90.0)).on_plane(Vec3::NEG_Y)) < 1e-6);
    }
}

/// Bright in one corner of the compass and dark elsewhere, without a plane of symmetry; a colour by height.
struct Lopsided;

impl Sky for Lopsided {
    fn radiance(&self, direction: Vec3) -> Spectrum {
        let lobe = (direction.dot(Vec3::new(0.48, 0.6, 0.64)).max(0.0)).powi(4) + 0.3 * direction.x.max(0.0);
        Spectrum(std::array::from_fn(|band| lobe * (1.0 + band as f32 * direction.y)))
    }

    fn brightest(&self) -> Vec3 {
        Vec3::Y
    }
}

#[test]
fn skies_without_symmetry_and_with_colours_are_summed_as_well() {
    let table = OpenSky::new(&Lopsided);
    for normal in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z, Vec3::Y, Vec3::new(0.36, -0.48, 0.8)] {
        let exact = reference(&Lopsided, normal) as f32;
        let error = (lux(table.on_plane(normal)) - exact).abs();
        assert!(error <= 1.1e-3 * lux(table.horizontal()), "{normal}: {error}");
    }
    let whole = horizontal(|direction| f64::from(Lopsided.radiance(direction)[5]));
    assert!((table.horizontal()[5] / whole as f32 - 1.0).abs() < 4.0 * f32::EPSILON, "the same sums");
}
