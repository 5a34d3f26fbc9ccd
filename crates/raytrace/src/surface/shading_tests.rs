use std::f32::consts::PI;

use glam::{Affine2, Vec2};
use light::{Dark, Path, Ray, Texture, Wrap, check::furnace};
use proptest::prelude::*;

use super::super::finish::{Finish, Image, NormalMap};
use super::super::phong::Phong;
use super::*;

fn direction(cos: f32, turn: f32) -> Vec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    Vec3::new(sin * turn.cos(), cos, sin * turn.sin()).normalize()
}

/// A hit on a horizontal face.
fn hit(toward_eye: Vec3) -> Hit {
    let place = Place { position: Vec3::ZERO, error: 1e-6, normal: Vec3::Y, seed: 0 };
    Hit { uv: Vec2::splat(0.5), tangent: Vec3::X, ..Hit::plain(place, toward_eye, 1.0) }
}

/// Light of radiance 1 from all around, sent as beams; mirror rays see it as well.
struct Beams {
    steps: u32,
}

impl Surroundings for Beams {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        let (across, along) = place.normal.any_orthonormal_pair();
        // Equal steps of cos² and azimuth: each stands for π/steps² of irradiance on the plane.
        for i in 0..self.steps * self.steps {
            let cos = (((i / self.steps) as f32 + 0.5) / self.steps as f32).sqrt();
            let local = direction(cos, 2.0 * PI * ((i % self.steps) as f32 + 0.5) / self.steps as f32);
            let toward = across * local.x + along * local.z + place.normal * local.y;
            let irradiance = Spectrum::splat(PI / (self.steps * self.steps) as f32 / cos);
            receive(Arrival::Beam { toward, irradiance, radius: None });
        }
    }

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        Spectrum::ONE
    }
}

/// One beam of irradiance 1 facing its source.
struct Lamp(Vec3);

impl Surroundings for Lamp {
    fn arrivals(&self, _: &Place, receive: &mut dyn FnMut(Arrival)) {
        receive(Arrival::Beam { toward: self.0, irradiance: Spectrum::ONE, radius: None });
    }

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        Spectrum::ZERO
    }
}

fn image(colour: [f32; 3]) -> Image {
    let texel = [colour[0], colour[1], colour[2], 1.0];
    let texture = Texture::new(1, 1, &[texel], [Wrap::Repeat; 2]).expect("one texel for one texel");
    Image { texture: texture.into(), transform: Affine2::IDENTITY }
}

fn finishes() -> impl Strategy<Value = Finish> {
    let colour = (0.0f32..=1.0, 0.0f32..=1.0, 0.0f32..=1.0).prop_map(Vec3::from);
    let leaf = prop_oneof![Just(0.0f32), 0.0f32..=1.0];
    let numbers = (0.0f32..=1.0, 0.0f32..=1.0, 1.0f32..3.0, leaf);
    (colour.clone(), colour, numbers).prop_map(|(base, through, (metallic, roughness, ior, transmission))| {
        Finish {
            base_colour: base,
            metallic,
            roughness,
            // Few indices, so that few tables are made.
            ior: (ior * 4.0).round() / 4.0,
            diffuse_transmission: transmission,
            diffuse_transmission_colour: through,
            ..Finish::default()
        }
    })
}

#[test]
fn a_matt_surface_reflects_its_reflectance() {
    for (cos, base) in [(1.0, Vec3::splat(0.5)), (0.3, Vec3::new(0.8, 0.2, 0.1)), (0.05, Vec3::ONE)] {
        let surface = Surface::new(Finish { base_colour: base, ior: 1.0, ..Finish::default() });
        let rho = Spectrum::reflectance(base);
        let share = furnace(&surface, &hit(direction(cos, 0.4)));
        // Rounding of a dozen operations; π and 1/π do not cancel exactly.
        assert!((share - rho).map(f32::abs).max() <= 12.0 * f32::EPSILON);
        let lit = surface.radiance(&hit(direction(cos, 0.4)), &Lamp(direction(0.7, 2.0)));
        assert!((lit - rho * (0.7 * FRAC_1_PI)).map(f32::abs).max() <= 12.0 * f32::EPSILON);
    }
}

