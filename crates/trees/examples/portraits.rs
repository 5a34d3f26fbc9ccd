//! Each species as triangles and as planes, from 5 to 20 m and from above, side by side in PNGs.
//!
//! `cargo run --release -p keikan-trees --example portraits -- FOLDER [WIDTH]`

mod common;

use common::*;
use glam::{DVec3, Vec3};
use keikan_trees::{Setting, reference::Reference};
use light::View;

fn main() {
    let mut args = std::env::args().skip(1);
    let folder = args.next().expect("a folder for the pictures");
    let width: u32 = args.next().map_or(400, |w| w.parse().expect("a width"));
    let only = args.next();
    let light = Daylight::clear(Vec3::new(0.55, 0.7, 0.45).normalize(), 5);
    for (name, growth) in growths() {
        if only.as_ref().is_some_and(|only| only != name) {
            continue;
        }
        let mesh = mesh(&growth);
        let reference = Reference::new(&mesh);
        let species = species(&mesh, 4, 768);
        let d = species.description();
        println!(
            "{name}: {} triangles, {:?} texels, {:.1} MB, extinction {:.2}/m, leaf {:.3} m, scatter {:.2}, lean {:.2}, shelter {:.2}, half width {:.2} m",
            mesh.triangle_count(),
            d.side.size(),
            species.bytes() as f64 / 1e6,
            species.extinction(),
            d.leaf.size,
            d.leaf.scatter,
            d.leaf.lean,
            d.shelter,
            d.half_width
        );
        let stand = alone(species, Setting::default());
        let h = f64::from(growth.height);
        let eyes = [
            ("5m", DVec3::new(0.0, 1.6, 5.0 + f64::from(growth.spread) * 0.5), 0.38, 62.0),
            ("20m", DVec3::new(6.0, 1.6, 20.0), 0.5, 42.0),
            ("45", DVec3::new(0.0, 0.5 * h + 16.0, 16.0), 0.5, 36.0),
            ("above", DVec3::new(0.5, h + 18.0, 1.0), 0.5, 36.0),
        ];
        for (which, eye, aim, field) in eyes {
            let view = View::look_at(eye, DVec3::new(0.0, aim * h, 0.0), field, width, width * 5 / 4);
            let a =
                picture(&view, &light, &reference, 2, |ray, _| through_mesh(&reference, &light, 0.7, ray));
            let b = picture(&view, &light, &stand, 2, |ray, path| through_planes(&stand, &light, ray, path));
            let mut both = image::RgbImage::new(2 * width, view.height);
            image::imageops::replace(&mut both, &a, 0, 0);
            image::imageops::replace(&mut both, &b, i64::from(width), 0);
            both.save(format!("{folder}/{name}-{which}.png")).expect("a folder that can be written");
        }
    }
}
