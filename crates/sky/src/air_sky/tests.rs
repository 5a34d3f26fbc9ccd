use super::*;
use crate::daylight::diffuse_illuminance;
use crate::horizontal_illuminance;

fn at_altitude(degrees: f32) -> Vec3 {
    let h = degrees.to_radians();
    Vec3::new(0.0, h.sin(), -h.cos())
}

#[test]
fn explore() {
    for (turb, alb, ground) in [(0.06, 0.9, 0.2), (0.09, 0.9, 0.2), (0.09, 1.0, 0.2), (0.12, 0.95, 0.2)] {
        let air = Air { turbidity: turb, aerosol_albedo: alb, ground_albedo: ground, ..Air::CLEAR };
        println!("{turb} {alb} {ground}");
        for h in [2.0, 5.0, 10.0, 20.0, 30.0, 45.0, 60.0, 75.0, 85.0, 90.0] {
            let t = std::time::Instant::now();
            let sky = AirSky::new(&air, at_altitude(h), 0.0);
            let dt = t.elapsed().as_secs_f64();
            let single = AirSky::new(&Air { multiple: false, ..air }, at_altitude(h), 0.0);
            let ours = horizontal_illuminance(&sky);
            let ies = diffuse_illuminance(1.0, h.into());
            println!(
                "{h:4} {ours:8.0} {:8.0} {ies:8.0} {:.3}  {:.3} s",
                horizontal_illuminance(&single),
                ours / ies,
                dt
            );
        }
    }
    println!("thesis");
    for h in [10.0, 20.0, 30.0, 60.0, 90.0] {
        let sky = AirSky::new(&Air::THESIS, at_altitude(h), 0.0);
        println!("{h:4} {:8.0} {:8.0}", horizontal_illuminance(&sky), sky.radiance(Vec3::Y).luminance());
    }
}
