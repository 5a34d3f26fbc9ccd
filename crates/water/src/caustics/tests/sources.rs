//! [`Beams`] as a source of light.

use std::sync::Arc;

use light::{Arrival, Occlude, Ray};

use super::*;

/// A sun of E = 1, with shadows.
struct Sun(Vec3);

impl Illuminate for Sun {
    fn arrivals(&self, place: &Place, occlude: &dyn Occlude, receive: &mut dyn FnMut(Arrival)) {
        let irradiance = occlude.transmittance(&place.leave(self.0, f32::INFINITY));
        receive(Arrival::Beam { toward: self.0, irradiance, radius: Some(0.0) });
    }
}

/// A square pool about x, z = `at`, 0.
fn at(x: f64, half: f32, level: f64) -> FlatWater {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let positions = corners.map(|(x, z)| Vec3::new(x * half, 0.0, z * half)).to_vec();
    let mesh = Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    let water = Water::new(Spectrum::splat(0.1), Vec::new(), 1.34).unwrap();
    FlatWater::new(water, &mesh, &DAffine3::from_translation(DVec3::new(x, level, 0.0)))
}

fn beams(waters: &[FlatWater], waves: &[Waves], source: Source, part: Part) -> Beams {
    let inner: Arc<dyn Illuminate> = match source {
        Source::At(lamp) => Arc::new(Luminaire {
            position: lamp.as_vec3(),
            world_from_luminaire: glam::Mat3::IDENTITY,
            distribution: light::Distribution::isotropic(1.0),
            spectrum: Spectrum::ONE,
            glints: false,
        }),
        Source::Toward(toward) => Arc::new(Sun(toward.as_vec3())),
        Source::Around | Source::Area(_) => unreachable!("no beams are made of these"),
    };
    let setting = Setting { cells: 16.0, width: 0.02, disc: 0.00465 };
    let waves: Vec<Arc<Waves>> = waves.iter().cloned().map(Arc::new).collect();
    Beams::new(inner, source, waters.to_vec().into(), &waves, (Rules::default(), setting, part))
}

fn place(at: DVec3, normal: Vec3) -> Place {
    Place { position: at.as_vec3(), error: 1e-6, normal, seed: 5 }
}

fn found(beams: &Beams, place: &Place) -> Vec<Arrival> {
    let mut out = Vec::new();
    beams.arrivals(place, &Vacuum, &mut |arrival| out.push(arrival));
    out
}

#[test]
fn beams_begin_where_no_wave_reaches() {
    // 48 waves of a wind: the sum of their heights is several times what they reach together.
    let wind = crate::waves::Wind { speed: 8.0, fetch: 10_000.0, toward: DVec2::X, depth: None, waves: 48 };
    let waves = Waves::new(wind.raise(3).unwrap(), DVec2::ZERO);
    let pool = at(0.0, 6.0, 0.0);
    let highest = (0..60_000u32).map(|i| {
        let [u, v] = light::sampling::lattice(i, 60_000, [0, 0]).map(|u| 12.0 * f64::from(u) - 6.0);
        waves.height(DVec2::new(u, v)).abs()
    });
    let highest = highest.fold(0.0, f64::max);
    assert!(waves.highest() > 1.5 * highest, "{} {highest}", waves.highest());
    let beams = beams(&[pool], &[waves], Source::Toward(sun(20.0)), Part::All);
    // A hundredth more than the waves reach, for crests between the points looked at.
    for y in [-1.01, 1.01].map(|share| share * highest) {
        let light = |i: u32| {
            let at = DVec3::new(0.05 * f64::from(i), y, 0.4);
            beams.irradiance(&place(at, Vec3::Y * -(y.signum() as f32)), &Vacuum)[0]
        };
        let light: Vec<f32> = (0..20).map(light).collect();
        let [least, most] =
            [light.iter().fold(9.0f32, |a, b| a.min(*b)), light.iter().fold(0.0f32, |a, b| a.max(*b))];
        // Under flat water it is the same everywhere.
        assert!(most > 1.1 * least, "{y}: as flat as can be: {least} {most}");
    }
}

#[test]
fn a_water_does_not_disturb_another() {
    // The other's level is where the first one's things stand.
    let first = at(0.0, 2.0, 0.0);
    for level in [-1.0, 0.5] {
        let others = [first.clone(), at(50.0, 2.0, level)];
        let toward = Source::Toward(sun(25.0));
        let alone = beams(std::slice::from_ref(&first), &[waves(0.025)], toward, Part::Through);
        let both = beams(&others, &[waves(0.025), waves(0.025)], toward, Part::Through);
        for i in 0..30 {
            let at = place(DVec3::new(0.1 * f64::from(i) - 1.5, -1.0, 0.1), Vec3::Y);
            assert_eq!(found(&alone, &at), found(&both, &at), "{i}");
        }
        let alone = beams(std::slice::from_ref(&first), &[waves(0.025)], toward, Part::Reflected);
        let both = beams(&others, &[waves(0.025), waves(0.025)], toward, Part::Reflected);
        for i in 0..30 {
            let at = place(DVec3::new(0.1 * f64::from(i) - 1.5, 0.5, 0.1), Vec3::NEG_Y);
            assert_eq!(found(&alone, &at), found(&both, &at), "{i}");
        }
    }
}

