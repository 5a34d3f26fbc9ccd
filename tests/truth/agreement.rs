//! Scanline and rays answer the same question: the same picture, and every pixel that differs is explained.

use std::collections::BTreeSet;

use keikan::pipeline::Monitor;
use keikan_tests::{luminances, pipeline};

const PARK: &str = include_str!("../../crates/cli/scenes/park.toml");
const SIZE: (u32, u32) = (160, 100);

/// What stands for the background among the faces of a pixel.
const BACKGROUND: (u32, u32) = (u32::MAX, 0);

/// What one way of seeing says: luminance, and the faces in each pixel. Light without shadows from a plain
/// sky and sun, so that what differs is visibility alone.
fn picture(visibility: &str, samples: &str) -> (Vec<f32>, Vec<BTreeSet<(u32, u32)>>) {
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
    let mut faces = vec![BTreeSet::new(); (SIZE.0 * SIZE.1) as usize];
    pipeline.see.see(0..SIZE.1, 0..SIZE.0, &mut |row, pieces| {
        let mut covered = vec![0.0f32; SIZE.0 as usize];
        for piece in pieces {
            covered[piece.column as usize] += piece.share;
            faces[(row * SIZE.0 + piece.column) as usize].insert((piece.hit.instance, piece.hit.triangle));
        }
        for (column, covered) in covered.into_iter().enumerate() {
            if covered < 0.9999 {
                faces[row as usize * SIZE.0 as usize + column].insert(BACKGROUND);
            }
        }
    });
    (luminances(&film), faces)
}

#[test]
fn every_pixel_that_differs_is_explained() {
    const SAMPLES: u32 = 256;
    let (exact, by_lines) = picture("scanline", "1");
    let (sampled, by_rays) = picture("rays", &SAMPLES.to_string());
    let brightest = exact.iter().copied().fold(0.0, f32::max);
    let (mut worst, mut different, mut unexplained) = (0.0f32, 0, 0);
    for (i, (a, b)) in exact.iter().zip(&sampled).enumerate() {
        let difference = (a - b).abs() / brightest;
        worst = worst.max(difference);
        different += u32::from(difference > 1e-3);
        // One face (or only background) for both: the pixel differs by where in it the face is shaded, i.e.
        // by what the light changes over one pixel. Several: a sum of areas, known to scanlines to 1/16 of a
        // pixel for edges that run along them, and to N stratified samples to about N^-¾ an edge.
        let faces: BTreeSet<_> = by_lines[i].union(&by_rays[i]).collect();
        let allowed = if faces.len() > 1 { 1.0 / 16.0 + 2.0 * (SAMPLES as f32).powf(-0.75) } else { 5e-3 };
        if difference > allowed {
            unexplained += 1;
            println!("pixel {} {}: {a} {b}, faces {faces:?}", i as u32 % SIZE.0, i as u32 / SIZE.0);
        }
    }
    println!("{different} pixels differ by 0.1 % of the brightest or more, by {:.2} % at most", 100.0 * worst);
    assert_eq!(unexplained, 0);
}
