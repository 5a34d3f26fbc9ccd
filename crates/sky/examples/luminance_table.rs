//! How bright a sky is: kcd/m² by altitude and by azimuth off the sun, and the lux that it gives to level ground.
//!
//! `cargo run --release -p keikan-sky --example luminance_table -- [MODEL] [SUN_ALTITUDE]`, for instance `cie-12 40`; without
//! arguments the physical sky with the sun 40° high. Names are those of scene files (`physical`, `thesis`, `overcast`, `cie-1` …).

use glam::Vec3;
use keikan_sky::{Conditions, Model, horizontal_illuminance};

/// Unit vector so high and so far from north (−Z) to east (+X), both in degrees.
fn toward(altitude: f64, azimuth: f64) -> Vec3 {
    let [(high, level), (east, north)] = [altitude, azimuth].map(|angle| angle.to_radians().sin_cos());
    Vec3::new((level * east) as f32, high as f32, (-level * north) as f32)
}

fn main() -> Result<(), String> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "physical".to_owned());
    let model = Model::named(&name).ok_or_else(|| {
        let names: Vec<_> = Model::all().map(Model::name).collect();
        format!("no sky is called {name}; there are {}", names.join(", "))
    })?;
    let sun =
        arguments.next().map_or(Ok(40.0), |text| text.parse::<f64>().map_err(|e| format!("{text}: {e}")))?;

    let sky = model.sky(&Conditions::new(toward(sun, 180.0)));
    println!("{name}, the sun {sun}° high: {:.0} lx on level ground; kcd/m²:", horizontal_illuminance(&*sky));
    let azimuths = [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0];
    print!("altitude  off the sun:");
    azimuths.iter().for_each(|azimuth| print!("{azimuth:7.0}°"));
    println!();
    for altitude in [90.0, 75.0, 60.0, 45.0, 30.0, 15.0, 5.0, 0.0] {
        print!("{altitude:7.0}°             ");
        for azimuth in azimuths {
            let luminance = sky.radiance(toward(altitude, 180.0 + azimuth)).luminance();
            print!("{:8.2}", luminance / 1000.0);
        }
        println!();
    }
    Ok(())
}
