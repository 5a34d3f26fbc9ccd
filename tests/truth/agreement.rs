//! Scanline and rays answer the same question: the same faces with the same shares in every pixel, and every
//! share that differs is explained by what each method cannot know.

use std::collections::BTreeMap;

use keikan_tests::pipeline;

const PARK: &str = include_str!("../../crates/cli/scenes/park.toml");
const SIZE: (u32, u32) = (160, 100);
const SAMPLES: u32 = 256;

/// Share of each face (instance, triangle) in each pixel.
fn shares(visibility: &str) -> Vec<BTreeMap<(u32, u32), f64>> {
    let samples = SAMPLES.to_string();
    let set =
        [("visibility", visibility), ("samples", &samples), ("sub-scanlines", "16"), ("sky.model", "none")];
    let (_, pipeline) = pipeline(PARK, SIZE, &set);
    let mut shares = vec![BTreeMap::new(); (SIZE.0 * SIZE.1) as usize];
    pipeline.see.see(0..SIZE.1, 0..SIZE.0, &mut |row, pieces| {
        for piece in pieces {
            let pixel: &mut BTreeMap<_, f64> = &mut shares[(row * SIZE.0 + piece.column) as usize];
            *pixel.entry((piece.hit.instance, piece.hit.triangle)).or_default() += f64::from(piece.share);
        }
    });
    shares
}

#[test]
fn every_share_that_differs_is_explained() {
    let (exact, sampled) = (shares("scanline"), shares("rays"));
    // A face whose border crosses the pixel: N jittered strata of side N^-½ know its area to the strata that
    // the border crosses, about 2 √N of them (a border in and one out), each wrong by at most its own area
    // with the deviation of a uniform sign: 2 N^-¾ is one deviation, and 4.5 of them are met once in 10⁵.
    let border = 4.5 * 2f64.sqrt() * f64::from(SAMPLES).powf(-0.75);
    // Lines 1/16 apart cannot know where between them a border that runs along them lies.
    let allowed = border + 1.0 / 32.0;
    let (mut worst, mut compared, mut differ) = (0.0f64, 0u32, 0u32);
    for (i, (lines, rays)) in exact.iter().zip(&sampled).enumerate() {
        for face in lines.keys().chain(rays.keys()) {
            let of = |pixel: &BTreeMap<_, f64>| pixel.get(face).copied().unwrap_or(0.0);
            let difference = (of(lines) - of(rays)).abs();
            compared += 1;
            differ += u32::from(difference > 1e-3);
            worst = worst.max(difference);
            // A pixel that one face fills for both methods must be that face's alone.
            let filled = lines.len() == 1 && rays.len() == 1 && of(lines) > 0.9999 && of(rays) > 0.9999;
            let allowed = if filled { 1e-5 } else { allowed };
            let at = (i as u32 % SIZE.0, i as u32 / SIZE.0);
            assert!(difference <= allowed, "pixel {at:?}, face {face:?}: {} {}", of(lines), of(rays));
        }
    }
    println!(
        "{compared} shares, {differ} differ by 0.001 or more, {worst:.4} at most ({allowed:.4} is explained)"
    );
}