#[test]
fn a_white_surface_loses_nothing_whatever_its_gloss() {
    for roughness in [0.0, 0.2, 0.3, 0.6, 1.0] {
        for metallic in [0.0, 0.5, 1.0] {
            let surface = Surface::new(Finish { roughness, metallic, ..Finish::default() });
            let white =
                Spectrum::reflectance(Vec3::ONE).0.iter().fold(1.0f32, |least, &band| least.min(band));
            for cos in [0.1, 0.5, 1.0] {
                let share = furnace(&surface, &hit(direction(cos, 0.0)));
                // A white metal's facets lose 1 − F_ms of what they pass on when F₀ < 1: no more than twice the loss.
                let bound = 2.0 * (1.0 - white) + 32.0 * f32::EPSILON;
                assert!(
                    (share - Spectrum::ONE).map(f32::abs).max() <= bound,
                    "{roughness} {metallic} {cos}: {share:?}"
                );
            }
        }
    }
}

#[test]
fn beams_from_all_around_bring_what_even_light_brings() {
    for (metallic, ior) in [(0.0, 1.5), (1.0, 1.5), (0.5, 2.0)] {
        for roughness in [0.5, 0.75, 1.0] {
            let base_colour = Vec3::new(0.9, 0.5, 0.2);
            let surface = Surface::new(Finish { base_colour, metallic, roughness, ior, ..Finish::default() });
            for cos in [0.2, 0.6, 1.0] {
                let hit = hit(direction(cos, 0.1));
                let even = furnace(&surface, &hit);
                let beams = surface.radiance(&hit, &Beams { steps: 256 });
                // Tables are within 0.5 % for a lobe, here both at E(o) and in Ē.
                assert!(
                    (even - beams).map(f32::abs).max() < 0.01,
                    "{metallic} {roughness} {cos}: {even:?} {beams:?}"
                );
            }
        }
    }
}

#[test]
fn polished_stone_mirrors_as_fresnel_says_and_metal_in_its_colour() {
    /// Radiance 1 along mirror rays, nothing else.
    struct Behind;
    impl Surroundings for Behind {
        fn arrivals(&self, _: &Place, _: &mut dyn FnMut(Arrival)) {}
        fn radiance(&self, ray: &Ray, path: Path) -> Spectrum {
            assert!(ray.direction.y > 0.0 && path.depth == 1 && path.share <= 1.0);
            Spectrum::ONE
        }
    }
    let stone = Surface::new(Finish { base_colour: Vec3::splat(0.1), roughness: 0.0, ..Finish::default() });
    for cos in [0.2f32, 0.5, 1.0] {
        let seen = stone.radiance(&hit(direction(cos, 0.0)), &Behind)[0];
        let exact = light::fresnel(1.5, f64::from(cos)) as f32;
        // The table's 0.5 %, and facets of width α.
        assert!((seen - exact).abs() < 0.005 + 0.0047, "{cos}: {seen} {exact}");
    }
    let copper = Vec3::new(0.95, 0.64, 0.54);
    let metal =
        Surface::new(Finish { base_colour: copper, metallic: 1.0, roughness: 0.0, ..Finish::default() });
    let seen = metal.radiance(&hit(Vec3::Y), &Behind);
    assert!((seen - Spectrum::reflectance(copper)).map(f32::abs).max() < 0.005, "the table's 0.5 %");
}

