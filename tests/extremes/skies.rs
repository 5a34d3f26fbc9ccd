//! Every sky from deep night to noon, every direction.

use std::sync::Arc;

use glam::Vec3;
use light::{Illuminate, Place, Vacuum};
use sky::{Conditions, DIAMETER_DEG, Description, Dome, Model, Sun, bouguer, horizontal_illuminance};

use crate::ledger::{Ledger, inputs};

fn toward(altitude: f64, azimuth: f64) -> Vec3 {
    let ((sin, cos), (s, c)) = (altitude.to_radians().sin_cos(), azimuth.sin_cos());
    Vec3::new((cos * s) as f32, sin as f32, -(cos * c) as f32)
}

#[test]
fn skies() {
    let ledger = Ledger::new("sky");
    for model in Model::all() {
        for altitude in [-90.0, -6.0, 0.0, 0.3, 20.0, 90.0] {
            let sky = model.sky(&Conditions::new(toward(altitude, 0.0)));
            let at = (model.name(), altitude);
            for [elevation, azimuth] in inputs([(-90.0, 90.0), (0.0, std::f64::consts::TAU)], 60) {
                let radiance = sky.radiance(toward(elevation, azimuth));
                let sound = radiance.is_finite() && radiance.0.iter().all(|band| *band >= 0.0);
                ledger.holds("radiance is finite and not negative", sound, (at, elevation, azimuth));
            }
            let lux = horizontal_illuminance(&*sky);
            let dome = Dome::new(&Description { albedo: 0.0, ..Description::new(Arc::clone(&sky)) });
            let open = f64::from(dome.open_irradiance(Vec3::Y).luminance());
            // The stated error of the table of open planes.
            ledger.note(
                "open planes against a sum over the sky",
                (open - lux).abs() / lux.max(1e-9),
                1.2e-3,
                at,
            );
            ledger.holds("no more than the sun outside the air", lux < 134_000.0, (at, lux));
        }
    }
    ledger.close();
}

#[test]
fn suns() {
    let ledger = Ledger::new("sun");
    for [altitude, diameter, tilt] in inputs([(-90.0, 90.0), (0.0, 90.0), (0.0, 180.0)], 3000) {
        let sun = Sun {
            toward: toward(altitude, 0.0),
            irradiance: light::Spectrum::ONE,
            angular_diameter_deg: diameter as f32,
            samples: 4,
        };
        let place = Place { position: Vec3::ZERO, error: 0.0, normal: toward(90.0 - tilt, 1.0), seed: 7 };
        let found = sun.irradiance(&place, &Vacuum)[0];
        ledger.holds(
            "a plane gets no more than faces the sun",
            (0.0..=1.000_01).contains(&found),
            (altitude, diameter, tilt),
        );
    }
    let mut before: Option<f32> = None;
    for step in 0..=2000 {
        let altitude = -1.0 + f64::from(step) * 1e-3;
        let sun = Sun {
            toward: toward(altitude, 0.0),
            irradiance: light::Spectrum::ONE,
            angular_diameter_deg: DIAMETER_DEG,
            samples: 16,
        };
        let facing = Place { position: Vec3::ZERO, error: 0.0, normal: sun.toward, seed: 1 };
        let found = sun.irradiance(&facing, &Vacuum)[0];
        if let Some(before) = before {
            // Half a degree of disc in 533 steps: at most 4/π of the mean step.
            ledger.note("it rises without a jump", f64::from((found - before).abs()), 0.003, altitude);
        }
        before = Some(found);
    }
    for [transmittance, altitude] in inputs([(0.0, 1.0), (-90.0, 90.0)], 5000) {
        let direct = bouguer::direct_normal(1.0, transmittance, altitude);
        let sky = bouguer::sky_horizontal(1.0, transmittance, altitude);
        let sin = altitude.max(0.0).to_radians().sin();
        ledger.note(
            "Bouguer and Nagata give no more than comes",
            (direct * sin + sky - sin).max(0.0),
            1e-9,
            (transmittance, altitude),
        );
    }
    ledger.close();
}
