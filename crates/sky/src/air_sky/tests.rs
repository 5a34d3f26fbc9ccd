use super::*;
use crate::daylight::diffuse_illuminance;
use crate::horizontal_illuminance;
use crate::open_sky::horizontal;
use crate::solar_spectrum;

mod photons;
mod reference;

fn at_altitude(degrees: f64) -> Vec3 {
    let h = degrees.to_radians();
    Vec3::new(0.0, h.sin() as f32, -h.cos() as f32)
}

fn direction(altitude: f64, azimuth_from_sun: f64) -> Vec3 {
    let (h, a) = (altitude.to_radians(), azimuth_from_sun.to_radians());
    Vec3::new((h.cos() * a.sin()) as f32, h.sin() as f32, (-h.cos() * a.cos()) as f32)
}

fn irradiance(sky: &AirSky, band: usize) -> f64 {
    horizontal(|d| sky.radiance(d)[band].into())
}

const SINGLE: Air = Air { multiple: false, ..Air::CLEAR };

#[test]
fn the_clear_sky_has_the_illuminances_of_the_ies() {
    // RP-21, medians of widely spread measurements (a square root of sin h); 15 % is the aim that the air's
    // turbidity, ozone and aerosol were chosen by, and what they reach: lowest at 5°, highest around 20°.
    for altitude in [5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 75.0, 85.0] {
        let [whole, single] = [Air::CLEAR, SINGLE]
            .map(|air| horizontal_illuminance(&AirSky::new(&air, at_altitude(altitude), 0.0)));
        let ies = diffuse_illuminance(1.0, altitude);
        println!(
            "{altitude:4}° {whole:6.0} lx (once scattered {single:6.0}), IES {ies:6.0}, {:.3}",
            whole / ies
        );
        assert!((whole / ies - 1.0).abs() < 0.15, "{altitude}: {whole} {ies}");
    }
}

#[test]
fn the_thesis_air_gives_what_an_independent_computation_of_its_equations_gives() {
    // (altitude, illuminance of the sky, luminance of the zenith) by summing 380 to 780 nm in steps of 20 nm with
    // the optical depths of N = 2.5473e25, H = 7994 m and Peck and Reeder's index.
    for (altitude, lux, zenith) in
        [(10.0, 4083.0, 595.0), (30.0, 6913.0, 1151.0), (60.0, 8656.0, 2909.0), (90.0, 9104.0, 4376.0)]
    {
        let sky = AirSky::new(&Air::THESIS, at_altitude(altitude), 0.0);
        let ours = horizontal_illuminance(&sky);
        let up = f64::from(sky.radiance(Vec3::Y).luminance());
        // The sum's steps of 20 nm through the sun's lines, and 0.900 for a ratio that is 0.897 to 0.903.
        assert!((ours / lux - 1.0).abs() < 0.01, "{altitude}: {ours} {lux}");
        assert!((up / zenith - 1.0).abs() < 0.01, "{altitude}: {up} {zenith}");
    }
}

#[test]
fn single_scattering_is_that_of_a_plain_sum() {
    for (air, elevation) in [(SINGLE, 0.0), (Air::THESIS, 0.0), (Air { turbidity: 0.3, ..SINGLE }, 2000.0)] {
        let optics = Optics::new(&air);
        for sun in [60.0, 5.0, 0.0, -4.0] {
            let sky = AirSky::with(&optics, at_altitude(sun), elevation);
            for (altitude, azimuth) in [(90.0, 0.0), (40.0, 30.0), (15.0, 170.0), (1.0, 60.0), (5.0, 0.0)] {
                let d = direction(altitude, azimuth);
                for band in [0, 6] {
                    let exact = reference::radiance(&optics, band, d, at_altitude(sun), elevation);
                    let ours = f64::from(sky.radiance(d)[band]);
                    // The plain sum's steps and 32 points along a ray make 0.5 %, the slant columns' 3e-4 of depths
                    // up to 10 as much; the table, with multiple scattering left out and the sun on the horizon or
                    // below, 2 %: there light falls to 1/e within 15° of azimuth. What is dark (below a thousandth of
                    // the zenith, where the orders that are left out here shine) is as wrong as that.
                    let zenith = f64::from(sky.radiance(Vec3::Y)[band]);
                    let bound = if sun > 0.0 { 0.01 * exact } else { 0.03 * exact + 1e-3 * zenith };
                    assert!(
                        (ours - exact).abs() < bound,
                        "{sun} {altitude} {azimuth} {band}: {ours} {exact}"
                    );
                }
            }
        }
    }
}