#[test]
fn light_from_behind_the_face_never_counts() {
    let surface = Surface::new(Finish { roughness: 0.3, ..Finish::default() });
    let mut leaning = hit(direction(0.6, 0.0));
    leaning.shading_normal = direction(0.7, 3.0);
    // Behind the face, but before the normal for shading.
    let behind = Vec3::new(leaning.shading_normal.x, -0.05, leaning.shading_normal.z).normalize();
    assert!(behind.dot(leaning.shading_normal) > 0.0);
    assert_eq!(surface.radiance(&leaning, &Lamp(behind)), Spectrum::ZERO);
    // And no step on the way there: light fades out over the last degrees.
    let matt = Surface::new(Finish { ior: 1.0, ..Finish::default() });
    let just_above = Vec3::new(behind.x, 1e-4, behind.z).normalize();
    assert!(matt.radiance(&leaning, &Lamp(just_above))[0] < 1e-3, "fade is below 2 cos_face / cos_shading");
}

#[test]
fn leaves_let_light_through_and_keep_the_energy() {
    let leaf = Finish { diffuse_transmission: 0.5, ior: 1.0, ..Finish::default() };
    let seen = Surface::new(leaf.clone()).radiance(&hit(Vec3::Y), &Lamp(Vec3::NEG_Y));
    let white = Spectrum::reflectance(Vec3::ONE);
    assert!((seen - white * (0.5 * FRAC_1_PI)).map(f32::abs).max() <= 12.0 * f32::EPSILON);
    let share = furnace(&Surface::new(leaf), &hit(Vec3::Y));
    assert!((share - white).map(f32::abs).max() <= 12.0 * f32::EPSILON, "half back, half through");
    assert_eq!(Surface::new(Finish::default()).radiance(&hit(Vec3::Y), &Lamp(Vec3::NEG_Y)), Spectrum::ZERO);
}

#[test]
fn lamps_shine_in_the_dark_and_textures_weigh_them() {
    let emission = Vec3::new(100.0, 200.0, 50.0);
    let lamp = Finish { emission, emission_texture: Some(image([1.0, 0.5, 1.0])), ..Finish::default() };
    let seen = Surface::new(lamp).radiance(&hit(Vec3::Y), &Dark).luminance();
    let expected = 0.2126 * 100.0 + 0.7152 * 100.0 + 0.0722 * 50.0;
    // 16-bit texels, and the luminance of a normalised light.
    assert!((seen / expected - 1.0).abs() < 1e-4, "{seen}");
}

#[test]
fn textures_and_vertex_colours_multiply() {
    let red = Finish { ior: 1.0, base_texture: Some(image([1.0, 0.0, 0.0])), ..Finish::default() };
    let mut hit = hit(Vec3::Y);
    hit.vertex_colour = Vec3::splat(0.5);
    let share = furnace(&Surface::new(red), &hit);
    let expected = Spectrum::reflectance(Vec3::new(0.5, 0.0, 0.0));
    assert!((share - expected).map(f32::abs).max() < 1e-4, "16-bit texels");
    let metal = image([0.0, 0.5, 0.25]);
    let both = Finish { metallic: 1.0, metallic_roughness_texture: Some(metal), ..Finish::default() };
    let read = both.metal_and_roughness_at(&hit);
    assert!((read - Vec2::new(0.25, 0.5)).abs().max_element() < 1e-4, "blue and green");
}

#[test]
fn normal_maps_lean_with_the_image() {
    // (1, 0, 1) in the map: towards growing u; (0, 1, 1): towards shrinking v.
    let map = |colour, turn: f32| {
        let mut image = image(colour);
        image.transform = Affine2::from_angle(turn);
        NormalMap { image, scale: 1.0 }
    };
    let diagonal = std::f32::consts::FRAC_1_SQRT_2;
    let right = map([0.5 + 0.5 * diagonal, 0.5, 0.5 + 0.5 * diagonal], 0.0);
    let up = map([0.5, 0.5 + 0.5 * diagonal, 0.5 + 0.5 * diagonal], 0.0);
    let hit = hit(Vec3::Y);
    let close = |a: Vec3, b: Vec3| assert!(a.distance(b) < 1e-4, "16-bit texels: {a} {b}");
    close(shading_normal(&hit, Some(&right)), Vec3::new(diagonal, diagonal, 0.0));
    // u to +X and outside +Y: up = outside × right = −Z.
    close(shading_normal(&hit, Some(&up)), Vec3::new(0.0, diagonal, -diagonal));
    // The image turned by 90°: its own u is where v' = ... its right lies along M⁻¹ X.
    let turned = map([0.5 + 0.5 * diagonal, 0.5, 0.5 + 0.5 * diagonal], PI / 2.0);
    close(shading_normal(&hit, Some(&turned)), Vec3::new(0.0, diagonal, -diagonal));
    // Without texture coordinates the map says nothing.
    let bare = Hit { tangent: Vec3::ZERO, ..hit };
    assert_eq!(shading_normal(&bare, Some(&right)), Vec3::Y);
}

