//! CIE 171:2006 case 5.5, the directional transmittance of clear glass, through scene file, lamp and pipeline.

use std::path::Path;

use crate::photometry::{self, lambertian};

/// n = 1.52, no absorption. Columns: angle of incidence \[°\], two faces without and with the reflections between them:
/// mean of both polarisations of (1 − r)² and of (1 − r)/(1 + r), published to five digits.
const CASE_5_5: [[f64; 3]; 10] = [
    [0.0, 0.91665, 0.91832],
    [10.0, 0.91662, 0.91829],
    [20.0, 0.91613, 0.91790],
    [30.0, 0.91366, 0.91596],
    [40.0, 0.90545, 0.90946],
    [50.0, 0.88249, 0.89116],
    [60.0, 0.82359, 0.84347],
    [70.0, 0.68110, 0.72471],
    [80.0, 0.37094, 0.45604],
    [85.0, 0.14828, 0.24565],
];

/// Lux below a lamp, with `between` on the way, half way up.
fn lux(between: &str) -> f64 {
    let folder = photometry::folder("cie171_glass");
    photometry::write(&folder, "lambertian.ies", &lambertian(1000.0, 1));
    let text = format!(
        r#"
        [[material]]
        name = "glass"
        colour = 1
        transmission = 1
        roughness = 0
        ior = 1.52
        [[material]]
        name = "filled"
        colour = 1
        transmission = 1
        roughness = 0
        ior = 1.52
        attenuation_distance = 1
        {between}
        [[light]]
        file = "lambertian.ies"
        position = [0, 3, 0]
        [[camera]]
        position = [0, 2, 4]
        target = [0, 0, 0]
        [[sensor]]
        points = [[0, 0, 0]]
        "#
    );
    let scene = scene::parse(&text, &folder, Path::new("cie171_glass.toml")).unwrap();
    let (_, pipeline) = keikan_tests::build(&scene, (8, 8), &[]);
    keikan::lux::table(&scene, &pipeline).rows[0].total
}

#[test]
fn case_5_5_directional_transmittance() {
    let open = lux("[[model]]\nplane = { size = [0.1, 0.1] }\nposition = [9, 1, 0]");
    println!("CIE 171 case 5.5: degrees, slab here, CIE without, pane here, CIE with inner reflections");
    for [angle, without, with] in CASE_5_5 {
        let pane = lux(&format!(
            "[[model]]\nplane = {{ size = [2, 2] }}\nposition = [0.01, 1.5, 0.02]\nrotation = [{angle}, 0, 0]\nmaterial = \"glass\""
        )) / open;
        let slab = lux(&format!(
            "[[model]]\nbox = {{ size = [2, 0.006, 2] }}\nposition = [0.01, 1.5, 0.02]\nrotation = [{angle}, 0, 0]\nmaterial = \"filled\""
        )) / open;
        println!("{angle:4} {slab:9.5} {without:9.5} {pane:9.5} {with:9.5}");
        // Five digits; f32 on the way, and the angle in f32: dT/dθ < 6 a radian at 85°, times 1e-7.
        let bound = 5e-6 + 32.0 * f64::from(f32::EPSILON);
        assert!((pane - with).abs() < bound, "pane at {angle}°: {pane} {with}");
        // The shadow multiplies what unpolarised light loses at each face.
        assert!((slab - without).abs() < bound, "slab at {angle}°: {slab} {without}");
    }
}

/// A body in a sky of the same luminance everywhere: what it neither absorbs nor emits cannot be told from the sky.
fn furnace(material: &str, body: &str) -> Vec<f32> {
    let text = format!(
        r#"
        [sky]
        model = "uniform"
        albedo = 1
        illuminance = 31415.926535
        [[material]]
        name = "m"
        roughness = 0
        {material}
        [[model]]
        {body}
        material = "m"
        rotation = [20, 30, 0]
        [[camera]]
        position = [3, 4, 5]
        target = [0, 1, 0]
        "#
    );
    let set = [("ray-depth", "24"), ("ray-share", "0.0001")];
    keikan_tests::luminances(&keikan_tests::render(&text, (32, 24), &set))
}

#[test]
fn mirrors_and_glass_vanish_in_a_furnace() {
    let cube = "box = { size = [2, 2, 2] }";
    let pane = "plane = { size = [3, 3] }";
    let cases = [
        ("mirror", "colour = 1\nmetallic = 1", cube, 5e-3),
        ("pane", "colour = 1\ntransmission = 1\nior = 1.52", pane, 1e-4),
        ("glass", "colour = 1\ntransmission = 1\nior = 1.52\nattenuation_distance = 1", cube, 5e-3),
    ];
    for (name, material, body, bound) in cases {
        let seen = furnace(material, body);
        let sky = seen[0];
        // A metal's table is good to 0.5 %. Glass loses the rays that the limit on their share cuts, below 1e-4 each and at
        // most some dozens of them; panes lose nothing: sums of f32 shares and 8 bands.
        for (i, luminance) in seen.iter().enumerate() {
            assert!((luminance / sky - 1.0).abs() < bound, "{name}, pixel {i}: {luminance} {sky}");
        }
    }
}
