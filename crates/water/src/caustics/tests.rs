mod sources;

use std::f64::consts::TAU;

use glam::{DAffine3, DVec2, DVec3, Vec3};
use light::{Illuminate, Luminaire, Mesh, Place, Spectrum, Vacuum};
use proptest::prelude::*;

use super::*;
use crate::flat::{FlatWater, Lit, Part, Rules, Source};
use crate::waves::{Stokes, Waves};
use crate::{SunBelow, Water, Way};

/// A square pool of clear water about the origin.
fn pool(half: f32) -> FlatWater {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let positions = corners.map(|(x, z)| Vec3::new(x * half, 0.0, z * half)).to_vec();
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    let water = Water::new(Spectrum::ZERO, Vec::new(), 1.34).unwrap();
    FlatWater::new(water, &mesh, &DAffine3::IDENTITY)
}

/// The sun this far off the zenith, towards x and a little z.
fn sun(degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(0.96 * sin, cos, 0.28 * sin)
}

/// Two waves 5 cm high, 1 m long; or as steep as they come, with slopes to 0.63 together.
fn waves(amplitude: f64) -> Waves {
    let wave = |angle: f64, phase| Stokes::new(amplitude, 1.0, DVec2::from_angle(angle), phase).unwrap();
    Waves::new(vec![wave(0.3, 0.4), wave(1.6, 2.0)], DVec2::ZERO)
}

fn map(water: &FlatWater, waves: &Waves, toward: DVec3, step: f64) -> BeamMap {
    BeamMap::new(water, waves, Source::Toward(toward), Way::Refracted, (step, 0.0))
}

/// Level irradiance in the square about a point.
fn level(map: &BeamMap, at: DVec3, half: f64) -> f64 {
    let mut sum = 0.0;
    map.beams(at, half, &mut |beam| sum += beam.level);
    sum
}

/// ∫ T n·s dA over the surface above a rectangle of x, z, over its area: midpoints, with its own Fresnel.
fn through(waves: &Waves, toward: DVec3, half: f64) -> f64 {
    let n = 800;
    let mut sum = 0.0;
    for i in 0..n {
        for j in 0..n {
            let at = DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) / f64::from(n) * (2.0 * half) - half;
            let normal = waves.normal(at);
            let cos = normal.dot(toward);
            sum += (1.0 - mirrored(cos)) * cos / normal.y;
        }
    }
    sum / f64::from(n * n)
}

/// Fresnel's reflectance as thesis 3.3 has it.
fn mirrored(cos: f64) -> f64 {
    let i = cos.acos();
    let j = (i.sin() / 1.34).asin();
    0.5 * (((i - j).tan() / (i + j).tan()).powi(2) + ((i - j).sin() / (i + j).sin()).powi(2))
}

#[test]
fn calm_water_is_as_flat_water() {
    let water = pool(4.0);
    let toward = sun(40.0);
    let map = map(&water, &Waves::default(), toward, 0.25);
    let flat = SunBelow::new(&water.surface, toward, Spectrum::ONE).unwrap();
    for at in [DVec3::new(0.13, -1.7, 0.4), DVec3::new(-2.0, -0.3, 2.2), DVec3::new(0.5, -2.0, -0.5)] {
        for half in [0.001, 0.1, 0.6] {
            let (mut sum, mut most) = (0.0, 0.0f64);
            map.beams(at, half, &mut |beam| {
                sum += beam.level;
                most = most.max(beam.toward.distance(flat.toward));
            });
            // Leans are f32; shares of slivers too.
            let expected = f64::from(flat.horizontal[0]);
            assert!(
                (sum / expected - 1.0).abs() < 1e-5 && most < 1e-6,
                "{at} {half}: {sum} {expected} {most}"
            );
        }
    }
}

/// Waves, sun, depth → what arrives in tiles that have the whole bottom between them, over what goes through.
fn kept(waves: &Waves, toward: DVec3, depth: f64, half: f64) -> f64 {
    let water = pool(2.0);
    let map = map(&water, waves, toward, 1.0 / 32.0);
    // Everything that goes through 4 m of surface comes down within twice that.
    let n = (8.0 / half) as i32;
    let mut sum = 0.0;
    for i in -n..n {
        for j in -n..n {
            let tile = DVec3::new(f64::from(i) + 0.5, 0.0, f64::from(j) + 0.5) * (2.0 * half);
            sum += level(&map, tile - DVec3::Y * depth, half) * 4.0 * half * half;
        }
    }
    sum / (through(waves, toward, 2.0) * 16.0)
}