#[test]
fn degenerate_hits_give_finite_light() {
    let surface =
        Surface::new(Finish { roughness: 0.0, metallic: f32::NAN, ior: f32::NAN, ..Finish::default() });
    for eye in [Vec3::X, direction(1e-7, 0.0), Vec3::Y] {
        for toward in [Vec3::X, Vec3::NEG_X, eye, -eye, Vec3::Y, direction(1e-7, PI)] {
            for normal in [Vec3::Y, Vec3::X, direction(0.1, 1.0)] {
                let hit = Hit { shading_normal: normal, ..hit(eye) };
                let seen = surface.radiance(&hit, &Lamp(toward));
                assert!(
                    seen.is_finite() && seen.0.iter().all(|&band| band >= 0.0),
                    "{eye} {toward} {normal}"
                );
            }
        }
    }
}

#[test]
fn phong_reflects_its_two_shares() {
    let phong = Phong { diffuse: Spectrum::splat(0.4), specular: Spectrum::splat(0.3), exponent: 20.0 };
    let even = furnace(&phong, &hit(direction(0.5, 0.0)));
    assert!((even[0] - 0.7).abs() <= 12.0 * f32::EPSILON);
    // Head on the whole highlight lies above the surface: ∫ (n+2)/(2π) cosⁿ⁺¹ dω = 1.
    let beams = phong.radiance(&hit(Vec3::Y), &Beams { steps: 256 })[0];
    // Midpoint rule in u = cos²: u^(n/2) has second derivative (n/2)(n/2 − 1) = 90, /24/256².
    assert!((beams - 0.7).abs() < 1e-4, "{beams}");
    assert!(phong.radiance(&hit(direction(0.1, 0.0)), &Beams { steps: 256 })[0] < 0.7);
}

proptest! {
    #[test]
    fn no_surface_sends_back_more_than_arrives(finish in finishes(), cos in 0.0f32..=1.0, turn in 0.0f32..6.0) {
        let share = furnace(&Surface::new(finish), &hit(direction(cos, turn)));
        prop_assert!(share.is_finite() && share.0.iter().all(|&band| band >= 0.0));
        // Rounding of some 30 operations.
        prop_assert!(share.max() <= 1.0 + 32.0 * f32::EPSILON, "{share:?}");
    }

    #[test]
    fn beams_are_reflected_alike_both_ways(finish in finishes(), a in 0.05f32..=1.0, b in 0.05f32..=1.0, turn in 0.0f32..6.0) {
        let surface = Surface::new(finish);
        let (a, b) = (direction(a, 0.3), direction(b, turn));
        let there = surface.radiance(&hit(a), &Lamp(b)) * (1.0 / b.y);
        let back = surface.radiance(&hit(b), &Lamp(a)) * (1.0 / a.y);
        // The narrowest lobe, α² = 2.2e-5, doubles the half vector's rounding and sees it against α: 1e-7/0.0047
        // relative, times some 10 where the lobe is steepest; the rest is rounding.
        let bound = 3e-4 * there.max().max(back.max()) + 1e-6;
        prop_assert!((there - back).map(f32::abs).max() <= bound, "{there:?} {back:?}");
    }
}