fn gas(optics: &Optics, band: usize) -> photons::Gas {
    photons::Gas {
        coefficients: [optics.molecules[band], optics.aerosol[band], optics.ozone_depth(band) / 20_000.0],
        scales: [optics.air.molecule_scale_height, 1200.0],
        aerosol_albedo: optics.air.aerosol_albedo,
        aerosol_phase: |cos| {
            let q = 0.5 + 0.5 * cos;
            // The printed constants' integral is 0.99979.
            (0.0446 + 0.263 * q.powi(8) + 0.373 * q.powi(64)) / 0.999_79
        },
        ground_albedo: optics.air.ground_albedo,
    }
}

#[test]
fn all_orders_together_are_those_of_single_paths_of_light() {
    let hazy = Air { turbidity: 0.2, aerosol_albedo: 0.9, ground_albedo: 0.5, ..Air::CLEAR };
    for (air, suns) in [(Air::CLEAR, [5.0, 40.0]), (hazy, [10.0, 70.0])] {
        let optics = Optics::new(&air);
        for sun in suns {
            let sky = AirSky::with(&optics, at_altitude(sun), 0.0);
            for band in [0, 6] {
                let ours = irradiance(&sky, band) / optics.sun[band];
                let toward = at_altitude(sun).as_dvec3();
                let [mean, error] = gas(&optics, band).sky(toward, 15_000, &mut photons::Random(1));
                println!("{sun}° band {band}: {ours:.5}, paths {mean:.5} ± {error:.5}");
                // Three standard errors, and 2 % for phase functions cut short and for the grids.
                assert!(
                    (ours - mean).abs() < 3.0 * error + 0.02 * mean,
                    "{sun} {band}: {ours} {mean} ± {error}"
                );
            }
        }
    }
}

/// Flux through the top of the air, upwards, in one band.
fn flux_up(optics: &Optics, sun: f64) -> f64 {
    let orders = Orders::new(optics, sun);
    let r = GLOBE + 90_000.0;
    // From straight down to the globe's rim, and on to where the thin air beside it ends, 60 km high.
    let rim = |height: f64| -(1.0 - ((GLOBE + height) / r).powi(2)).sqrt();
    let mut sum = 0.0;
    let ranges = [(-1.0, rim(0.0), 24), (rim(0.0), rim(60_000.0), 24)];
    let points = ranges.iter().flat_map(|&(from, to, count)| {
        crate::gauss::points(count)
            .into_iter()
            .map(move |(t, weight)| (from + (to - from) * t, (to - from) * weight))
    });
    for (mu, weight) in points {
        let path = Path::whole(optics, r, mu, STATIONS);
        for k in 0..12 {
            let across = (std::f64::consts::PI * (f64::from(k) + 0.5) / 12.0).cos();
            let between = mu * sun.sin() + (1.0 - mu * mu).sqrt() * sun.cos() * across;
            let view = View { optics, orders: Some(&orders), sun: sun.sin(), between };
            let phases = [rayleigh(between as f32), optics.air.aerosol_phase.value(between as f32), 1.0];
            let [molecules, aerosol] = view.once(&path);
            let integrals = [molecules, aerosol, view.again(&path)];
            let radiance: f64 = integrals.iter().zip(phases).map(|(i, p)| i[0] * f64::from(p)).sum();
            sum += radiance * mu.abs() * weight * std::f64::consts::TAU / 12.0;
        }
    }
    sum
}

#[test]
fn light_is_neither_made_nor_lost_where_nothing_absorbs() {
    let air = Air { aerosol_albedo: 1.0, ozone: 0.0, ground_albedo: 0.0, ..Air::CLEAR };
    let optics = Optics::new(&air);
    for degrees in [30.0f64, 60.0] {
        let sun = degrees.to_radians();
        let sky = AirSky::with(&optics, at_altitude(degrees), 0.0);
        let direct = optics.sunlight(GLOBE, sun.sin())[0] * sun.sin();
        let down = irradiance(&sky, 0) + direct;
        // The top is a wider sphere than the ground: of what leaves it, per area of ground.
        let up = flux_up(&optics, sun) * ((GLOBE + 90_000.0) / GLOBE).powi(2);
        let whole = optics.sun[0] * sun.sin();
        println!("{degrees}°: down {:.4}, up {:.4}", down / whole, up / whole);
        // A globe lit from one side is not a plane: light crosses between places under higher and lower suns, by
        // the air's height (8 km) over the globe's radius times tan of the sun's angle from the zenith: 0.2 %. And
        // the quadratures, 0.5 %.
        assert!(((down + up) / whole - 1.0).abs() < 0.007, "{degrees}: {}", (down + up) / whole);
    }
}

