//! Same input, same bits: threads, regions and layers change nothing.

use keikan::pipeline::{Monitor, Region};
use keikan_tests::pipeline;
use light::Spectrum;

const PARK: &str = include_str!("../../crates/cli/scenes/park.toml");

/// What looks at bodies in several places and follows rays: a ball that mirrors, a clear body with a bore, two lamps.
const BODIES: &str = r#"
    [sky]
    model = "uniform"
    illuminance = 100
    [[material]]
    name = "floor"
    colour = 0.5
    [[material]]
    name = "mirror"
    colour = 0.9
    roughness = 0
    metallic = 1
    [[material]]
    name = "glass"
    colour = 1
    roughness = 0
    transmission = 1
    ior = 1.52
    [[model]]
    name = "ground"
    plane = { size = [8, 8] }
    material = "floor"
    [[solid]]
    name = "ball"
    sphere = { radius = 0.7 }
    position = [-0.9, 0.7, 0]
    material = "mirror"
    [[solid]]
    name = "ring"
    difference = ["whole", "bore"]
    [[solid]]
    name = "whole"
    cylinder = { radius = 0.6, height = 1.2 }
    position = [0.8, 0.01, 0.2]
    material = "glass"
    [[solid]]
    name = "bore"
    cylinder = { radius = 0.3, height = 2 }
    position = [0.8, -0.1, 0.2]
    material = "glass"
    [[light]]
    name = "left"
    position = [-2, 3, 2]
    intensity = 300
    temperature = 2700
    [[light]]
    name = "right"
    position = [3, 2, 1]
    intensity = 200
    temperature = 5000
    [[camera]]
    position = [0.5, 2, 4]
    target = [0, 0.5, 0]
"#;

/// Turbid water with waves that gather light, a lamp above and one below, sky, and light from face to face.
const POND: &str = r#"
    [settings]
    interreflection = "patches"
    "interreflection.patches" = 300
    [settings.water.caustics]
    cells = 8
    [sky]
    model = "uniform"
    illuminance = 100
    [[model]]
    plane = { size = [6, 6] }
    position = [0, -1.5, 0]
    [[model]]
    box = { size = [1, 3, 6] }
    position = [-3, -1.5, 0]
    [[model]]
    box = { size = [0.3, 2, 0.3] }
    position = [0.4, -1.5, -0.5]
    [[water]]
    quality = "jerlov-5C"
    polygon = { points = [[-3, 0, -3], [3, 0, -3], [3, 0, 3], [-3, 0, 3]] }
    waves = [{ amplitude = 0.02, wavelength = 0.8, direction = 60 }]
    [[light]]
    name = "above"
    position = [1, 2, 1]
    intensity = 300
    temperature = 2700
    [[light]]
    name = "below"
    position = [-1, -0.8, 1]
    intensity = 50
    temperature = 5000
    [[camera]]
    position = [2.5, 2, 4]
    target = [0, -0.3, 0]
"#;

const SCENES: [&str; 3] = [PARK, BODIES, POND];

const SIZE: (u32, u32) = (97, 61);

fn bits(pixels: &[Spectrum]) -> Vec<u32> {
    pixels.iter().flat_map(|pixel| pixel.0.map(f32::to_bits)).collect()
}

fn with_threads(scene: &str, threads: usize) -> Vec<u32> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let (plan, pipeline) = pipeline(scene, SIZE, &[]);
        bits(&pipeline.render(&plan.region, false, &Monitor::default()).unwrap().layers[0].pixels)
    })
}

#[test]
fn one_two_and_five_threads_make_the_same_picture() {
    for scene in SCENES {
        let one = with_threads(scene, 1);
        assert!(one == with_threads(scene, 2) && one == with_threads(scene, 5));
    }
}

#[test]
fn a_region_is_a_part_of_the_picture() {
    for (scene, visibility) in SCENES.into_iter().flat_map(|scene| ["scanline", "rays"].map(|by| (scene, by)))
    {
        let (plan, pipeline) = pipeline(scene, SIZE, &[("visibility", visibility), ("samples", "4")]);
        let whole = pipeline.render(&plan.region, false, &Monitor::default()).unwrap();
        let region = Region { columns: 13..70, rows: 5..48 };
        let part = pipeline.render(&region, false, &Monitor::default()).unwrap();
        for row in 0..43 {
            let from_whole = &whole.layers[0].pixels[(row + 5) * 97 + 13..][..57];
            assert_eq!(
                bits(from_whole),
                bits(&part.layers[0].pixels[row * 57..][..57]),
                "{visibility}, row {row}"
            );
        }
    }
}

#[test]
fn layers_sum_to_the_picture() {
    SCENES.into_iter().for_each(layers_sum);
}

fn layers_sum(scene: &str) {
    let (plan, pipeline) = pipeline(scene, SIZE, &[]);
    let film = pipeline.render(&plan.region, true, &Monitor::default()).unwrap();
    assert_eq!(film.layers.len(), pipeline.sources.len() + 2);
    for (i, whole) in film.layers[0].pixels.iter().enumerate() {
        let sum: Spectrum = film.layers[1..].iter().map(|layer| layer.pixels[i]).sum();
        // The same products, summed in another order: some hundred roundings of the largest term.
        assert!((sum - *whole).map(f32::abs).max() <= 128.0 * f32::EPSILON * whole.max(), "pixel {i}");
    }
}
