use light::bands::WAVELENGTHS_NM;
use proptest::prelude::*;

use super::*;

#[test]
fn every_named_water_is_possible() {
    assert_eq!(names().count(), 17);
    for name in names() {
        let water = Water::named(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        for b in 0..WAVELENGTHS_NM.len() {
            let (a, scattering, c) = (water.absorption()[b], water.scattering()[b], water.extinction()[b]);
            assert!(
                a > 0.0 && scattering > 0.0 && scattering <= c && water.diffuse()[b] <= c,
                "{name} band {b}"
            );
            assert!(
                (0.0..=1.0).contains(&water.albedo()[b]) && water.turned_back()[b] <= water.albedo()[b],
                "{name}"
            );
        }
        // β(θ) sums to b: midpoints of 1e-3 in cos θ do not see the peaks, so from 60° on, against b_b.
        let steps = 1000;
        let back: Spectrum = (0..steps).map(|i| water.volume_scattering(-(f64::from(i) + 0.5) * 1e-3)).sum();
        let back = back * (1e-3 * std::f32::consts::TAU);
        for b in 0..8 {
            // Midpoints: h²/24 · β′ at 90°, where it is steepest, 3 β; and f32.
            assert!((back[b] / water.backscattering()[b] - 1.0).abs() < 2e-5, "{name} band {b}");
        }
        assert_eq!(Water::named(&name.to_uppercase()), Ok(water));
    }
}

#[test]
fn pure_water_has_the_published_coefficients() {
    let water = Water::named("distilled").unwrap();
    // WOPP v3 at 500, 535, 570 and 605 nm: 0.0207, 0.0466, 0.0716, 0.2559. A band's mean of the curve differs from its middle
    // by its curvature: a tenth where it is smooth, more at the step at 600 nm.
    for (band, a) in [(2, 0.0207), (3, 0.0466), (4, 0.0716)] {
        assert!(
            (f64::from(water.absorption()[band]) / a - 1.0).abs() < 0.1,
            "{band}: {}",
            water.absorption()[band]
        );
    }
    // Zhang 2009 at 436.6 nm by (λ/440)^−4.2 from 3.3545e-3; the kernel's width adds 1 %.
    let b = 3.3545e-3 * (436.6f64 / 440.0).powf(-4.2);
    assert!((f64::from(water.scattering()[0]) / b - 1.0).abs() < 0.02);
    assert!((water.turned_back()[0] - 0.5 * water.scattering()[0] / water.diffuse()[0]).abs() < 1e-7);
}

#[test]
fn indices_are_quan_and_frys() {
    // (λ, S, T, n), five decimals.
    for (nm, salinity, celsius, n) in [
        (400.0, 0.0, 20.0, 1.34321),
        (450.0, 35.0, 20.0, 1.34586),
        (550.0, 0.0, 20.0, 1.33434),
        (550.0, 35.0, 20.0, 1.34079),
        (550.0, 35.0, 10.0, 1.34167),
        (700.0, 0.0, 20.0, 1.33019),
    ] {
        assert!((refractive_index(nm, salinity, celsius) - n).abs() < 6e-6, "{nm} {salinity} {celsius}");
    }
    assert!((FRESH - refractive_index(550.0, 0.0, 20.0)).abs() < 5e-5);
    assert!((SEA - refractive_index(550.0, 35.0, 20.0)).abs() < 5e-5);
}

/// Where K = a + b_b and Kirk's attenuation stand to what Jerlov measured (1976, table XXVII) at 450 and 550 nm \[1/m\]: two
/// bands lie near. Jerlov's types and the coefficients are of different waters and years.
#[test]
fn attenuation_is_of_the_order_that_jerlov_measured() {
    for (name, measured) in [
        ("jerlov-I", [0.019, 0.063]),
        ("jerlov-IA", [0.026, 0.067]),
        ("jerlov-IB", [0.036, 0.072]),
        ("jerlov-II", [0.068, 0.089]),
        ("jerlov-III", [0.135, 0.12]),
        ("jerlov-1C", [0.25, 0.12]),
        ("jerlov-3C", [0.39, 0.19]),
        ("jerlov-5C", [0.56, 0.30]),
        ("jerlov-7C", [0.89, 0.46]),
        ("jerlov-9C", [1.6, 0.63]),
    ] {
        let water = Water::named(name).unwrap();
        // Daylight enters at some 31° from the vertical under water.
        let [k, kirk] = [water.diffuse(), water.downward(0.86) * (1.0 / 0.86)].map(|k| {
            [f64::from(0.5 * (k[0] + k[1])) / measured[0], f64::from(0.6 * k[3] + 0.4 * k[4]) / measured[1]]
        });
        println!("{name}: over the measured attenuation at 450 and 550 nm: a + b_b {k:.2?}, Kirk {kirk:.2?}");
        assert!(k.iter().all(|ratio| (0.5..1.3).contains(ratio)), "detours are missing: {k:?}");
        // Williamson and Hollins' IB absorbs more (0.041 at 450 nm) than Jerlov's attenuates: 1.7.
        assert!(kirk.iter().all(|ratio| (0.65..1.75).contains(ratio)), "{kirk:?}");
    }
}

#[test]
fn the_thesis_pool_keeps_what_is_printed_but_the_phase_function() {
    let pool = Water::named("thesis-pool").unwrap();
    // Band 3 (535.9 nm) lies between green and blue: c = 0.159 − 0.026 · 12.1/88, β(90°) likewise.
    let share = (548.0 - 535.9) / (548.0 - 460.0);
    let (c, beta) = (0.159 - 0.026 * share, 2.3e-4 + 1.33e-4 * share);
    // The kernel reaches across the corner at 548 nm.
    assert!((f64::from(pool.extinction()[3]) / c - 1.0).abs() < 0.05);
    assert!((f64::from(pool.volume_scattering(0.0)[3]) / beta - 1.0).abs() < 0.02);
    assert!((f64::from(pool.scattering()[3] / pool.volume_scattering(0.0)[3]) - 16.06).abs() < 0.01);
}

#[test]
fn secchi_depths_fall_with_chlorophyll() {
    let depths =
        [0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0].map(|c| Water::of_chlorophyll(c).unwrap().secchi_depth());
    assert!(depths.windows(2).all(|w| w[0] > w[1]), "{depths:?}");
    // Case 1 waters of 0.1, 1 and 10 mg/m³ have some 30 to 40, 12 to 20 and 4 to 7 m (Morel et al. 2007): within a third.
    for (i, [low, high]) in [(1, [20.0, 50.0]), (3, [8.0, 26.0]), (5, [3.0, 9.0])] {
        assert!((low..high).contains(&depths[i]), "{depths:?}");
    }
}

#[test]
fn impossible_waters_are_refused_in_words() {
    let said = |error: QualityError| error.to_string();
    assert!(
        said(Water::named("beer").unwrap_err())
            .starts_with("no water is called 'beer'; there are pool, distilled")
    );
    assert_eq!(
        said(Water::of_chlorophyll(-1.0).unwrap_err()),
        "chlorophyll is -1 mg/m³, but must lie within 0 and 100 mg/m³"
    );
    assert!(Water::of_chlorophyll(f64::NAN).is_err() && Water::of_secchi_depth(1000.0).is_err());
    let new = |absorption, scattering, extinction| {
        said(
            Water::measured(&Measured {
                absorption,
                scattering,
                extinction,
                phase: Phase::petzold(),
                index: FRESH,
            })
            .unwrap_err(),
        )
    };
    let one: &[(f64, f64)] = &[(550.0, 1.0)];
    assert!(new(Some(one), None, None).starts_with("1 of absorption a, scattering b and extinction c"));
    assert!(new(Some(one), Some(one), Some(one)).starts_with("3 of"));
    assert_eq!(new(Some(&[]), Some(one), None), "the table of absorption is empty");
    assert!(new(Some(one), Some(&[(500.0, 1.0), (500.0, 1.0)]), None).contains("row 2"));
    assert!(new(Some(one), Some(&[(500.0, -1.0)]), None).contains("scattering in row 1 is -1"));
    assert!(new(Some(one), Some(&[(f64::NAN, 1.0)]), None).contains("row 1"));
    assert!(
        new(Some(one), None, Some(&[(550.0, 0.5)])).contains("absorption a (1 1/m) exceeds the extinction")
    );
    let sick = Water::new(Spectrum::splat(f32::NAN), vec![], 1.33).unwrap_err();
    assert!(said(sick).contains("absorption around 436.6 nm is NaN"));
    assert!(
        Water::new(Spectrum::ONE, vec![], 0.9).is_err() && Water::new(Spectrum::ONE, vec![], 1.0).is_ok()
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn two_of_three_tables_tell_the_third(a in 0.0f64..2.0, b in 0.0f64..2.0, slope in 0.0f64..1e-3) {
        let absorption = [(400.0, a), (700.0, a + 300.0 * slope)];
        let scattering = [(500.0, b)];
        let extinction = [(400.0, a + b), (700.0, a + b + 300.0 * slope)];
        let measured = |a, b, c| Measured { absorption: a, scattering: b, extinction: c, phase: Phase::water(), index: 1.34 };
        let ab = Water::measured(&measured(Some(&absorption), Some(&scattering), None)).unwrap();
        // Rounding may make b exceed c by an ulp, so a hair is added to the extinction.
        let more = extinction.map(|(nm, c)| (nm, c * (1.0 + 1e-14) + 1e-300));
        let ac = Water::measured(&measured(Some(&absorption), None, Some(&more))).unwrap();
        let bc = Water::measured(&measured(None, Some(&scattering), Some(&more))).unwrap();
        for band in 0..8 {
            // Differences of numbers of up to 4 in f64, then f32.
            prop_assert!((ab.scattering()[band] - ac.scattering()[band]).abs() <= 1e-6);
            prop_assert!((ab.absorption()[band] - bc.absorption()[band]).abs() <= 1e-6);
        }
    }

    #[test]
    fn secchi_depths_come_back(depth in 2.0f64..40.0) {
        let water = Water::of_secchi_depth(depth).unwrap();
        // f32 coefficients.
        prop_assert!((water.secchi_depth() / depth - 1.0).abs() < 1e-6);
    }
}
