//! The spans of polygons: a hexagon, a bar before it, and one that leans through both, line by line.
//!
//! `cargo run --release -p keikan-scanline --example spans` prints which face shows from which x to which x \[pixel\], exactly: nothing
//! is sampled along a line. Then it draws the same, a letter a pixel.

use std::f32::consts::TAU;
use std::sync::Arc;

use glam::{DAffine3, DVec3, Vec3};
use keikan_scanline::{Knobs, Rule, Scanline};
use light::{Geometry, Instance, Mesh, View};

const SIZE: [u32; 2] = [64, 24];

/// A convex polygon as a fan of triangles.
fn polygon(corners: Vec<Vec3>) -> Mesh {
    let triangles = (2..corners.len() as u32).map(|i| [0, i - 1, i]).collect();
    Mesh { positions: corners, triangles, ..Mesh::default() }
}

fn main() {
    let corner = |i: u16| Vec3::new((TAU * f32::from(i) / 6.0).cos(), (TAU * f32::from(i) / 6.0).sin(), -4.0);
    let bar = [(-1.6, -0.2), (1.6, 0.3), (1.6, 0.5), (-1.6, 0.0)].map(|(x, y)| Vec3::new(x, y, -3.5));
    // Near on the left, far on the right: where it passes through the others, another face shows.
    let [[a, b], [c, d]] =
        [(-1.2, -2.5), (1.6, -6.0)].map(|(x, z)| [Vec3::new(x, -0.7, z), Vec3::new(x, 0.7, z)]);
    let meshes =
        vec![polygon((0..6).map(corner).collect()), polygon(bar.to_vec()), polygon(vec![a, c, d, b])];
    let instances = (0..3).map(|mesh| Instance { mesh, world_from_mesh: DAffine3::IDENTITY }).collect();

    let view = View::look_at(DVec3::ZERO, DVec3::NEG_Z, 34.0, SIZE[0], SIZE[1]);
    let knobs = Knobs { sub_scanlines: 1, rule: Rule::Midpoint, ..Knobs::default() };
    let stage = Scanline::new(Arc::new(Geometry { meshes, instances }), view, knobs);
    let letter = |instance: u32| ['H', 'b', 'L'][instance as usize];
    for line in (0..stage.line_count()).step_by(3) {
        print!("y = {:4.1}:", stage.line(line).0);
        for span in stage.spans(line).opaque {
            let [near, far] = span.x.map(|x| -stage.point(line, &span, x).z);
            let name = letter(span.instance);
            print!("  {name} {:.3} to {:.3}, {near:.2} to {far:.2} m away;", span.x[0], span.x[1]);
        }
        println!();
    }
    println!();
    for line in 0..stage.line_count() {
        let spans = stage.spans(line).opaque;
        let at = |column: u32| {
            let x = f64::from(column) + 0.5;
            let shows = spans.iter().find(|span| span.x[0] <= x && x < span.x[1]);
            shows.map_or('.', |span| letter(span.instance))
        };
        println!("{}", (0..SIZE[0]).map(at).collect::<String>());
    }
}
