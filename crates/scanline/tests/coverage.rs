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

/// Root of the mean squared error of coverage over all pixels that an edge passes through.
fn rmse(triangles: &[[Vec3; 3]], rule: Rule, sub_scanlines: u32) -> f64 {
    let (mut sum, mut count) = (0.0, 0u32);
    for triangle in triangles {
        let geometry = placed(soup(&[*triangle]));
        let corners = reference::screen(&geometry, &flat(), 0, 0);
        let polygon = corners.map(|c| DVec2::new(c.x, c.y));
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
fn the_midpoint_rule_is_the_better_one() {
    let triangles = triangles();
    println!("strips  trapezoid  midpoint   (RMSE of coverage at edges)");
    for strips in [1, 2, 4, 8, 16] {
        let (trapezoid, midpoint) =
            (rmse(&triangles, Rule::Trapezoid, strips), rmse(&triangles, Rule::Midpoint, strips));
        println!("{strips:>6}  {trapezoid:.6}   {midpoint:.6}");
        assert!(midpoint < trapezoid);
        // Worst edge, horizontal: the error is even within ±h/2, its root mean square h/√12.
        assert!(trapezoid < 1.0 / (12f64.sqrt() * f64::from(strips)));
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
