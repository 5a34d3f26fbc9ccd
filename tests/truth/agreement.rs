//! Scanline and rays answer the same question: the same picture, and every pixel that differs is explained.

use keikan::pipeline::Monitor;
use keikan_tests::{luminances, pipeline};

const PARK: &str = include_str!("../../crates/cli/scenes/park.toml");
const SIZE: (u32, u32) = (160, 100);

/// Luminance with shadowless, skyless light, so that what differs is visibility alone.
fn picture(visibility: &str, samples: &str) -> (Vec<f32>, Vec<usize>) {
    let set = [
        ("visibility", visibility),
        ("samples", samples),
        ("sub-scanlines", "16"),
        ("shading", "span"),
        ("shadows", "off"),
        ("sky.model", "uniform"),
        ("sun.samples", "1"),
    ];
    let (plan, pipeline) = pipeline(PARK, SIZE, &set);
    let film = pipeline.render(&plan.region, false, &Monitor::default()).unwrap();
    let mut faces = vec![std::collections::BTreeSet::new(); (SIZE.0 * SIZE.1) as usize];
    pipeline.see.see(0..SIZE.1, 0..SIZE.0, &mut |row, pieces| {
        for piece in pieces {
            faces[(row * SIZE.0 + piece.column) as usize].insert((piece.hit.instance, piece.hit.triangle));
        }
    });
    (luminances(&film), faces.iter().map(std::collections::BTreeSet::len).collect())
}

#[test]
fn every_pixel_that_differs_is_explained() {
    let samples = 256u32;
    let (exact, faces) = picture("scanline", "1");
    let (sampled, _) = picture("rays", &samples.to_string());
    let brightest = exact.iter().copied().fold(0.0, f32::max);
    let (mut worst, mut unexplained) = (0.0f32, 0);
    for (i, (a, b)) in exact.iter().zip(&sampled).enumerate() {
        let difference = (a - b).abs() / brightest;
        worst = worst.max(difference);
        // A pixel with one face and no background differs only by where it is shaded: by what the light
        // changes over one pixel. One with several is a sum of areas: stratified samples know each
        // area to O(N^-3/4) per edge, the scanlines to 1/(2·16) for edges that run along them.
        let allowed = if faces[i] <= 1 { 0.01 } else { 0.01 + 1.0 / 32.0 + (samples as f32).powf(-0.75) * 2.0 };
        if difference > allowed {
            unexplained += 1;
            println!("pixel {} {}: {a} {b}, {} faces", i as u32 % SIZE.0, i as u32 / SIZE.0, faces[i]);
        }
    }
    println!("largest difference {worst:.4} of the brightest pixel");
    assert_eq!(unexplained, 0);
}