#[test]
fn nothing_comes_off_a_surface_into_another_water() {
    // A basin beside a wavy pond, its surface 3 m higher, reaches down below the pond's.
    let waters = [at(0.0, 2.0, 0.0), at(3.0, 1.0, 3.0)];
    let calm = Waves::default();
    let reflected = beams(
        &waters,
        &[waves(0.025), calm.clone()],
        Source::Toward(DVec3::new(-0.6, 0.8, 0.0)),
        Part::Reflected,
    );
    for i in 0..20 {
        let inside = DVec3::new(2.1 + 0.05 * f64::from(i), 1.0, 0.0);
        assert!(found(&reflected, &place(inside, Vec3::NEG_Y)).is_empty(), "{inside}");
    }
    // The same place without the basin has some: the test can fail.
    let open =
        beams(&waters[..1], &[waves(0.025)], Source::Toward(DVec3::new(-0.6, 0.8, 0.0)), Part::Reflected);
    assert!((0..20).any(|i| {
        !found(&open, &place(DVec3::new(2.1 + 0.05 * f64::from(i), 1.0, 0.0), Vec3::NEG_Y)).is_empty()
    }));
}

#[test]
fn a_surface_too_large_says_how_finely_it_is_cut() {
    let setting = Setting { cells: 64.0, width: 0.0, disc: 0.0 };
    let ripples = Waves::new(vec![Stokes::new(0.001, 0.1, DVec2::X, 0.0).unwrap()], DVec2::ZERO);
    assert_eq!(setting.cells_over(&at(0.0, 1.0, 0.0), &ripples), Some(64.0));
    assert_eq!(setting.cells_over(&at(0.0, 1.0, 0.0), &Waves::default()), None);
    // 2047 cells along 2 km: 0.1 m has a tenth of one.
    let cells = setting.cells_over(&at(0.0, 1000.0, 0.0), &ripples).unwrap();
    assert!((cells * 2000.0 / 0.1 / 2047.0 - 1.0).abs() < 1e-3, "{cells}");
}

/// A board of 0.5 m × 0.5 m.
struct Board(f32, Vec3);

impl Occlude for Board {
    fn transmittance(&self, segment: &Ray) -> Spectrum {
        let t = (self.0 - segment.origin.y) / segment.direction.y;
        let off = (segment.at(t) - self.1).abs();
        let on = t > 0.0 && t < segment.length && off.x < 0.25 && off.z < 0.25;
        if on { Spectrum::ZERO } else { Spectrum::ONE }
    }
}

#[test]
fn boards_on_either_leg_cast_shadows() {
    // A high sun, waves of 1 cm: a beam leans by less than 0.15 + slopes/4, so that 0.3 m below or above a board's middle its shadow is whole.
    let pool = [at(0.0, 3.0, 0.0)];
    let small = [waves(0.005)];
    let through = beams(&pool, &small, Source::Toward(sun(2.0)), Part::Through);
    let deep = place(DVec3::new(0.1, -1.0, 0.1), Vec3::Y);
    let off = beams(&pool, &small, Source::Toward(sun(2.0)), Part::Reflected);
    let high = place(DVec3::new(0.1, 1.0, 0.1), Vec3::NEG_Y);
    for (source, place, boards) in [(&through, deep, [-0.7, 0.3]), (&off, high, [0.7, 0.3])] {
        assert!(source.irradiance(&place, &Vacuum)[0] > 0.0);
        for y in boards {
            let over = Board(y, Vec3::new(0.1, 0.0, 0.1));
            assert!(source.irradiance(&place, &over).is_zero(), "{y}");
            let aside = Board(y, Vec3::new(1.5, 0.0, 0.1));
            assert_eq!(source.irradiance(&place, &aside), source.irradiance(&place, &Vacuum), "{y}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// At any place about two waters, one above the other and only the first with waves: in their waters, near the levels, beside them.
    #[test]
    fn parts_add_up_to_all(
        lamp in prop::option::of(prop::array::uniform3(-2.0..3.0f64)), x in -2.5..7.0f64, y in -2.0..2.5f64, z in -2.5..2.5f64,
        normal in prop::array::uniform3(-1.0..1.0f32), both in any::<bool>(),
    ) {
        let waters = [at(0.0, 2.0, 0.0), at(4.5, 2.0, 0.7)];
        let second = if both { waves(0.02) } else { Waves::default() };
        let waves = [waves(0.025), second];
        let source = lamp.map_or(Source::Toward(sun(30.0)), |lamp| Source::At(DVec3::from(lamp)));
        let normal = Vec3::from(normal).try_normalize().unwrap_or(Vec3::Y);
        let place = place(DVec3::new(x, y, z), normal);
        let of = |part| beams(&waters, &waves, source, part).irradiance(&place, &Vacuum);
        let whole = of(Part::All);
        let sum: Spectrum = [Part::Direct, Part::Reflected, Part::Through].map(of).into_iter().sum();
        for b in 0..8 {
            prop_assert!(whole[b].is_finite() && whole[b] >= 0.0);
            // f32 sums of some hundred beams.
            prop_assert!((whole[b] - sum[b]).abs() <= 1e-5 * whole[b], "{} {}", whole[b], sum[b]);
        }
    }
}