#[test]
fn all_that_goes_through_arrives() {
    for (waves, toward, depth) in [
        (waves(0.025), sun(10.0), 1.8),
        (waves(0.025), sun(10.0), 0.3),
        (waves(0.025), sun(50.0), 2.0),
        (waves(0.044), sun(10.0), 1.8),
        (waves(0.044), sun(30.0), 1.0),
    ] {
        let kept = kept(&waves, toward, depth, 0.125);
        println!("steepest {:.2}: {:.5}", waves.steepest(), kept - 1.0);
        // Facets of chords: T and cos are off by h²/12 of their curvature, ½ k² (slope)² at most: ½ (2π/32)²/12 · 0.63² = 6e-4.
        assert!((kept - 1.0).abs() < 1e-3, "{kept}");
    }
}

#[test]
fn a_receiver_of_any_width_has_its_share() {
    // Squares at places that know nothing of the waves: the mean of n irradiances of deviation σ is off by σ/√n; five of those.
    let (water, waves, toward) = (pool(4.0), waves(0.044), sun(10.0));
    let map = map(&water, &waves, toward, 1.0 / 32.0);
    for half in [0.002, 0.02] {
        let n = 40_000u32;
        let (mut sum, mut squares) = (0.0, 0.0);
        for i in 0..n {
            // Over whole lengths of both waves' pattern nearly: a golden lattice on 4 m.
            let [u, v] = light::sampling::lattice(i, n, [0, 0]).map(|u| 4.0 * f64::from(u) - 2.0);
            let e = level(&map, DVec3::new(u, -1.5, v), half);
            (sum, squares) = (sum + e, squares + e * e);
        }
        let mean = sum / f64::from(n);
        let deviation = (squares / f64::from(n) - mean * mean).sqrt();
        // Which 4 m of surface light up these 4 m of bottom: those straight up the mean ray, give or take what waves move at the rim.
        let shift = SunBelow::new(&water.surface, toward, Spectrum::ONE).unwrap().toward;
        let over = DVec2::new(shift.x, shift.z) * (1.5 / shift.y);
        let moved = Waves::new(waves.each().to_vec(), -over);
        let expected = through(&moved, toward, 2.0);
        println!("{half}: {:.5}, deviation {deviation:.3}", mean / expected - 1.0);
        // At the rim, 0.15 m wide at most on 4 sides, light is off by its deviation, in patches of half a wave: 32 of them.
        let rim = 4.0 * 0.15 * 4.0 / 16.0 * deviation / 32f64.sqrt();
        assert!((mean - expected).abs() < 5.0 * deviation / f64::from(n).sqrt() + rim, "{mean} {expected}");
    }
}