#[test]
fn bands_are_near_spectra_in_steps_of_5_nm() {
    // A band has width σ: ½ (m 4τ σ/λ)² of what has come through air mass m, 3e-4 m² in the bluest: under a sun 5°
    // high m = 10, and near the horizon with the ray's own path 13, so 5 %. Luminance hardly sees it.
    for (sun, bound, luminance) in [(20.0, 0.005, 0.001), (5.0, 0.05, 0.0025)] {
        let directions = [(90.0, 0.0), (30.0, 90.0), (5.0, 30.0), (1.0, 180.0)];
        let table = |optics: &Optics| {
            let sky = AirSky::with(optics, at_altitude(sun), 0.0);
            directions.map(|(h, a)| sky.radiance(direction(h, a)))
        };
        let ours = table(&Optics::new(&SINGLE));
        let mut spectra = [const { Vec::new() }; 4];
        for group in 0..10 {
            let nm: Wide = std::array::from_fn(|k| 380.0 + 5.0 * (8 * group + k) as f64);
            for (spectrum, values) in spectra.iter_mut().zip(table(&Optics::at(&SINGLE, nm))) {
                spectrum.extend(nm.iter().zip(values.0).map(|(&nm, value)| (nm, f64::from(value))));
            }
        }
        for (ours, spectrum) in ours.iter().zip(&spectra) {
            let exact = Spectrum::from_table(spectrum);
            let errors: Vec<f32> = (0..BANDS).map(|band| ours[band] / exact[band] - 1.0).collect();
            let error = ours.luminance() / exact.luminance() - 1.0;
            println!("{sun}°: bands {errors:.4?}, luminance {error:+.5}");
            assert!(errors.iter().all(|error| error.abs() < bound) && error.abs() < luminance);
        }
    }
}

#[test]
fn the_table_is_within_its_stated_error() {
    for (sun, bound) in [(60.0f64, 0.002), (10.0, 0.002), (0.0, 0.01), (-4.0, 0.01)] {
        let optics = Optics::new(&Air::CLEAR);
        let sky = AirSky::with(&optics, at_altitude(sun), 0.0);
        let orders = Orders::new(&optics, sun.to_radians());
        let mut worst = (0.0f64, 0.0, 0.0);
        for i in 0..300 {
            // Spread by the golden ratio, closer at the horizon.
            let share = (f64::from(i) + 0.5) / 300.0;
            let (altitude, azimuth) = (90.0 * share * share, (f64::from(i) * 111.246).rem_euclid(180.0));
            let d = direction(altitude, azimuth);
            let between = d.as_dvec3().dot(at_altitude(sun).as_dvec3());
            let path = Path::rising(&optics, GLOBE, f64::from(d.y), 0.0, STATIONS);
            let view = View { optics: &optics, orders: Some(&orders), sun: sun.to_radians().sin(), between };
            let integrals = view.integrals(&path);
            let phases = [rayleigh(between as f32), optics.air.aerosol_phase.value(between as f32), 1.0];
            for band in 0..BANDS {
                let exact: f64 = integrals.iter().zip(phases).map(|(i, p)| i[band] * f64::from(p)).sum();
                let error = (f64::from(sky.radiance(d)[band]) / exact - 1.0).abs();
                if error > worst.0 {
                    worst = (error, altitude, azimuth);
                }
            }
        }
        println!("{sun}°: {:.2} %, {:.1}° high {:.0}° from the sun", 100.0 * worst.0, worst.1, worst.2);
        assert!(worst.0 < bound, "{sun}: {worst:?}");
    }
}

