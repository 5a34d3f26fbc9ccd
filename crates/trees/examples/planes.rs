//! A tree's planes: where they stand, how they fade as the eye rises, and what all of them hide beside the mesh they are made of.
//!
//! `cargo run --release -p keikan-trees --example planes -- [SEED]`. The tree is a spreading one of 9 m; its share is that of parallel
//! rays through a disc as wide as its crown, about the middle of the crown.

use glam::Vec3;
use keikan_trees::reference::Reference;
use keikan_trees::{Bake, Fade, Form, Growth, Placed, Setting, Shading, Stand, bake, grow};
use light::{Occlude, Ray};

/// Rays along and across the disc.
const RAYS: u32 = 96;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let seed = std::env::args().nth(1).map_or(Ok(2), |text| text.parse())?;
    let mesh = grow(&Growth::usual(Form::Spreading, 9.0, seed)).ok_or("such a tree does not grow")?;
    let species = bake(&mesh, &Bake { rows: 256, ..Bake::default() })?;
    let (tree, reference) = (species.description().clone(), Reference::new(&mesh));
    let [base, top] = tree.envelope.heights();
    println!(
        "{} triangles, {} KB of pictures; crown from {base:.1} to {top:.1} m",
        mesh.triangle_count(),
        species.bytes() / 1000
    );
    let heights: Vec<_> = tree.slices.iter().map(|slice| format!("{:.2}", slice.height)).collect();
    println!(
        "one vertical plane of {:.1} × {:.1} m; horizontal ones at {} m\n",
        2.0 * tree.half_width,
        tree.height,
        heights.join(", ")
    );

    let mut stands = Vec::new();
    for fade in [Fade::Thesis, Fade::Density, Fade::Opaque] {
        let placed = Placed { species: 0, position: Vec3::ZERO, height: tree.height, rotation: 0.0 };
        let setting = Setting { fade, ..Setting::default() };
        stands.push(Stand::new(vec![species.clone()], vec![placed])?.with(setting, Shading::Leaves));
    }
    println!(
        "elevation | cos θ: vertical, horizontal | hidden: mesh |  as the thesis fades |  density |  opaque"
    );
    for elevation in [0.0f32, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0] {
        let (sin, cos) = elevation.to_radians().sin_cos();
        let [toward, up] = [Vec3::new(0.0, sin, cos), Vec3::new(0.0, cos, -sin)];
        let middle = Vec3::Y * (0.5 * (base + top));
        let radius = tree.envelope.widest();
        // The mean of what parallel rays from `toward` lose.
        let hidden = |left: &dyn Fn(&Ray) -> f32| {
            let offset = |i: u32| (i as f32 + 0.5) / RAYS as f32 * 2.0 - 1.0;
            let at = (0..RAYS * RAYS).map(|i| (offset(i % RAYS), offset(i / RAYS)));
            let inside: Vec<_> = at.filter(|(x, y)| x * x + y * y < 1.0).collect();
            let sum: f32 = inside
                .iter()
                .map(|&(x, y)| {
                    let from = middle + (Vec3::X * x + up * y) * radius + toward * 50.0;
                    1.0 - left(&Ray::new(from, -toward))
                })
                .sum();
            sum / inside.len() as f32
        };
        let through_mesh = |ray: &Ray| {
            reference.through(ray.origin.as_dvec3(), ray.direction.as_dvec3(), 0.0, f64::INFINITY) as f32
        };
        print!("{elevation:8.0}° | {:15.2}, {sin:10.2} | {:12.3}", cos.max(0.0), hidden(&through_mesh));
        for stand in &stands {
            print!(" | {:8.3}", hidden(&|ray| stand.transmittance(ray).mean()));
        }
        println!();
    }
    Ok(())
}