#[test]
fn every_path_is_found() {
    // One steep wave along x, straight sun: paths to a point by scanning where the refracted ray of each surface point comes down, in f64 and
    // with Snell's law as sin/n; between two that lie on either side of it is one.
    let wave = Stokes::new(0.06, 1.0, DVec2::X, 0.0).unwrap();
    let waves = Waves::new(vec![wave], DVec2::ZERO);
    let map = map(&pool(4.0), &waves, DVec3::Y, 1.0 / 64.0);
    let depth = 1.5;
    let lands = |x: f64| {
        let at = DVec2::new(x, 0.0);
        let normal = waves.normal(at);
        // By how much the ray is turned away from the side that the normal leans to.
        let tilt = normal.x.atan2(normal.y);
        let turned = tilt - (tilt.sin() / 1.34).asin();
        x - (depth + waves.height(at)) * turned.tan()
    };
    let (mut most, mut worst) = (0, 0.0f64);
    let n = 80_000;
    let step = 6.0 / f64::from(n);
    let surface = |k: usize| k as f64 * step - 3.0;
    let landed: Vec<f64> = (0..=n as usize).map(|k| lands(surface(k))).collect();
    for i in 0..200 {
        let x = -0.5 + f64::from(i) / 200.0 + 0.0012;
        // Where paths leave the surface, and what they bring: T over how far apart neighbours come down.
        let mut truth = Vec::new();
        for (k, ends) in landed.windows(2).enumerate() {
            let (a, b) = (ends[0] - x, ends[1] - x);
            if a * b <= 0.0 && a != b {
                let share = 1.0 - mirrored(waves.normal(DVec2::new(surface(k), 0.0)).y);
                truth.push((surface(k), share * step / (b - a).abs()));
            }
        }
        // Where two paths are about to meet a mesh may have them or not.
        if truth.iter().any(|&(_, dense)| dense > 5.0) {
            continue;
        }
        let (mut found, mut got): (Vec<f64>, f64) = (Vec::new(), 0.0);
        map.beams(DVec3::new(x, -depth, 0.01), 1e-5, &mut |beam| {
            found.push(beam.from.x);
            got += beam.level;
        });
        for (from, _) in &truth {
            // Paths through one leaf are told as one.
            assert!(
                found.iter().any(|x| (x - from).abs() < 4.0 / 64.0),
                "{x}: {from} of {truth:?} {found:?}"
            );
        }
        let expected: f64 = truth.iter().map(|(_, dense)| dense).sum();
        worst = worst.max((got / expected - 1.0).abs());
        most = most.max(truth.len());
    }
    println!("{most} paths at most, off by {worst:.4} at most");
    // Light is even over a step: E changes over half of it by h/2 P''/P' of itself, with P' > 1/5, and P'' < ¼ · 1.5 k³ a of the depth
    // (¼ of the slope turns a ray): 0.8 at those paths, and less than a fifth of that over all.
    assert!(worst < 0.2, "{worst}");
    assert!(most >= 3, "nothing folds: {most}");
}

fn some() -> impl Strategy<Value = Waves> {
    let one = (0.0..0.06f64, 0.3..4.0f64, 0.0..TAU, -4.0..4.0f64);
    prop::collection::vec(one, 1..4).prop_map(|waves| {
        let wave = |(steep, length, angle, phase): (f64, f64, f64, f64)| {
            Stokes::new(0.5 * steep * length, length, DVec2::from_angle(angle), phase).unwrap()
        };
        Waves::new(waves.into_iter().map(wave).collect(), DVec2::ZERO)
    })
}

/// Sum over tiles of a bottom, and whether any was negative or no number.
fn bottom(map: &BeamMap, depth: f64, half: f64) -> (f64, bool) {
    let n = (4.0 / half) as i32;
    let (mut sum, mut sound) = (0.0, true);
    for i in -n..n {
        for j in -n..n {
            let tile = DVec3::new(f64::from(i) + 0.5, 0.0, f64::from(j) + 0.5) * (2.0 * half);
            map.beams(tile - DVec3::Y * depth, half, &mut |beam| {
                sum += beam.level * 4.0 * half * half;
                sound &= beam.level >= 0.0 && beam.level.is_finite() && beam.from.is_finite();
                sound &= (beam.toward.length() - 1.0).abs() < 1e-12 && beam.toward.y > 0.0;
            });
        }
    }
    (sum, sound)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn the_same_flux_comes_to_every_depth(waves in some(), angle in 0.0..40.0f64, depths in prop::array::uniform2(0.5..1.5f64)) {
        let map = map(&pool(1.5), &waves, sun(angle), 0.05);
        let (highest, [a, b]) = (waves.highest(), depths);
        let [(first, sound), (second, sounds)] = [a, b].map(|depth| bottom(&map, depth + highest, 0.2));
        prop_assert!(sound && sounds);
        // Sums of clipped areas, and slivers by points.
        prop_assert!((first / second - 1.0).abs() < 1e-5, "{first} {second}");
        // No more than comes to the surface, which is flat at 1 up to what waves move at the rim; and no less than 9 tenths.
        let most = 9.0 * angle.to_radians().cos() + 12.0 * highest * angle.to_radians().sin();
        prop_assert!(first <= most && first > 0.9 * (18.0 * angle.to_radians().cos() - most), "{first} {most}");
    }
}

