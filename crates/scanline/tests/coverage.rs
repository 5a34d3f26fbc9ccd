//! How exact is a pixel's coverage? Against the area of polygon ∩ pixel.

mod common;

use common::{placed, soup, stage, totals};
use glam::{DVec2, DVec3, Vec3};
use keikan_scanline::{Knobs, Rule, Shading, reference};
use light::{Projection, View};

const SIZE: u32 = 24;

/// Parallel, one pixel a metre, so that edges on the screen are those of the world.
fn flat() -> View {
    let half_height = 0.5 * f64::from(SIZE);
    View {
        projection: Projection::Orthographic { half_height },
        ..View::look_at(DVec3::ZERO, -DVec3::Z, 60.0, SIZE, SIZE)
    }
}

/// 150 triangles of all directions, corners from the R₂ sequence (Roberts 2018: steps 1/φ, 1/φ² with φ³ = φ + 1).
fn triangles() -> Vec<[Vec3; 3]> {
    let phi = 1.324_717_957_244_746_f64;
    let corner = |i: u32| {
        let at = |step: f64| ((f64::from(i) * step).fract() - 0.5) * 22.0;
        Vec3::new(at(1.0 / phi) as f32, at(1.0 / (phi * phi)) as f32, -5.0)
    };
    (0..150).map(|i| [3 * i, 3 * i + 1, 3 * i + 2].map(corner)).collect()
}

/// 100 rectangles with upright and level sides, at fractional positions, of R₂ corners.
fn rectangles() -> Vec<Vec<Vec3>> {
    let corners: Vec<Vec3> = triangles().concat();
    let of = |pair: &[Vec3]| {
        let (a, c) = (pair[0], pair[1]);
        vec![a, Vec3::new(c.x, a.y, -5.0), c, Vec3::new(a.x, c.y, -5.0)]
    };
    corners.chunks_exact(2).take(100).map(of).collect()
}

/// 100 bars of `width` pixels that rise by `rise` (of their length) and less, at all heights.
fn bars(width: f32, rise: f32) -> Vec<Vec<Vec3>> {
    let corners: Vec<Vec3> = triangles().concat();
    let bar = |(i, c): (usize, &Vec3)| {
        let lean = 10.0 * rise * (i as f32 / 50.0 - 1.0);
        let at = |x: f32, y: f32| Vec3::new(x, 0.5 * c.y + y, -5.0);
        vec![at(-9.3, -lean), at(9.1, lean), at(9.1, lean + width), at(-9.3, width - lean)]
    };
    corners.iter().take(100).enumerate().map(bar).collect()
}

/// Root of the mean squared error of coverage over all pixels that an edge of a convex polygon passes through.
fn rmse(polygons: &[Vec<Vec3>], rule: Rule, sub_scanlines: u32) -> f64 {
    let (mut sum, mut count) = (0.0, 0u32);
    for corners in polygons {
        let fan: Vec<_> = (2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]).collect();
        let geometry = placed(soup(&fan));
        let on_screen = |p: &Vec3| flat().screen_from_view(p.as_dvec3());
        let polygon: Vec<DVec2> = corners.iter().map(on_screen).map(|c| DVec2::new(c.x, c.y)).collect();
        let knobs = Knobs { sub_scanlines, rule, shading: Shading::PerPixel };
        let totals = totals(&stage(geometry, flat(), knobs), SIZE, SIZE);
        for (i, total) in (0..).zip(totals) {
            let area = reference::area(&polygon, i % SIZE, i / SIZE);
            if area > 1e-9 && area < 1.0 - 1e-9 {
                sum += (total - area).powi(2);
                count += 1;
            }
        }
    }
    (sum / f64::from(count)).sqrt()
}

#[test]
fn the_exact_rule_is_the_best_one() {
    let scenes = [
        ("triangles", triangles().iter().map(|t| t.to_vec()).collect()),
        ("rectangles", rectangles()),
        ("wires of 0.3 pixels", bars(0.3, 1.0)),
        ("nearly level bars", bars(3.0, 0.1)),
    ];
    println!("RMSE of coverage at edges: strips, trapezoid, midpoint, exact");
    for (name, polygons) in &scenes {
        let of = |rule, strips| rmse(polygons, rule, strips);
        for strips in [1, 2, 4, 8, 16] {
            let (trapezoid, midpoint) = (of(Rule::Trapezoid, strips), of(Rule::Midpoint, strips));
            let exact = of(Rule::Exact, strips);
            println!("{name:<20} {strips:>2}  {trapezoid:.6}  {midpoint:.6}  {exact:.9}");
            // Corners are f32: off by 24 · 2⁻²⁴ pixels. So are slopes, which move a border in its strip as if by
            // 2⁻²⁴ of that. A corner that bends a border by less than 0.02 pixels is not cut at: it changes the
            // area by half of that times half a strip, and this in one or two of some 30 pixels.
            assert!(exact < 0.02 / 4.0 / f64::from(strips) / 30f64.sqrt(), "{exact}");
            if *name == "triangles" {
                assert!(midpoint < trapezoid);
                // Worst edge, horizontal: the error is even within ±h/2, its root mean square h/√12.
                assert!(trapezoid < 1.0 / (12f64.sqrt() * f64::from(strips)));
            }
        }
    }
}

