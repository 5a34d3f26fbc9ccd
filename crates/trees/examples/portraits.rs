//! Each species as triangles and as planes, from 5 to 20 m and from above, side by side in PNGs.
//!
//! `cargo run --release -p keikan-trees --example portraits -- FOLDER [WIDTH]`

mod common;

use common::*;
use glam::{DVec2, DVec3, Vec3};
use keikan_trees::{Setting, Stand, reference::Reference};
use light::{Occlude, Path, Place, Ray, Spectrum, Surroundings, Traverse, View};

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

/// A picture of ground, sky and a tree; `tree` answers a viewing ray that ends at the ground with what it adds and lets
/// through.
fn picture(
    view: &View,
    light: &Daylight,
    occlude: &dyn Occlude,
    aa: u32,
    tree: impl Fn(&Ray, Path) -> (Spectrum, f32),
) -> image::RgbImage {
    let around = Around(light, occlude);
    image::RgbImage::from_fn(view.width, view.height, |column, row| {
        let mut sum = Vec3::ZERO;
        for i in 0..aa * aa {
            let at = DVec2::new(
                f64::from(column) + (f64::from(i % aa) + 0.5) / f64::from(aa),
                f64::from(row) + (f64::from(i / aa) + 0.5) / f64::from(aa),
            );
            let mut ray = view.ray(at);
            if ray.direction.y < 0.0 {
                ray.length = -ray.origin.y / ray.direction.y;
            }
            let behind = if ray.length.is_finite() {
                let seed = column.wrapping_mul(7919) ^ row;
                let place = Place { position: ray.at(ray.length), error: 1e-5, normal: Vec3::Y, seed };
                let mut irradiance = light.sky * std::f32::consts::PI;
                around.beams(&place, &mut |arrival| irradiance += arrival.on_plane(Vec3::Y));
                Spectrum::reflectance(Vec3::new(0.16, 0.17, 0.1)) * irradiance * std::f32::consts::FRAC_1_PI
            } else {
                Spectrum::reflectance(Vec3::new(0.55, 0.7, 1.0)) * light.sky * 3.0
            };
            let spread = (view.pixel_width(1.0) / f64::from(aa)) as f32;
            let (added, left) = tree(&ray, Path { spread, ..Path::EYE });
            let colour = (added + behind * left) * light::colour::D65;
            sum += light::colour::srgb_from_xyz(colour.xyz());
        }
        // White: a perfect white surface on level ground would be 1/π.
        let linear = sum / (aa * aa) as f32 * std::f32::consts::PI * 1.7;
        image::Rgb(
            linear.to_array().map(|c| (light::colour::encode_srgb(c.clamp(0.0, 1.0)) * 255.0 + 0.5) as u8),
        )
    })
}

/// What a mesh adds to a viewing ray and lets through.
fn through_mesh(mesh: &Reference, light: &Daylight, passed: f32, ray: &Ray) -> (Spectrum, f32) {
    let line = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let seed = ray.direction.x.to_bits() ^ ray.direction.y.to_bits().rotate_left(13);
    match mesh_radiance(mesh, light, line, passed, seed) {
        Some(radiance) => (radiance, 0.0),
        None => (Spectrum::ZERO, 1.0),
    }
}

/// The same for planes.
fn through_planes(stand: &Stand, light: &Daylight, ray: &Ray, path: Path) -> (Spectrum, f32) {
    let way = stand.way(ray, path, &Around(light, stand));
    (way.added, way.transmittance[0])
}
