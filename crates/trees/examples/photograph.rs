//! A species from a photograph with alpha, level, from 45° and from above.
//!
//! `cargo run --release -p keikan-trees --example photograph -- SIDE.png OUT.png`

use glam::{DVec3, Vec3};
use keikan_trees::{Photo, Picture, Placed, Stand, from_photo};
use light::{Arrival, Occlude, Path, Place, Ray, Spectrum, Surroundings, Traverse, View};

/// A sun, and as much light again from the sky.
struct Day<'a>(&'a Stand);

impl Surroundings for Day<'_> {
    fn arrivals(&self, place: &Place, receive: &mut dyn FnMut(Arrival)) {
        let toward = Vec3::new(0.5, 0.6, 0.6).normalize();
        if toward.dot(place.normal) > 0.0 {
            let irradiance = self.0.transmittance(&place.leave(toward, f32::INFINITY)) * 3.0;
            receive(Arrival::Beam { toward, irradiance, radius: None });
        }
        receive(Arrival::Field { irradiance: Spectrum::splat(0.4 + 0.4 * place.normal.y) });
    }

    fn radiance(&self, _: &Ray, _: Path) -> Spectrum {
        Spectrum::ONE
    }
}

fn main() {
    let mut args = std::env::args().skip(1);
    let (side, out) = (args.next().expect("a photograph"), args.next().expect("a name for the picture"));
    let side = image::open(side).expect("a picture").to_rgba8();
    let texels: Vec<[u8; 4]> = side.pixels().map(|p| p.0).collect();
    let photo = Photo { height: 7.0, leaf: 0.07, reflectance: None, planes: 4, seed: 1 };
    let species = from_photo(Picture { width: side.width(), texels: &texels }, None, &photo).expect("a tree");
    let d = species.description();
    println!(
        "{:?}, half width {:.2} m, extinction {:.2}/m",
        d.side.size(),
        d.half_width,
        species.extinction()
    );
    println!("{:?}", d.envelope.knots());
    let tree = Placed { species: 0, position: Vec3::ZERO, height: 7.0, rotation: 0.0 };
    let stand = Stand::new(vec![species], vec![tree]).expect("a tree");
    let mut picture = image::RgbImage::new(900, 300);
    for (i, elevation) in [0.1f64, 0.8, 1.5].into_iter().enumerate() {
        let back = DVec3::new(0.0, elevation.sin(), elevation.cos());
        let target = DVec3::Y * 3.5;
        let view = View::look_at(target + back * 20.0, target, 28.0, 300, 300);
        for at in (0..300u32).flat_map(|y| (0..300u32).map(move |x| (x, y))) {
            let ray = view.ray(glam::DVec2::new(f64::from(at.0) + 0.5, f64::from(at.1) + 0.5));
            let path = Path { spread: view.pixel_width(1.0) as f32, ..Path::EYE };
            let seen = stand.way(&ray, path, &Day(&stand)).bring(Spectrum::splat(0.6)) * light::colour::D65;
            let rgb = light::colour::srgb_from_xyz(seen.xyz());
            let code = rgb.to_array().map(|c| (light::colour::encode_srgb(c.clamp(0.0, 1.0)) * 255.0) as u8);
            picture.put_pixel(at.0 + 300 * i as u32, at.1, image::Rgb(code));
        }
    }
    picture.save(out).expect("a picture that can be written");
}