#[test]
fn an_upright_edge_is_exact() {
    let square = [
        [Vec3::new(-3.3, -9.0, -5.0), Vec3::new(4.7, -9.0, -5.0), Vec3::new(4.7, 9.0, -5.0)],
        [Vec3::new(-3.3, -9.0, -5.0), Vec3::new(4.7, 9.0, -5.0), Vec3::new(-3.3, 9.0, -5.0)],
    ];
    let stage = stage(placed(soup(&square)), flat(), Knobs { sub_scanlines: 1, ..Knobs::default() });
    let totals = totals(&stage, SIZE, SIZE);
    let row = &totals[(10 * SIZE) as usize..(11 * SIZE) as usize];
    // −3.3 as an f32 is at 12 − 3.3 = 8.7 of the picture: 0.3 of pixel 8. Three f32 roundings.
    assert!((row[8] - 0.3).abs() < 3.0 * 4.0 * f64::from(f32::EPSILON), "{}", row[8]);
    assert!((row[16] - 0.7).abs() < 3.0 * 4.0 * f64::from(f32::EPSILON), "{}", row[16]);
}

/// A wall at depth 5, and one that passes through it along the line a x + b y = c on the screen.
#[test]
fn where_faces_cross_each_has_its_area() {
    for (a, b, c) in [(1.0f32, 0.37, 14.2), (0.04, 1.0, 12.3), (-0.3, 0.9, 5.1)] {
        let wall = |z: &dyn Fn(f32, f32) -> f32| {
            let at = |x: f32, y: f32| Vec3::new(x - 12.0, 12.0 - y, z(x, y));
            let [p, q, r, s] = [at(-20.0, -20.0), at(44.0, -20.0), at(44.0, 44.0), at(-20.0, 44.0)];
            [[p, q, r], [p, r, s]]
        };
        let [level, tilted] = [wall(&|_, _| -5.0), wall(&|x, y| -5.0 + 0.01 * (a * x + b * y - c))];
        let geometry = placed(soup(&[level, tilted].concat()));
        let stage = stage(geometry, flat(), Knobs { sub_scanlines: 1, ..Knobs::default() });
        let mut nearer = vec![0.0; (SIZE * SIZE) as usize];
        for (row, piece) in common::picture(&stage, 0..SIZE, 0..SIZE) {
            if piece.hit.triangle >= 2 {
                nearer[(row * SIZE + piece.column) as usize] += f64::from(piece.share);
            }
        }
        // The half plane a x + b y > c, as a large square on its side of the line.
        let (normal, c) = (DVec2::new(a.into(), b.into()), f64::from(c));
        let foot = normal * (c / normal.length_squared());
        let (along, out) = (normal.perp().normalize() * 99.0, normal.normalize() * 99.0);
        let square = [foot - along, foot + along, foot + along + out, foot - along + out];
        for (i, share) in (0..).zip(nearer) {
            let area = reference::area(&square, i % SIZE, i / SIZE);
            // Depths are f32: wrong by 5 · 2⁻²⁴ m where the walls part by 0.01 m per pixel.
            let bound = 8.0 * 5.0 * f64::from(f32::EPSILON) / 0.01;
            assert!((share - area).abs() <= bound, "{a} {b} at {i}: {share} {area}");
        }
    }
}

/// Terrain whose faces are about a pixel wide: corners are too many to cut at.
#[test]
fn rough_outlines_are_no_worse_than_by_the_midpoint_rule() {
    let octave = |k: i32, x: f32, z: f32| {
        let f = 0.02 * 2f32.powi(k);
        (f * x + 1.3 * k as f32).sin() * (f * z - 0.7 * k as f32).cos() * 12.0 * 0.45f32.powi(k)
    };
    let hills = common::terrain(150, 400.0, |x, z| (0..8).map(|k| octave(k, x, z)).sum());
    let view = View::look_at(DVec3::new(0.0, 22.0, 60.0), DVec3::new(0.0, 14.0, 0.0), 40.0, 160, 100);
    let totals = |rule, sub_scanlines| {
        let knobs = Knobs { sub_scanlines, rule, shading: Shading::PerPixel };
        totals(&stage(placed(hills.clone()), view, knobs), 160, 100)
    };
    let truth = totals(Rule::Midpoint, 64);
    println!("RMSE of coverage at outlines of terrain: strips, midpoint, exact");
    for strips in [1, 2, 4, 8] {
        let of = |rule| {
            let found = totals(rule, strips);
            // Rounding to f32 leaves filled pixels a few 10⁻⁷ below 1.
            let partly = || found.iter().zip(&truth).filter(|(_, t)| **t > 1e-5 && **t < 1.0 - 1e-5);
            let sum: f64 = partly().map(|(f, t)| (f - t).powi(2)).sum();
            (sum / partly().count() as f64).sqrt()
        };
        let (midpoint, exact) = (of(Rule::Midpoint), of(Rule::Exact));
        println!("{strips:>2}  {midpoint:.4}  {exact:.4}");
        assert!(exact < midpoint);
    }
}