/// A lamp over the pool, in a place's irradiance by [`Beams`] and by [`Lit`].
fn lamp(at: DVec3, waves: Waves, points: &[DVec3]) -> Vec<[f64; 2]> {
    let waters: std::sync::Arc<[FlatWater]> = vec![pool(4.0)].into();
    let lamp = || Luminaire {
        position: at.as_vec3(),
        world_from_luminaire: glam::Mat3::IDENTITY,
        distribution: light::Distribution::isotropic(1000.0),
        spectrum: Spectrum::ONE,
        glints: false,
    };
    let setting = Setting { cells: 32.0, width: 0.0, disc: 0.0 };
    let source = Source::At(at);
    let flat = Lit::new(Box::new(lamp()), source, std::sync::Arc::clone(&waters), Rules::default());
    let beams = Beams::new(
        std::sync::Arc::new(lamp()),
        source,
        waters,
        &[waves.into()],
        (Rules::default(), setting, Part::All),
    );
    let irradiance = |by: &dyn Illuminate, position: &DVec3| {
        let place = Place { position: position.as_vec3(), error: 0.0, normal: Vec3::Y, seed: 0 };
        f64::from(by.irradiance(&place, &Vacuum)[3])
    };
    points.iter().map(|point| [irradiance(&beams, point), irradiance(&flat, point)]).collect()
}

#[test]
fn a_lamp_shines_through_waves_that_are_none_as_through_flat_water() {
    // Waves of a micrometre, whose steps are 3 cm.
    let ripple = Waves::new(vec![Stokes::new(1e-6, 1.0, DVec2::X, 0.0).unwrap()], DVec2::ZERO);
    let points = [DVec3::new(0.3, -1.5, 0.2), DVec3::new(-1.0, -0.7, 1.4), DVec3::new(1.5, -2.5, -0.5)];
    for at in [DVec3::new(0.0, 3.0, 0.0), DVec3::new(1.0, 0.8, 0.5)] {
        for [beams, flat] in lamp(at, ripple.clone(), &points) {
            // Light of a beam is even, and that of a lamp r away falls as 1/r⁴ at most (with the cosine): over the half of a step by 2 h/r.
            println!("{:.5}", beams / flat - 1.0);
            assert!((beams / flat - 1.0).abs() < 2.0 / 32.0 / at.y, "{at}: {beams} {flat}");
        }
    }
}

#[test]
fn light_moves_as_little_as_time() {
    // Over a tenth of a millisecond waves move by 0.12 mm: a line as wide as the square, 4 cm, by 1/300 of itself; up and down there
    // are 10 such lines of 10 times the mean to a metre.
    let (water, toward) = (pool(2.0), sun(10.0));
    let at = |moment: f64| {
        let map = map(&water, &waves(0.025).at_moment(moment), toward, 1.0 / 32.0);
        let point = |i: u32| {
            let [u, v] = light::sampling::lattice(i, 2000, [0, 0]).map(|u| 2.0 * f64::from(u) - 1.0);
            level(&map, DVec3::new(u, -1.8, v), 0.02)
        };
        (0..2000).map(point).collect::<Vec<f64>>()
    };
    let (now, soon, later) = (at(1.0), at(1.0001), at(1.02));
    let differ = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.iter().sum::<f64>()
    };
    let (little, much) = (differ(&now, &soon), differ(&now, &later));
    println!("0.1 ms: {little:.6}, 20 ms: {much:.4}");
    // It is not standing still either.
    assert!(little < 0.01 && much > 5.0 * little, "{little} {much}");
}

#[test]
fn what_is_mirrored_above_the_water_is_all_that_is() {
    // The sun off the waves, on a ceiling: Σ over tiles over the flux that is not let through.
    let (water, waves, toward) = (pool(1.0), waves(0.01), sun(20.0));
    let map = BeamMap::new(&water, &waves, Source::Toward(toward), Way::Mirrored, (1.0 / 32.0, 0.0));
    let mut sum = 0.0;
    for i in -40..40 {
        for j in -40..40 {
            let tile = DVec3::new(f64::from(i) + 0.5, 0.0, f64::from(j) + 0.5) * 0.2;
            sum += level(&map, tile + DVec3::Y * 1.5, 0.1) * 0.04;
        }
    }
    let n = 400;
    let mut expected = 0.0;
    for i in 0..n {
        for j in 0..n {
            let at = DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) / f64::from(n) * 2.0 - 1.0;
            let normal = waves.normal(at);
            let cos = normal.dot(toward);
            expected += mirrored(cos) * cos / normal.y * 4.0 / f64::from(n * n);
        }
    }
    // Fresnel's reflectance is linear over a cell but for h²/8 of its curvature: below a thousandth of it at these angles.
    assert!((sum / expected - 1.0).abs() < 1e-3, "{sum} {expected}");
}