#[test]
fn dusk_has_no_step_and_no_sun_anywhere_breaks_anything() {
    for altitude in [0.0, -0.26, -2.0, -6.0, -17.9] {
        let [a, b] = [0.005, -0.005].map(|d| AirSky::new(&Air::CLEAR, at_altitude(altitude + d), 0.0));
        for (h, azimuth) in [(90.0, 0.0), (10.0, 0.0), (0.0, 180.0), (30.0, 100.0)] {
            let [a, b] = [&a, &b].map(|sky| sky.radiance(direction(h, azimuth)));
            for band in 0..BANDS {
                // Of light that falls by a factor of 10 in 2.5° at most (0.01 · ln 10 · 0.41 = 1 %), doubled for where the
                // globe's shadow passes; or so dark that it is nothing: a millionth of starlight.
                let difference = (a[band] - b[band]).abs();
                assert!(
                    difference <= 0.03 * a[band].max(b[band]) + 1e-16,
                    "{altitude} {h} {azimuth} {band}: {a:?} {b:?}"
                );
            }
        }
    }
    for sun in [90.0, -5.0, -90.0] {
        for (turbidity, elevation) in [(0.0, 0.0), (1.0, 8000.0), (1.0, 0.0)] {
            let sky = AirSky::new(&Air { turbidity, ..Air::CLEAR }, at_altitude(sun), elevation);
            for (h, azimuth) in [(90.0, 0.0), (10.0, 0.0), (0.0, 180.0), (-40.0, 100.0), (sun, 0.0)] {
                let light = sky.radiance(direction(h, azimuth));
                assert!(light.is_finite() && light.0.iter().all(|&band| band >= 0.0), "{sun} {h}: {light:?}");
            }
        }
    }
}

/// The largest difference to the CIE clear sky above 10° and further than `excluded` \[degrees\] from the sun, each
/// divided by its own maximum there, at 550 nm.
fn against_cie(air: &Air, sun: f64, excluded: f64) -> f64 {
    let optics = Optics::at(air, [550.0; BANDS]);
    let sky = AirSky::with(&optics, at_altitude(sun), 0.0);
    let mut pairs = Vec::new();
    for h in (10..=90).step_by(2) {
        for a in (0..=180).step_by(4) {
            let d = direction(h.into(), a.into());
            if f64::from(d.angle_between(at_altitude(sun))).to_degrees() > excluded {
                let cie = crate::Distribution::CIE_CLEAR.relative_luminance(d, at_altitude(sun));
                pairs.push((f64::from(sky.radiance(d)[0]), f64::from(cie)));
            }
        }
    }
    let largest = pairs.iter().fold((0.0f64, 0.0f64), |m, p| (m.0.max(p.0), m.1.max(p.1)));
    pairs.iter().map(|p| (p.0 / largest.0 - p.1 / largest.1).abs()).fold(0.0, f64::max)
}

#[test]
fn the_thesis_claim_of_20_percent_holds_where_it_does_and_the_repaired_haze_keeps_to_11() {
    let repaired = Air::REPAIRED;
    for sun in [10.0, 30.0, 50.0, 60.0, 90.0] {
        let [thesis, whole] = [20.0, 0.0].map(|excluded| against_cie(&Air::THESIS, sun, excluded));
        let own = against_cie(&repaired, sun, 2.5);
        println!("{sun}°: thesis {thesis:.3} (with the sun's surroundings {whole:.3}), repaired {own:.3}");
        assert!(thesis <= 0.20, "{sun}: {thesis}");
        assert!(own <= 0.11, "{sun}: {own}");
    }
    // Next to the sun the claim fails: the CIE's cusp against Gibbons' flat lobe (figure 4.3 leaves it out).
    assert!(against_cie(&Air::THESIS, 60.0, 0.0) > 0.4);
}

#[test]
fn the_sky_is_blue_away_from_the_sun_and_red_towards_it_at_dusk() {
    let blue = |light: Spectrum| light[0] / light[7];
    let day = AirSky::new(&Air::CLEAR, at_altitude(40.0), 0.0);
    let sun = Spectrum(std::array::from_fn(|band| solar_spectrum::extraterrestrial()[band]));
    assert!(blue(day.radiance(direction(50.0, 180.0))) > 1.5 * blue(sun));
    assert!(blue(day.radiance(direction(2.0, 90.0))) < blue(day.radiance(direction(50.0, 180.0))));
    let dusk = AirSky::new(&Air::CLEAR, at_altitude(-3.0), 0.0);
    assert!(blue(dusk.radiance(direction(1.0, 0.0))) < blue(sun));
    assert!(blue(dusk.radiance(Vec3::Y)) > 1.5 * blue(sun), "the blue hour, by ozone");
}
