use std::f32::consts::PI;
use std::sync::Arc;

use light::{Opacity, Uniform, Vacuum};
use proptest::prelude::*;

use super::*;
use crate::obstacles::scenes::{Plain, boxes, canyon, town};
use crate::{Distribution, Dome, Luminous};

fn luminous(distribution: Distribution, altitude_deg: f32) -> Description {
    let (sin, cos) = altitude_deg.to_radians().sin_cos();
    Description::new(Arc::new(Luminous::new(distribution, Vec3::new(0.0, sin, -cos))))
}

fn place(position: Vec3, normal: Vec3) -> Place {
    Place { position, error: 4.0 * f32::EPSILON * position.abs().max_element().max(1.0), normal, seed: 0 }
}

#[test]
fn a_uniform_sky_gives_a_plain_pi_times_its_radiance() {
    let description = Description::new(Arc::new(Uniform { radiance: Spectrum::ONE }));
    for count in [1, 7, 10, 40, 80] {
        let sky = BandSky::new(&description, &Geometry::default(), None, count);
        let e = sky.irradiance(&place(Vec3::ZERO, Vec3::Y), &Vacuum)[0];
        // Every band has exactly its share: rounding alone is left.
        assert!((e / PI - 1.0).abs() <= 2.0 * f32::EPSILON, "{count}: {e}");
        assert_eq!(e, sky.open_irradiance(Vec3::Y)[0]);
    }
}

#[test]
fn a_street_and_a_town_have_what_very_many_rays_find() {
    let normals = [Vec3::Y, Vec3::Z, Vec3::NEG_Z, Vec3::new(0.6, 0.8, 0.0)];
    let mut squares = [0.0; 2];
    for geometry in [canyon(), town(20, 40.0, 11)] {
        let plain = Plain::new(&geometry);
        for (altitude, distribution) in [(90.0, Distribution::MoonSpencer), (35.0, Distribution::CIE_CLEAR)] {
            let description = Description { samples: 4096, ..luminous(distribution, altitude) };
            let dome = Dome::new(&description);
            let skies = [10, 40].map(|count| BandSky::new(&description, &geometry, None, count));
            for (i, normal) in normals.into_iter().cycle().take(8).enumerate() {
                let at = place(Vec3::new(1.3, if i < 4 { 0.0 } else { 3.0 }, 0.7), normal);
                let truth = dome.irradiance(&at, &plain).luminance();
                let open = dome.open_irradiance(at.normal).luminance();
                for (sky, square) in skies.iter().zip(&mut squares) {
                    let error = (sky.irradiance(&at, &Vacuum).luminance() - truth).abs();
                    let brightest = description.sky.radiance(description.sky.brightest()).luminance();
                    // An edge along the bands misplaces half of one at most, (2/N) ∫ L sin² α dα of it: π L/(2 N). Three
                    // edges (two roofs, the horizon) can be seen at once. The rays' own noise with 4096 is 0.2 %.
                    let bound = 3.0 * PI / (2.0 * sky.count as f32) * brightest + 0.002 * open;
                    assert!(error < bound, "{at:?}: {error} {bound}");
                    *square += (error / open).powi(2);
                }
            }
        }
    }
    let [coarse, fine] = squares.map(|square| (square / 32.0).sqrt());
    println!("10 bands: {coarse:.4}, 40 bands: {fine:.4} of the open light");
    // Four times as many: by first order a quarter, but for what is chance.
    assert!(fine < 0.5 * coarse);
}

