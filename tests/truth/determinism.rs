//! Same input, same bits: threads, regions and layers change nothing.

use keikan::pipeline::{Monitor, Region};
use keikan_tests::pipeline;
use light::Spectrum;

const SCENE: &str = include_str!("../../crates/cli/scenes/park.toml");
const SIZE: (u32, u32) = (97, 61);

fn bits(pixels: &[Spectrum]) -> Vec<u32> {
    pixels.iter().flat_map(|pixel| pixel.0.map(f32::to_bits)).collect()
}

fn with_threads(threads: usize) -> Vec<u32> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let (plan, pipeline) = pipeline(SCENE, SIZE, &[]);
        bits(&pipeline.render(&plan.region, false, &Monitor::default()).unwrap().layers[0].pixels)
    })
}

#[test]
fn one_two_and_five_threads_make_the_same_picture() {
    let one = with_threads(1);
    assert_eq!(one, with_threads(2));
    assert_eq!(one, with_threads(5));
}

#[test]
fn a_region_is_a_part_of_the_picture() {
    for visibility in ["scanline", "rays"] {
        let (plan, pipeline) = pipeline(SCENE, SIZE, &[("visibility", visibility), ("samples", "4")]);
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
    let (plan, pipeline) = pipeline(SCENE, SIZE, &[]);
    let film = pipeline.render(&plan.region, true, &Monitor::default()).unwrap();
    assert_eq!(film.layers.len(), pipeline.sources.len() + 2);
    for (i, whole) in film.layers[0].pixels.iter().enumerate() {
        let sum: Spectrum = film.layers[1..].iter().map(|layer| layer.pixels[i]).sum();
        // The same products, summed in another order: some hundred roundings of the largest term.
        assert!((sum - *whole).map(f32::abs).max() <= 128.0 * f32::EPSILON * whole.max(), "pixel {i}");
    }
}
