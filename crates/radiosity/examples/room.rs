//! Lux in a dry, empty room under a luminous panel, without and with interreflection, and beside Φ/(S(1 − ρ)).
//!
//! `cargo run --release -p keikan-radiosity --example room`

use std::f32::consts::PI;
use std::sync::Arc;

use glam::{DAffine3, Vec3};
use keikan_radiosity::{
    Between, Cut, Interreflected, Linking, Links, Orders, Patch, Patches, Side, Source, Surfaces, direct,
    solve,
};
use light::{AreaLight, AreaShape, Geometry, Illuminate, Instance, Mesh, Place, Spectrum, Vacuum};

const SIZE: Vec3 = Vec3::new(6.0, 3.0, 4.0);
const REFLECTANCE: f32 = 0.5;

/// The room's inside alone.
struct Inside;

impl Surfaces for Inside {
    fn takes_part(&self, _: [u32; 2], side: Side) -> bool {
        side == Side::Back
    }

    fn reflectance(&self, _: &Patch) -> Spectrum {
        Spectrum::splat(REFLECTANCE)
    }
}

fn main() {
    // A box, counter-clockwise seen from outside.
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * SIZE;
    let faces = [[0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = Mesh { positions: (0..8).map(corner).collect(), triangles, ..Mesh::default() };
    let placed = Instance { mesh: 0, world_from_mesh: DAffine3::IDENTITY };
    let geometry = Geometry { meshes: vec![mesh], instances: vec![placed] };

    // 1.2 by 0.6 m of 5000 cd/m² just below the ceiling; shines down, u × v = −Y.
    let grey = Spectrum::ONE * (5000.0 / Spectrum::ONE.luminance());
    let shape = AreaShape::Rectangle { half_u: Vec3::X * 0.6, half_v: Vec3::Z * 0.3 };
    let lamp = AreaLight { shape, centre: Vec3::new(1.5, 2.99, 2.0), radiance: grey, samples: 16 };

    let patches = Arc::new(Patches::new(&geometry, &Inside, &Cut { edge: 0.4, ..Cut::default() }));
    let linking = Linking { closed: true, ..Linking::default() };
    let links = Links::new(&patches, &Between::dry(&Vacuum), &linking);
    let primary = direct(&patches, &[&lamp], &Vacuum, 6);
    let source = Source { emitted: &[], direct: &primary };
    let [three, all] =
        [Orders::Count(3), Orders::Until(1e-5)].map(|orders| solve(&patches, &links, &source, orders));

    let surface: f64 = patches.iter().map(|patch| patch.area()).sum();
    let mean = |values: &[Spectrum]| {
        let sums = patches.integral(values).map(|sum| (sum / surface) as f32);
        f64::from(Spectrum(sums).luminance())
    };
    let flux = f64::from(lamp.radiance.luminance() * PI * 1.2 * 0.6);
    println!(
        "{} patches, {} links; {flux:.0} lm in {surface:.0} m², ρ = {REFLECTANCE}",
        patches.len(),
        links.len()
    );
    println!("mean lux of all surfaces: primary {:.2} (Φ/S = {:.2})", mean(&primary), flux / surface);
    for solution in [&three, &all] {
        let found = mean(&primary) + mean(&solution.irradiance);
        let closed = flux / (surface * f64::from(1.0 - REFLECTANCE));
        println!(
            "  with {:2} orders {found:.2} of Φ/(S(1−ρ)) = {closed:.2}: {:.4}",
            solution.orders,
            found / closed
        );
    }

    let stages = [&three, &all]
        .map(|solution| Interreflected::new(&geometry, Arc::clone(&patches), &links, solution, &linking));
    println!("lux 0.85 m above the floor, z = 2 m: primary, with three orders, with all");
    for i in 0..6 {
        let position = Vec3::new(0.5 + i as f32, 0.85, 2.0);
        let desk = Place { position, error: 0.0, normal: Vec3::Y, seed: i };
        let lux = |light: &dyn Illuminate| light.irradiance(&desk, &Vacuum).luminance();
        let [direct, three, all] = [&lamp as &dyn Illuminate, &stages[0], &stages[1]].map(lux);
        println!("  x = {:.1} m: {direct:6.1} {:6.1} {:6.1}", position.x, direct + three, direct + all);
    }
}
