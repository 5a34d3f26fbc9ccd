//! A uniform sky of luminance L lights an open plain with π L lx, and a plane turned by β with π L (1 + cos β)/2.

use std::f64::consts::PI;

use keikan_tests::{luminances, pipeline};

/// Degrees from the horizontal.
const TURNS: [f64; 7] = [0.0, 15.0, 45.0, 60.0, 90.0, 120.0, 150.0];

/// Luminance of the sky as the picture shows it \[cd/m²\], and lux at planes turned by [`TURNS`].
fn sky_and_planes(set: &[(&str, &str)]) -> (f64, Vec<f64>) {
    let mut text = String::from(
        r#"
        [sun]
        off = true
        [sky]
        model = "uniform"
        illuminance = 10000
        [[model]]
        plane = { size = [1, 1] }
        position = [0, -50, 0]
        [[camera]]
        position = [0, 2, 0]
        direction = [0.3, 1, 0.1]
        "#,
    );
    for turn in TURNS {
        let (sin, cos) = turn.to_radians().sin_cos();
        // Not along an axis: away from what a cuboid's faces are aligned with.
        let normal = [0.6 * sin, cos, 0.8 * sin];
        text += &format!("[[sensor]]\npoints = [[0, 0, 0]]\nnormal = {normal:?}\n");
    }
    let set: Vec<(&str, &str)> = set.iter().copied().chain([("sky.albedo", "0")]).collect();
    let (plan, pipeline) = pipeline(&text, (8, 8), &set);
    let film = pipeline.render(&plan.region, false, &keikan::pipeline::Monitor::default()).unwrap();
    let seen = luminances(&film);
    let sky = f64::from(seen[0]);
    assert!(seen.iter().all(|pixel| (f64::from(*pixel) / sky - 1.0).abs() < 1e-6), "not uniform: {seen:?}");
    let scene = scene::parse(&text, std::path::Path::new("."), std::path::Path::new("open.toml")).unwrap();
    let lux = keikan::lux::table(&scene, &pipeline).rows.iter().map(|row| row.total).collect();
    (sky, lux)
}

#[test]
fn a_uniform_sky_lights_a_plain_with_pi_times_its_luminance() {
    // As shares of a plain's light. The sky is made as bright as its stated illuminance by the midpoint rule on bands of altitude 1.5°
    // high: sin 0.75° Σ sin 2h = 1/(2 cos 0.75°) where ½ is right.
    let scale = 1.0 / 0.75f64.to_radians().cos() - 1.0;
    // Eight bands, f32.
    let rounding = 16.0 * f64::from(f32::EPSILON);
    // Rays: an open place is not sampled; planes are interpolated in a table, to 0.1 % as its own test states.
    // Cuboid: the midpoint rule on elements of width h, seen from its centre: h²/24 times the largest Laplacian of
    // 1/(1 + u² + v²)², which is 8; 40 of them fill the opening angle of 75°.
    let h = 2.0 * 37.5f64.to_radians().tan() / 40.0;
    // Bands: exact for the plain (Σ over equal projected widths); of 40 the turned plane's horizon cuts one, which counts as a
    // whole band or not at all.
    let methods: [(&str, &str, f64, f64); 3] = [
        ("rays", "sky.rays", 0.0, 1e-3),
        ("cuboid", "sky.elements", h * h / 3.0, h * h / 3.0),
        ("bands", "sky.bands", rounding, 0.5 / 40.0),
    ];
    for (method, knob, plain, turned) in methods {
        let (luminance, lux) = sky_and_planes(&[("sky.visibility", method), (knob, "40")]);
        for (turn, lux) in TURNS.into_iter().zip(lux) {
            let expected = PI * luminance * 0.5 * (1.0 + turn.to_radians().cos());
            let off = (lux - expected) / (PI * luminance);
            println!("{method} {turn}°: {lux:.3} lx for {expected:.3}, off by {off:.1e} of a plain's");
            let bound = scale + rounding + if turn == 0.0 { plain } else { turned };
            assert!(off.abs() <= bound, "{method} {turn}°: {lux} {expected}, {off:e} beyond {bound:e}");
        }
    }
}
