//! Lamps in other waters, beside a water, and partly in one.

use light::{AreaLight, AreaShape, Vacuum};

use super::*;

fn lit(lamp: DVec3, waters: &Arc<[FlatWater]>) -> Lit {
    Lit::new(Box::new(luminaire(lamp)), Source::At(lamp), Arc::clone(waters), Rules::default())
}

fn place(at: DVec3, toward: DVec3) -> Place {
    let normal = (toward - at).normalize_or(DVec3::Y).as_vec3();
    Place { position: at.as_vec3(), error: 0.0, normal, seed: 3 }
}

/// Two squares, 4 m across and 10 m apart, levels 0 and `second`.
fn two(second: f64) -> Arc<[FlatWater]> {
    let water = || grey(0.3, 0.5, Phase::petzold());
    let corners = [(-2.0, -2.0), (-2.0, 2.0), (2.0, 2.0), (2.0, -2.0)];
    let positions = corners.map(|(x, z)| Vec3::new(x, 0.0, z)).to_vec();
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    let far = DAffine3::from_translation(DVec3::new(10.0, second, 0.0));
    Arc::new([square(water(), 2.0, 0.0), FlatWater::new(water(), &mesh, &far)])
}

#[test]
fn a_lamp_in_one_water_gives_another_nothing() {
    for second in [3.0, 0.0, -1.0] {
        let waters = two(second);
        let lamp = DVec3::new(10.0, second - 0.5, 0.0);
        let lit = lit(lamp, &waters);
        for at in [DVec3::new(0.0, -1.0, 0.0), DVec3::new(1.0, -0.2, 1.0)] {
            for toward in [lamp, at + DVec3::Y] {
                assert!(lit.irradiance(&place(at, toward), &Vacuum).is_zero(), "{second}: {at}");
            }
            let ray = Ray { origin: at.as_vec3(), direction: Vec3::NEG_Y, length: 1.0 };
            assert!(lit.scattered(&ray, &Vacuum).is_zero(), "{second}: {at}");
        }
        // In the air over the first it has what comes through the second's surface, and no mirror image.
        let over = DVec3::new(9.0, second + 2.0, 0.0);
        let up = place(over, over + DVec3::NEG_Y);
        let alone = Lit::new(
            Box::new(luminaire(lamp)),
            Source::At(lamp),
            Arc::new([waters[1].clone()]),
            Rules::default(),
        );
        assert_eq!(lit.irradiance(&up, &Vacuum), alone.irradiance(&up, &Vacuum));
        assert!(!lit.irradiance(&up, &Vacuum).is_zero());
    }
}

#[test]
fn a_lamp_beside_a_water_below_its_level_shines_in_through_its_side() {
    let waters: Arc<[FlatWater]> = Arc::new([square(grey(0.3, 0.5, Phase::petzold()), 2.0, 0.0)]);
    let lamp = DVec3::new(5.0, -1.0, 0.0);
    let lit = lit(lamp, &waters);
    let at = DVec3::new(1.0, -1.0, 0.0);
    let got = lit.irradiance(&place(at, lamp), &Vacuum)[3];
    // 4 m of which one is in water.
    let expected = waters[0].water.loss(Loss::Diffuse).attenuate(1.0)[3] / 16.0;
    assert!((got / expected - 1.0).abs() < 1e-5, "{got} {expected}");
    // Straight only: a place that looks up sees no mirror image of it.
    assert!(lit.irradiance(&place(at, at + DVec3::Y), &Vacuum).is_zero());
    // In air it is as anywhere.
    let dry = DVec3::new(4.0, -1.0, 0.0);
    assert!((lit.irradiance(&place(dry, lamp), &Vacuum)[3] - 1.0).abs() < 1e-6);
}

#[test]
fn a_lamp_that_the_surface_cuts_is_its_two_halves() {
    let waters: Arc<[FlatWater]> = Arc::new([square(grey(0.3, 0.5, Phase::petzold()), 3.0, 0.0)]);
    // An upright panel of 20 cm × 20 cm that shines towards −x, and its upper and lower halves.
    let panel = |y: f32, half: f32| AreaLight {
        shape: AreaShape::Rectangle { half_u: Vec3::Z * 0.1, half_v: Vec3::Y * half },
        centre: Vec3::new(2.0, y, 0.0),
        radiance: Spectrum::ONE,
        samples: 4096,
    };
    let of =
        |lamp: AreaLight| Lit::new(Box::new(lamp), Source::Area(lamp), Arc::clone(&waters), Rules::default());
    let [whole, upper, lower] = [panel(0.0, 0.1), panel(0.05, 0.05), panel(-0.05, 0.05)].map(of);
    let turned = Lit::new(
        Box::new(AreaLight {
            shape: AreaShape::Rectangle { half_u: Vec3::Y * 0.1, half_v: Vec3::Z * 0.1 },
            ..panel(0.0, 0.1)
        }),
        Source::Area(AreaLight {
            shape: AreaShape::Rectangle { half_u: Vec3::Y * 0.1, half_v: Vec3::Z * 0.1 },
            ..panel(0.0, 0.1)
        }),
        Arc::clone(&waters),
        Rules::default(),
    );
    for at in [DVec3::new(0.0, -0.8, 0.3), DVec3::new(-0.5, 0.9, -0.2)] {
        for toward in [DVec3::new(2.0, 0.0, 0.0), DVec3::new(2.0, -at.y, 0.0)] {
            let place = place(at, toward);
            let parts: Vec<f32> =
                [&whole, &upper, &lower, &turned].map(|lit| lit.irradiance(&place, &Vacuum)[3]).into();
            let sum = parts[1] + parts[2];
            // The lattices that stand for them differ, and shine from one side or from the other.
            if sum > 0.0 {
                assert!((parts[0] / sum - 1.0).abs() < 0.01, "{at}: {parts:?}");
            } else {
                assert_eq!(parts[0], 0.0);
            }
        }
    }
    assert!(
        [DVec3::new(0.0, -0.8, 0.3), DVec3::new(4.0, -0.8, 0.3)]
            .iter()
            .any(|at| { !whole.irradiance(&place(*at, DVec3::new(2.0, 0.0, 0.0)), &Vacuum).is_zero() })
    );
}
