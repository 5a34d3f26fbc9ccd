//! A lamp from a file lights a wall as the inverse-square law says, in lux and in the picture.

use std::f64::consts::PI;
use std::path::Path;

use crate::photometry;

/// A narrow lobe, smooth enough to be tabulated: I = 2000 cos⁴ γ.
fn candela(gamma: f64) -> f64 {
    2000.0 * gamma.cos().max(0.0).powi(4)
}

/// A wall of reflectance 0.5 in the plane z = 0, a lamp `distance` in front of it that looks at it.
fn scene(test: &str, distance: f64) -> scene::Scene {
    // Tests run side by side: each has a file of its own.
    let folder = photometry::folder(&format!("wall-{test}"));
    photometry::write(&folder, "lobe.ies", &photometry::ies(1, candela));
    let text = format!(
        r#"
        [[material]]
        name = "half"
        colour = 0.5
        [[model]]
        polygon = {{ points = [[-50, -50, 0], [50, -50, 0], [50, 50, 0], [-50, 50, 0]] }}
        material = "half"
        [[light]]
        file = "lobe.ies"
        position = [0, 0, {distance}]
        aim = [0, 0, 0]
        [[camera]]
        position = [0, 0, 12]
        target = [0, 0, 0]
        orthographic = 8
        [[sensor]]
        normal = [0, 0, 1]
        line = {{ from = [0, 0, 0], to = [4, 0, 0], count = 41 }}
        "#
    );
    scene::parse(&text, &folder, Path::new("wall.toml")).unwrap()
}

/// E = I(γ) cos γ / d² with γ the angle off the lamp's axis, which is the wall's normal.
fn expected(distance: f64, x: f64, y: f64) -> f64 {
    let d2 = distance * distance + x * x + y * y;
    let cos = distance / d2.sqrt();
    candela(cos.acos()) * cos / d2
}

#[test]
fn lux_on_a_wall_follow_the_inverse_square_law() {
    let mut worst: f64 = 0.0;
    for distance in [0.5, 1.0, 2.0, 5.0, 20.0] {
        let scene = scene("law", distance);
        let (_, pipeline) = keikan_tests::build(&scene, (8, 8), &[]);
        for row in keikan::lux::table(&scene, &pipeline).rows {
            let truth = expected(distance, row.position[0], row.position[1]);
            // Beyond 80° off the axis cos⁴ is below 1e-3 of the peak, and the table's own step shows.
            if row.position[0] / distance < 80f64.to_radians().tan() {
                worst = worst.max((row.total / truth - 1.0).abs());
            }
        }
    }
    println!("worst deviation from the inverse-square law: {worst:.2e}");
    // Linear interpolation of cos⁴ γ over h = 1°: h²/8 · |f″|/f = h²/8 · |12 tan² γ − 4|, at 80° 1.5 %…
    // asked is 0.1 % where the lamp is bright; see the next test for the whole bound.
    let h = 1f64.to_radians();
    assert!(worst <= h * h / 8.0 * (12.0 * 80f64.to_radians().tan().powi(2) - 4.0) * 1.05);
}

#[test]
fn within_45_degrees_of_the_axis_a_tenth_of_a_per_cent() {
    for distance in [0.5, 1.0, 2.0, 5.0, 20.0] {
        let scene = scene("bright", distance);
        let (_, pipeline) = keikan_tests::build(&scene, (8, 8), &[]);
        for row in keikan::lux::table(&scene, &pipeline).rows {
            if row.position[0] / distance < 45f64.to_radians().tan() {
                let truth = expected(distance, row.position[0], row.position[1]);
                // The issue's own figure; h²/8 (12 tan² 45° − 4) = 3.0e-4 is what interpolation leaves.
                assert!((row.total / truth - 1.0).abs() < 1e-3, "{row:?} {truth}");
            }
        }
    }
}

#[test]
fn the_picture_shows_the_luminance_of_those_lux() {
    let scene = scene("picture", 2.0);
    let (width, height) = (80, 80);
    let (plan, pipeline) = keikan_tests::build(&scene, (width, height), &[]);
    let film = pipeline.render(&plan.region, false, &keikan::pipeline::Monitor::default()).unwrap();
    for (i, luminance) in keikan_tests::luminances(&film).into_iter().enumerate() {
        let (column, row) = (i as u32 % width, i as u32 / width);
        let (x, y) = (f64::from(column) * 0.1 + 0.05 - 4.0, 4.0 - f64::from(row) * 0.1 - 0.05);
        if x.hypot(y) > 2.0 {
            continue;
        }
        let truth = 0.5 / PI * expected(2.0, x, y);
        // As above (3e-4), and the pixel is shaded once at its centre.
        assert!((f64::from(luminance) / truth - 1.0).abs() < 1e-3, "{column} {row}: {luminance} {truth}");
    }
}

/// The power of a table is relative: candelas say how much light there is, whatever its spectrum.
#[test]
fn a_table_of_a_spectrum_changes_the_colour_alone() {
    let lit = |colour: &str| {
        let text = format!(
            "[sun]\noff = true\n[sky]\noff = true\n[[model]]\nplane = {{ size = [4, 4] }}\n[[light]]\nposition = [0, 2, 0]\n\
             intensity = 100\n{colour}\n[[camera]]\nposition = [0, 3, 3]\ntarget = [0, 0, 0]\n[[sensor]]\npoints = [[0, 0, 0]]\n"
        );
        keikan_tests::lux(&text, &[])[0]
    };
    for spectrum in
        ["[[585, 0], [589, 1], [593, 0]]", "[[400, 30], [500, 10], [700, 90]]", "[[546, 1e-6], [547, 1e-6]]"]
    {
        let found = lit(&format!("spectrum = {spectrum}"));
        // 100 cd at 2 m; f32.
        assert!((found / 25.0 - 1.0).abs() < 1e-5, "{spectrum}: {found}");
    }
}
