use super::*;
use crate::daylight::diffuse_illuminance;
use crate::horizontal_illuminance;

fn at_altitude(degrees: f32) -> Vec3 {
    let h = degrees.to_radians();
    Vec3::new(0.0, h.sin(), -h.cos())
}

#[test]
fn explore() {
    for h in [2.0, 5.0, 6.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 75.0, 85.0] {
        let sky = AirSky::new(&Air::CLEAR, at_altitude(h), 0.0);
        let ours = horizontal_illuminance(&sky);
        let ies = diffuse_illuminance(1.0, h.into());
        println!("{h} {ours} {:.3}", ours / ies);
    }
}
mod photons;

fn gas(optics: &Optics, band: usize) -> photons::Gas {
    photons::Gas {
        coefficients: [optics.molecules[band], optics.aerosol[band], optics.ozone_depth(band) / 20_000.0],
        scales: [optics.air.molecule_scale_height, 1200.0],
        aerosol_albedo: optics.air.aerosol_albedo,
        aerosol_phase: |cos| {
            let q = 0.5 + 0.5 * cos;
            (0.0446 + 0.263 * q.powi(8) + 0.373 * q.powi(64)) / 0.999_79
        },
        ground_albedo: optics.air.ground_albedo,
    }
}

#[test]
fn mc() {
    let optics = Optics::new(&Air::CLEAR);
    for h in [2.0f32, 5.0, 10.0] {
        let sky = AirSky::with(&optics, at_altitude(h), 0.0);
        let single = AirSky::new(&Air { multiple: false, ..Air::CLEAR }, at_altitude(h), 0.0);
        for band in [0, 6] {
            let ours = crate::open_sky::horizontal(|d| sky.radiance(d)[band].into()) / optics.sun[band];
            let one = crate::open_sky::horizontal(|d| single.radiance(d)[band].into()) / optics.sun[band];
            let [mean, error] =
                gas(&optics, band).sky(at_altitude(h).as_dvec3(), 60_000, &mut photons::Random(1));
            println!(
                "{h} {band}: {one:.5} {ours:.5} {mean:.5} ± {error:.5} {:.3} ± {:.3}",
                ours / mean,
                error / mean
            );
        }
    }
}