/// Half a circle by looking at every triangle from many points of it.
#[test]
fn stretches_are_those_of_a_look_at_every_triangle() {
    use crate::obstacles::scenes::meets;
    let geometry = town(30, 50.0, 4);
    let description = Description { ground_height: Some(0.7), ..luminous(Distribution::CIE_CLEAR, 8.0) };
    let sky = BandSky::new(&description, &geometry, None, 9);
    let mut covered = 0;
    for (position, normal) in [
        (Vec3::new(0.3, 0.0, 0.4), Vec3::Y),
        (Vec3::new(0.3, 2.0, 0.4), Vec3::X),
        (Vec3::new(-1.3, 6.0, 1.9), Vec3::new(0.6, 0.64, -0.48)),
        (Vec3::new(0.3, 25.0, 0.4), Vec3::NEG_Y),
    ] {
        let at = place(position, normal);
        let hidden = sky.hidden(&at, &sky.solid);
        let origin = at.leave(normal, f32::INFINITY).origin.as_dvec3();
        let floor = if position.y >= 0.7 { f64::from(0.7f32) } else { f64::NEG_INFINITY };
        let world_from_plane = plane_from_world(normal).transpose();
        for band in 0..9 {
            let middle = table::middle(band, 9);
            for i in 0..101 {
                let (sin, cos) = ((f64::from(i) + 0.5) / 101.0 * std::f64::consts::PI).sin_cos();
                let direction = world_from_plane * (DVec3::X * cos + middle * sin);
                let alpha = sin.atan2(cos);
                let mut own = hidden.iter().filter(|interval| interval.band as usize == band);
                let ours = own.any(|interval| interval.from <= alpha && alpha <= interval.to);
                // Two ways of computing, and normals of f32, which are not quite of length 1.
                match meets(&geometry, (origin, f64::from(at.error)), direction, floor, 1e-6) {
                    0 => {}
                    sign => {
                        assert_eq!(ours, sign > 0, "{at:?} {band} {i}");
                        covered += usize::from(ours);
                    }
                }
            }
        }
    }
    assert!(covered > 500, "{covered}");
}

/// Lets half through.
struct Half;

impl Occlude for Half {
    fn transmittance(&self, _: &Ray) -> Spectrum {
        Spectrum::splat(0.5)
    }
}

#[test]
fn veils_are_asked_about_where_nothing_solid_is() {
    let description = luminous(Distribution::CIE_CLEAR, 50.0);
    let mut veil = boxes([(DVec3::ZERO, DVec3::splat(2.0), 0.3)]);
    veil.meshes[0].opacity = Some(Arc::new(Opacity { texture: None, factor: 0.5, cutoff: None }));
    let sky = BandSky::new(&description, &veil, None, 20);
    for normal in [Vec3::Y, Vec3::NEG_Z] {
        let e = sky.irradiance(&place(Vec3::new(0.1, 0.2, 0.3), normal), &Half);
        let half = sky.open_irradiance(normal) * 0.5;
        // One rounding for each of some 3000 rays.
        assert!((e - half).map(f32::abs).max() <= 3000.0 * f32::EPSILON * half.max());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn more_in_the_way_never_lets_more_through(
        (x, y, z) in (-15.0f32..15.0, 0.0f32..12.0, -15.0f32..15.0),
        height in -1.0f32..1.0,
        turn in 0.0..2.0 * PI,
    ) {
        let across = (1.0 - height * height).sqrt();
        let at = place(Vec3::new(x, y, z), Vec3::new(across * turn.cos(), height, across * turn.sin()).normalize());
        let description = luminous(Distribution::CIE_CLEAR, 40.0);
        let more = town(30, 40.0, 5);
        let fewer = Geometry { instances: more.instances[..12].to_vec(), ..more.clone() };
        let [some, many] = [&fewer, &more]
            .map(|geometry| BandSky::new(&description, geometry, None, 12).irradiance(&at, &Vacuum));
        let open = BandSky::new(&description, &more, None, 12).open_irradiance(at.normal);
        for band in 0..SPECTRAL {
            // Sums in f64, rounded once.
            let over = 1.0 + f32::EPSILON;
            prop_assert!(0.0 <= many[band] && many[band] <= some[band] * over && some[band] <= open[band] * over);
        }
    }
}

#[test]
fn odd_places_are_finite() {
    let sky = BandSky::new(&luminous(Distribution::CIE_CLEAR, 40.0), &canyon(), None, 8);
    for normal in [Vec3::ZERO, Vec3::NAN, Vec3::NEG_Y, Vec3::X] {
        for position in [Vec3::ZERO, Vec3::NAN, Vec3::splat(1e30), Vec3::new(0.0, 9.0, -6.0)] {
            let e = sky.irradiance(&place(position, normal), &Vacuum);
            assert!(e.is_finite() && e.0.iter().all(|&band| band >= 0.0), "{position} {normal}");
        }
    }
}
